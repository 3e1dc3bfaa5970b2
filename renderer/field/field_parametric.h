/* SPDX-License-Identifier: MIT */
/* Parametric surfaces in a field while it is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_PARAMETRIC_H
#define RENDERER_FIELD_PARAMETRIC_H

#include "builder.h"
#include "renderer/code/surface_sample.h"

/* The numbers of a surface (renderer/sdf/patches.h). The last few that were made are kept for the
 * process: making them takes as long as a picture, and whoever moves the node or edits another one
 * asks for the same again. Any thread. */
struct parametric_numbers {
    const double *numbers;
    size_t rows; /* of four numbers */
    struct bounds box;
    /* Private. */
    char *key;
    int users;
    uint64_t used;
};

/* Those of a node of KIND_SURFACE, until they are released. NULL: it has no surface; or the builder
 * has failed, with the place of the part that cannot be read. */
struct parametric_numbers *parametric_numbers_of(struct builder *b, const struct node *node);
void parametric_release(struct parametric_numbers *surface);

/* What a node has, in its text. */
struct parametric_source {
    cJSON *json; /* the texts lie in it; the caller deletes it */
    struct surface surface;
    double letters[EQUATION_LETTERS];
    int levels; /* of patches */
};
/* False: it has none, and there is nothing to delete. */
bool parametric_source_of(const struct node *node, struct parametric_source *out);

#endif
