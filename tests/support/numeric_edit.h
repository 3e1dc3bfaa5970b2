/* SPDX-License-Identifier: MIT */
/* Random edits of numbers alone, as a slider makes them; the same on every machine. */
#ifndef TESTS_SUPPORT_NUMERIC_EDIT_H
#define TESTS_SUPPORT_NUMERIC_EDIT_H

#include "random_document.h"

/* One to three operations on parameters and transforms of nodes, also in models, on properties of
 * materials and on what is beside the field. Numbers move a little (`wild`: are any that the tables
 * allow). Most edits apply. Caller frees. */
cJSON *numeric_edit(struct random *random, const struct scene *scene, bool wild);

#endif
