/* SPDX-License-Identifier: MIT */
/* Random documents and edits, the same on every machine: every member of every table may occur.
 * Not for drawing: the numbers are any that the tables allow (random_scene.h has tame ones). */
#ifndef TESTS_SUPPORT_RANDOM_EDIT_H
#define TESTS_SUPPORT_RANDOM_EDIT_H

#include "protocol/edit.h"
#include "random_scene.h"

/* A valid value of the row; materials are among `materials`. Caller frees. */
cJSON *random_value(struct random *random, const struct param *param,
                    const struct resource_list *materials);
/* A valid document of about `nodes` nodes. Caller destroys. */
struct scene *random_document(struct random *random, size_t nodes);
/* One to four operations. Most apply; some are refused: places that are gone, wrong values,
 * materials in use, cycles. Caller frees. */
cJSON *random_edit(struct random *random, const struct scene *scene);
/* Changes some bytes of a text of `length` bytes, mostly into others that JSON knows. */
void random_damage(struct random *random, char *text, size_t length);

#endif
