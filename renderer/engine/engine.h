/* SPDX-License-Identifier: MIT */
/* Pictures without a GPU: the shaders' own functions, written as C over vectors by renderer/spmd,
 * and an interpreter of field programs. Where the device is software this takes a part of the time,
 * and nothing is compiled for a scene.
 *
 * Immutable scenes; tiles of one may be drawn by several threads at once. */
#ifndef RENDERER_ENGINE_H
#define RENDERER_ENGINE_H

#include "renderer/field/field.h"
#include "renderer/glsl/interface.h"

/* A picture by longitude and latitude, with smaller ones of it. Linear light. */
struct engine_sky {
    int width, height, levels;
    float *texels; /* four for each, level by level */
};

enum { ENGINE_SKIES = 3 }; /* UNIT_PANORAMA, UNIT_MIRRORED, UNIT_IRRADIANCE */

struct engine_program; /* a field, ready to be run */

/* `lanes`: width of the vectors, 0 for the widest that the processor has. NULL where the engine
 * does not know all of the field, or has no such width. */
struct engine_program *engine_program_create(const struct field *field, int lanes);
/* The widths that the processor has, from the widest; 0 behind the last. */
int engine_lanes(size_t index);
/* The same for another field of this shape; NULL: nothing. Each has to be destroyed. */
struct engine_program *engine_program_ref(struct engine_program *program);
void engine_program_destroy(struct engine_program *program);

enum engine_smoothing { ENGINE_PLAIN, ENGINE_BLEND, ENGINE_ADAPTIVE, ENGINE_FULL };

struct engine_picture {
    const struct engine_program *program;
    const float *numbers; /* of the field; it may be another of the same shape */
    const struct frame_block *frame;
    const struct engine_sky *skies[ENGINE_SKIES];
    enum engine_smoothing smoothing;
    int samples, rays;
};

/* Draws pixels x, y to x + width, y + height: four bytes each, rows `stride` bytes apart. */
void engine_draw(const struct engine_picture *picture, int x, int y, int width, int height,
                 uint8_t *out, size_t stride);

#endif
