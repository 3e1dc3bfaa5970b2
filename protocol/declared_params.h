/* SPDX-License-Identifier: MIT */
/* Parameters that a document declares for its primitives, shaders and models:
 * [{"name", "type", "default"?, "range"?, "doc"?}, ...]. They become rows of a table, so that
 * values of them are read, checked and printed like all others. Those of a model have no default
 * but the place that they set: {"name", "type", "sets", "range"?, "doc"?}. */
#ifndef PROTOCOL_DECLARED_PARAMS_H
#define PROTOCOL_DECLARED_PARAMS_H

#include "record.h"

/* Records point at `type` and have to be gone before it. */
struct declared_params {
    /* Of a primitive or model: the rows of the node type that names it, then the declared ones. Of
     * a shader: the declared ones. Owned, with all texts of the declared ones. */
    struct record_type type;
    size_t first_declared; /* index of the first declared row */
    char **sets;           /* of a model: the place that each declared row sets, else NULL; owned */
};

/* Types that may be declared, by their canonical names; NULL-terminated. */
extern const char *const declared_param_types[];
/* HLSL's spellings, which are read too; ends with a row whose name is NULL. */
extern const struct declared_param_alias {
    const char *name, *type;
} declared_param_aliases[];

/* Whose parameters they are. */
enum declared_of { DECLARED_OF_ANY, DECLARED_OF_CODE, DECLARED_OF_MODEL };

/* Checks declarations; their names may not be among those of `taken` (may be NULL). Whether there
 * is what a model's rows set is not looked at. */
bool declared_params_check(const cJSON *rows, enum declared_of of, const struct record_type *taken,
                           const char *place, struct error *err);
/* Canonical JSON of rows that pass the check. Caller frees. */
char *declared_params_text(const cJSON *rows);
/* `text` as from declared_params_text. The table begins with the rows of `first` (may be NULL). */
struct declared_params *declared_params_create(const char *name, const struct record_type *first,
                                               const char *text);
void declared_params_destroy(struct declared_params *declared); /* NULL is fine */

#endif
