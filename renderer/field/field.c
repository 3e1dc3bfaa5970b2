/* SPDX-License-Identifier: MIT */
/* What a field program is apart from making one (field_compile.c) and running it
 * (field_evaluate.c). */
#include "field.h"

#include <assert.h>
#include <stdlib.h>

#include "field_sites.h"

/* Components that a parameter has in the buffer. A choice is part of the program; of a list of
 * points the place and the count are here. */
static int stored_components(enum param_type type)
{
    return type == PARAM_ENUM ? 0 : type == PARAM_POINTS ? 2 : param_components(type);
}

int field_layout(const struct param *params, int used, struct param_slot out[SDF_PARAMS_MAX])
{
    int taken[SDF_PARAMS_MAX + 1] = {0};
    int vec4s = (used + 3) / 4;

    for (int i = 0; i < used; i++) {
        taken[i / 4]++;
    }
    for (size_t i = 0; params[i].name; i++) {
        const int components = stored_components(params[i].type);
        int at = 0;
        while (taken[at] + components > 4) {
            at++;
        }
        assert(i < SDF_PARAMS_MAX && at < SDF_PARAMS_MAX);
        out[i] = components ? (struct param_slot){at, taken[at], components}
                            : (struct param_slot){-1, 0, 0};
        taken[at] += components;
        vec4s = components && at + 1 > vec4s ? at + 1 : vec4s;
    }
    return vec4s;
}

struct field *field_ref(struct field *field)
{
    field->references++;
    return field;
}

static void free_codes(struct field_code *codes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        code_destroy(codes[i].code);
    }
    free(codes);
}

void field_unref(struct field *field)
{
    if (!field || --field->references > 0) {
        return;
    }
    sites_destroy(field->sites);
    free(field->params);
    free(field->arguments);
    if (field->base) {
        field_unref(field->base);
        free(field);
        return;
    }
    for (size_t i = 0; i < field->leaf_count; i++) {
        free(field->leaves[i].id);
    }
    free(field->leaves);
    free(field->members);
    free_codes(field->codes, field->code_count);
    free_codes(field->shaders, field->shader_count);
    free(field->instructions);
    free(field);
}

static int compare_leaf(const void *key, const void *item)
{
    const uint32_t a = *(const uint32_t *)key, b = ((const struct field_leaf *)item)->number;

    return (a > b) - (a < b);
}

const char *field_leaf_id(const struct field *field, uint32_t number)
{
    if (field->leaf_count == 0) {
        return NULL;
    }
    const struct field_leaf *leaf =
        bsearch(&number, field->leaves, field->leaf_count, sizeof *field->leaves, compare_leaf);
    return leaf ? leaf->id : NULL;
}
