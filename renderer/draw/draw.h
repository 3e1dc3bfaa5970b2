/* SPDX-License-Identifier: MIT */
/* Draws tiles: march, light, resolve, and the way of the pixels back. Knows no scenes.
 *
 * A tile's pixels are fetched while the next one is drawn: draw_tile starts, draw_collect waits. */
#ifndef RENDERER_DRAW_H
#define RENDERER_DRAW_H

#include "frame.h"
#include "renderer/gl/program.h"
#include "renderer/gl/targets.h"

enum { DRAW_SLOTS = 2 }; /* tiles of one picture on their way */

struct draw; /* targets and resolve passes of one context */

/* What a picture shows, and how its pixels come back. */
struct draw_form {
    enum aov aov;
    bool floats;
    const char *define; /* for glsl/resolve.glsl */
    enum out_kind kind;
    GLenum read_format, read_type;
    int read_bytes;     /* of a pixel as read */
    bool matter, light; /* the passes that it needs besides march */
};

const struct draw_form *draw_form_find(enum aov aov, bool floats);

/* The numbers of a field on the GPU. */
struct draw_numbers {
    GLuint buffer, texture; /* texture: 0 where a uniform block serves */
};
/* `count` vec4s, then zeros up to `capacity`. */
void draw_numbers_init(struct draw_numbers *out, const struct draw *draw, const float *numbers,
                       size_t count, size_t capacity);
void draw_numbers_finish(struct draw_numbers *numbers, const struct gl *gl);

struct tile {
    int x, y, width, height; /* pixels of the picture, y down */
};

/* A tile on its way. */
struct draw_slot {
    GLuint buffer;
    GLuint queries[3];
    GLsync fence;
    struct tile tile;
    struct job_times times;
};

/* One picture's own objects. */
struct draw_picture {
    const struct draw_form *form;
    int samples;
    GLuint frame;
    struct draw_slot slots[DRAW_SLOTS];
};

/* `tile_side`: how many samples a tile is wide and high, a multiple of 32; 0: what is good for the
 * device. */
struct draw *draw_create(const struct gl *gl, bool software, int tile_side, struct error *err);
void draw_destroy(struct draw *draw);
/* Largest tile in pixels. */
void draw_tile_size(const struct draw *draw, int samples, int *out_width, int *out_height);
uint64_t draw_compilations(const struct draw *draw);

bool draw_begin(struct draw *draw, struct draw_picture *out, const struct frame_block *block,
                const struct draw_form *form, struct error *err);
void draw_end(struct draw *draw, struct draw_picture *picture);
bool draw_tile(struct draw *draw, struct draw_picture *picture, const struct program *program,
               const struct draw_numbers *numbers, struct tile tile, int slot, struct error *err);
/* Waits for the tile in `slot` and copies its rows to `to`, which are `stride` bytes apart. */
bool draw_collect(struct draw *draw, struct draw_picture *picture, int slot, uint8_t *to,
                  size_t stride, struct error *err);

#endif
