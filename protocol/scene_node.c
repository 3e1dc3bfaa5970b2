/* SPDX-License-Identifier: MIT */
/* Nodes and subtrees by themselves. Being part of a scene is scene_tree.c. */
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "scene_internal.h"

struct node *node_create(const struct node_type *type, const struct record_type *params)
{
    struct node *node = memory_alloc(1, sizeof *node);

    node->type = type;
    node->height = 1;
    record_init(&node->common, &node_common_type);
    record_init(&node->transform, &transform_type);
    record_init(&node->params, params);
    return node;
}

void node_destroy(struct node *node)
{
    if (!node) {
        return;
    }
    for (size_t i = 0; i < node->child_count; i++) {
        node_destroy(node->children[i]);
    }
    free(node->children);
    record_finish(&node->common);
    record_finish(&node->transform);
    record_finish(&node->params);
    free(node->id);
    free(node);
}

void node_add_child(struct node *parent, struct node *child, size_t position)
{
    parent->children = memory_open_slot(parent->children, parent->child_count, position);
    parent->children[position] = child;
    parent->child_count++;
    child->parent = parent;
    child->last_position = position;
    for (; parent && parent->height <= child->height; parent = child->parent) {
        parent->height = child->height + 1;
        child = parent;
    }
}

/* After a child of `height` has left. Mostly one of the first that stay is as high. */
static void lower(struct node *node, size_t height)
{
    while (node && node->height == height + 1) {
        size_t highest = 0;
        for (size_t i = 0; i < node->child_count && highest < height; i++) {
            const size_t child = node->children[i]->height;
            highest = child > highest ? child : highest;
        }
        height = node->height;
        node->height = highest + 1;
        node = node->height < height ? node->parent : NULL;
    }
}

void node_remove_child(struct node *child)
{
    struct node *parent = child->parent;

    memory_close_slot(parent->children, parent->child_count, node_position(child));
    parent->child_count--;
    child->parent = NULL;
    lower(parent, child->height);
}

void node_move(struct node *node, struct node *parent, size_t position)
{
    const size_t old = node_position(node);

    if (parent != node->parent) {
        node_remove_child(node);
        node_add_child(parent, node, position);
        return;
    }
    struct node **from = parent->children + old, **to = parent->children + position;
    if (from < to) {
        memmove(from, from + 1, (position - old) * sizeof *from);
    } else {
        memmove(to + 1, to, (old - position) * sizeof *to);
    }
    *to = node;
    node->last_position = position;
}

/* Siblings that came and went have moved it by a few places: it is looked for around the last. */
size_t node_position(const struct node *node)
{
    const struct node *parent = node->parent;

    if (!parent) {
        return 0;
    }
    size_t low = node->last_position, high = low;
    if (low >= parent->child_count) {
        low = high = parent->child_count - 1;
    }
    while (parent->children[low] != node && parent->children[high] != node) {
        low -= low > 0;
        high += high + 1 < parent->child_count;
    }
    const size_t position = parent->children[low] == node ? low : high;
    parent->children[position]->last_position = position;
    return position;
}

struct node *node_next(const struct node *node, const struct node *top)
{
    if (node->child_count > 0) {
        return node->children[0];
    }
    for (; node != top; node = node->parent) {
        const size_t next = node_position(node) + 1;
        if (next < node->parent->child_count) {
            return node->parent->children[next];
        }
    }
    return NULL;
}

size_t node_count(const struct node *node)
{
    size_t count = 0;

    for (const struct node *each = node; each; each = node_next(each, node)) {
        count++;
    }
    return count;
}

size_t node_depth(const struct node *node)
{
    size_t depth = 1;

    while (node->parent) {
        node = node->parent;
        depth++;
    }
    return depth;
}

const struct resource *node_owner(const struct node *node)
{
    while (node->parent) {
        node = node->parent;
    }
    return node->model;
}

static struct resource *named(const struct resource_list *list, const struct node_type *type,
                              enum node_kind kind, const struct record *params, const char *param)
{
    return type->kind == kind ? resource_find(list, record_text(params, param)) : NULL;
}

const struct resource *node_model(const struct scene *scene, const struct node *node)
{
    return named(&scene->models, node->type, KIND_MODEL, &node->params, "model");
}

const struct resource *node_primitive(const struct scene *scene, const struct node *node)
{
    return named(&scene->primitives, node->type, KIND_CODE, &node->params, "primitive");
}

const struct record_type *node_params_type(const struct scene *scene, const struct node_type *type,
                                           const struct record *params)
{
    const struct resource *declaring =
        type->kind == KIND_MODEL ? named(&scene->models, type, KIND_MODEL, params, "model")
                                 : named(&scene->primitives, type, KIND_CODE, params, "primitive");

    return declaring ? &declaring->declared->type : &type->record;
}

const struct resource *node_material(const struct scene *scene, const struct node *node)
{
    for (; node; node = node->parent) {
        const char *name = record_text(&node->common, "material");
        if (*name) {
            return resource_find(&scene->materials, name);
        }
    }
    return NULL;
}
