/* SPDX-License-Identifier: MIT */
/* Asks the GLSL of a field program about points, on whatever device EGL gives: the fragment stage,
 * as in production, one pixel for each point. Not a renderer: no camera, no marching. */
#ifndef TESTS_SUPPORT_PROBE_H
#define TESTS_SUPPORT_PROBE_H

#include "renderer/field/field.h"
#include "renderer/gl/egl.h"
#include "renderer/gl/gl.h"

enum { PROBE_SIDE = 128, PROBE_POINTS_MAX = PROBE_SIDE * PROBE_SIDE };

struct probe {
    struct egl egl;
    struct gl gl;
    GLuint vertex_array, framebuffer, targets[5];
    GLuint buffers[2], views[2]; /* points, numbers */
};

/* One program, for every field of one shape. */
struct probe_program {
    GLuint program;
};

struct probe_answer {
    float distance;                         /* map() */
    uint32_t leaf;                          /* surface(); 0 where the program has none */
    float material[FIELD_MATERIAL_NUMBERS]; /* as in the buffer */
};

bool probe_init(struct probe *probe, struct error *err);
void probe_finish(struct probe *probe);

/* `surface`: with surface(), which takes longer to compile. `in_texture`: N() reads a texture
 * instead of a uniform block. */
bool probe_program_init(struct probe_program *program, const struct probe *probe,
                        const struct field *field, bool surface, bool in_texture,
                        struct error *err);
void probe_program_finish(struct probe_program *program, const struct probe *probe);

/* `repeat` draws the same again, for measuring. */
void probe_run(const struct probe *probe, const struct probe_program *program,
               const struct field *field, const float (*points)[3], size_t count, int repeat,
               struct probe_answer *out);

#endif
