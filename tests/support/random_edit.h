/* SPDX-License-Identifier: MIT */
/* Random edits, the same on every machine. */
#ifndef TESTS_SUPPORT_RANDOM_EDIT_H
#define TESTS_SUPPORT_RANDOM_EDIT_H

#include "protocol/edit.h"
#include "random_document.h"

/* One to four operations. Most apply; some are refused: places that are gone, wrong values,
 * names in use, circles. Caller frees. */
cJSON *random_edit(struct random *random, const struct scene *scene);
/* Changes some bytes of a text of `length` bytes, mostly into others that JSON knows. */
void random_damage(struct random *random, char *text, size_t length);

#endif
