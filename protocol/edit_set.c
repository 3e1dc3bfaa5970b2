/* SPDX-License-Identifier: MIT */
/* The operation `set`: one value, a name, or a whole record. Types are edit_type.c. */
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

/* A name of something else, which counts its users. */
static bool set_name(struct editor *editor, struct node *node, struct record *record, int index,
                     const char *at, const cJSON *value)
{
    struct scene *scene = editor->scene;
    const struct param *param = &record->type->params[index];
    struct value old = record->values[index], fresh = {0};
    param_value_reset(param, &fresh);
    if ((!cJSON_IsNull(value) && !param_value_set(param, &fresh, value, at, editor->err)) ||
        !scene_check_name(scene, resource_kind_named_by(param->type), fresh.text, at,
                          editor->err)) {
        param_value_finish(&fresh);
        return false;
    }
    scene_count_user(scene, node, -1);
    record->values[index] = fresh;
    bool ok = param->type != PARAM_MODEL || scene_check_models(scene, node, at, editor->err);
    if (!ok) {
        record->values[index] = old;
        old = fresh;
    } else {
        edit_undo_by(editor,
                     edit_set_operation(at, old.set ? param_value_json(param, &old) : NULL));
        edit_did(editor, edit_set_operation(at, record_get(record, index)));
    }
    scene_count_user(scene, node, 1);
    param_value_finish(&old);
    return ok;
}

static bool fail_place(const struct editor *editor, const char *at)
{
    return error_set(editor->err, ERROR_NOT_FOUND, at, "there is nothing to set at this place");
}

/* One value of a node, whatever depends on it. */
static bool set_in_record(struct editor *editor, struct node *node, struct record *record,
                          const char *name, const char *at, const cJSON *value)
{
    int index = record_type_find(record->type, name);
    if (index < 0) {
        return record_type_unknown(record->type, name, at, editor->err);
    }
    switch (record->type->params[index].type) {
    case PARAM_FUNCTION:
        return edit_set_primitive(editor, node, index, at, value);
    case PARAM_MODEL:
    case PARAM_MATERIAL:
        return set_name(editor, node, record, index, at, value);
    default:
        return set_value(editor, record, name, at, value);
    }
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
                   ? set_in_record(editor, node, &node->params, place->part[3], at, value)
                   : fail_place(editor, at);
    }
    if (place_is(place, 2, "type")) {
        return edit_set_node_type(editor, node, at, value);
    }
    return record_type_find(&node_common_type, place->part[2]) < 0
               ? fail_place(editor, at)
               : set_in_record(editor, node, &node->common, place->part[2], at, value);
}

static bool set_in_resource(struct editor *editor, const struct place *place,
                            const struct resource_kind *kind, const char *at, const cJSON *value)
{
    struct resource *resource = edit_find_resource(editor, kind, place->part[1], at);
    if (!resource) {
        return false;
    }
    if (place->count == 3 && kind->type && place_is(place, 2, kind->type)) {
        return edit_set_resource_type(editor, kind, resource, at, value);
    }
    int depth = kind->values ? 3 : 2;
    if (place->count != depth + 1 || (kind->values && !place_is(place, 2, kind->values))) {
        return fail_place(editor, at);
    }
    int rows = resource_rows(resource->record.type);
    return rows >= 0 && place_is(place, depth, resource->record.type->params[rows].name)
               ? edit_set_rows(editor, kind, resource, rows, at, value)
               : set_value(editor, &resource->record, place->part[depth], at, value);
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
    const struct resource_kind *kind = edit_find_kind(&place);
    if (place.count >= 3 && kind) {
        return set_in_resource(editor, &place, kind, at, value);
    }
    return fail_place(editor, at);
}
