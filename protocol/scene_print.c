/* SPDX-License-Identifier: MIT */
/* Writing documents so that they read back the same: what is set, in the order of the tables. */
#include "json.h"
#include "scene_parts.h"

/* Adds the record as an object, unless nothing in it is set. */
static void add_record(cJSON *object, const char *name, const struct record *record)
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
    add_record(json, "transform", &node->transform);
    add_record(json, "params", &node->params);
    if (node->child_count > 0) {
        cJSON *children = cJSON_AddArrayToObject(json, "children");
        for (size_t i = 0; i < node->child_count; i++) {
            cJSON_AddItemToArray(children, node_to_json(node->children[i]));
        }
    }
    return json;
}

cJSON *resource_light_json(const struct resource *light)
{
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "id", light->name);
    cJSON_AddStringToObject(json, "type", light->record.type->name);
    record_print(&light->record, json);
    return json;
}

cJSON *resource_material_json(const struct resource *material)
{
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "shader", material->record.type->name);
    add_record(json, "properties", &material->record);
    return json;
}

cJSON *scene_to_json(const struct scene *scene)
{
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "format", SCENE_FORMAT);
    record_print(&scene->info, json);
    add_record(json, "camera", &scene->camera);
    if (scene->lights.count > 0) {
        cJSON *lights = cJSON_AddArrayToObject(json, "lights");
        for (size_t i = 0; i < scene->lights.count; i++) {
            cJSON_AddItemToArray(lights, resource_light_json(scene->lights.items[i]));
        }
    }
    if (scene->materials.count > 0) {
        cJSON *materials = cJSON_AddObjectToObject(json, "materials");
        for (size_t i = 0; i < scene->materials.count; i++) {
            const struct resource *material = scene->materials.items[i];
            cJSON_AddItemToObject(materials, material->name, resource_material_json(material));
        }
    }
    add_record(json, "environment", &scene->environment);
    add_record(json, "render", &scene->render);
    cJSON_AddItemToObject(json, "root", node_to_json(scene->root));
    return json;
}

char *scene_print(const struct scene *scene, bool pretty)
{
    cJSON *json = scene_to_json(scene);
    char *text = json_print(json, pretty);
    cJSON_Delete(json);
    return text;
}
