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
enum { BINDING_FRAME = 0, BINDING_NUMBERS = 1 };                /* uniform blocks */
enum { BINDING_LIST = 0, BINDING_NEXT = 1, BINDING_STACK = 2 }; /* storage blocks */
enum {
    UNIT_GEOMETRY,
    UNIT_MATTER,
    UNIT_MORE,
    UNIT_NUMBERS,
    UNIT_TOTAL,
    UNIT_RAY_FROM,
    UNIT_RAY_ALONG,
    UNIT_VISIBILITY,
    UNIT_PANORAMA,
    UNIT_MIRRORED,
    UNIT_IRRADIANCE,
    UNIT_HAZE,
    UNIT_STEPS,
    UNIT_PIXELS,
    UNIT_COUNTED,
    UNIT_COUNT
};

/* Images that are written. There may be but eight at once, so the passes with a field in them and
 * the others have sets of their own. */
enum {
    IMAGE_GEOMETRY,
    IMAGE_MATTER,
    IMAGE_MORE,
    IMAGE_STEPS,
    IMAGE_STARTS,
    IMAGE_VISIBILITY,
    IMAGE_HAZE
};
enum {
    IMAGE_RAY_FROM,
    IMAGE_RAY_ALONG,
    IMAGE_WEIGHT,
    IMAGE_MEDIUM,
    IMAGE_TOTAL,
    IMAGE_SEEN, /* visibility */
    IMAGE_PIXELS,
    IMAGE_COUNTED
};

enum {
    GROUP_SIDE = 8,  /* samples that one work group covers: glsl/group.glsl */
    BLOCK_SIDE = 8,  /* pixels that share a start: glsl/march_pass.glsl */
    STACK_DEPTH = 8, /* rays of a sample that wait: glsl/stack.glsl */
};

/* Which samples a pass is for: glsl/frame.glsl. */
enum pass_mode { PASS_TILE, PASS_COARSE, PASS_LIST };

/* What a pass is told of where it is at. */
struct pass_place {
    int x, y, width, height; /* of the tile with its margin, in pixels of the picture */
    enum pass_mode mode;
    GLuint list; /* PASS_LIST: buffer of glsl/group.glsl, with the arguments of the dispatch */
    int turn[4]; /* glsl/frame.glsl */
};

struct pass {
    GLuint program;
    GLint tile, turn; /* locations of the uniforms of these names, -1: not used */
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
/* Draws into the current framebuffer. */
void pass_draw(const struct pass *pass, const struct gl *gl, const struct pass_place *place);
/* Runs a compute shader over the samples of the place. */
void pass_compute(const struct pass *pass, const struct gl *gl, const struct pass_place *place);

#endif
