/* SPDX-License-Identifier: MIT */
/* Asks the GLSL of field programs about points, on whatever device EGL gives: in a compute shader,
 * as in production, one invocation for each point. Not a renderer: no camera, no marching. */
#ifndef TESTS_SUPPORT_PROBE_H
#define TESTS_SUPPORT_PROBE_H

#include "renderer/field/field.h"
#include "renderer/gl/egl.h"
#include "renderer/gl/gl.h"

struct probe {
    struct egl egl;
    struct gl gl;
    GLuint buffers[3], views[2]; /* points, numbers, answers */
    float field_mask;            /* of programs made from now on: glsl/field_mask.glsl */
};

/* One program for several fields, which compiles faster than one for each: the text around them is
 * longer than theirs. It serves every list of fields of these shapes. */
struct probe_program {
    GLuint program;
    bool surface;
};

struct probe_answer {
    float distance;                         /* map() */
    uint32_t leaf;                          /* surface(); 0 where the program has none */
    float material[FIELD_MATERIAL_NUMBERS]; /* as in the buffer */
};

bool probe_init(struct probe *probe, struct error *err);
void probe_finish(struct probe *probe);

/* `surface`: with surface(), which takes longer to compile. `in_block`: N() reads a uniform block
 * instead of a texture, which software compiles ten times slower. A driver may cut off loops after
 * 65,535 iterations of all fields together. Only one field of several may have users' code. */
bool probe_program_init(struct probe_program *program, const struct probe *probe,
                        struct field *const *fields, size_t count, bool surface, bool in_block,
                        struct error *err);
void probe_program_finish(struct probe_program *program, const struct probe *probe);

/* The answer of fields[i] about points[j] goes to out[i * point_count + j]. */
void probe_run(const struct probe *probe, const struct probe_program *program,
               struct field *const *fields, size_t count, const float (*points)[3],
               size_t point_count, struct probe_answer *out);

/* The leaf and material may differ only where two leaves are nearly equal: then they are those of
 * the C evaluator nearby. */
bool probe_agrees(const struct field *field, const float point[3],
                  const struct probe_answer *answer);

#endif
