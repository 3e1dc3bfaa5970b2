/* SPDX-License-Identifier: MIT */
/* Random values, trees and documents, the same on every machine: every member of every table may
 * occur. Not for drawing: the numbers are any that the tables allow (random_scene.h has tame
 * ones). */
#ifndef TESTS_SUPPORT_RANDOM_DOCUMENT_H
#define TESTS_SUPPORT_RANDOM_DOCUMENT_H

#include <cjson/cJSON.h>

#include "random_scene.h"

/* What a document has beside the tree, told apart from protocol/resource.c on purpose. */
struct random_kind {
    const char *list;
    size_t offset;                   /* of the list in struct scene */
    const char *type;                /* member that chooses a row of `table`; NULL: it is the row */
    const char *values;              /* member with the values; NULL: they stand beside the type */
    const struct record_type *table; /* NULL: a tree */
};

enum {
    RANDOM_LIGHTS,
    RANDOM_VOLUMES,
    RANDOM_PRIMITIVES,
    RANDOM_SHADERS,
    RANDOM_MATERIALS,
    RANDOM_MODELS,
    RANDOM_KINDS
};
extern const struct random_kind random_kinds[RANDOM_KINDS];

const struct resource_list *random_list(const struct scene *scene, int kind);

bool random_chance(struct random *random, double probability);
/* A valid value of the row; what it names is in the scene (NULL: nothing is). Caller frees all. */
cJSON *random_value(struct random *random, const struct param *param, const struct scene *scene);
cJSON *random_record(struct random *random, const struct record_type *type,
                     const struct scene *scene);
/* A subtree of 1 to `nodes` nodes without ids. */
cJSON *random_tree(struct random *random, size_t nodes, const struct scene *scene);
cJSON *random_resource(struct random *random, int kind, const struct scene *scene);
/* Rows of parameters that set some of what is in the model's tree. */
cJSON *random_model_rows(struct random *random, const struct resource *model);
/* The name of a type or shader that a resource of this kind may have. */
const char *random_type_name(struct random *random, int kind, const struct scene *scene);

/* A valid document of about `nodes` nodes, some more in its models. Caller destroys. */
struct scene *random_document(struct random *random, size_t nodes);

#endif
