/* SPDX-License-Identifier: MIT */
/* Render targets of the fragment shaders of a tile: glsl/starts_pass.glsl, sample_pass.glsl,
 * mask_pass.glsl, rays_pass.glsl. */
#ifndef RENDERER_FRAGMENT_TARGETS_H
#define RENDERER_FRAGMENT_TARGETS_H

#include "pass.h"
#include "texture.h"

/* What is drawn into. */
enum fragment_target { FRAGMENT_STARTS, FRAGMENT_SAMPLES, FRAGMENT_MASK, FRAGMENT_RAYS };
enum { FRAGMENT_TARGETS = FRAGMENT_RAYS + 1 };

struct fragment_targets {
    int side;
    GLuint samples[SAMPLE_TEXTURE_COUNT]; /* rgba32f but SAMPLE_COUNTED, which is rg32f */
    GLuint starts;                        /* r32f, one texel for each block */
    GLuint mask;                          /* r32f */
    GLuint rays;                          /* r32f, one texel for each column */
    GLuint buffers[FRAGMENT_TARGETS];
    struct outputs outputs;
    GLuint vertices; /* the empty vertex array that core profiles want */
};

/* For the current context: framebuffers are not shared. */
bool fragment_targets_init(struct fragment_targets *out_targets, const struct gl *gl, int side,
                           struct error *err);
void fragment_targets_finish(struct fragment_targets *targets, const struct gl *gl);
/* Binds what is read. */
void fragment_targets_bind(const struct fragment_targets *targets, const struct gl *gl);
/* So that nothing was drawn into FRAGMENT_SAMPLES. */
void fragment_targets_clear(const struct fragment_targets *targets, const struct gl *gl);
/* Into one of them; to FRAGMENT_SAMPLES it is added. */
void fragment_targets_draw(const struct fragment_targets *targets, const struct gl *gl,
                           enum fragment_target target, const struct pass *pass,
                           const struct dispatch_args *dispatch, struct pass_args args);

#endif
