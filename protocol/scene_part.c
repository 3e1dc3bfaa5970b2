/* SPDX-License-Identifier: MIT */
/* A part of a scene as a document of its own, with what it uses and nothing else. */
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "scene_internal.h"

struct part {
    const struct scene *scene;
    const struct resource **used;
    size_t used_count, used_capacity;
    size_t nodes, most;
};

static bool add_tree(struct part *part, const struct node *top);

static bool is_used(const struct part *part, const struct resource *resource)
{
    for (size_t i = part->used_count; i-- > 0;) {
        if (part->used[i] == resource) {
            return true;
        }
    }
    return false;
}

/* NULL: nothing. False: too many nodes. */
static bool add_resource(struct part *part, const struct resource *resource)
{
    if (!resource || is_used(part, resource)) {
        return true;
    }
    if (part->used_count == part->used_capacity) {
        part->used_capacity = 2 * part->used_capacity + 8;
        part->used = memory_resize(part->used, part->used_capacity, sizeof *part->used);
    }
    part->used[part->used_count++] = resource;
    return add_resource(part, resource->shader) &&
           (!resource->root || add_tree(part, resource->root));
}

static bool add_named(struct part *part, const struct record *record)
{
    for (int i = 0; record->type->params[i].name; i++) {
        const struct resource_kind *kind = resource_kind_named_by(record->type->params[i].type);
        const char *name = kind ? record->values[i].text : NULL;

        if (name && *name &&
            !add_resource(
                part, resource_find(resource_list_of(kind, (struct scene *)part->scene), name))) {
            return false;
        }
    }
    return true;
}

static bool add_tree(struct part *part, const struct node *top)
{
    for (const struct node *node = top; node; node = node_next(node, top)) {
        if (++part->nodes > part->most || !add_named(part, &node->common) ||
            !add_named(part, &node->params)) {
            return false;
        }
    }
    return true;
}

/* What two equal subtrees differ in. */
static void remove_names(cJSON *node, bool ids)
{
    cJSON *child;

    if (ids) {
        cJSON_DeleteItemFromObjectCaseSensitive(node, "id");
    }
    cJSON_DeleteItemFromObjectCaseSensitive(node, "name");
    cJSON_ArrayForEach(child, cJSON_GetObjectItemCaseSensitive(node, "children"))
    {
        remove_names(child, ids);
    }
}

/* Ids stay where parameters of a model set something of the nodes. */
static void remove_names_of_model(cJSON *model)
{
    cJSON *root = cJSON_GetObjectItemCaseSensitive(model, "root");

    remove_names(root ? root : model, !root);
}

static void print_used(const struct part *part, const struct resource_kind *kind, cJSON *json)
{
    const struct resource_list *list = resource_list_of(kind, (struct scene *)part->scene);
    cJSON *all = NULL;

    for (size_t i = 0; i < list->count; i++) {
        if (is_used(part, list->items[i])) {
            cJSON *item = resource_json(kind, list->items[i]);

            if (list->items[i]->root) {
                remove_names_of_model(item);
            }
            all = all ? all : cJSON_AddObjectToObject(json, kind->list);
            cJSON_AddItemToObject(all, list->items[i]->name, item);
        }
    }
}

static cJSON *print_root(const struct node *node, const struct resource *material)
{
    cJSON *json = node_to_json(node);
    cJSON *transform = cJSON_GetObjectItemCaseSensitive(json, "transform");

    remove_names(json, true);
    cJSON_DeleteItemFromObjectCaseSensitive(json, "visible");
    cJSON_DeleteItemFromObjectCaseSensitive(transform, "translation");
    if (transform && !transform->child) {
        cJSON_DeleteItemFromObjectCaseSensitive(json, "transform");
    }
    if (material && !cJSON_GetObjectItemCaseSensitive(json, "material")) {
        cJSON_AddStringToObject(json, "material", material->name);
    }
    return json;
}

/* Takes `root`. */
static cJSON *print_part(const struct part *part, cJSON *root)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "format", SCENE_FORMAT);
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        if (kind->user) {
            print_used(part, kind, json);
        }
    }
    cJSON_AddItemToObject(json, "root", root);
    return json;
}

cJSON *scene_part_of_node(const struct scene *scene, const struct node *node, size_t most)
{
    struct part part = {.scene = scene, .most = most};
    const struct resource *material = node_material(scene, node);
    cJSON *json = NULL;

    if (add_tree(&part, node) && add_resource(&part, material)) {
        json = print_part(&part, print_root(node, material));
    }
    free(part.used);
    return json;
}

cJSON *scene_part_of_material(const struct scene *scene, const struct resource *material)
{
    struct part part = {.scene = scene};
    cJSON *root = cJSON_CreateObject();

    add_resource(&part, material);
    cJSON_AddStringToObject(root, "type", "sphere");
    cJSON_AddStringToObject(root, "material", material->name);
    cJSON *json = print_part(&part, root);
    free(part.used);
    return json;
}
