/* SPDX-License-Identifier: MIT */
/* The registry as one list. Its rows stand in registry/. */
#include <string.h>

#include "protocol/registry/rows.h"

static const struct node_type *const tables[] = {
    node_shapes,     node_solids,    node_flat,      node_fractals,
    node_operations, node_modifiers, node_structure,
};
enum { TABLE_COUNT = sizeof tables / sizeof tables[0] };

const char *node_group_name(enum node_group group)
{
    static const char *const names[] = {
        [GROUP_PRIMITIVE] = "primitive", [GROUP_SHAPE] = "shape",
        [GROUP_OPERATION] = "operation", [GROUP_MODIFIER] = "modifier",
        [GROUP_STRUCTURE] = "structure",
    };

    return names[group];
}

size_t node_type_count(void)
{
    size_t count = 0;

    while (node_type_at(count)) {
        count++;
    }
    return count;
}

const struct node_type *node_type_at(size_t index)
{
    for (size_t i = 0; i < TABLE_COUNT; i++) {
        for (const struct node_type *row = tables[i]; row->record.name; row++) {
            if (index-- == 0) {
                return row;
            }
        }
    }
    return NULL;
}

const struct node_type *node_type_find(const char *name)
{
    for (size_t i = 0; i < TABLE_COUNT; i++) {
        for (const struct node_type *row = tables[i]; row->record.name; row++) {
            if (strcmp(row->record.name, name) == 0) {
                return row;
            }
        }
    }
    return NULL;
}
