/* SPDX-License-Identifier: MIT */
/* Random scenes and edits of them, as a user makes them; the same on every machine. */
#ifndef TESTS_SUPPORT_EDITED_SCENE_H
#define TESTS_SUPPORT_EDITED_SCENE_H

#include <cjson/cJSON.h>

#include "random_scene.h"

/* `count` small shapes on a plane, of the first materials; the third one is metal, the fourth
 * glass. */
struct scene *edited_scene_scattered(struct random *random, int count, size_t materials);
/* The same, twisted around Y, or in the node `mirror`. */
struct scene *edited_scene_twisted(struct random *random, int count, size_t materials);
struct scene *edited_scene_mirrored(struct random *random, int count, size_t materials);
/* By turns as many shapes on a plane, nodes of all types, the scene that has everything. */
struct scene *edited_scene(struct random *random, size_t life, int count);
const struct node *edited_scene_child(struct random *random, const struct scene *scene);
/* Something small goes a small way, mostly; numbers, materials, lights; what is seen; nodes that
 * come, called by `number`, and go. Caller frees. */
cJSON *edited_scene_ops(struct random *random, const struct scene *scene, int number);

#endif
