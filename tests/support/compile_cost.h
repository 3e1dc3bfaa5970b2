/* SPDX-License-Identifier: MIT */
/* What the driver takes to compile a scene: processor time of the compilers, none of a cache. */
#ifndef TESTS_SUPPORT_COMPILE_COST_H
#define TESTS_SUPPORT_COMPILE_COST_H

#include "renderer/code/code.h"
#include "renderer/renderer.h"

/* A renderer whose driver keeps nothing between programs; the environment is changed for it. Fails
 * the test where there is none. */
struct renderer *compile_cost_renderer(void);
/* Milliseconds for a scene without code; the median of several shapes, each new to the renderer
 * once. */
double compile_cost_plain(struct renderer *renderer);
/* The same for a scene with `count` shapes, each of which has this code for a distance, or one
 * shape whose material has it for a shader. Fails the test where it is refused. */
double compile_cost_code(struct renderer *renderer, enum code_use use, const char *text, int count);
/* The same for a whole document, new to the renderer. */
double compile_cost_scene(struct renderer *renderer, struct scene *scene);

#endif
