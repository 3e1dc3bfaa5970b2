/* SPDX-License-Identifier: MIT */
/* Resources: their kinds, their lists, and the rows that they declare. Their JSON is
 * resource_json.c. */
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "scene_internal.h"
#include "suggest.h"

/* clang-format off */
const struct resource_kind resource_kinds[] = {
    {.list = "lights", .item = "light", .offset = offsetof(struct scene, lights),
     .limit = LIMIT_LIGHTS, .array = true, .type = "type", .table = light_types},
    {.list = "volumes", .item = "volume", .offset = offsetof(struct scene, volumes),
     .limit = LIMIT_VOLUMES, .array = true, .type = "type", .table = volume_types},
    {.list = "primitives", .item = "primitive", .user = "node", .named_by = PARAM_FUNCTION,
     .offset = offsetof(struct scene, primitives), .limit = LIMIT_PRIMITIVES, .extends = "field",
     .table = &primitive_type},
    {.list = "shaders", .item = "shader", .user = "material",
     .offset = offsetof(struct scene, shaders), .limit = LIMIT_SHADERS, .table = &shader_type},
    {.list = "materials", .item = "material", .user = "node", .named_by = PARAM_MATERIAL,
     .offset = offsetof(struct scene, materials), .limit = LIMIT_MATERIALS, .type = "shader",
     .values = "properties", .table = shader_types},
    {.list = "models", .item = "model", .user = "node", .named_by = PARAM_MODEL,
     .offset = offsetof(struct scene, models), .limit = LIMIT_MODELS, .extends = "model",
     .table = &model_type},
    {.list = NULL},
};
/* clang-format on */

struct resource_list *resource_list_of(const struct resource_kind *kind, struct scene *scene)
{
    return (struct resource_list *)((char *)scene + kind->offset);
}

const struct resource_kind *resource_kind_find(const char *list)
{
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        if (strcmp(kind->list, list) == 0) {
            return kind;
        }
    }
    return NULL;
}

const struct resource_kind *resource_kind_named_by(enum param_type type)
{
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        if (kind->named_by && kind->named_by == (int)type) {
            return kind;
        }
    }
    return NULL;
}

/* --- single ones --- */

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
    node_destroy(resource->root);
    declared_params_destroy(resource->declared);
    record_finish(&resource->record);
    free(resource->name);
    free(resource);
}

const struct record_type *resource_type(const struct scene *scene, const struct resource_kind *kind,
                                        const char *name, struct resource **out_shader,
                                        const char *place, struct error *err)
{
    const struct record_type *type = record_type_in(kind->table, name);
    const struct resource_list *shaders = kind->table == shader_types ? &scene->shaders : NULL;

    *out_shader = shaders ? resource_find(shaders, name) : NULL;
    if (type || *out_shader) {
        return type ? type : &(*out_shader)->declared->type;
    }
    struct suggestion suggestion = {.text = name};
    char hint[LIMIT_ID_BYTES + 32];
    for (type = kind->table; type->name; type++) {
        suggest_consider(&suggestion, type->name);
    }
    for (size_t i = 0; shaders && i < shaders->count; i++) {
        suggest_consider(&suggestion, shaders->items[i]->name);
    }
    error_set(err, ERROR_INVALID, place, "unknown %s \"%.64s\"%s", kind->type, name,
              suggest_hint(&suggestion, hint, sizeof hint));
    return NULL;
}

void resource_count_user(struct resource *material, int by)
{
    if (material->shader) {
        material->shader->users += (size_t)by;
    }
}

int resource_rows(const struct record_type *type)
{
    for (int i = 0; type->params[i].name; i++) {
        if (type->params[i].type == PARAM_ROWS) {
            return i;
        }
    }
    return -1;
}

static const struct record_type *extended(const struct resource_kind *kind)
{
    return kind->extends ? &node_type_find(kind->extends)->record : NULL;
}

bool resource_check_rows(const struct resource_kind *kind, const cJSON *rows, const char *place,
                         struct error *err)
{
    return declared_params_check(rows,
                                 kind->table == &model_type ? DECLARED_OF_MODEL : DECLARED_OF_CODE,
                                 extended(kind), place, err);
}

struct declared_params *resource_define(const struct resource_kind *kind,
                                        const struct resource *resource)
{
    const int rows = resource_rows(resource->record.type);

    return declared_params_create(resource->name, extended(kind),
                                  resource->record.values[rows].text);
}

/* --- lists --- */

static int compare_resources(const void *a, const void *b)
{
    return strcmp(((const struct resource *)a)->name, ((const struct resource *)b)->name);
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
    list->items = memory_open_slot(list->items, list->count, position);
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
    memory_close_slot(list->items, list->count, resource_list_position(list, resource));
    list->count--;
    tdelete(resource, &list->names, compare_resources);
}
