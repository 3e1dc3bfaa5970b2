/* SPDX-License-Identifier: MIT */
/* Reading documents strictly. Writing them is scene_print.c. */
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "limits.h"
#include "memory.h"
#include "nearest.h"
#include "scene_parts.h"

static bool fail_member(const char *name, const char *const *names, const char *place,
                        struct error *err)
{
    struct nearest nearest = {.text = name};
    char path[ERROR_PLACE_BYTES], hint[64];
    for (int i = 0; names[i]; i++) {
        nearest_consider(&nearest, names[i]);
    }
    return error_set(err, ERROR_INVALID, error_place(path, place, name),
                     "there is no member \"%.64s\" here%s", name,
                     nearest_hint(&nearest, hint, sizeof hint));
}

/* Members of an object that is no record of its own: each name at most once, no other. The JSON
 * of name i goes to found[i], NULL where absent. */
static bool sort_members(const cJSON *object, const char *const *names, const cJSON **found,
                         const char *place, struct error *err)
{
    if (!cJSON_IsObject(object)) {
        return error_set(err, ERROR_INVALID, place, "expected an object");
    }
    for (int i = 0; names[i]; i++) {
        found[i] = NULL;
    }
    for (const cJSON *member = object->child; member; member = member->next) {
        int i = 0;
        while (names[i] && strcmp(names[i], member->string) != 0) {
            i++;
        }
        if (!names[i]) {
            return fail_member(member->string, names, place, err);
        }
        found[i] = member;
    }
    return true;
}

static bool fail_name(const char *name, const char *place, struct error *err)
{
    return error_set(err, ERROR_INVALID, place,
                     "\"%.80s\" is not a name: expected 1 to %d of A-Z a-z 0-9 _ . -", name,
                     LIMIT_ID_BYTES);
}

/* `json` NULL: absent, `*out` stays NULL. */
static bool read_id(const cJSON *json, const char **out, const char *place, struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    error_place(path, place, "id");
    if (!json) {
        return true;
    }
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, path, "expected a text");
    }
    if (!record_name_valid(json->valuestring)) {
        return fail_name(json->valuestring, path, err);
    }
    *out = json->valuestring;
    return true;
}

static bool read_type_name(const cJSON *json, const char **out, const char *place,
                           const char *member, struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    error_place(path, place, member);
    if (!json) {
        return error_set(err, ERROR_INVALID, path, "is missing");
    }
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_INVALID, path, "expected a text");
    }
    *out = json->valuestring;
    return true;
}

static bool read_record(struct record *record, const cJSON *json, const char *place,
                        const char *member, struct error *err)
{
    char path[ERROR_PLACE_BYTES];
    error_place(path, place, member);
    return !json || record_read(record, json, path, err);
}

bool node_type_unknown(const char *name, const char *place, struct error *err)
{
    struct nearest nearest = {.text = name};
    char hint[64];
    for (size_t i = 0; i < node_type_count(); i++) {
        nearest_consider(&nearest, node_type_at(i)->record.name);
    }
    return error_set(err, ERROR_INVALID, place, "unknown type \"%.64s\"%s", name,
                     nearest_hint(&nearest, hint, sizeof hint));
}

bool resource_type_unknown(const struct record_type *table, const char *name, const char *place,
                           struct error *err)
{
    struct nearest nearest = {.text = name};
    char hint[64];
    const char *what = table == shader_types ? "shader" : "type";
    for (; table->name; table++) {
        nearest_consider(&nearest, table->name);
    }
    return error_set(err, ERROR_INVALID, place, "unknown %s \"%.64s\"%s", what, name,
                     nearest_hint(&nearest, hint, sizeof hint));
}

/* --- nodes --- */

enum { NODE_ID, NODE_TYPE, NODE_TRANSFORM, NODE_PARAMS, NODE_CHILDREN, NODE_COMMON };

struct reader {
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
        node_append(node, child);
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
    size_t count = record_type_count(&node_common_type);
    assert(NODE_COMMON + count < sizeof names / sizeof names[0]);
    for (size_t i = 0; i < count; i++) {
        names[NODE_COMMON + i] = node_common_type.params[i].name;
    }
    return sort_members(json, names, found, place, err);
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
    if (!read_type_name(json, &name, place, "type", err)) {
        return NULL;
    }
    const struct node_type *type = node_type_find(name);
    if (!type) {
        node_type_unknown(name, error_place(type_place, place, "type"), err);
    }
    return type;
}

static struct node *read_tree(struct reader *reader, const cJSON *json, const char *place,
                              size_t depth)
{
    const cJSON *found[16];
    const char *id = NULL;
    char path[ERROR_PLACE_BYTES];
    struct error *err = reader->err;
    const cJSON *given = cJSON_IsObject(json) ? cJSON_GetObjectItemCaseSensitive(json, "id") : NULL;
    if (!read_id(given, &id, place, err)) {
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
    struct node *node = node_create(type);
    node->id = id ? memory_text(id) : NULL;
    if (!read_common(&node->common, found, place, err) ||
        !read_record(&node->transform, found[NODE_TRANSFORM], place, "transform", err) ||
        !read_record(&node->params, found[NODE_PARAMS], place, "params", err) ||
        !read_children(reader, node, found[NODE_CHILDREN], place, depth)) {
        node_destroy(node);
        return NULL;
    }
    return node;
}

struct node *node_read(const cJSON *json, const char *place, struct error *err)
{
    struct reader reader = {.err = err};
    return read_tree(&reader, json, place, 1);
}

/* --- resources --- */

/* "id" and "type" apart, the rest in an object of its own. Caller frees. */
static cJSON *without_id_and_type(const cJSON *json)
{
    cJSON *rest = cJSON_CreateObject();
    for (const cJSON *member = json->child; member; member = member->next) {
        if (strcmp(member->string, "id") != 0 && strcmp(member->string, "type") != 0) {
            cJSON_AddItemToObject(rest, member->string, cJSON_Duplicate(member, true));
        }
    }
    return rest;
}

struct resource *resource_read_light(const cJSON *json, const struct resource_list *lights,
                                     const char *place, struct error *err)
{
    char path[ERROR_PLACE_BYTES], type_place[ERROR_PLACE_BYTES], made[LIMIT_ID_BYTES + 1];
    const char *id = NULL, *type_name;
    if (!cJSON_IsObject(json)) {
        error_set(err, ERROR_INVALID, place, "expected an object");
        return NULL;
    }
    if (!read_id(cJSON_GetObjectItemCaseSensitive(json, "id"), &id, place, err)) {
        return NULL;
    }
    if (id) {
        error_place(path, "/lights", id);
        place = path;
    }
    if (!read_type_name(cJSON_GetObjectItemCaseSensitive(json, "type"), &type_name, place, "type",
                        err)) {
        return NULL;
    }
    const struct record_type *type = record_type_in(light_types, type_name);
    if (!type) {
        error_place(type_place, place, "type");
        resource_type_unknown(light_types, type_name, type_place, err);
        return NULL;
    }
    if (id && resource_find(lights, id)) {
        error_set(err, ERROR_CONFLICT, place, "the id \"%s\" is in use", id);
        return NULL;
    }
    for (int number = 1; !id; number++) {
        snprintf(made, sizeof made, "%s-%d", type_name, number);
        id = resource_find(lights, made) ? NULL : made;
    }
    struct resource *light = resource_create(id, type);
    cJSON *params = without_id_and_type(json);
    if (!record_read(&light->record, params, place, err)) {
        resource_destroy(light);
        light = NULL;
    }
    cJSON_Delete(params);
    return light;
}

struct resource *resource_read_material(const char *name, const cJSON *json, const char *place,
                                        struct error *err)
{
    static const char *const names[] = {"shader", "properties", NULL};
    const cJSON *found[2];
    const char *shader;
    if (!record_name_valid(name)) {
        fail_name(name, place, err);
        return NULL;
    }
    if (!sort_members(json, names, found, place, err) ||
        !read_type_name(found[0], &shader, place, "shader", err)) {
        return NULL;
    }
    const struct record_type *type = record_type_in(shader_types, shader);
    if (!type) {
        char type_place[ERROR_PLACE_BYTES];
        error_place(type_place, place, "shader");
        resource_type_unknown(shader_types, shader, type_place, err);
        return NULL;
    }
    struct resource *material = resource_create(name, type);
    if (!read_record(&material->record, found[1], place, "properties", err)) {
        resource_destroy(material);
        return NULL;
    }
    return material;
}

static bool read_lights(struct scene *scene, const cJSON *array, struct error *err)
{
    if (array && !cJSON_IsArray(array)) {
        return error_set(err, ERROR_INVALID, "/lights", "expected an array of lights");
    }
    for (const cJSON *item = array ? array->child : NULL; item; item = item->next) {
        struct resource_list *lights = &scene->lights;
        char place[ERROR_PLACE_BYTES];
        if (lights->count == LIMIT_LIGHTS) {
            return error_set(err, ERROR_LIMIT, "/lights", "more lights than the maximum %d",
                             LIMIT_LIGHTS);
        }
        snprintf(place, sizeof place, "/lights/%zu", lights->count);
        struct resource *light = resource_read_light(item, lights, place, err);
        if (!light) {
            return false;
        }
        resource_list_insert(lights, light, lights->count);
    }
    return true;
}

static bool read_materials(struct scene *scene, const cJSON *object, struct error *err)
{
    if (object && !cJSON_IsObject(object)) {
        return error_set(err, ERROR_INVALID, "/materials", "expected an object of materials");
    }
    for (const cJSON *item = object ? object->child : NULL; item; item = item->next) {
        struct resource_list *materials = &scene->materials;
        char place[ERROR_PLACE_BYTES];
        if (materials->count == LIMIT_MATERIALS) {
            return error_set(err, ERROR_LIMIT, "/materials", "more materials than the maximum %d",
                             LIMIT_MATERIALS);
        }
        error_place(place, "/materials", item->string);
        struct resource *material = resource_read_material(item->string, item, place, err);
        if (!material) {
            return false;
        }
        resource_list_insert(materials, material, materials->count);
    }
    return true;
}

/* --- documents --- */

enum {
    DOC_SCENE_FORMAT,
    DOC_NAME,
    DOC_CAMERA,
    DOC_LIGHTS,
    DOC_MATERIALS,
    DOC_ENVIRONMENT,
    DOC_RENDER,
    DOC_ROOT,
    DOC_RESERVED,
    DOC_COUNT = DOC_RESERVED + 3
};

static const char *const document_members[] = {
    "format", "name", "camera",  "lights",     "materials", "environment",
    "render", "root", "shaders", "primitives", "models",    NULL,
};

static bool check_format(const cJSON *const *found, struct error *err)
{
    const cJSON *format = found[DOC_SCENE_FORMAT];
    if (!cJSON_IsString(format) || strcmp(format->valuestring, SCENE_FORMAT) != 0) {
        return error_set(err, ERROR_INVALID, "/format", "%s \"" SCENE_FORMAT "\"",
                         format ? "expected" : "is missing, expected");
    }
    for (int i = DOC_RESERVED; i < DOC_COUNT; i++) {
        if (found[i] && (!cJSON_IsObject(found[i]) || found[i]->child)) {
            char place[ERROR_PLACE_BYTES];
            error_place(place, "", document_members[i]);
            return error_set(err, ERROR_INVALID, place,
                             "is reserved: expected an object without members");
        }
    }
    return true;
}

static bool read_root(struct scene *scene, const cJSON *json, struct error *err)
{
    if (!json) {
        return error_set(err, ERROR_INVALID, "/root", "is missing");
    }
    struct node *root = node_read(json, "/root", err);
    if (!root) {
        return false;
    }
    if (!scene_attach(scene, root, NULL, 0, "/root", err)) {
        node_destroy(root);
        return false;
    }
    return true;
}

static bool read_document(struct scene *scene, const cJSON *document, struct error *err)
{
    const cJSON *found[DOC_COUNT];
    if (!sort_members(document, document_members, found, "", err) || !check_format(found, err)) {
        return false;
    }
    if (found[DOC_NAME] && !record_read_value(&scene->info, 0, found[DOC_NAME], "/name", err)) {
        return false;
    }
    return read_record(&scene->camera, found[DOC_CAMERA], "", "camera", err) &&
           read_lights(scene, found[DOC_LIGHTS], err) &&
           read_materials(scene, found[DOC_MATERIALS], err) &&
           read_record(&scene->environment, found[DOC_ENVIRONMENT], "", "environment", err) &&
           read_record(&scene->render, found[DOC_RENDER], "", "render", err) &&
           read_root(scene, found[DOC_ROOT], err);
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

struct scene *scene_parse(const char *text, size_t length, struct error *err)
{
    cJSON *document = json_parse(text, length, err);
    struct scene *scene = document ? scene_read(document, err) : NULL;
    cJSON_Delete(document);
    return scene;
}
