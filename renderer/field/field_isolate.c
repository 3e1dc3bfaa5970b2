/* SPDX-License-Identifier: MIT */
/* Isolated nodes and what is around them: a list, ordered by address. */
#include "field_isolate.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct entry {
    const struct node *node;
    bool itself;
};

struct isolation {
    struct entry *entries;
    size_t count, capacity;
};

/* Where the node is, or belongs. */
static size_t find(const struct isolation *isolation, const struct node *node)
{
    size_t low = 0, high = isolation->count;

    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if ((uintptr_t)isolation->entries[middle].node < (uintptr_t)node) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static struct entry *at(const struct isolation *isolation, const struct node *node)
{
    const size_t index = find(isolation, node);

    return index < isolation->count && isolation->entries[index].node == node
               ? &isolation->entries[index]
               : NULL;
}

/* False: it was there already. */
static bool add(struct isolation *isolation, const struct node *node)
{
    if (at(isolation, node)) {
        return false;
    }
    const size_t index = find(isolation, node);
    if (isolation->count == isolation->capacity) {
        isolation->capacity = 2 * isolation->capacity + 16;
        isolation->entries =
            memory_resize(isolation->entries, isolation->capacity, sizeof *isolation->entries);
    }
    struct entry *entry = isolation->entries + index;
    memmove(entry + 1, entry, (isolation->count++ - index) * sizeof *entry);
    *entry = (struct entry){.node = node};
    return true;
}

static void add_with_ancestors(struct isolation *isolation, const struct scene *scene,
                               const struct node *node);

static void add_instances(struct isolation *isolation, const struct scene *scene,
                          const struct node *top, const struct resource *model)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        if (node->type->kind == KIND_MODEL && node_model(scene, node) == model) {
            add_with_ancestors(isolation, scene, node);
        }
    }
}

/* As deep as models hold each other. */
static void add_with_ancestors(struct isolation *isolation, const struct scene *scene,
                               const struct node *node)
{
    const struct node *top = NULL;

    for (; node && add(isolation, node); node = node->parent) {
        top = node->parent ? NULL : node;
    }
    if (!top || !top->model) {
        return;
    }
    add_instances(isolation, scene, scene->root, top->model);
    for (size_t i = 0; i < scene->models.count; i++) {
        add_instances(isolation, scene, scene->models.items[i]->root, top->model);
    }
}

struct isolation *isolation_create(const struct scene *scene, const char *const *ids, size_t count)
{
    struct isolation *isolation = memory_alloc(1, sizeof *isolation);

    for (size_t i = 0; i < count; i++) {
        const struct node *node = scene_find(scene, ids[i]);
        if (node) {
            add_with_ancestors(isolation, scene, node);
            at(isolation, node)->itself = true;
        }
    }
    if (isolation->count == 0) {
        isolation_destroy(isolation);
        return NULL;
    }
    return isolation;
}

void isolation_destroy(struct isolation *isolation)
{
    if (isolation) {
        free(isolation->entries);
        free(isolation);
    }
}

enum isolated_part isolation_part(const struct isolation *isolation, const struct node *node)
{
    const struct entry *entry = at(isolation, node);

    return !entry ? ISOLATED_AWAY : entry->itself ? ISOLATED_ITSELF : ISOLATED_AROUND;
}
