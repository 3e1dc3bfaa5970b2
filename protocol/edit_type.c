/* SPDX-License-Identifier: MIT */
/* Setting what decides of which type a record is: a node's type, primitive or model, a light's
 * type, a material's shader, the rows that a primitive, shader or model declares. Values go over by
 * name; what the new type does not know or accept falls to its default, and the inverse sets it
 * again. */
#include <string.h>

#include "edit_internal.h"

/* What `from` has set and `type` knows and accepts. A name of one kind is none of another. */
static struct record converted(const struct record *from, const struct record_type *type)
{
    struct record to;

    record_init(&to, type);
    for (int i = 0; from->type->params[i].name; i++) {
        const struct param *param = &from->type->params[i];
        const int index = record_type_find(type, param->name);
        if (index < 0 || (resource_kind_named_by(type->params[index].type) &&
                          type->params[index].type != param->type)) {
            continue;
        }
        cJSON *json = record_get(from, i);
        if (json) {
            record_set(&to, index, json, "", NULL);
        }
        cJSON_Delete(json);
    }
    return to;
}

/* The same for a node's parameters, which are of more than their type's rows where they name a
 * primitive or model. */
static struct record converted_params(const struct scene *scene, const struct record *from,
                                      const struct node_type *type)
{
    struct record to = converted(from, &type->record);
    const struct record_type *params = node_params_type(scene, type, &to);

    if (params != to.type) {
        record_finish(&to);
        to = converted(from, params);
    }
    return to;
}

/* Takes `changed`, which the record becomes, and `back`, what undoing so far would make of that.
 * The inverse sets the rest, in the order of the rows: a name before what it declares. */
static void change(struct editor *editor, struct record *record, struct record changed,
                   struct record back, const char *values)
{
    for (int i = (int)record_type_count(record->type) - 1; i >= 0; i--) {
        if (!param_value_equal(&back.values[i], &record->values[i])) {
            char place[PATH_TEXT_BYTES + 1];
            snprintf(place, sizeof place, "%s/%s", values, record->type->params[i].name);
            edit_undo_by(editor, edit_set_operation(place, record_get(record, i)));
        }
    }
    record_finish(&back);
    record_finish(record);
    *record = changed;
}

static void node_values(char out[PATH_TEXT_BYTES + 1], const struct node *node)
{
    snprintf(out, PATH_TEXT_BYTES + 1, "/nodes/%s/params", node->id);
}

static void resource_values(char out[PATH_TEXT_BYTES + 1], const struct resource_kind *kind,
                            const struct resource *resource)
{
    snprintf(out, PATH_TEXT_BYTES + 1, "/%s/%s%s%s", kind->list, resource->name,
             kind->values ? "/" : "", kind->values ? kind->values : "");
}

/* A name of a primitive or model among a node's parameters. */
struct naming {
    const char *at;
    const cJSON *value;
    int index;
};

/* Whether models name each other in a circle with this type and these parameters of the node. */
static bool closes_circle(struct editor *editor, struct node *node, const struct node_type *type,
                          const struct record *params, const char *at)
{
    const struct node_type *old_type = node->type;
    const struct record old = node->params;

    node->type = type;
    node->params = *params;
    const bool ok =
        type->kind != KIND_MODEL || scene_check_models(editor->scene, node, at, editor->err);
    node->type = old_type;
    node->params = old;
    return !ok;
}

/* `from`, of a node of this type, with another name among it; false and `err` where that cannot
 * be. */
static bool rename_declaring(struct editor *editor, struct node *node, const struct node_type *type,
                             const struct record *from, const struct naming *naming,
                             struct record *out)
{
    const struct scene *scene = editor->scene;
    const struct resource_kind *kind =
        resource_kind_named_by(from->type->params[naming->index].type);
    struct record named;

    record_copy(&named, from);
    bool ok =
        record_set(&named, naming->index, naming->value, naming->at, editor->err) &&
        scene_check_name(scene, kind, named.values[naming->index].text, naming->at, editor->err);
    if (ok) {
        *out = converted(&named, node_params_type(scene, type, &named));
        ok = scene_check_retyped(scene, node, out->type, naming->at, editor->err) &&
             !closes_circle(editor, node, type, out, naming->at);
        if (!ok) {
            record_finish(out);
        }
    }
    record_finish(&named);
    return ok;
}

/* What the next operation names for the node, which gets this type; false: nothing. */
static bool named_next(const struct editor *editor, const struct node *node,
                       const struct node_type *type, struct naming *out)
{
    const char *op = edit_member_text(editor->next, "op");
    const char *at = edit_member_text(editor->next, "at");
    char values[PATH_TEXT_BYTES + 1];

    node_values(values, node);
    const size_t length = strlen(values);
    if (!op || !at || strcmp(op, "set") != 0 || strncmp(at, values, length) != 0 ||
        at[length] != '/') {
        return false;
    }
    out->at = at;
    out->value = cJSON_GetObjectItemCaseSensitive(editor->next, "value");
    out->index = record_type_find(&type->record, at + length + 1);
    const struct resource_kind *kind =
        out->index < 0 ? NULL : resource_kind_named_by(type->record.params[out->index].type);
    return kind && kind->extends && cJSON_IsString(out->value);
}

/* Gives `changed` that name, if it can have it: a parameter may set what only the named one
 * declares, and then neither this nor its inverse could be two steps. */
static bool take_name(struct editor *editor, struct node *node, const struct node_type *type,
                      struct record *changed, struct naming *out)
{
    struct editor trial = {.scene = editor->scene};
    struct record named;

    if (!named_next(editor, node, type, out) ||
        !rename_declaring(&trial, node, type, changed, out, &named)) {
        return false;
    }
    record_finish(changed);
    *changed = named;
    editor->next = editor->next->next;
    return true;
}

bool edit_set_node_type(struct editor *editor, struct node *node, const char *at,
                        const cJSON *value)
{
    char values[PATH_TEXT_BYTES + 1];
    struct naming naming;

    if (!cJSON_IsString(value)) {
        return error_set(editor->err, ERROR_INVALID, at, "expected the name of a type");
    }
    const struct node_type *type = node_type_find(value->valuestring);
    if (!type) {
        return node_type_unknown(value->valuestring, at, editor->err);
    }
    struct record changed = converted_params(editor->scene, &node->params, type);
    const bool named = take_name(editor, node, type, &changed, &naming);
    if (!named && !scene_check_retyped(editor->scene, node, changed.type, at, editor->err)) {
        record_finish(&changed);
        return false;
    }
    struct record back = converted_params(editor->scene, &changed, node->type);
    if (back.type != node->params.type) { /* its name is lost, and the first to be set */
        struct record base = back;
        back = converted(&base, node->params.type);
        record_finish(&base);
    }
    scene_count_user(editor->scene, node, -1);
    node_values(values, node);
    change(editor, &node->params, changed, back, values);
    edit_undo_by(editor, edit_set_operation(at, cJSON_CreateString(node->type->record.name)));
    edit_did(editor, edit_set_operation(at, cJSON_CreateString(type->record.name)));
    if (named) {
        edit_did(editor, edit_set_operation(naming.at, record_get(&node->params, naming.index)));
    }
    node->type = type;
    scene_count_user(editor->scene, node, 1);
    return true;
}

bool edit_set_declaring(struct editor *editor, struct node *node, int index, const char *at,
                        const cJSON *value)
{
    const struct naming naming = {.at = at, .value = value, .index = index};
    struct record changed, back;
    char values[PATH_TEXT_BYTES + 1];

    if (!rename_declaring(editor, node, node->type, &node->params, &naming, &changed)) {
        return false;
    }
    cJSON *old = record_get(&node->params, index);
    back = converted(&changed, node->params.type);
    param_value_finish(&back.values[index]);
    param_value_copy(&back.values[index], &node->params.values[index]);
    scene_count_user(editor->scene, node, -1);
    node_values(values, node);
    change(editor, &node->params, changed, back, values);
    edit_undo_by(editor, edit_set_operation(at, old));
    edit_did(editor, edit_set_operation(at, record_get(&node->params, index)));
    scene_count_user(editor->scene, node, 1);
    return true;
}

bool edit_set_resource_type(struct editor *editor, const struct resource_kind *kind,
                            struct resource *resource, const char *at, const cJSON *value)
{
    char values[PATH_TEXT_BYTES + 1];
    struct resource *shader;

    if (!cJSON_IsString(value)) {
        return error_set(editor->err, ERROR_INVALID, at, "expected the name of a %s", kind->type);
    }
    const struct record_type *type =
        resource_type(editor->scene, kind, value->valuestring, &shader, at, editor->err);
    if (!type) {
        return false;
    }
    struct record changed = converted(&resource->record, type);
    struct record back = converted(&changed, resource->record.type);
    const char *old = resource->record.type->name;
    resource_values(values, kind, resource);
    change(editor, &resource->record, changed, back, values);
    edit_undo_by(editor, edit_set_operation(at, cJSON_CreateString(old)));
    edit_did(editor, edit_set_operation(at, cJSON_CreateString(type->name)));
    resource_count_user(resource, -1);
    resource->shader = shader;
    resource_count_user(resource, 1);
    return true;
}

/* --- rows --- */

struct users {
    const struct record_type *old, *fresh;
};

static void convert_user(struct editor *editor, const struct users *users, struct record *record,
                         const char *values)
{
    struct record changed = converted(record, users->fresh);

    change(editor, record, changed, converted(&changed, users->old), values);
}

static void convert_nodes(struct editor *editor, const struct users *users, struct node *top)
{
    for (struct node *node = top; node; node = node_next(node, top)) {
        if (node->params.type == users->old) {
            char values[PATH_TEXT_BYTES + 1];
            node_values(values, node);
            convert_user(editor, users, &node->params, values);
        }
    }
}

static void convert_users(struct editor *editor, const struct users *users)
{
    struct scene *scene = editor->scene;

    for (const struct resource_kind *kind = resource_kinds; kind->list; kind++) {
        const struct resource_list *list = resource_list_of(kind, scene);
        for (size_t i = 0; i < list->count; i++) {
            struct resource *resource = list->items[i];
            if (resource->record.type == users->old) {
                char values[PATH_TEXT_BYTES + 1];
                resource_values(values, kind, resource);
                convert_user(editor, users, &resource->record, values);
            }
            convert_nodes(editor, users, resource->root);
        }
    }
    convert_nodes(editor, users, scene->root);
}

/* Whether what parameters of models set is there with the new rows, and what these set. */
static bool check_rows(const struct editor *editor, const struct resource *resource,
                       const struct declared_params *fresh, const char *at)
{
    return (!resource->root ||
            scene_check_targets(editor->scene, resource, fresh, at, editor->err)) &&
           scene_check_all_retyped(editor->scene, &resource->declared->type, &fresh->type, at,
                                   editor->err);
}

bool edit_set_rows(struct editor *editor, const struct resource_kind *kind,
                   struct resource *resource, int index, const char *at, const cJSON *value)
{
    struct record *record = &resource->record;

    if (!cJSON_IsNull(value) && !resource_check_rows(kind, value, at, editor->err)) {
        return false;
    }
    cJSON *old = record_get(record, index);
    record_set(record, index, value, at, NULL);
    struct declared_params *before = resource->declared, *fresh = resource_define(kind, resource);
    if (!check_rows(editor, resource, fresh, at)) {
        const cJSON none = {.type = cJSON_NULL};
        record_set(record, index, old ? old : &none, at, NULL);
        cJSON_Delete(old);
        declared_params_destroy(fresh);
        return false;
    }
    resource->declared = fresh;
    convert_users(editor, &(struct users){&before->type, &resource->declared->type});
    declared_params_destroy(before);
    edit_undo_by(editor, edit_set_operation(at, old));
    edit_did(editor, edit_set_operation(at, record_get(record, index)));
    return true;
}
