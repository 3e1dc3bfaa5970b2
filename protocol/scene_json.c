/* SPDX-License-Identifier: MIT */
/* Reading documents strictly. Writing them is scene_print.c. */
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "scene_internal.h"
#include "suggest.h"

bool scene_read_id(const cJSON *json, const char **out, const char *place, struct error *err)
{
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, "id");
    if (!json) {
        return true;
    }
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, path, "expected a text");
    }
    *out = json->valuestring;
    return record_check_name(json->valuestring, path, err);
}

bool scene_read_record(struct record *record, const cJSON *json, const char *place,
                       const char *member, struct error *err)
{
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, member);
    return !json || record_read(record, json, path, err);
}

bool node_type_unknown(const char *name, const char *place, struct error *err)
{
    struct suggestion suggestion = {.text = name};
    char hint[64];

    for (size_t i = 0; i < node_type_count(); i++) {
        suggest_consider(&suggestion, node_type_at(i)->record.name);
    }
    return error_set(err, ERROR_INVALID, place, "unknown type \"%.64s\"%s", name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

/* --- nodes --- */

enum { NODE_ID, NODE_TYPE, NODE_TRANSFORM, NODE_PARAMS, NODE_CHILDREN, NODE_COMMON };

struct reader {
    const struct scene *scene;
    size_t count; /* nodes so far */
    struct error *err;
};

static struct node *read_tree(struct reader *reader, const cJSON *json, const char *place,
                              size_t depth);

static bool read_children(struct reader *reader, struct node *node, const cJSON *array,
                          const char *place, size_t depth)
{
    char path[ERROR_PLACE_BYTES];

    error_place(path, place, "children");
    if (array && !cJSON_IsArray(array)) {
        return error_set(reader->err, ERROR_INVALID, path, "expected an array of nodes");
    }
    for (const cJSON *item = array ? array->child : NULL; item; item = item->next) {
        if (node->child_count == LIMIT_CHILDREN) {
            return error_set(reader->err, ERROR_LIMIT, path, "more children than the maximum %d",
                             LIMIT_CHILDREN);
        }
        char child_place[ERROR_PLACE_BYTES], number[24];
        snprintf(number, sizeof number, "%zu", node->child_count);
        error_place(child_place, path, number);
        struct node *child = read_tree(reader, item, child_place, depth + 1);
        if (!child) {
            return false;
        }
        node_add_child(node, child, node->child_count);
    }
    return true;
}

/* The members of node_common_type stand beside the node's own. */
static bool read_common(struct record *common, const cJSON *const *found, const char *place,
                        struct error *err)
{
    char path[ERROR_PLACE_BYTES];

    for (int i = 0; common->type->params[i].name; i++) {
        const cJSON *json = found[NODE_COMMON + i];
        error_place(path, place, common->type->params[i].name);
        if (json && !record_read_value(common, i, json, path, err)) {
            return false;
        }
    }
    return true;
}

static bool sort_node_members(const cJSON *json, const cJSON **found, const char *place,
                              struct error *err)
{
    const char *names[16] = {"id", "type", "transform", "params", "children"};
    const size_t count = record_type_count(&node_common_type);

    assert(NODE_COMMON + count < sizeof names / sizeof names[0]);
    for (size_t i = 0; i < count; i++) {
        names[NODE_COMMON + i] = node_common_type.params[i].name;
    }
    return json_sort_members(json, names, found, place, err);
}

static bool count_node(struct reader *reader, const char *place, size_t depth)
{
    if (depth > LIMIT_NODE_DEPTH) {
        return error_set(reader->err, ERROR_LIMIT, place,
                         "%zu levels of nodes are above the maximum %d", depth, LIMIT_NODE_DEPTH);
    }
    if (++reader->count > LIMIT_NODES) {
        return error_set(reader->err, ERROR_LIMIT, place, "more nodes than the maximum %d",
                         LIMIT_NODES);
    }
    return true;
}

static const struct node_type *read_node_type(const cJSON *json, const char *place,
                                              struct error *err)
{
    char type_place[ERROR_PLACE_BYTES];
    const char *name;

    if (!json_read_text(json, &name, place, "type", err)) {
        return NULL;
    }
    const struct node_type *type = node_type_find(name);
    if (!type) {
        node_type_unknown(name, error_place(type_place, place, "type"), err);
    }
    return type;
}

/* The parameters of a field and of an instance depend on the name that is among them. A model that
 * is not there is told once the node is part of the scene. */
static const struct record_type *read_params_type(struct reader *reader,
                                                  const struct node_type *type, const cJSON *params,
                                                  const char *place)
{
    char path[ERROR_PLACE_BYTES];
    const struct scene *scene = reader->scene;
    const cJSON *name =
        cJSON_GetObjectItemCaseSensitive(params, type->kind == KIND_MODEL ? "model" : "primitive");

    if (type->kind == KIND_MODEL && cJSON_IsString(name)) {
        const struct resource *model = resource_find(&scene->models, name->valuestring);
        return model ? &model->declared->type : &type->record;
    }
    if (type->kind != KIND_CODE || !cJSON_IsString(name) || !*name->valuestring) {
        return &type->record;
    }
    error_place(path, error_place(path, place, "params"), "primitive");
    if (!scene_check_name(scene, resource_kind_named_by(PARAM_FUNCTION), name->valuestring, path,
                          reader->err)) {
        return NULL;
    }
    return &resource_find(&scene->primitives, name->valuestring)->declared->type;
}

static struct node *read_tree(struct reader *reader, const cJSON *json, const char *place,
                              size_t depth)
{
    const cJSON *found[16];
    const char *id = NULL;
    char path[ERROR_PLACE_BYTES];
    struct error *err = reader->err;
    const cJSON *given = cJSON_IsObject(json) ? cJSON_GetObjectItemCaseSensitive(json, "id") : NULL;

    if (!scene_read_id(given, &id, place, err)) {
        return NULL;
    }
    if (id) {
        place = error_place(path, "/nodes", id);
    }
    if (!count_node(reader, place, depth) || !sort_node_members(json, found, place, err)) {
        return NULL;
    }
    const struct node_type *type = read_node_type(found[NODE_TYPE], place, err);
    if (!type) {
        return NULL;
    }
    const struct record_type *params = read_params_type(reader, type, found[NODE_PARAMS], place);
    if (!params) {
        return NULL;
    }
    struct node *node = node_create(type, params);
    node->id = id ? memory_text(id) : NULL;
    if (!read_common(&node->common, found, place, err) ||
        !scene_read_record(&node->transform, found[NODE_TRANSFORM], place, "transform", err) ||
        !scene_read_record(&node->params, found[NODE_PARAMS], place, "params", err) ||
        !read_children(reader, node, found[NODE_CHILDREN], place, depth)) {
        node_destroy(node);
        return NULL;
    }
    return node;
}

struct node *node_read(const struct scene *scene, const cJSON *json, const char *place,
                       struct error *err)
{
    struct reader reader = {.scene = scene, .err = err};

    return read_tree(&reader, json, place, 1);
}

/* --- documents --- */

enum { DOC_FORMAT, DOC_NAME, DOC_CAMERA, DOC_ENVIRONMENT, DOC_RENDER, DOC_ROOT, DOC_RESOURCES };

static bool check_format(const cJSON *format, struct error *err)
{
    return (cJSON_IsString(format) && strcmp(format->valuestring, SCENE_FORMAT) == 0) ||
           error_set(err, ERROR_INVALID, "/format", "%s \"" SCENE_FORMAT "\"",
                     format ? "expected" : "is missing, expected");
}

/* Of all models in the list: each may have instances of those behind it. */
static bool read_trees(struct scene *scene, const struct resource_kind *kind, const cJSON *json,
                       struct error *err)
{
    const struct resource_list *list = resource_list_of(kind, scene);
    const cJSON *item = json ? json->child : NULL;
    char place[ERROR_PLACE_BYTES];

    for (size_t i = 0; i < list->count; i++, item = item->next) {
        struct resource *resource = list->items[i];
        error_place(place, error_place(place, "", kind->list), resource->name);
        if (!resource_read_tree(scene, resource, kind, item, place, err)) {
            return false;
        }
    }
    return true;
}

static bool read_resources(struct scene *scene, const struct resource_kind *kind, const cJSON *json,
                           struct error *err)
{
    struct resource_list *list = resource_list_of(kind, scene);
    char home[ERROR_PLACE_BYTES], place[ERROR_PLACE_BYTES], number[24];

    error_place(home, "", kind->list);
    if (json && !(kind->array ? cJSON_IsArray(json) : cJSON_IsObject(json))) {
        return error_set(err, ERROR_INVALID, home, "expected an %s of %s",
                         kind->array ? "array" : "object", kind->list);
    }
    for (const cJSON *item = json ? json->child : NULL; item; item = item->next) {
        if (list->count == kind->limit) {
            return error_set(err, ERROR_LIMIT, home, "more %s than the maximum %zu", kind->list,
                             kind->limit);
        }
        snprintf(number, sizeof number, "%zu", list->count);
        error_place(place, home, item->string ? item->string : number);
        struct resource *resource = resource_read(scene, kind, item->string, item, place, err);
        if (!resource) {
            return false;
        }
        resource_list_insert(list, resource, list->count);
        resource_count_user(resource, 1);
    }
    return read_trees(scene, kind, json, err);
}

static bool read_all_resources(struct scene *scene, const cJSON *const *found, struct error *err)
{
    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        if (!read_resources(scene, kind, found[DOC_RESOURCES + (kind - resource_kinds)], err)) {
            return false;
        }
    }
    return true;
}

static bool read_root(struct scene *scene, const cJSON *json, struct error *err)
{
    if (!json) {
        return error_set(err, ERROR_INVALID, "/root", "is missing");
    }
    scene->root = node_read(scene, json, "/root", err);
    return scene->root;
}

static bool read_document(struct scene *scene, const cJSON *document, struct error *err)
{
    const char *names[16] = {"format", "name", "camera", "environment", "render", "root"};
    const cJSON *found[16];

    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        names[DOC_RESOURCES + (kind - resource_kinds)] = kind->list;
    }
    if (!json_sort_members(document, names, found, "", err) ||
        !check_format(found[DOC_FORMAT], err)) {
        return false;
    }
    if (found[DOC_NAME] && !record_read_value(&scene->info, 0, found[DOC_NAME], "/name", err)) {
        return false;
    }
    return scene_read_record(&scene->camera, found[DOC_CAMERA], "", "camera", err) &&
           read_all_resources(scene, found, err) &&
           scene_read_record(&scene->environment, found[DOC_ENVIRONMENT], "", "environment", err) &&
           scene_read_record(&scene->render, found[DOC_RENDER], "", "render", err) &&
           read_root(scene, found[DOC_ROOT], err) && scene_attach_all(scene, err);
}

struct scene *scene_read(const cJSON *document, struct error *err)
{
    struct scene *scene = scene_create_without_root();

    if (!read_document(scene, document, err)) {
        scene_destroy(scene);
        return NULL;
    }
    return scene;
}

/* Takes `document`. */
static struct scene *take_document(cJSON *document, struct error *err)
{
    struct scene *scene = document ? scene_read(document, err) : NULL;

    cJSON_Delete(document);
    memory_settle();
    return scene;
}

struct scene *scene_parse(const char *text, size_t length, struct error *err)
{
    return take_document(json_parse(text, length, err), err);
}

struct scene *scene_parse_printed(const char *text, size_t length, struct error *err)
{
    return take_document(json_parse_printed(text, length, err), err);
}
