/* SPDX-License-Identifier: MIT */
/* One pass over a tile: a program put together out of files of glsl/. Drivers' messages are turned
 * back into file and line.
 *
 * March and light are compute shaders: some GPUs give the fragment stage a small part of the chip,
 * and llvmpipe, which may find lane 0 unused in a fragment shader, fetches even what is the same
 * for all lanes lane by lane there, which made programs four times as large. */
#ifndef RENDERER_PASS_H
#define RENDERER_PASS_H

#include "gl.h"

/* Bindings that the shaders name (layout(binding = ...)). */
enum { BINDING_FRAME = 0, BINDING_NUMBERS = 1 };
enum {
    UNIT_GEOMETRY = 0,
    UNIT_MATTER = 1,
    UNIT_MORE = 2,
    UNIT_NUMBERS = 3,
    UNIT_RADIANCE = 4,
};

/* Units of the images that are written. */
enum { IMAGE_GEOMETRY = 0, IMAGE_MATTER = 1, IMAGE_MORE = 2, IMAGE_RADIANCE = 3, IMAGE_STARTS = 4 };

enum {
    GROUP_SIDE = 8, /* samples that one work group covers: glsl/group.glsl */
    BLOCK_SIDE = 8, /* samples that share a start: glsl/march.glsl */
};

struct pass {
    GLuint program;
    GLint tile; /* location of the uniform of that name, -1: not used */
};

struct pass_source {
    bool compute;              /* else a fragment shader over the whole target */
    const char *defines;       /* lines for above everything else; may be "" */
    const char *const *files;  /* names in glsl/, NULL at the end */
    const char *map, *surface; /* the texts that `files` calls "map" and "surface" */
};

/* In the calling thread; ERROR_COMPILE with the place `file:line` when the driver refuses it. */
bool pass_init(struct pass *out_pass, const struct gl *gl, const struct pass_source *source,
               struct error *err);
void pass_finish(struct pass *pass, const struct gl *gl);
/* Draws into the current framebuffer; the tile's place becomes the uniform `tile`. */
void pass_draw(const struct pass *pass, const struct gl *gl, int tile_x, int tile_y);
/* Runs a compute shader for at least width x height samples. */
void pass_compute(const struct pass *pass, const struct gl *gl, int tile_x, int tile_y, int width,
                  int height);
/* The coarse run of march.glsl, before the fine one. */
void pass_compute_coarse(const struct pass *pass, const struct gl *gl, int tile_x, int tile_y,
                         int width, int height);

#endif
