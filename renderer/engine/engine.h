/* SPDX-License-Identifier: MIT */
/* Pictures without a GPU: the shaders' own functions, written as C over vectors by renderer/spmd,
 * and an interpreter of field programs. Where the device is software this takes a part of the time,
 * and nothing is compiled for a scene.
 *
 * A program is immutable, and may be used by several threads. Other calls are of one thread; those
 * that draw start threads of their own. */
#ifndef RENDERER_ENGINE_H
#define RENDERER_ENGINE_H

#include "renderer/field/field.h"
#include "renderer/glsl/interface.h"

enum { ENGINE_LEVELS = 16 };

/* A picture by longitude and latitude, with smaller ones of it. Linear light. */
struct engine_map {
    int width, height, levels;
    bool column;                     /* of each row the first texel alone is made */
    uint16_t *texels[ENGINE_LEVELS]; /* of each level, four halves for each */
    size_t bytes;                    /* of all of them */
};

enum { ENGINE_MAPS = 3 }; /* UNIT_ENVIRONMENT_MAP, UNIT_SPECULAR_MAP, UNIT_IRRADIANCE_MAP */

/* The surroundings of a scene (glsl/environment.glsl): as they are, as surfaces of each roughness
 * reflect them, and as diffuse ones receive them. `halves`: their picture, four for each texel, row
 * 0 on top, finite, 0 and above; allocated, and the maps' own from then on. NULL: the frame block's
 * colours. */
void engine_maps_make(const struct frame_uniforms *frame, uint16_t *halves, int width, int height,
                      struct engine_map out[ENGINE_MAPS]);
/* The same where the frame block's colours do not change around the vertical: of the second and the
 * third map the first column alone. */
void engine_maps_make_columns(const struct frame_uniforms *frame,
                              struct engine_map out[ENGINE_MAPS]);
void engine_maps_finish(struct engine_map maps[ENGINE_MAPS]);
/* Width or height of a level of a picture so wide or high. */
int engine_map_side(int side, int level);

struct engine_program; /* a field, ready to be run */

/* `lanes`: width of the vectors; 0: the widest that the processor has. `threads`: how many draw; 0:
 * one for each processor. NULL: the engine has no such width. Holds a reference of the field. */
struct engine_program *engine_program_create(struct field *field, int lanes, int threads);
/* The widths that the processor has, from the widest; 0 behind the last. */
int engine_lanes(size_t index);
/* Another reference, which may be used for another field of this structure. NULL: nothing. Each
 * reference has to be destroyed. */
struct engine_program *engine_program_ref(struct engine_program *program);
void engine_program_destroy(struct engine_program *program);

/* Evaluates the field at `count` points, at least one. Each point gets the tape of a cube around it
 * whose half side is at most `half`; INFINITY: the whole program. `params`: the numbers of the
 * field, which may be another of this structure. Returns the number of operations that ran, summed
 * over the points. */
uint64_t engine_distances(const struct engine_program *program, const float *params,
                          const float (*points)[3], size_t count, float half, float *out);

/* Of a field that is to be explored. */
struct engine_extent {
    float reach; /* of rays */
    float scale; /* of what is of interest */
    float least; /* half of the smallest cubes */
};

enum { ENGINE_MARGIN = 4 };
enum engine_smoothing { ENGINE_PLAIN, ENGINE_BLEND, ENGINE_ADAPTIVE, ENGINE_FULL };

struct engine_picture {
    struct engine_program *program;
    const float *params; /* of the field; it may be another of the same shape */
    const struct frame_uniforms *frame;
    const struct engine_map *maps[ENGINE_MAPS];
    uint64_t surroundings; /* identifies these maps */
    enum engine_smoothing smoothing;
    int margin;             /* pixels around a tile that are drawn too, ENGINE_MARGIN at most */
    int rays;               /* of a sample after the first */
    int transmission_depth; /* surfaces that light goes through; 0: none */
    bool shadows, lights;   /* whether they are wanted */
    bool sparse;            /* one sample, of fewer pixels where that pays; light, distances */
};

/* What pictures keep for the next of the same field. Of one thread; it outlives its canvases. */
struct engine_cubes;
struct engine_cubes *engine_cubes_create(void);
void engine_cubes_forget(struct engine_cubes *cubes);
void engine_cubes_destroy(struct engine_cubes *cubes); /* NULL: nothing */

/* What a picture keeps between its tiles: cubes of space with what matters in each, and sums of
 * samples. */
struct engine_canvas;

/* Where pixels of an output go. */
struct engine_output {
    enum output kind;
    int channels; /* of a pixel */
    bool floats;  /* else bytes */
    uint8_t *pixels;
    size_t stride; /* bytes from row to row */
};

struct engine_rect {
    int x, y, width, height;
};

/* Whether a call shall end before its tile is drawn: asked by all threads that draw, each time that
 * a few vectors of rays are drawn. */
struct engine_pause {
    bool (*wanted)(void *data); /* NULL: never */
    void *data;
};

struct engine_drawn {
    uint64_t rays;   /* reflected and refracted ones, that were followed */
    uint64_t pixels; /* of the tile, that were drawn and not copied */
    bool paused;     /* the next call shall be one with the same arguments, and goes on */
};

/* `picture` is copied; what it points to stays until the canvas is destroyed. */
struct engine_canvas *engine_canvas_create(struct engine_cubes *cubes,
                                           const struct engine_picture *picture);
/* Keeps sums of samples for the pixels of `region`, so that its tiles can get more samples
 * later. */
void engine_canvas_keep(struct engine_canvas *canvas, struct engine_rect region);
void engine_canvas_destroy(struct engine_canvas *canvas);

/* Draws samples `from` to `until` of a tile, whose earlier samples are in the kept sums. Where
 * `from` is not 0 and antialiasing is adaptive, only pixels with all earlier samples get more. One
 * call for a canvas at a time. Pixels that are known to equal those of the last picture are
 * copied. */
struct engine_drawn engine_draw(struct engine_canvas *canvas, struct engine_rect tile, int from,
                                int until, const struct engine_output *outputs, size_t count,
                                const struct engine_pause *pause);

#endif
