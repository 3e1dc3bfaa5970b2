/* SPDX-License-Identifier: MIT */
/* How much work an edit is, estimated before it is applied. */
#include <string.h>

#include "edit_internal.h"

enum { TEXT_BYTES = 256 }; /* of a text that are as much work as a value */

struct weight {
    const struct scene *scene;
    size_t sum, most;
    bool instances;  /* operations so far brought, moved or made instances of models */
    bool into_model; /* they put something into a tree of a model */
};

static bool is_instance(const cJSON *member)
{
    const struct node_type *type =
        member->string && strcmp(member->string, "type") == 0 && cJSON_IsString(member)
            ? node_type_find(member->valuestring)
            : NULL;

    return type && type->kind == KIND_MODEL;
}

/* Whether an instance of a model is in it. */
static bool weigh_value(struct weight *weight, const cJSON *value)
{
    bool instance = is_instance(value);

    weight->sum += 1 + (cJSON_IsString(value) ? strlen(value->valuestring) / TEXT_BYTES : 0);
    for (const cJSON *part = value->child; part && weight->sum <= weight->most; part = part->next) {
        instance = weigh_value(weight, part) || instance;
    }
    return instance;
}

static bool weigh_nodes(struct weight *weight, const struct node *top)
{
    bool instance = false;

    for (const struct node *node = top; node && weight->sum <= weight->most;
         node = node_next(node, top)) {
        weight->sum++;
        instance = instance || node->type->kind == KIND_MODEL;
    }
    return instance;
}

/* Rows change every node that uses them; a name of a model is followed through all models. */
static bool reaches_all_nodes(const struct resource *resource, const char *name)
{
    const struct record_type *type = resource ? resource->record.type : NULL;
    const int rows = type ? resource_rows(type) : -1;

    return strcmp(name, "model") == 0 || (rows >= 0 && strcmp(name, type->params[rows].name) == 0);
}

/* Whether an instance of a model may be there, or become one. */
static bool weigh_place(struct weight *weight, const char *at)
{
    struct path path;

    if (!at || !path_split(&path, at, NULL) || path.count < 2) {
        return false;
    }
    const struct resource_kind *kind = edit_find_kind(&path);
    const struct resource *resource =
        kind ? resource_find(resource_list_of(kind, (struct scene *)weight->scene), path.part[1])
             : NULL;
    if (path.count > 2) {
        const bool all = reaches_all_nodes(resource, path.part[path.count - 1]);
        weight->sum += all ? weight->scene->node_count : 0;
        return all;
    }
    const struct node *node =
        path_is(&path, 0, "nodes") ? scene_find(weight->scene, path.part[1]) : NULL;
    return weigh_nodes(weight, resource ? resource->root : node);
}

/* Whether the place is in a tree of a model: one that is there, or one that is brought. */
static bool is_in_model(const struct weight *weight, const char *into)
{
    struct path path;

    if (!path_split(&path, into, NULL)) {
        return false;
    }
    const struct node *parent = path.count == 2 ? scene_find(weight->scene, path.part[1]) : NULL;
    return (parent && node_owner(parent)) || (path.count == 1 && path_is(&path, 0, "models"));
}

/* An instance in a model is followed through all models. Where an operation finds what an earlier
 * one moved, nobody knows yet where that is: then it counts as if it found any of them. */
static void weigh_target(struct weight *weight, const char *into)
{
    weight->into_model = weight->into_model || is_in_model(weight, into);
    weight->sum += weight->instances && weight->into_model ? weight->scene->node_count : 0;
}

size_t edit_weight(const struct scene *scene, const cJSON *ops, size_t most)
{
    struct weight weight = {.scene = scene, .most = most};

    for (const cJSON *op = ops ? ops->child : NULL; op && weight.sum <= most; op = op->next) {
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(op, "value");
        const char *into = edit_member_text(op, "into");
        weight.sum++;
        const bool brings = value && weigh_value(&weight, value);
        const bool moves = weigh_place(&weight, edit_member_text(op, "at"));
        weight.instances = weight.instances || brings || moves;
        if (into) {
            weigh_target(&weight, into);
        }
    }
    return weight.sum;
}
