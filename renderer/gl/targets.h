/* SPDX-License-Identifier: MIT */
/* What the passes draw into: textures and framebuffers of one size, made once and used for every
 * tile. The formats stand here alone, because a program that draws into another format is compiled
 * again by some drivers. */
#ifndef RENDERER_TARGETS_H
#define RENDERER_TARGETS_H

#include "gl.h"

/* Kinds of finished pixels. */
enum out_kind { OUT_BYTES /* rgba8 */, OUT_FLOATS /* rgba32f */, OUT_UINTS /* r32ui */, OUT_KINDS };

struct targets {
    int width, height; /* in samples; multiples of GROUP_SIDE */
    GLuint geometry, matter, more, radiance, out[OUT_KINDS];
    GLuint starts;                 /* one texel for each block of march.glsl */
    GLuint out_buffers[OUT_KINDS]; /* framebuffers */
    GLuint vertices;               /* the empty vertex array that core profiles want */
};

/* For the current context: framebuffers are not shared. */
bool targets_init(struct targets *out_targets, const struct gl *gl, int width, int height,
                  struct error *err);
void targets_finish(struct targets *targets, const struct gl *gl);
/* Binds everything that passes read or write to its unit, but the framebuffers. */
void targets_bind(const struct targets *targets, const struct gl *gl);

#endif
