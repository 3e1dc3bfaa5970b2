/* SPDX-License-Identifier: MIT */
/* Resources from JSON and back: one way for all kinds, by their table. */
#include <string.h>

#include "json.h"
#include "limits.h"
#include "scene_internal.h"

/* --- reading --- */

static bool is_own_member(const struct resource_kind *kind, const char *name)
{
    return (kind->array && strcmp(name, "id") == 0) ||
           (kind->type && strcmp(name, kind->type) == 0) ||
           (kind->table == &model_type && strcmp(name, "root") == 0);
}

/* A model is a node, or has the node as its root beside what it declares. */
static const cJSON *root_in(const struct resource_kind *kind, const cJSON *json)
{
    return kind->table == &model_type ? cJSON_GetObjectItemCaseSensitive(json, "root") : NULL;
}

static bool read_values(struct resource *resource, const struct resource_kind *kind,
                        const cJSON *json, const char *place, struct error *err)
{
    if (kind->values) {
        const char *const names[] = {kind->type, kind->values, NULL};
        const cJSON *found[2];
        return json_sort_members(json, names, found, place, err) &&
               scene_read_record(&resource->record, found[1], place, kind->values, err);
    }
    for (const cJSON *member = json->child; member; member = member->next) {
        if (!is_own_member(kind, member->string) &&
            !record_read_member(&resource->record, member, place, err)) {
            return false;
        }
    }
    return true;
}

/* What the rows declare has to go with the kind. */
static bool read_definition(struct resource *resource, const struct resource_kind *kind,
                            const cJSON *json, const char *place, struct error *err)
{
    const int index = resource_rows(resource->record.type);

    if (index < 0) {
        return true;
    }
    const char *name = resource->record.type->params[index].name;
    const cJSON *rows = cJSON_GetObjectItemCaseSensitive(json, name);
    char path[ERROR_PLACE_BYTES];
    if (rows && !resource_check_rows(kind, rows, error_place(path, place, name), err)) {
        return false;
    }
    resource->declared = resource_define(kind, resource);
    return true;
}

static bool read_body(struct resource *resource, const struct resource_kind *kind,
                      const cJSON *json, const char *place, struct error *err)
{
    if (kind->table == &model_type && !root_in(kind, json)) {
        resource->declared = resource_define(kind, resource);
        return true;
    }
    return read_values(resource, kind, json, place, err) &&
           read_definition(resource, kind, json, place, err);
}

bool resource_read_tree(const struct scene *scene, struct resource *resource,
                        const struct resource_kind *kind, const cJSON *json, const char *place,
                        struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    const cJSON *root = root_in(kind, json);

    if (kind->table != &model_type) {
        return true;
    }
    resource->root =
        node_read(scene, root ? root : json, root ? error_place(path, place, "root") : place, err);
    if (resource->root) {
        resource->root->model = resource;
    }
    return resource->root;
}

static bool check_new_name(const struct scene *scene, const struct resource_kind *kind,
                           const char *name, const char *place, struct error *err)
{
    if (!record_check_name(name, place, err)) {
        return false;
    }
    if (resource_find(resource_list_of(kind, (struct scene *)scene), name)) {
        return error_set(err, ERROR_CONFLICT, place, "the %s \"%s\" is in use",
                         kind->array ? "id" : "name", name);
    }
    return kind->table != &shader_type || !record_type_in(shader_types, name) ||
           error_set(err, ERROR_CONFLICT, place, "\"%s\" is a built-in shader", name);
}

/* TYPE-1, TYPE-2, ...: the first that is free. */
static const char *free_name(const struct resource_list *list, const struct record_type *type,
                             char out[LIMIT_ID_BYTES + 1])
{
    int number = 1;

    do {
        snprintf(out, LIMIT_ID_BYTES + 1, "%s-%d", type->name, number++);
    } while (resource_find(list, out));
    return out;
}

/* The row of the resource's record; NULL and `err` where there is none. */
static const struct record_type *read_type(const struct scene *scene,
                                           const struct resource_kind *kind, const cJSON *json,
                                           struct resource **out_shader, const char *place,
                                           struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    const char *name;

    *out_shader = NULL;
    if (!kind->type) {
        return kind->table;
    }
    if (!json_read_text(cJSON_GetObjectItemCaseSensitive(json, kind->type), &name, place,
                        kind->type, err)) {
        return NULL;
    }
    return resource_type(scene, kind, name, out_shader, error_place(path, place, kind->type), err);
}

struct resource *resource_read(const struct scene *scene, const struct resource_kind *kind,
                               const char *name, const cJSON *json, const char *place,
                               struct error *err)
{
    char path[ERROR_PLACE_BYTES], made[LIMIT_ID_BYTES + 1];
    struct resource *shader;

    if (!cJSON_IsObject(json)) {
        error_set(err, ERROR_INVALID, place, "expected an object");
        return NULL;
    }
    if (kind->array) {
        const cJSON *id = cJSON_GetObjectItemCaseSensitive(json, "id");
        if (!scene_read_id(id, &name, place, err)) {
            return NULL;
        }
        if (name) {
            place = error_place(path, error_place(path, "", kind->list), name);
        }
    }
    if (name && !check_new_name(scene, kind, name, place, err)) {
        return NULL;
    }
    const struct record_type *type = read_type(scene, kind, json, &shader, place, err);
    if (!type) {
        return NULL;
    }
    if (!name) {
        name = free_name(resource_list_of(kind, (struct scene *)scene), type, made);
    }
    struct resource *resource = resource_create(name, type);
    resource->shader = shader;
    if (!read_body(resource, kind, json, place, err)) {
        resource_destroy(resource);
        return NULL;
    }
    return resource;
}

/* --- printing --- */

cJSON *resource_json(const struct resource_kind *kind, const struct resource *resource)
{
    cJSON *json = cJSON_CreateObject();

    if (resource->root) {
        record_print(&resource->record, json);
        if (json->child) {
            cJSON_AddItemToObject(json, "root", node_to_json(resource->root));
            return json;
        }
        cJSON_Delete(json);
        return node_to_json(resource->root);
    }
    if (kind->array) {
        cJSON_AddStringToObject(json, "id", resource->name);
    }
    if (kind->type) {
        cJSON_AddStringToObject(json, kind->type, resource->record.type->name);
    }
    if (kind->values) {
        scene_add_record(json, kind->values, &resource->record);
    } else {
        record_print(&resource->record, json);
    }
    return json;
}
