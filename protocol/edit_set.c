/* SPDX-License-Identifier: MIT */
/* The operation `set`: one value, a whole record, or a type. */
#include <string.h>

#include "edit_parts.h"

static bool set_value(struct editor *editor, struct record *record, const char *name,
                      const char *at, const cJSON *value)
{
    int index = record_type_find(record->type, name);
    if (index < 0) {
        return record_type_unknown(record->type, name, at, editor->err);
    }
    cJSON *old = record_get(record, index);
    if (!record_set(record, index, value, at, editor->err)) {
        cJSON_Delete(old);
        return false;
    }
    edit_undo_by(editor, edit_set_operation(at, old));
    edit_did(editor, edit_set_operation(at, record_get(record, index)));
    return true;
}

static bool set_record(struct editor *editor, struct record *record, const char *at,
                       const cJSON *value)
{
    struct record fresh;
    record_init(&fresh, record->type);
    if (!cJSON_IsNull(value) && !record_read(&fresh, value, at, editor->err)) {
        record_finish(&fresh);
        return false;
    }
    cJSON *old = cJSON_CreateObject();
    record_print(record, old);
    edit_undo_by(editor, edit_set_operation(at, old));
    record_finish(record);
    *record = fresh;
    cJSON *now = cJSON_CreateObject();
    record_print(record, now);
    edit_did(editor, edit_set_operation(at, now));
    return true;
}

static bool set_material(struct editor *editor, struct node *node, const char *at,
                         const cJSON *value)
{
    if (cJSON_IsString(value) && record_name_valid(value->valuestring) &&
        !scene_check_material(editor->scene, value->valuestring, at, editor->err)) {
        return false;
    }
    scene_count_user(editor->scene, node, -1);
    bool ok = set_value(editor, &node->common, "material", at, value);
    scene_count_user(editor->scene, node, 1);
    return ok;
}

/* `to` gets what `from` has set and the type of `to` knows and accepts. */
static void convert(struct record *to, const struct record *from)
{
    for (int i = 0; from->type->params[i].name; i++) {
        int index = record_type_find(to->type, from->type->params[i].name);
        cJSON *json = index >= 0 ? record_get(from, i) : NULL;
        if (json) {
            record_set(to, index, json, "", NULL);
        }
        cJSON_Delete(json);
    }
}

static bool equal_values(const struct value *a, const struct value *b)
{
    return a->set == b->set && memcmp(a->number, b->number, sizeof a->number) == 0 &&
           (a->text == b->text || (a->text && b->text && strcmp(a->text, b->text) == 0));
}

/* Another type of a record. Its inverse sets the type back, then every value that changing there
 * and back would lose; `values` is the place of those. */
static void set_record_type(struct editor *editor, struct record *record,
                            const struct record_type *type, const char *at, const char *values)
{
    struct record changed, back;
    record_init(&changed, type);
    convert(&changed, record);
    record_init(&back, record->type);
    convert(&back, &changed);
    for (int i = 0; back.type->params[i].name; i++) {
        if (!equal_values(&back.values[i], &record->values[i])) {
            char place[PLACE_TEXT_BYTES + 1];
            snprintf(place, sizeof place, "%s/%s", values, back.type->params[i].name);
            edit_undo_by(editor, edit_set_operation(place, record_get(record, i)));
        }
    }
    edit_undo_by(editor, edit_set_operation(at, cJSON_CreateString(record->type->name)));
    edit_did(editor, edit_set_operation(at, cJSON_CreateString(type->name)));
    record_finish(&back);
    record_finish(record);
    *record = changed;
}

static bool set_node_type(struct editor *editor, struct node *node, const char *at,
                          const cJSON *value)
{
    char values[PLACE_TEXT_BYTES + 1];
    if (!cJSON_IsString(value)) {
        return error_set(editor->err, ERROR_INVALID, at, "expected the name of a type");
    }
    const struct node_type *type = node_type_find(value->valuestring);
    if (!type) {
        return node_type_unknown(value->valuestring, at, editor->err);
    }
    snprintf(values, sizeof values, "/nodes/%s/params", node->id);
    set_record_type(editor, &node->params, &type->record, at, values);
    node->type = type;
    return true;
}

static bool set_resource_type(struct editor *editor, struct resource *resource,
                              const struct record_type *table, const char *at, const cJSON *value)
{
    char values[PLACE_TEXT_BYTES + 1];
    bool light = table == light_types;
    if (!cJSON_IsString(value)) {
        return error_set(editor->err, ERROR_INVALID, at, "expected the name of a %s",
                         light ? "type" : "shader");
    }
    const struct record_type *type = record_type_in(table, value->valuestring);
    if (!type) {
        return resource_type_unknown(table, value->valuestring, at, editor->err);
    }
    snprintf(values, sizeof values, light ? "/lights/%s" : "/materials/%s/properties",
             resource->name);
    set_record_type(editor, &resource->record, type, at, values);
    return true;
}

static bool fail_place(const struct editor *editor, const char *at)
{
    return error_set(editor->err, ERROR_NOT_FOUND, at, "there is nothing to set at this place");
}

static bool set_in_node(struct editor *editor, const struct place *place, const char *at,
                        const cJSON *value)
{
    struct node *node = edit_find_node(editor, place->part[1], at);
    if (!node) {
        return false;
    }
    if (place_is(place, 2, "transform")) {
        return place->count == 3 ? set_record(editor, &node->transform, at, value)
                                 : set_value(editor, &node->transform, place->part[3], at, value);
    }
    if (place->count == 4) {
        return place_is(place, 2, "params")
                   ? set_value(editor, &node->params, place->part[3], at, value)
                   : fail_place(editor, at);
    }
    if (place_is(place, 2, "type")) {
        return set_node_type(editor, node, at, value);
    }
    if (place_is(place, 2, "material")) {
        return set_material(editor, node, at, value);
    }
    if (record_type_find(&node_common_type, place->part[2]) < 0) {
        return fail_place(editor, at);
    }
    return set_value(editor, &node->common, place->part[2], at, value);
}

static bool set_in_resource(struct editor *editor, const struct place *place,
                            const struct resource_list *list, const char *at, const cJSON *value)
{
    struct resource *resource = edit_find_resource(editor, list, place->part[1], at);
    if (!resource) {
        return false;
    }
    if (edit_is_lights(editor, list)) {
        if (place->count != 3 || place_is(place, 2, "id")) {
            return fail_place(editor, at);
        }
        return place_is(place, 2, "type")
                   ? set_resource_type(editor, resource, light_types, at, value)
                   : set_value(editor, &resource->record, place->part[2], at, value);
    }
    if (place->count == 3 && place_is(place, 2, "shader")) {
        return set_resource_type(editor, resource, shader_types, at, value);
    }
    if (place->count == 4 && place_is(place, 2, "properties")) {
        return set_value(editor, &resource->record, place->part[3], at, value);
    }
    return fail_place(editor, at);
}

bool edit_set(struct editor *editor, const cJSON *op)
{
    struct scene *scene = editor->scene;
    const char *at = edit_member_text(op, "at");
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(op, "value");
    struct record *const records[] = {&scene->camera, &scene->environment, &scene->render};
    struct place place;
    if (!place_split(&place, at, editor->err)) {
        return false;
    }
    if (place.count == 1 && record_type_find(scene->info.type, place.part[0]) >= 0) {
        return set_value(editor, &scene->info, place.part[0], at, value);
    }
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        if (place_is(&place, 0, records[i]->type->name) && place.count <= 2) {
            return place.count == 1 ? set_record(editor, records[i], at, value)
                                    : set_value(editor, records[i], place.part[1], at, value);
        }
    }
    if (place.count >= 3 && place_is(&place, 0, "nodes")) {
        return set_in_node(editor, &place, at, value);
    }
    const struct resource_list *list = edit_find_list(editor, &place);
    if (place.count >= 3 && list) {
        return set_in_resource(editor, &place, list, at, value);
    }
    return fail_place(editor, at);
}
