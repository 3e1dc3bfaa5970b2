/* SPDX-License-Identifier: MIT */
/* The scene in memory: nodes, resources, and finding them. Its JSON is scene_json.c. */
#include "scene.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "memory.h"
#include "nearest.h"
#include "scene_parts.h"

/* Balanced trees of the C library: no choice of ids makes them slow, as it would a hash table. */
struct node_index {
    void *nodes;
    size_t *next; /* for each type: numbers below are not given to nodes without an id */
};

static void keep(void *item)
{
    (void)item;
}

static int compare_nodes(const void *a, const void *b)
{
    return strcmp(((const struct node *)a)->id, ((const struct node *)b)->id);
}

static int compare_resources(const void *a, const void *b)
{
    return strcmp(((const struct resource *)a)->name, ((const struct resource *)b)->name);
}

/* Makes room for one more pointer at `position`. Capacity is the next power of two. */
static void *make_room(void *items, size_t count, size_t position)
{
    if ((count & (count - 1)) == 0) {
        items = memory_resize(items, count ? 2 * count : 1, sizeof(void *));
    }
    void **slots = items;
    memmove(slots + position + 1, slots + position, (count - position) * sizeof *slots);
    return items;
}

static void close_gap(void *items, size_t count, size_t position)
{
    void **slots = items;
    memmove(slots + position, slots + position + 1, (count - position - 1) * sizeof *slots);
}

/* --- nodes --- */

struct node *node_create(const struct node_type *type)
{
    struct node *node = memory_alloc(1, sizeof *node);
    node->type = type;
    record_init(&node->common, &node_common_type);
    record_init(&node->transform, &transform_type);
    record_init(&node->params, &type->record);
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

static void add_child(struct node *parent, struct node *child, size_t position)
{
    parent->children = make_room(parent->children, parent->child_count, position);
    parent->children[position] = child;
    parent->child_count++;
    child->parent = parent;
}

static void remove_child(struct node *child)
{
    struct node *parent = child->parent;
    close_gap(parent->children, parent->child_count, node_position(child));
    parent->child_count--;
    child->parent = NULL;
}

void node_append(struct node *parent, struct node *child)
{
    add_child(parent, child, parent->child_count);
}

static struct node *copy_node(const struct node *from)
{
    struct node *to = memory_alloc(1, sizeof *to);
    to->id = memory_text(from->id);
    to->type = from->type;
    record_copy(&to->common, &from->common);
    record_copy(&to->transform, &from->transform);
    record_copy(&to->params, &from->params);
    for (size_t i = 0; i < from->child_count; i++) {
        node_append(to, copy_node(from->children[i]));
    }
    return to;
}

static size_t count_nodes(const struct node *node)
{
    size_t count = 1;
    for (size_t i = 0; i < node->child_count; i++) {
        count += count_nodes(node->children[i]);
    }
    return count;
}

size_t node_height(const struct node *node)
{
    size_t height = 0;
    for (size_t i = 0; i < node->child_count; i++) {
        size_t below = node_height(node->children[i]);
        height = below > height ? below : height;
    }
    return height + 1;
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

size_t node_position(const struct node *node)
{
    size_t position = 0;
    while (node->parent && node->parent->children[position] != node) {
        position++;
    }
    return position;
}

const char *node_material_name(const struct node *node)
{
    return record_text(&node->common, "material");
}

const struct resource *node_material(const struct scene *scene, const struct node *node)
{
    for (; node; node = node->parent) {
        const char *name = node_material_name(node);
        if (*name) {
            return resource_find(&scene->materials, name);
        }
    }
    return NULL;
}

/* --- the index of nodes --- */

struct node *scene_find(const struct scene *scene, const char *id)
{
    const struct node key = {.id = (char *)id};
    struct node *const *found = tfind(&key, &scene->index->nodes, compare_nodes);
    return found ? *found : NULL;
}

static bool index_node(struct scene *scene, struct node *node)
{
    struct node *const *slot = tsearch(node, &scene->index->nodes, compare_nodes);
    if (!slot) {
        abort();
    }
    return *slot == node;
}

/* Also right for a subtree of which only a part is indexed. */
static void unindex_tree(struct scene *scene, struct node *node)
{
    if (node->id && scene_find(scene, node->id) == node) {
        tdelete(node, &scene->index->nodes, compare_nodes);
    }
    for (size_t i = 0; i < node->child_count; i++) {
        unindex_tree(scene, node->children[i]);
    }
}

static bool index_given_ids(struct scene *scene, struct node *node, struct error *err)
{
    if (node->id && !index_node(scene, node)) {
        char place[ERROR_PLACE_BYTES];
        error_place(place, "/nodes", node->id);
        return error_set(err, ERROR_CONFLICT, place, "the id \"%s\" is in use", node->id);
    }
    for (size_t i = 0; i < node->child_count; i++) {
        if (!index_given_ids(scene, node->children[i], err)) {
            return false;
        }
    }
    return true;
}

static void fill_in_ids(struct scene *scene, struct node *node)
{
    size_t type = 0;
    while (node_type_at(type) != node->type) {
        type++;
    }
    while (!node->id) {
        char id[LIMIT_ID_BYTES + 1];
        snprintf(id, sizeof id, "%s-%zu", node->type->record.name, ++scene->index->next[type]);
        if (!scene_find(scene, id)) {
            node->id = memory_text(id);
            index_node(scene, node);
        }
    }
    for (size_t i = 0; i < node->child_count; i++) {
        fill_in_ids(scene, node->children[i]);
    }
}

/* --- changing the tree --- */

bool scene_check_material(const struct scene *scene, const char *name, const char *place,
                          struct error *err)
{
    if (!*name || resource_find(&scene->materials, name)) {
        return true;
    }
    struct nearest nearest = {.text = name};
    char hint[LIMIT_ID_BYTES + 32];
    for (size_t i = 0; i < scene->materials.count; i++) {
        nearest_consider(&nearest, scene->materials.items[i]->name);
    }
    return error_set(err, ERROR_INVALID, place, "there is no material \"%s\"%s", name,
                     nearest_hint(&nearest, hint, sizeof hint));
}

void scene_count_user(struct scene *scene, const struct node *node, int by)
{
    struct resource *material = resource_find(&scene->materials, node_material_name(node));
    if (material) {
        material->users += (size_t)by;
    }
}

static void count_users(struct scene *scene, const struct node *node, int by)
{
    scene_count_user(scene, node, by);
    for (size_t i = 0; i < node->child_count; i++) {
        count_users(scene, node->children[i], by);
    }
}

static bool check_materials(const struct scene *scene, const struct node *node, struct error *err)
{
    char place[ERROR_PLACE_BYTES];
    error_place(place, error_place(place, "/nodes", node->id), "material");
    if (!scene_check_material(scene, node_material_name(node), place, err)) {
        return false;
    }
    for (size_t i = 0; i < node->child_count; i++) {
        if (!check_materials(scene, node->children[i], err)) {
            return false;
        }
    }
    return true;
}

bool scene_check_room(const struct node *parent, const struct node *node, const char *place,
                      struct error *err)
{
    size_t depth = (parent ? node_depth(parent) : 0) + node_height(node);
    if (depth > LIMIT_NODE_DEPTH) {
        return error_set(err, ERROR_LIMIT, place, "%zu levels of nodes are above the maximum %d",
                         depth, LIMIT_NODE_DEPTH);
    }
    if (parent && node->parent != parent && parent->child_count >= LIMIT_CHILDREN) {
        return error_set(err, ERROR_LIMIT, place, "%zu children are above the maximum %d",
                         parent->child_count + 1, LIMIT_CHILDREN);
    }
    return true;
}

bool scene_attach(struct scene *scene, struct node *node, struct node *parent, size_t position,
                  const char *place, struct error *err)
{
    size_t count = scene->node_count + count_nodes(node);
    if (count > LIMIT_NODES) {
        return error_set(err, ERROR_LIMIT, place, "%zu nodes are above the maximum %d", count,
                         LIMIT_NODES);
    }
    if (!scene_check_room(parent, node, place, err)) {
        return false;
    }
    bool ok = index_given_ids(scene, node, err);
    if (ok) {
        fill_in_ids(scene, node);
        ok = check_materials(scene, node, err);
    }
    if (!ok) {
        unindex_tree(scene, node);
        return false;
    }
    count_users(scene, node, 1);
    if (parent) {
        add_child(parent, node, position);
    } else {
        scene->root = node;
    }
    scene->node_count = count;
    return true;
}

void scene_detach(struct scene *scene, struct node *node)
{
    unindex_tree(scene, node);
    count_users(scene, node, -1);
    scene->node_count -= count_nodes(node);
    remove_child(node);
}

void scene_move(struct node *node, struct node *parent, size_t position)
{
    remove_child(node);
    add_child(parent, node, position);
}

/* --- resources --- */

struct resource *resource_create(const char *name, const struct record_type *type)
{
    struct resource *resource = memory_alloc(1, sizeof *resource);
    resource->name = memory_text(name);
    record_init(&resource->record, type);
    return resource;
}

void resource_destroy(struct resource *resource)
{
    if (!resource) {
        return;
    }
    free(resource->name);
    record_finish(&resource->record);
    free(resource);
}

struct resource *resource_find(const struct resource_list *list, const char *name)
{
    const struct resource key = {.name = (char *)name};
    struct resource *const *found = tfind(&key, &list->names, compare_resources);
    return found ? *found : NULL;
}

void resource_list_insert(struct resource_list *list, struct resource *resource, size_t position)
{
    if (!tsearch(resource, &list->names, compare_resources)) {
        abort();
    }
    list->items = make_room(list->items, list->count, position);
    list->items[position] = resource;
    list->count++;
}

size_t resource_list_position(const struct resource_list *list, const struct resource *resource)
{
    size_t position = 0;
    while (list->items[position] != resource) {
        position++;
    }
    return position;
}

void resource_list_remove(struct resource_list *list, struct resource *resource)
{
    close_gap(list->items, list->count, resource_list_position(list, resource));
    list->count--;
    tdelete(resource, &list->names, compare_resources);
}

static void finish_list(struct resource_list *list)
{
    tdestroy(list->names, keep);
    for (size_t i = 0; i < list->count; i++) {
        resource_destroy(list->items[i]);
    }
    free(list->items);
}

static void copy_list(struct resource_list *to, const struct resource_list *from)
{
    for (size_t i = 0; i < from->count; i++) {
        struct resource *copy = memory_alloc(1, sizeof *copy);
        copy->name = memory_text(from->items[i]->name);
        copy->users = from->items[i]->users;
        record_copy(&copy->record, &from->items[i]->record);
        resource_list_insert(to, copy, i);
    }
}

/* --- scenes --- */

struct scene *scene_create_without_root(void)
{
    struct scene *scene = memory_alloc(1, sizeof *scene);
    record_init(&scene->info, &scene_info_type);
    record_init(&scene->camera, &camera_type);
    record_init(&scene->environment, &environment_type);
    record_init(&scene->render, &render_type);
    scene->index = memory_alloc(1, sizeof *scene->index);
    scene->index->next = memory_alloc(node_type_count(), sizeof *scene->index->next);
    return scene;
}

struct scene *scene_create_empty(void)
{
    struct scene *scene = scene_create_without_root();
    struct node *root = node_create(node_type_find("union"));
    root->id = memory_text("root");
    scene_attach(scene, root, NULL, 0, "", NULL);
    return scene;
}

struct scene *scene_copy(const struct scene *scene)
{
    struct scene *copy = memory_alloc(1, sizeof *copy);
    record_copy(&copy->info, &scene->info);
    record_copy(&copy->camera, &scene->camera);
    record_copy(&copy->environment, &scene->environment);
    record_copy(&copy->render, &scene->render);
    copy_list(&copy->lights, &scene->lights);
    copy_list(&copy->materials, &scene->materials);
    copy->root = copy_node(scene->root);
    copy->node_count = scene->node_count;
    copy->index = memory_alloc(1, sizeof *copy->index);
    copy->index->next = memory_alloc(node_type_count(), sizeof *copy->index->next);
    memcpy(copy->index->next, scene->index->next, node_type_count() * sizeof *copy->index->next);
    index_given_ids(copy, copy->root, NULL);
    return copy;
}

void scene_destroy(struct scene *scene)
{
    if (!scene) {
        return;
    }
    tdestroy(scene->index->nodes, keep);
    free(scene->index->next);
    free(scene->index);
    node_destroy(scene->root);
    finish_list(&scene->lights);
    finish_list(&scene->materials);
    record_finish(&scene->info);
    record_finish(&scene->camera);
    record_finish(&scene->environment);
    record_finish(&scene->render);
    free(scene);
}

static size_t walk_node(const struct node *node, size_t index,
                        void (*visit)(void *data, const struct node *node, size_t index),
                        void *data)
{
    visit(data, node, index++);
    for (size_t i = 0; i < node->child_count; i++) {
        index = walk_node(node->children[i], index, visit, data);
    }
    return index;
}

void scene_walk(const struct scene *scene,
                void (*visit)(void *data, const struct node *node, size_t index), void *data)
{
    walk_node(scene->root, 0, visit, data);
}

static const struct resource *named(const struct resource_list *list, const struct node *node,
                                    enum node_kind kind, const char *param)
{
    return node->type->kind == kind ? resource_find(list, record_text(&node->params, param)) : NULL;
}

const struct resource *node_model(const struct scene *scene, const struct node *node)
{
    return named(&scene->models, node, KIND_MODEL, "model");
}

const struct resource *node_primitive(const struct scene *scene, const struct node *node)
{
    return named(&scene->primitives, node, KIND_CODE, "primitive");
}
