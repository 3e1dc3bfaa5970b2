/* SPDX-License-Identifier: MIT */
/* Draws tiles: runs the passes over their samples and reads the pixels back. Independent of scenes.
 *
 * A tile's pixels are fetched while the next one is drawn: draw_tile starts, draw_collect waits.
 * Several outputs of one tile are drawn at once and collected one by one. */
#ifndef RENDERER_DRAW_H
#define RENDERER_DRAW_H

#include "environment.h"
#include "protocol/picture.h"
#include "render_settings.h"
#include "renderer/gl/fragment_targets.h"
#include "renderer/gl/param_buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/targets.h"

enum { TILES_IN_FLIGHT = 2 }; /* tiles of one picture on their way */

/* Where the samples of a tile lie. Pictures of one sample have a set of their own, so that they may
 * come between two samples of another's tile. */
enum draw_set { DRAW_SET_ONCE, DRAW_SET_SAMPLED, DRAW_SETS };

/* The shaders that a device draws by. */
enum shader_kind { SHADER_COMPUTE, SHADER_FRAGMENT, SHADER_KINDS };

struct draw; /* targets and passes of one context */

/* An output, and how its pixels come back. */
struct output_format {
    enum aov aov;
    bool floats;
    enum output output;
    enum out_kind kind;
    GLenum read_format, read_type;
    int read_bytes;          /* of a pixel as read */
    enum program_stage last; /* of the passes that it needs */
};

/* NULL where the output has no such format. */
const struct output_format *output_format_find(enum aov aov, bool floats);

struct tile {
    int x, y, width, height; /* pixels of the picture, y down */
};

/* What a tile is drawn from. */
struct draw_scene {
    struct program *program;
    const struct param_buffer *params;
    GLuint tapes; /* 0: the program has none */
    struct environment *environment;
    const float *values;           /* the numbers in memory */
    struct engine_program *engine; /* NULL: it cannot draw this */
};

enum { DRAW_MARKS = 256 }; /* moments taken in a tile; what is beyond counts with the last */

/* A tile on its way. */
struct tile_in_flight {
    GLuint buffers[AOV_COUNT];
    GLuint rays; /* numbers of secondary rays, one for each column; 0: no fragment shaders */
    GLsync fence;
    struct tile tile;
    int samples;                /* drawn of each pixel, while there are more to come; else 0 */
    bool paused;                /* the engine has drawn a part of it */
    GLuint queries[DRAW_MARKS]; /* on a GPU: made where they are first needed */
    uint8_t stages[DRAW_MARKS]; /* what ended at each */
    int marks;
    uint8_t *pixels[AOV_COUNT]; /* drawn by the engine; else NULL */
    uint64_t last_us;           /* on the CPU: the last mark */
    uint64_t stage_us[FRAME_STAGES];
};

struct draw_backend;

/* One picture's own objects. */
struct draw_picture {
    const struct draw_backend *backend;             /* what draws it */
    enum shader_kind shader_kind;                   /* of the device, if that does */
    const struct output_format *formats[AOV_COUNT]; /* NULL: not asked for */
    struct render_settings settings;
    int lights;
    bool transmissive; /* light goes through something */
    GLuint frame;
    struct frame_uniforms *block; /* drawn by the engine; else NULL, */
    struct engine_canvas *canvas; /* and this too */
    struct tile_in_flight slots[TILES_IN_FLIGHT];
    /* Drawn in rounds: each tile gets samples `from` to `until`, and between two rounds its pixels
     * are kept in textures as large as the region that is drawn. */
    long kept_pixels; /* 0: there is one round */
    int from, until;
    GLuint kept, kept_counted; /* 0: there is one round, or the engine keeps them */
    GLuint keeper;             /* the framebuffer by which they are copied */
    int left, top;             /* of the region */
    uint64_t copied;           /* pixels that the last picture had */
};

/* `tile_side`: how many pixels a tile is wide and high, a multiple of 8; 0: what is good for the
 * device. */
struct draw *draw_create(const struct gl *gl, bool software, int tile_side);
/* Creates targets and static programs of one kind of shaders, unless they are there. Otherwise the
 * first picture of that kind creates them, and fails for the same reasons. */
bool draw_prepare(struct draw *draw, enum shader_kind shader_kind, struct error *err);
void draw_destroy(struct draw *draw);
/* The side of a picture's tiles, in pixels: the smallest side, doubled so many times, within the
 * largest that the textures hold. A device's tile and its margin share that side. */
int draw_tile_side(const struct draw *draw, const struct draw_picture *picture, int doublings);
uint64_t draw_compilations(const struct draw *draw);
/* Drops what the engine's pictures have kept for later pictures. */
void draw_forget(struct draw *draw);
/* When the engine's tiles shall pause. */
void draw_set_pause(struct draw *draw, const struct engine_pause *pause);
/* Reflected and refracted rays that were started. */
uint64_t draw_rays(const struct draw *draw);
/* Pixels that the engine has drawn, and not copied. */
uint64_t draw_pixels(const struct draw *draw);

/* `formats`: for each output NULL or its format. */
bool draw_begin(struct draw *draw, struct draw_picture *out, const struct frame_uniforms *block,
                const struct output_format *const formats[AOV_COUNT],
                const struct render_settings *settings, const struct draw_scene *scene,
                struct error *err);
void draw_end(struct draw *draw, struct draw_picture *picture);
/* The engine draws it, whose tiles pause. */
bool draw_picture_pauses(const struct draw_picture *picture);
/* Its pixels have several samples each. */
bool draw_is_sampled(const struct draw_picture *picture);
/* What is kept between rounds takes 24 or 32 bytes for each pixel. */
enum {
    DRAW_ROUNDS_PIXELS = 1 << 22,   /* of a picture, at most, */
    DRAW_ROUNDS_TOGETHER = 1 << 23, /* and of all that are drawn in rounds */
};
/* Before the first tile: the picture is drawn in rounds of ever more samples, each a whole picture,
 * while the pixels above allow it. All outputs but color keep to one round. */
void draw_in_rounds(struct draw *draw, struct draw_picture *picture, struct tile region);
/* After the last tile: false when all samples are there. */
bool draw_next_round(struct draw_picture *picture);
struct picture_rounds draw_rounds(const struct draw_picture *picture);
/* Draws the first sample of each pixel, or goes on where the last round ended. If `samples` of the
 * slot is not 0 afterwards, the tile is unfinished, and draw_tile_more draws one more sample. Until
 * `samples` is 0, no other sampled picture may be drawn. A `paused` tile is unfinished too:
 * draw_tile_more goes on, and any other picture may be drawn meanwhile. */
bool draw_tile(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
               struct tile tile, int slot, struct error *err);
bool draw_tile_more(struct draw *draw, struct draw_picture *picture, const struct draw_scene *scene,
                    int slot, struct error *err);
/* Waits for the tile in `slot`. True when it is there; its times are in the slot then. */
bool draw_wait(struct draw *draw, struct draw_picture *picture, int slot, struct error *err);
/* After draw_wait: copies the rows of one output to `to`, which are `stride` bytes apart. */
bool draw_collect(struct draw *draw, struct draw_picture *picture, int slot, enum aov aov,
                  uint8_t *to, size_t stride, struct error *err);

#endif
