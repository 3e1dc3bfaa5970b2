/* SPDX-License-Identifier: MIT */
/* Modifiers around a child, for tests: what is inside by the words of the catalogue, and how steep
 * the field is. */
#ifndef TESTS_SUPPORT_MODIFIED_H
#define TESTS_SUPPORT_MODIFIED_H

#include "renderer/field/field.h"
#include "tests/support/random_scene.h"

struct modified {
    const struct node_type *type;
    char *text;                  /* of the node */
    struct field *whole, *child; /* the child alone */
    double n[SDF_NUMBERS_MAX];   /* parameters as a document has them */
};

/* The field of a node; ends the program where it does not compile. The caller unrefs. */
struct field *modified_field(const char *node);

/* `params` and `child` are JSON; `n` is to be filled in. */
struct modified modified_create(const char *type, const char *params, const char *child);
/* By chance, without a transform of its own. The child ends in every direction; it is a shape with
 * exact distances or a blend of two shapes. */
struct modified modified_random(struct random *random, const struct node_type *type, bool exact);
void modified_finish(struct modified *modified);

/* Below 0 inside. */
typedef double modified_meaning(const struct field *child, const double p[3], const double *n);
modified_meaning *modified_meaning_find(const char *type); /* NULL: this list has none */
size_t modified_meaning_count(void);

/* How much farther from its box the point is than the stretch allows for its distance. */
double modified_outside(const struct modified *modified, const double p[3]);
/* The largest rate of change from a point, often at a seam, to some others. */
double modified_steepness(struct random *random, const struct modified *modified);

#endif
