/* SPDX-License-Identifier: MIT */
/* The operation `set`: one value, a name, or a whole record. Types are edit_type.c. */
#include <string.h>

#include "edit_internal.h"

static bool set_value(struct editor *editor, struct record *record, const char *name,
                      const char *at, const cJSON *value)
{
    const int index = record_type_find(record->type, name);

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

/* A name of a material, which counts its users. */
static bool set_material(struct editor *editor, struct node *node, struct record *record, int index,
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
    edit_undo_by(editor, edit_set_operation(at, old.set ? param_value_json(param, &old) : NULL));
    edit_did(editor, edit_set_operation(at, record_get(record, index)));
    scene_count_user(scene, node, 1);
    param_value_finish(&old);
    return true;
}

static bool fail_place(const struct editor *editor, const char *at)
{
    return error_set(editor->err, ERROR_NOT_FOUND, at, "there is nothing to set at this place");
}

/* One value of a node, whatever depends on it. */
static bool set_in_record(struct editor *editor, struct node *node, struct record *record,
                          const char *name, const char *at, const cJSON *value)
{
    const int index = record_type_find(record->type, name);

    if (index < 0) {
        return record_type_unknown(record->type, name, at, editor->err);
    }
    switch (record->type->params[index].type) {
    case PARAM_FUNCTION:
    case PARAM_MODEL:
        return edit_set_declaring(editor, node, index, at, value);
    case PARAM_MATERIAL:
        return set_material(editor, node, record, index, at, value);
    default:
        return set_value(editor, record, name, at, value);
    }
}

static bool set_in_node(struct editor *editor, const struct path *path, const char *at,
                        const cJSON *value)
{
    struct node *node = edit_find_node(editor, path->part[1], at);

    if (!node) {
        return false;
    }
    if (path_is(path, 2, "transform")) {
        return path->count == 3 ? set_record(editor, &node->transform, at, value)
                                : set_value(editor, &node->transform, path->part[3], at, value);
    }
    if (path->count == 4) {
        return path_is(path, 2, "params")
                   ? set_in_record(editor, node, &node->params, path->part[3], at, value)
                   : fail_place(editor, at);
    }
    if (path_is(path, 2, "type")) {
        return edit_set_node_type(editor, node, at, value);
    }
    return record_type_find(&node_common_type, path->part[2]) < 0
               ? fail_place(editor, at)
               : set_in_record(editor, node, &node->common, path->part[2], at, value);
}

static bool set_in_resource(struct editor *editor, const struct path *path,
                            const struct resource_kind *kind, const char *at, const cJSON *value)
{
    struct resource *resource = edit_find_resource(editor, kind, path->part[1], at);

    if (!resource) {
        return false;
    }
    if (path->count == 3 && kind->type && path_is(path, 2, kind->type)) {
        return edit_set_resource_type(editor, kind, resource, at, value);
    }
    const int depth = kind->values ? 3 : 2;
    if (path->count != depth + 1 || (kind->values && !path_is(path, 2, kind->values))) {
        return fail_place(editor, at);
    }
    const int rows = resource_rows(resource->record.type);
    return rows >= 0 && path_is(path, depth, resource->record.type->params[rows].name)
               ? edit_set_rows(editor, kind, resource, rows, at, value)
               : set_value(editor, &resource->record, path->part[depth], at, value);
}

bool edit_set(struct editor *editor, const cJSON *op)
{
    struct scene *scene = editor->scene;
    const char *at = edit_member_text(op, "at");
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(op, "value");
    struct record *const records[] = {&scene->camera, &scene->environment, &scene->render};
    struct path path;

    if (!path_split(&path, at, editor->err)) {
        return false;
    }
    if (path.count == 1 && record_type_find(scene->info.type, path.part[0]) >= 0) {
        return set_value(editor, &scene->info, path.part[0], at, value);
    }
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        if (path_is(&path, 0, records[i]->type->name) && path.count <= 2) {
            return path.count == 1 ? set_record(editor, records[i], at, value)
                                   : set_value(editor, records[i], path.part[1], at, value);
        }
    }
    if (path.count >= 3 && path_is(&path, 0, "nodes")) {
        return set_in_node(editor, &path, at, value);
    }
    const struct resource_kind *kind = edit_find_kind(&path);
    if (path.count >= 3 && kind) {
        return set_in_resource(editor, &path, kind, at, value);
    }
    return fail_place(editor, at);
}
