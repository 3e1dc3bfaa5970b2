/* SPDX-License-Identifier: MIT */
/* The light of what is around a scene, made ready for the passes: the picture itself where there is
 * one, what a surface of each roughness mirrors, and what falls on a matt one (glsl/sky.glsl).
 *
 * Belongs to the drawing thread. Counted; the same surroundings are made ready once, and those used
 * last are kept within LIMIT_PANORAMA_BYTES. What is made: radiance without the sun's disc, before
 * `intensity`, and before the turn and brightness of a picture, so that none of these makes it
 * anew. */
#ifndef RENDERER_ENVIRONMENT_H
#define RENDERER_ENVIRONMENT_H

#include <stdint.h>

#include "frame.h"
#include "renderer/engine/engine.h"
#include "renderer/gl/gl.h"
#include "renderer/image/decode.h"

struct environment {
    GLuint panorama; /* the picture, or the gradient as one; rgba16f as the others, with mipmaps */
    GLuint mirrored; /* mip level i for roughness (i + 1) / levels */
    GLuint irradiance;                     /* over pi, so 1 in an environment of 1 */
    struct engine_sky skies[ENGINE_SKIES]; /* the same in memory, where that is wanted */
    int references;
    uint64_t key;
    size_t bytes;
    struct environment *next;
};

struct environments; /* those of a renderer */

/* Compiles its shaders. `read`: environments are wanted in memory as well. NULL and `err` where GL
 * fails. */
struct environments *environments_create(const struct gl *gl, bool read, struct error *err);
void environments_destroy(struct environments *environments); /* NULL: nothing */

/* The same without its picture: one colour. */
void environment_leave_out(struct frame_block *block);
/* Whether it was made already: then nobody has to read its picture. `image`: the id of the file of
 * a block with SKY_IMAGE; else it means nothing. */
bool environments_have(struct environments *environments, const struct frame_block *block,
                       const char *image);
/* What is around a scene with this frame block; a new reference, NULL and `err` where GL fails.
 * `decoded`: its picture, where it has one that environments_have does not know. `*out_us`: the
 * time it took, 0 where it was ready. Changes bindings of textures, images, buffers and the
 * program. */
struct environment *environments_get(struct environments *environments,
                                     const struct frame_block *block, const char *image,
                                     const struct decoded *decoded, uint32_t *out_us,
                                     struct error *err);
void environment_unref(struct environments *environments, struct environment *environment);

#endif
