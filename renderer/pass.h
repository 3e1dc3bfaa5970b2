/* SPDX-License-Identifier: MIT */
/* One pass over a whole target: a program put together out of files of glsl/. Drivers' messages are
 * turned back into file and line. */
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

struct pass {
    GLuint program;
    GLint tile; /* location of the uniform of that name, -1: not used */
};

struct pass_source {
    const char *defines;      /* lines for above everything else; may be "" */
    const char *const *files; /* names in glsl/, NULL at the end */
    const char *map, *surface; /* the texts that `files` calls "map" and "surface" */
};

/* In the calling thread; ERROR_COMPILE with the place `file:line` when the driver refuses it. */
bool pass_init(struct pass *out_pass, const struct gl *gl, const struct pass_source *source,
               struct error *err);
void pass_finish(struct pass *pass, const struct gl *gl);
/* Draws the pass into the current framebuffer; the arguments become the uniform `tile`. */
void pass_draw(const struct pass *pass, const struct gl *gl, int tile_x, int tile_y);

#endif
