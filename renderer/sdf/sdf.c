/* SPDX-License-Identifier: MIT */
/* The distance functions in one list. */
#include "sdf.h"

#include <assert.h>
#include <string.h>

static const struct sdf *const tables[] = {sdf_shapes,     sdf_solids,    sdf_flat,    sdf_fractals,
                                           sdf_operations, sdf_modifiers, sdf_repeats, sdf_warps};
enum { TABLE_COUNT = sizeof tables / sizeof tables[0] };

const struct sdf *sdf_at(size_t index)
{
    for (size_t i = 0; i < TABLE_COUNT; i++) {
        for (const struct sdf *row = tables[i]; row->type; row++) {
            if (index-- == 0) {
                return row;
            }
        }
    }
    return NULL;
}

const struct sdf *sdf_find(const struct node_type *type)
{
    for (size_t i = 0; i < TABLE_COUNT; i++) {
        for (const struct sdf *row = tables[i]; row->type; row++) {
            if (strcmp(row->type, type->record.name) == 0) {
                return row;
            }
        }
    }
    return NULL;
}

int sdf_numbers(const struct param *params, const struct value *values,
                double out_n[SDF_NUMBERS_MAX])
{
    int count = 0;

    for (int i = 0; params[i].name; i++) {
        const struct value *value = &values[i];
        const int components = param_components(params[i].type);
        const bool points = params[i].type == PARAM_POINTS;
        const int listed = points ? 2 * (int)value->number[0] : 0;
        assert(count + components + points + listed <= SDF_NUMBERS_MAX);
        memcpy(out_n + count, value->number, (size_t)(components + points) * sizeof *out_n);
        count += components + points;
        if (listed > 0) {
            memcpy(out_n + count, value->points, (size_t)listed * sizeof *out_n);
            count += listed;
        }
    }
    return count;
}
