/* SPDX-License-Identifier: MIT */
/* Frees large scenes on a thread of its own, so that who draws does not wait: 30,000 nodes take
 * some 7 ms. */
#ifndef RENDERER_SCENE_BIN_H
#define RENDERER_SCENE_BIN_H

#include "protocol/scene.h"

struct scene_bin;

struct scene_bin *scene_bin_create(void); /* starts the thread; dies without one (aborts) */
/* Waits until all scenes are freed. NULL: nothing. */
void scene_bin_destroy(struct scene_bin *bin);
/* Takes the scene; a small one is freed at once. NULL: nothing. */
void scene_bin_take(struct scene_bin *bin, struct scene *scene);

#endif
