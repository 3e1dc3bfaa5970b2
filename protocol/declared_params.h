/* SPDX-License-Identifier: MIT */
/* Parameters that a document declares for its primitives and shaders:
 * [{"name", "type", "default"?, "range"?, "doc"?}, ...]. They become rows of a table, so that
 * values of them are read, checked and printed like all others. */
#ifndef PROTOCOL_DECLARED_PARAMS_H
#define PROTOCOL_DECLARED_PARAMS_H

#include "record.h"

/* Records point at `type` and have to be gone before it. */
struct declared_params {
    /* Of a primitive: the rows of the node type `field`, then the declared ones. Of a shader: the
     * declared ones. Owned, with all texts of the declared ones. */
    struct record_type type;
    size_t first_declared; /* index of the first declared row */
};

/* Types that may be declared, by their canonical names; NULL-terminated. */
extern const char *const declared_param_types[];
/* HLSL's spellings, which are read too; ends with a row whose name is NULL. */
extern const struct declared_param_alias {
    const char *name, *type;
} declared_param_aliases[];

/* Checks declarations; their names may not be among those of `taken` (may be NULL). */
bool declared_params_check(const cJSON *rows, const struct record_type *taken, const char *place,
                           struct error *err);
/* Canonical JSON of rows that pass the check. Caller frees. */
char *declared_params_text(const cJSON *rows);
/* `text` as from declared_params_text. The table begins with the rows of `first` (may be NULL). */
struct declared_params *declared_params_create(const char *name, const struct record_type *first,
                                               const char *text);
void declared_params_destroy(struct declared_params *declared); /* NULL is fine */

#endif
