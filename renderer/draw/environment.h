/* SPDX-License-Identifier: MIT */
/* The light of what is around a scene, made ready for the passes: the picture itself where there is
 * one, what a surface of each roughness reflects, and what falls on a diffuse one (glsl/sky.glsl).
 *
 * Belongs to the drawing thread, which counts references. Equal environments are prepared once. The
 * last ones are kept, up to LIMIT_PANORAMA_BYTES. They hold radiance without the sun's disc, before
 * `intensity`, rotation and brightness are applied. A change of these prepares nothing. */
#ifndef RENDERER_ENVIRONMENT_H
#define RENDERER_ENVIRONMENT_H

#include <stdint.h>

#include "frame_uniforms.h"
#include "renderer/engine/engine.h"
#include "renderer/gl/gl.h"

struct environment {
    struct engine_map maps[ENGINE_MAPS];
    GLuint textures[ENGINE_MAPS]; /* the same as rgba16f; 0: not on the device */
    int references;
    uint64_t key;
    size_t bytes; /* in memory */
    struct environment *next;
};

struct environments; /* those of a renderer */

struct environments *environments_create(const struct gl *gl);
void environments_destroy(struct environments *environments); /* NULL: nothing */

/* The same without its picture: one colour. */
void environment_leave_out(struct frame_uniforms *block);
/* Whether it is prepared already, so that its picture need not be read. `image`: the file id of a
 * block with SKY_IMAGE; else it means nothing. */
bool environments_have(struct environments *environments, const struct frame_uniforms *block,
                       const char *image);
/* What is around a scene with this frame block; a new reference. `maps`: those of its picture,
 * where it has one that environments_have does not know; taken. `*out_us`: the time it took, 0
 * where it was ready. */
struct environment *environments_get(struct environments *environments,
                                     const struct frame_uniforms *block, const char *image,
                                     struct engine_map *maps, uint32_t *out_us);
/* Binds its pictures to their units, after copying them to the device where they are not there. */
void environment_bind(struct environment *environment, const struct gl *gl);
void environment_unref(struct environments *environments, struct environment *environment);

#endif
