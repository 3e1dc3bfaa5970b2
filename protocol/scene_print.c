/* SPDX-License-Identifier: MIT */
/* Writing documents so that they read back the same: what is set, in the order of the tables. */
#include "json.h"
#include "memory.h"
#include "scene_internal.h"

void scene_add_record(cJSON *object, const char *name, const struct record *record)
{
    cJSON *json = cJSON_CreateObject();

    record_print(record, json);
    if (json->child) {
        cJSON_AddItemToObject(object, name, json);
    } else {
        cJSON_Delete(json);
    }
}

cJSON *node_to_json(const struct node *node)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "id", node->id);
    cJSON_AddStringToObject(json, "type", node->type->record.name);
    record_print(&node->common, json);
    scene_add_record(json, "transform", &node->transform);
    scene_add_record(json, "params", &node->params);
    if (node->child_count > 0) {
        cJSON *children = cJSON_AddArrayToObject(json, "children");
        for (size_t i = 0; i < node->child_count; i++) {
            cJSON_AddItemToArray(children, node_to_json(node->children[i]));
        }
    }
    return json;
}

static void add_resources(cJSON *json, const struct scene *scene, const struct resource_kind *kind)
{
    const struct resource_list *list = resource_list_of(kind, (struct scene *)scene);

    if (list->count == 0) {
        return;
    }
    cJSON *all = kind->array ? cJSON_CreateArray() : cJSON_CreateObject();
    cJSON_AddItemToObject(json, kind->list, all);
    for (size_t i = 0; i < list->count; i++) {
        cJSON *item = resource_json(kind, list->items[i]);
        if (kind->array) {
            cJSON_AddItemToArray(all, item);
        } else {
            cJSON_AddItemToObject(all, list->items[i]->name, item);
        }
    }
}

cJSON *scene_to_json(const struct scene *scene)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "format", SCENE_FORMAT);
    record_print(&scene->info, json);
    scene_add_record(json, "camera", &scene->camera);
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        add_resources(json, scene, kind);
    }
    scene_add_record(json, "environment", &scene->environment);
    scene_add_record(json, "render", &scene->render);
    cJSON_AddItemToObject(json, "root", node_to_json(scene->root));
    return json;
}

char *scene_print(const struct scene *scene, bool pretty)
{
    cJSON *json = scene_to_json(scene);
    char *text = json_print(json, pretty);

    cJSON_Delete(json);
    memory_settle();
    return text;
}
