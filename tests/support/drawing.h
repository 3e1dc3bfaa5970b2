/* SPDX-License-Identifier: MIT */
/* Scenes and pictures for tests that draw: whatever goes wrong fails the test with its message. */
#ifndef TESTS_SUPPORT_DRAWING_H
#define TESTS_SUPPORT_DRAWING_H

#include "renderer/renderer.h"

/* Has everything at once: mirrors, glass, a volume, fog, every type of light, adaptive samples. */
#define DRAWING_RICH "tests/golden/everything/rich/scene.json"

/* On the best device, with the shader cache of the environment's FIELDCAST_CACHE, if any;
 * `tile_side` as in renderer_params. */
struct renderer *drawing_renderer(int tile_side);
struct scene *drawing_parse(const char *text);
struct scene *drawing_read(const char *path);
struct resident *drawing_resident(struct renderer *renderer, const char *path);
/* Whole and plain: the scene says the rest. */
struct job_desc drawing_desc(int width, int height);
/* One output, of the newest revision. `desc` says the rest. */
struct image drawing_of(struct resident *resident, const struct job_desc *desc, enum aov aov);
/* All outputs that `desc` asks for, drawn at once; the others stay empty. */
struct drawing {
    struct image of[AOV_COUNT];
    double drawn_part; /* job_drawn_part() */
};
struct drawing drawing_outputs(struct renderer *renderer, struct resident *resident,
                               const struct job_desc *desc);
void drawing_finish(struct drawing *drawing);
bool drawing_is_same(const struct image *a, const struct image *b);
/* How two pictures of occlusion or shadows, as floats, differ: in so many places by more than
 * `much`. `dark` places of `wanted` get less than all light. */
struct light_difference {
    int off, dark;
};
struct light_difference drawing_compare_light(const struct image *light, const struct image *wanted,
                                              double much);

#endif
