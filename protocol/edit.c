/* SPDX-License-Identifier: MIT */
/* Edits: the form of their operations, applying all or none. The operations themselves are
 * edit_set.c, edit_type.c and edit_list.c; undo and redo are history.c. */
#include "edit.h"

#include <assert.h>
#include <string.h>

#include "edit_internal.h"
#include "limits.h"
#include "suggest.h"

/* --- paths --- */

const char *edit_member_text(const cJSON *op, const char *name)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(op, name);

    return cJSON_IsString(member) ? member->valuestring : NULL;
}

/* The text begins with a slash and has no empty part (check_text). */
bool path_split(struct path *path, const char *text, struct error *err)
{
    char *save = NULL;

    path->count = 0;
    snprintf(path->text, sizeof path->text, "%s", text);
    for (char *part = strtok_r(path->text, "/", &save); part; part = strtok_r(NULL, "/", &save)) {
        if (path->count == PATH_PARTS) {
            return error_set(err, ERROR_NOT_FOUND, text, "there is no such place");
        }
        path->part[path->count++] = part;
    }
    return true;
}

bool path_is(const struct path *path, int index, const char *name)
{
    return index < path->count && strcmp(path->part[index], name) == 0;
}

struct node *edit_find_node(const struct editor *editor, const char *id, const char *place)
{
    struct node *node = scene_find(editor->scene, id);

    if (!node) {
        error_set(editor->err, ERROR_NOT_FOUND, place, "there is no node \"%.64s\"", id);
    }
    return node;
}

const struct resource_kind *edit_find_kind(const struct path *path)
{
    return path->count > 0 ? resource_kind_find(path->part[0]) : NULL;
}

struct resource *edit_find_resource(const struct editor *editor, const struct resource_kind *kind,
                                    const char *name, const char *place)
{
    struct resource *resource = resource_find(resource_list_of(kind, editor->scene), name);

    if (!resource) {
        error_set(editor->err, ERROR_NOT_FOUND, place, "there is no %s \"%.64s\"", kind->item,
                  name);
    }
    return resource;
}

/* --- recording what was done --- */

cJSON *edit_operation(const char *name, const char *at)
{
    cJSON *op = cJSON_CreateObject();

    cJSON_AddStringToObject(op, "op", name);
    cJSON_AddStringToObject(op, strcmp(name, "insert") == 0 ? "into" : "at", at);
    return op;
}

cJSON *edit_set_operation(const char *at, cJSON *value)
{
    cJSON *op = edit_operation("set", at);

    cJSON_AddItemToObject(op, "value", value ? value : cJSON_CreateNull());
    return op;
}

void edit_undo_by(struct editor *editor, cJSON *op)
{
    cJSON_InsertItemInArray(editor->inverse, 0, op);
}

void edit_did(struct editor *editor, cJSON *op)
{
    cJSON_AddItemToArray(editor->applied, op);
}

/* --- the form of operations --- */

enum member {
    MEMBER_AT = 1,
    MEMBER_INTO = 2,
    MEMBER_BEFORE = 4,
    MEMBER_VALUE = 8,
    MEMBER_NAME = 16
};

static const char *const member_names[] = {"at", "into", "before", "value", "name"};

static const struct operation {
    const char *name;
    bool (*apply)(struct editor *editor, const cJSON *op);
    int required, optional; /* sets of enum member */
} operations[] = {
    {"set", edit_set, MEMBER_AT | MEMBER_VALUE, 0},
    {"insert", edit_insert, MEMBER_INTO | MEMBER_VALUE, MEMBER_BEFORE | MEMBER_NAME},
    {"remove", edit_remove, MEMBER_AT, 0},
    {"move", edit_move, MEMBER_AT, MEMBER_INTO | MEMBER_BEFORE},
};

enum { OPERATION_COUNT = sizeof operations / sizeof operations[0] };

static const struct operation *find_operation(const cJSON *op)
{
    const char *name = edit_member_text(op, "op");

    for (int i = 0; name && i < OPERATION_COUNT; i++) {
        if (strcmp(operations[i].name, name) == 0) {
            return &operations[i];
        }
    }
    return NULL;
}

static bool fail_operation(const cJSON *op, const char *place, struct error *err)
{
    const char *name = edit_member_text(op, "op");
    char path[ERROR_PLACE_BYTES], hint[64];

    error_place(path, place, "op");
    if (!name) {
        return error_set(err, ERROR_SYNTAX, path,
                         "expected \"set\", \"insert\", \"remove\" or \"move\"");
    }
    struct suggestion suggestion = {.text = name};
    for (int i = 0; i < OPERATION_COUNT; i++) {
        suggest_consider(&suggestion, operations[i].name);
    }
    return error_set(err, ERROR_SYNTAX, path, "unknown operation \"%.64s\"%s", name,
                     suggest_hint(&suggestion, hint, sizeof hint));
}

static bool check_member(const cJSON *json, int member, const char *place, struct error *err)
{
    if (member == MEMBER_VALUE || (member == MEMBER_BEFORE && cJSON_IsNull(json))) {
        return true;
    }
    if (!cJSON_IsString(json)) {
        return error_set(err, ERROR_SYNTAX, place, "expected a text%s",
                         member == MEMBER_BEFORE ? " or null" : "");
    }
    const char *text = json->valuestring;
    const size_t length = strlen(text);
    if (length > PATH_TEXT_BYTES) {
        return error_set(err, ERROR_LIMIT, place, "%zu bytes are above the maximum %d", length,
                         PATH_TEXT_BYTES);
    }
    if ((member == MEMBER_AT || member == MEMBER_INTO) &&
        (text[0] != '/' || text[length - 1] == '/' || strstr(text, "//"))) {
        return error_set(err, ERROR_SYNTAX, place, "\"%s\" is not a place such as \"/nodes/ID\"",
                         text);
    }
    return true;
}

static bool check_operation(const cJSON *op, const char *place, struct error *err)
{
    if (!cJSON_IsObject(op)) {
        return error_set(err, ERROR_SYNTAX, place, "expected an object");
    }
    const struct operation *operation = find_operation(op);
    if (!operation) {
        return fail_operation(op, place, err);
    }
    int missing = operation->required;
    for (const cJSON *json = op->child; json; json = json->next) {
        char path[ERROR_PLACE_BYTES];
        int allowed = operation->required | operation->optional, member = 0;
        for (int i = 0; i < (int)(sizeof member_names / sizeof member_names[0]); i++) {
            member |= strcmp(member_names[i], json->string) == 0 ? 1 << i : 0;
        }
        error_place(path, place, json->string);
        if (strcmp(json->string, "op") == 0) {
            continue;
        }
        if (!(member & allowed)) {
            return error_set(err, ERROR_SYNTAX, path, "\"%s\" has no member \"%.64s\"",
                             operation->name, json->string);
        }
        if (!check_member(json, member, path, err)) {
            return false;
        }
        missing &= ~member;
    }
    for (int i = 0; missing; i++, missing >>= 1) {
        if (missing & 1) {
            return error_set(err, ERROR_SYNTAX, place, "\"%s\" lacks the member \"%s\"",
                             operation->name, member_names[i]);
        }
    }
    return true;
}

static bool check_form(const cJSON *ops, struct error *err)
{
    size_t index = 0;

    if (!cJSON_IsArray(ops) || !ops->child) {
        return error_set(err, ERROR_SYNTAX, "", "expected an array of operations");
    }
    for (const cJSON *op = ops->child; op; op = op->next) {
        char place[32];
        snprintf(place, sizeof place, "/%zu", index++);
        if (!check_operation(op, place, err)) {
            return false;
        }
    }
    return true;
}

bool edit_check(const cJSON *ops, struct error *err)
{
    size_t count = 0;

    for (const cJSON *op = cJSON_IsArray(ops) ? ops->child : NULL; op; op = op->next) {
        count++;
    }
    if (count > LIMIT_OPERATIONS) {
        return error_set(err, ERROR_LIMIT, "", "%zu operations are above the maximum %d", count,
                         LIMIT_OPERATIONS);
    }
    return check_form(ops, err);
}

/* --- applying --- */

static bool apply_next(struct editor *editor, const cJSON *op)
{
    editor->next = op->next;
    return find_operation(op)->apply(editor, op);
}

static void roll_back(struct editor *failed)
{
    struct editor editor = {
        .scene = failed->scene,
        .applied = cJSON_CreateArray(),
        .inverse = cJSON_CreateArray(),
    };

    for (const cJSON *op = failed->inverse->child; op; op = editor.next) {
        const bool undone = apply_next(&editor, op);
        assert(undone);
        (void)undone;
    }
    cJSON_Delete(editor.applied);
    cJSON_Delete(editor.inverse);
}

static void give(cJSON *json, cJSON **out, bool ok)
{
    if (ok && out) {
        *out = json;
    } else {
        cJSON_Delete(json);
    }
}

static bool apply(struct scene *scene, const cJSON *ops, bool lenient, cJSON **out_applied,
                  cJSON **out_inverse, struct error *err)
{
    if (!check_form(ops, err)) {
        return false;
    }
    struct editor editor = {
        .scene = scene,
        .applied = cJSON_CreateArray(),
        .inverse = cJSON_CreateArray(),
        .lenient = lenient,
        .err = err,
    };
    bool ok = true;
    for (const cJSON *op = ops->child; op && ok; op = editor.next) {
        ok = apply_next(&editor, op) || lenient;
    }
    if (!ok) {
        roll_back(&editor);
    }
    ok = ok && editor.applied->child; /* leniently: at least one */
    give(editor.applied, out_applied, ok);
    give(editor.inverse, out_inverse, ok);
    return ok;
}

bool edit_apply(struct scene *scene, const cJSON *ops, cJSON **out_applied, cJSON **out_inverse,
                struct error *err)
{
    return apply(scene, ops, false, out_applied, out_inverse, err);
}

bool edit_apply_some(struct scene *scene, const cJSON *ops, cJSON **out_applied,
                     cJSON **out_inverse, struct error *err)
{
    return apply(scene, ops, true, out_applied, out_inverse, err);
}
