/* SPDX-License-Identifier: MIT */
/* The light of what is around a scene, made ready for the passes: the picture itself where there is
 * one, what a surface of each roughness mirrors, and what falls on a matt one.
 *
 * Belongs to the drawing thread. Counted; the same surroundings are made ready once, and the last
 * few are kept. What is made: radiance without the sun's disc, before `intensity`, and before the
 * turn and brightness of a picture, so that none of these makes it anew. */
#ifndef RENDERER_ENVIRONMENT_H
#define RENDERER_ENVIRONMENT_H

#include <stdint.h>

#include "frame.h"
#include "renderer/asset.h"
#include "renderer/gl/gl.h"

enum { MIRRORED_LEVELS = 6 }; /* roughness 0, 1/5, ... 1 */

struct environment {
    GLuint panorama;   /* rgba16f, longitude x latitude, row 0 straight up; 1x1 where no image is */
    GLuint mirrored;   /* rgba16f, mip level i for roughness i / (MIRRORED_LEVELS - 1) */
    GLuint irradiance; /* rgba16f: irradiance / pi, so 1 in an environment of 1 */
    int references;
    uint64_t key;
};

struct environments; /* those of a renderer */

/* Compiles its shaders. NULL and `err` where GL fails. */
struct environments *environments_create(const struct gl *gl, struct error *err);
void environments_destroy(struct environments *environments); /* NULL: nothing */

/* What is around a scene with this frame block; a new reference, NULL and `err` where GL fails.
 * `image`: the file of a block with SKY_IMAGE; NULL where it is not known. Where it cannot be shown
 * the block becomes SKY_SOLID and `*out_problem` says why, else that is ERROR_NONE: a warning at
 * /environment/image. `*out_us`: the time it took, 0 where it was ready. Changes bindings of
 * textures, images and the program. */
struct environment *environments_get(struct environments *environments, struct frame_block *block,
                                     const struct asset *image, struct error *out_problem,
                                     uint32_t *out_us, struct error *err);
void environment_unref(struct environments *environments, struct environment *environment);

#endif
