/* SPDX-License-Identifier: MIT */
/* One pass over a tile: a program made of a file of glsl/ and its includes. Messages of the driver
 * are mapped back to file and line.
 *
 * A pass is a compute shader or a fragment shader. In a fragment shader, llvmpipe may find lane 0
 * inactive. It then fetches uniform values for each lane, and programs are four times as large. */
#ifndef RENDERER_PASS_H
#define RENDERER_PASS_H

#include "gl.h"
#include "renderer/glsl/include.h"
#include "renderer/glsl/interface.h"

/* The tile that a pass computes. */
struct dispatch_args {
    int x, y, width, height; /* of the tile with its margin, in pixels of the picture */
    enum pass_mode mode;
    GLuint list; /* PASS_LIST: buffer of glsl/group.glsl, with the arguments of the dispatch */
};

/* The arguments of one pass: a struct of glsl/interface.h, as an array of integers. */
struct pass_args {
    const int32_t *values;
    int count;
};

/* PASS_ARGS(struct transmission_args, .light = 2), for the call that it stands in. */
#define PASS_ARGS(type, ...)                                                                       \
    ((struct pass_args){(const int32_t *)&(type){__VA_ARGS__},                                     \
                        (int)(sizeof(type) / sizeof(int32_t))})

struct pass {
    GLuint program;
    GLint locations[LOCATION_COUNT]; /* DISPATCH_LOCATION, ARGS_LOCATION and those that follow */
};

struct pass_source {
    bool compute;                /* else a fragment shader over the whole target */
    const char *defines;         /* lines for above everything else; NULL: none */
    const char *file;            /* the one with main() */
    const struct glsl_file *own; /* further texts beside those of glsl/: glsl/include.h */
};

/* In the calling thread; ERROR_COMPILE with the place `file:line` when the driver refuses it. */
bool pass_init(struct pass *out_pass, const struct gl *gl, const struct pass_source *source,
               struct error *err);
void pass_finish(struct pass *pass, const struct gl *gl);
/* Draws into the current framebuffer. */
void pass_draw(const struct pass *pass, const struct gl *gl, const struct dispatch_args *dispatch,
               struct pass_args args);
/* Runs a compute shader over the samples of the dispatch. */
void pass_compute(const struct pass *pass, const struct gl *gl,
                  const struct dispatch_args *dispatch, struct pass_args args);

#endif
