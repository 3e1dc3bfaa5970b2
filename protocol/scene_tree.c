/* SPDX-License-Identifier: MIT */
/* Nodes and resources become part of a scene and leave it: ids, names, limits, counts of users. */
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "limits.h"
#include "memory.h"
#include "scene_internal.h"
#include "suggest.h"

/* --- ids --- */

static int compare_nodes(const void *a, const void *b)
{
    return strcmp(((const struct node *)a)->id, ((const struct node *)b)->id);
}

struct node *scene_find(const struct scene *scene, const char *id)
{
    const struct node key = {.id = (char *)id};

    struct node *const *found = tfind(&key, &scene->index->nodes, compare_nodes);
    return found ? *found : NULL;
}

bool scene_index_node(struct scene *scene, struct node *node)
{
    struct node *const *slot = tsearch(node, &scene->index->nodes, compare_nodes);
    if (!slot) {
        abort();
    }
    return *slot == node;
}

/* Also right for a subtree of which only a part is indexed. */
static void unindex(struct scene *scene, struct node *top)
{
    for (struct node *node = top; node; node = node_next(node, top)) {
        if (node->id && scene_find(scene, node->id) == node) {
            tdelete(node, &scene->index->nodes, compare_nodes);
        }
    }
}

static bool index_given_ids(struct scene *scene, struct node *top, struct error *err)
{
    for (struct node *node = top; node; node = node_next(node, top)) {
        if (node->id && !scene_index_node(scene, node)) {
            char place[ERROR_PLACE_BYTES];
            error_place(place, "/nodes", node->id);
            return error_set(err, ERROR_CONFLICT, place, "the id \"%s\" is in use", node->id);
        }
    }
    return true;
}

static void fill_in_ids(struct scene *scene, struct node *top)
{
    for (struct node *node = top; node; node = node_next(node, top)) {
        while (!node->id) {
            char id[LIMIT_ID_BYTES + 1];
            snprintf(id, sizeof id, "%s-%zu", node->type->record.name,
                     ++scene->index->next[node->type->number]);
            if (!scene_find(scene, id)) {
                node->id = memory_text(id);
                scene_index_node(scene, node);
            }
        }
    }
}

/* --- names --- */

bool scene_check_name(const struct scene *scene, const struct resource_kind *kind, const char *name,
                      const char *place, struct error *err)
{
    const struct resource_list *list = resource_list_of(kind, (struct scene *)scene);

    if (!*name || resource_find(list, name)) {
        return true;
    }
    struct suggestion suggestion = {.text = name};
    char hint[LIMIT_ID_BYTES + 32];
    for (size_t i = 0; i < list->count; i++) {
        suggest_consider(&suggestion, list->items[i]->name);
    }
    return error_set(err, ERROR_INVALID, place, "there is no %s \"%s\"%s", kind->item, name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

/* What a node names: the callback sees each kind, name and the place of the name in the node. */
static bool each_name(const struct node *node,
                      bool (*see)(void *data, const struct resource_kind *kind, const char *name,
                                  const char *member, const char *param),
                      void *data)
{
    const struct record *const records[] = {&node->common, &node->params};

    for (int r = 0; r < 2; r++) {
        const struct param *params = records[r]->type->params;
        for (int i = 0; params[i].name; i++) {
            const struct resource_kind *kind = resource_kind_named_by(params[i].type);
            if (kind && *records[r]->values[i].text &&
                !see(data, kind, records[r]->values[i].text, r ? "params" : NULL, params[i].name)) {
                return false;
            }
        }
    }
    return true;
}

struct check {
    const struct scene *scene;
    const struct node *node;
    struct error *err;
};

static bool check_name(void *data, const struct resource_kind *kind, const char *name,
                       const char *member, const char *param)
{
    const struct check *check = data;
    char place[ERROR_PLACE_BYTES];

    error_place(place, "/nodes", check->node->id);
    if (member) {
        error_place(place, place, member);
    }
    return scene_check_name(check->scene, kind, name, error_place(place, place, param), check->err);
}

static bool check_names(const struct scene *scene, const struct node *top, struct error *err)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        struct check check = {.scene = scene, .node = node, .err = err};
        if (!each_name(node, check_name, &check)) {
            return false;
        }
    }
    return true;
}

struct count {
    struct scene *scene;
    int by;
};

static bool count_user(void *data, const struct resource_kind *kind, const char *name,
                       const char *member, const char *param)
{
    (void)member;
    (void)param;
    const struct count *count = data;

    resource_find(resource_list_of(kind, count->scene), name)->users += (size_t)count->by;
    return true;
}

void scene_count_user(struct scene *scene, const struct node *node, int by)
{
    struct count count = {.scene = scene, .by = by};

    each_name(node, count_user, &count);
}

static void count_users(struct scene *scene, const struct node *top, int by)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        scene_count_user(scene, node, by);
    }
}

/* --- subtrees --- */

static bool check_room(const struct node *parent, const struct node *node, const char *place,
                       struct error *err)
{
    const size_t depth = (parent ? node_depth(parent) : 0) + node->height;

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

static bool check_count(size_t count, const char *place, struct error *err)
{
    return count <= LIMIT_NODES ||
           error_set(err, ERROR_LIMIT, place, "%zu nodes are above the maximum %d", count,
                     LIMIT_NODES);
}

bool scene_attach(struct scene *scene, struct node *node, struct node *parent, size_t position,
                  const char *place, struct error *err)
{
    const size_t count = node_count(node);

    if (!check_count(scene->node_count + count, place, err) ||
        !check_room(parent, node, place, err)) {
        return false;
    }
    bool ok = index_given_ids(scene, node, err);
    if (ok) {
        fill_in_ids(scene, node);
        ok = check_names(scene, node, err);
    }
    if (!ok) {
        unindex(scene, node);
        return false;
    }
    count_users(scene, node, 1);
    scene->node_count += count;
    if (parent) {
        node_add_child(parent, node, position);
    }
    if (!scene_check_models(scene, node, place, err)) {
        scene_detach(scene, node);
        return false;
    }
    return true;
}

static struct node *tree_at(const struct scene *scene, size_t i)
{
    return i < scene->models.count ? scene->models.items[i]->root : scene->root;
}

static bool check_targets(const struct scene *scene, const struct resource *model,
                          struct error *err)
{
    char place[ERROR_PLACE_BYTES];

    error_place(place, error_place(place, "/models", model->name), "params");
    return scene_check_targets(scene, model, model->declared, place, err);
}

static bool check_all_targets(const struct scene *scene, struct error *err)
{
    for (size_t i = 0; i < scene->models.count; i++) {
        if (!check_targets(scene, scene->models.items[i], err)) {
            return false;
        }
    }
    return true;
}

bool scene_attach_all(struct scene *scene, struct error *err)
{
    const size_t trees = scene->models.count + 1;

    for (size_t i = 0; i < trees; i++) {
        scene->node_count += node_count(tree_at(scene, i));
    }
    bool ok = check_count(scene->node_count, "", err);
    for (size_t i = 0; i < trees && ok; i++) {
        ok = index_given_ids(scene, tree_at(scene, i), err);
    }
    for (size_t i = 0; i < trees && ok; i++) {
        fill_in_ids(scene, tree_at(scene, i));
    }
    for (size_t i = 0; i < trees && ok; i++) {
        ok = check_names(scene, tree_at(scene, i), err);
    }
    for (size_t i = 0; i < trees && ok; i++) {
        count_users(scene, tree_at(scene, i), 1);
    }
    return ok && scene_check_all_models(scene, "/models", err) && check_all_targets(scene, err);
}

void scene_detach(struct scene *scene, struct node *node)
{
    unindex(scene, node);
    count_users(scene, node, -1);
    scene->node_count -= node_count(node);
    if (node->parent) {
        node_remove_child(node);
    }
}

bool scene_move(struct scene *scene, struct node *node, struct node *parent, size_t position,
                const char *place, struct error *err)
{
    struct node *home = node->parent;
    const size_t old = node_position(node);

    if (!check_room(parent, node, place, err)) {
        return false;
    }
    const bool other_tree = node_owner(home) != node_owner(parent);
    if (other_tree && !scene_check_untargeted(scene, node, place, err)) {
        return false;
    }
    node_move(node, parent, position);
    if (other_tree && !scene_check_models(scene, node, place, err)) {
        node_move(node, home, old);
        return false;
    }
    return true;
}

/* --- resources --- */

bool scene_attach_resource(struct scene *scene, const struct resource_kind *kind,
                           struct resource *resource, size_t position, const char *place,
                           struct error *err)
{
    struct resource_list *list = resource_list_of(kind, scene);

    resource_list_insert(list, resource, position);
    if (resource->root && !scene_attach(scene, resource->root, NULL, 0, place, err)) {
        resource_list_remove(list, resource);
        return false;
    }
    if (resource->root && !check_targets(scene, resource, err)) {
        scene_detach(scene, resource->root);
        resource_list_remove(list, resource);
        return false;
    }
    resource_count_user(resource, 1);
    return true;
}

void scene_detach_resource(struct scene *scene, const struct resource_kind *kind,
                           struct resource *resource)
{
    if (resource->root) {
        scene_detach(scene, resource->root);
    }
    resource_count_user(resource, -1);
    resource_list_remove(resource_list_of(kind, scene), resource);
}
