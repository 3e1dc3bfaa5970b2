/* SPDX-License-Identifier: MIT */
/* What is inside of a shape, by the words of the catalogue: the oracle of the distance functions,
 * and therefore none of their formulas. */
#ifndef TESTS_SUPPORT_INSIDE_ORACLE_H
#define TESTS_SUPPORT_INSIDE_ORACLE_H

#include <stdbool.h>

struct inside_oracle {
    const char *type; /* name of the registry row, of KIND_SHAPE */
    /* `n`: the numbers of sdf_numbers, as a document has them: before `prepare`. */
    bool (*inside)(const double p[3], const double *n);
};

/* NULL where there is none. */
const struct inside_oracle *inside_oracle_find(const char *type);
/* With these numbers the shape is a surface, a line or a point, so that nothing is inside. */
bool inside_oracle_hollow(const char *type, const double *n);

/* Each ends with a row whose type is NULL. */
extern const struct inside_oracle inside_oracle_round[], inside_oracle_flat_sided[];

#endif
