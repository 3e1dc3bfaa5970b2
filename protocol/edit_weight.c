/* SPDX-License-Identifier: MIT */
/* How much work an edit is, estimated before it is applied. */
#include <string.h>

#include "edit_internal.h"

struct weight {
    const struct scene *scene;
    size_t sum, most;
};

static void weigh_value(struct weight *weight, const cJSON *value)
{
    weight->sum++;
    for (const cJSON *part = value->child; part && weight->sum <= weight->most; part = part->next) {
        weigh_value(weight, part);
    }
}

static void weigh_nodes(struct weight *weight, const struct node *top)
{
    for (const struct node *node = top; node && weight->sum <= weight->most;
         node = node_next(node, top)) {
        weight->sum++;
    }
}

/* Rows change every node that uses them; a name of a model is followed through all models. */
static bool reaches_all_nodes(const struct resource *resource, const char *name)
{
    const struct record_type *type = resource ? resource->record.type : NULL;
    const int rows = type ? resource_rows(type) : -1;

    return strcmp(name, "model") == 0 || (rows >= 0 && strcmp(name, type->params[rows].name) == 0);
}

static void weigh_place(struct weight *weight, const char *at)
{
    struct path path;

    if (!at || !path_split(&path, at, NULL) || path.count < 2) {
        return;
    }
    const struct resource_kind *kind = edit_find_kind(&path);
    const struct resource *resource =
        kind ? resource_find(resource_list_of(kind, (struct scene *)weight->scene), path.part[1])
             : NULL;
    if (path.count > 2) {
        weight->sum +=
            reaches_all_nodes(resource, path.part[path.count - 1]) ? weight->scene->node_count : 0;
    } else if (resource) {
        weigh_nodes(weight, resource->root);
    } else if (path_is(&path, 0, "nodes")) {
        weigh_nodes(weight, scene_find(weight->scene, path.part[1]));
    }
}

size_t edit_weight(const struct scene *scene, const cJSON *ops, size_t most)
{
    struct weight weight = {.scene = scene, .most = most};

    for (const cJSON *op = ops ? ops->child : NULL; op && weight.sum <= most; op = op->next) {
        const cJSON *value = cJSON_GetObjectItemCaseSensitive(op, "value");
        weight.sum++;
        if (value) {
            weigh_value(&weight, value);
        }
        weigh_place(&weight, edit_member_text(op, "at"));
    }
    return weight.sum;
}
