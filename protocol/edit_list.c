/* SPDX-License-Identifier: MIT */
/* The operations that change what there is and where: insert, remove, move. */
#include <string.h>

#include "edit_internal.h"
#include "limits.h"

static void add_text_or_null(cJSON *op, const char *name, const char *text)
{
    cJSON_AddItemToObject(op, name, text ? cJSON_CreateString(text) : cJSON_CreateNull());
}

/* Takes `value`. `name` is a resource's that has no id, else NULL. */
static cJSON *insert_operation(const char *into, const char *before, const char *name, cJSON *value)
{
    cJSON *op = edit_operation("insert", into);

    add_text_or_null(op, "before", before);
    if (name) {
        cJSON_AddStringToObject(op, "name", name);
    }
    cJSON_AddItemToObject(op, "value", value);
    return op;
}

static cJSON *move_operation(const char *at, const char *into, const char *before)
{
    cJSON *op = edit_operation("move", at);

    cJSON_AddStringToObject(op, "into", into);
    add_text_or_null(op, "before", before);
    return op;
}

/* --- nodes: insert, remove, move --- */

static const char *id_at(const struct node *parent, size_t position)
{
    return position < parent->child_count ? parent->children[position]->id : NULL;
}

static bool fail_before(const struct editor *editor, const char *place, const char *before)
{
    return error_set(editor->err, ERROR_NOT_FOUND, place, "\"%.64s\" is not there to come before",
                     before);
}

static bool find_position(const struct editor *editor, const struct node *parent, const cJSON *op,
                          const char *place, size_t *out)
{
    const char *before = edit_member_text(op, "before");
    const struct node *next = before ? scene_find(editor->scene, before) : NULL;

    if (next && next->parent == parent) {
        *out = node_position(next);
        return true;
    }
    *out = parent->child_count;
    return !before || editor->lenient || fail_before(editor, place, before);
}

static bool insert_node(struct editor *editor, const struct path *path, const char *into,
                        const cJSON *op)
{
    char at[PATH_TEXT_BYTES + 1], value_place[ERROR_PLACE_BYTES];
    struct node *parent = edit_find_node(editor, path->part[1], into);
    size_t position;

    if (!parent || !find_position(editor, parent, op, into, &position)) {
        return false;
    }
    error_place(value_place, into, "value");
    struct node *node = node_read(editor->scene, cJSON_GetObjectItemCaseSensitive(op, "value"),
                                  value_place, editor->err);
    if (!node) {
        return false;
    }
    if (!scene_attach(editor->scene, node, parent, position, into, editor->err)) {
        node_destroy(node);
        return false;
    }
    snprintf(at, sizeof at, "/nodes/%s", node->id);
    edit_undo_by(editor, edit_operation("remove", at));
    edit_did(editor, insert_operation(into, id_at(parent, position + 1), NULL, node_to_json(node)));
    return true;
}

static bool fail_root(const struct editor *editor, const struct node *node, const char *at,
                      const char *what)
{
    return error_set(editor->err, ERROR_CONFLICT, at, "the root%s cannot be %s",
                     node->model ? " of a model" : "", what);
}

static bool remove_node(struct editor *editor, const struct path *path, const char *at)
{
    char into[PATH_TEXT_BYTES + 1];
    struct node *node = edit_find_node(editor, path->part[1], at);

    if (!node) {
        return false;
    }
    if (!node->parent) {
        return fail_root(editor, node, at, "removed");
    }
    if (!scene_check_untargeted(editor->scene, node, at, editor->err)) {
        return false;
    }
    const char *before = id_at(node->parent, node_position(node) + 1);
    snprintf(into, sizeof into, "/nodes/%s", node->parent->id);
    edit_undo_by(editor, insert_operation(into, before, NULL, node_to_json(node)));
    edit_did(editor, edit_operation("remove", at));
    scene_detach(editor->scene, node);
    node_destroy(node);
    return true;
}

static bool check_move(const struct editor *editor, const struct node *node,
                       const struct node *parent, const char *at)
{
    if (!node->parent) {
        return fail_root(editor, node, at, "moved");
    }
    for (const struct node *above = parent; above; above = above->parent) {
        if (above == node) {
            return error_set(editor->err, ERROR_CONFLICT, at, "\"%s\" is \"%s\" itself or below it",
                             parent->id, node->id);
        }
    }
    return true;
}

static bool move_node(struct editor *editor, const struct path *path, const char *at,
                      const char *into, const cJSON *op)
{
    struct path target;
    char from[PATH_TEXT_BYTES + 1];
    size_t position;
    struct node *node = edit_find_node(editor, path->part[1], at);

    if (!node) {
        return false;
    }
    if (!into || !path_split(&target, into, NULL) || !path_is(&target, 0, "nodes") ||
        target.count != 2) {
        return error_set(editor->err, ERROR_NOT_FOUND, into ? into : at,
                         "a node moves into \"/nodes/ID\"");
    }
    struct node *parent = edit_find_node(editor, target.part[1], into);
    if (!parent || !check_move(editor, node, parent, at) ||
        !find_position(editor, parent, op, into, &position)) {
        return false;
    }
    const size_t old = node_position(node);
    if (position < parent->child_count && parent->children[position] == node) {
        return error_set(editor->err, ERROR_CONFLICT, at, "a node cannot come before itself");
    }
    snprintf(from, sizeof from, "/nodes/%s", node->parent->id);
    const char *after = id_at(node->parent, old + 1);
    position -= parent == node->parent && position > old;
    if (!scene_move(editor->scene, node, parent, position, at, editor->err)) {
        return false;
    }
    edit_undo_by(editor, move_operation(at, from, after));
    edit_did(editor, move_operation(at, into, id_at(parent, position + 1)));
    return true;
}

/* --- resources: insert, remove, move --- */

static const char *name_at(const struct resource_list *list, size_t position)
{
    return position < list->count ? list->items[position]->name : NULL;
}

static bool find_list_position(const struct editor *editor, const struct resource_list *list,
                               const cJSON *op, const char *place, size_t *out)
{
    const char *before = edit_member_text(op, "before");
    const struct resource *next = before ? resource_find(list, before) : NULL;

    *out = next ? resource_list_position(list, next) : list->count;
    return !before || next || editor->lenient || fail_before(editor, place, before);
}

static cJSON *insert_resource_operation(const struct resource_kind *kind,
                                        const struct resource_list *list, size_t position)
{
    const struct resource *resource = list->items[position];
    char home[PATH_TEXT_BYTES + 1];

    snprintf(home, sizeof home, "/%s", kind->list);
    return insert_operation(home, name_at(list, position + 1), kind->array ? NULL : resource->name,
                            resource_json(kind, resource));
}

static struct resource *read_resource(const struct editor *editor, const struct resource_kind *kind,
                                      const char *into, const cJSON *op)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(op, "value");
    const char *name = kind->array ? NULL : edit_member_text(op, "name");
    char place[ERROR_PLACE_BYTES];

    if (!kind->array && !name) {
        error_set(editor->err, ERROR_INVALID, into, "the name of the %s is missing", kind->item);
        return NULL;
    }
    error_place(place, into, name ? name : "value");
    struct resource *resource = resource_read(editor->scene, kind, name, value, place, editor->err);
    if (resource && !resource_read_tree(editor->scene, resource, kind, value, place, editor->err)) {
        resource_destroy(resource);
        return NULL;
    }
    return resource;
}

static bool insert_resource(struct editor *editor, const struct resource_kind *kind,
                            const char *into, const cJSON *op)
{
    const struct resource_list *list = resource_list_of(kind, editor->scene);
    char at[PATH_TEXT_BYTES + 1];
    size_t position;

    if (list->count >= kind->limit) {
        return error_set(editor->err, ERROR_LIMIT, into, "%zu %s are above the maximum %zu",
                         list->count + 1, kind->list, kind->limit);
    }
    if (!find_list_position(editor, list, op, into, &position)) {
        return false;
    }
    struct resource *resource = read_resource(editor, kind, into, op);
    if (!resource) {
        return false;
    }
    if (!scene_attach_resource(editor->scene, kind, resource, position, into, editor->err)) {
        resource_destroy(resource);
        return false;
    }
    snprintf(at, sizeof at, "%s/%s", into, resource->name);
    edit_undo_by(editor, edit_operation("remove", at));
    edit_did(editor, insert_resource_operation(kind, list, position));
    return true;
}

static bool remove_resource(struct editor *editor, const struct resource_kind *kind,
                            const struct path *path, const char *at)
{
    const struct resource_list *list = resource_list_of(kind, editor->scene);
    struct resource *resource = edit_find_resource(editor, kind, path->part[1], at);

    if (!resource) {
        return false;
    }
    if (resource->users > 0) {
        return error_set(editor->err, ERROR_CONFLICT, at, "is used by %zu %s%s", resource->users,
                         kind->user, resource->users == 1 ? "" : "s");
    }
    edit_undo_by(editor,
                 insert_resource_operation(kind, list, resource_list_position(list, resource)));
    edit_did(editor, edit_operation("remove", at));
    scene_detach_resource(editor->scene, kind, resource);
    resource_destroy(resource);
    return true;
}

static bool move_resource(struct editor *editor, const struct resource_kind *kind,
                          const struct path *path, const char *at, const char *into,
                          const cJSON *op)
{
    struct resource_list *list = resource_list_of(kind, editor->scene);
    struct resource *resource = edit_find_resource(editor, kind, path->part[1], at);
    char home[PATH_TEXT_BYTES + 1];
    size_t position;

    if (!resource) {
        return false;
    }
    snprintf(home, sizeof home, "/%s", kind->list);
    if (into && strcmp(into, home) != 0) {
        return error_set(editor->err, ERROR_NOT_FOUND, into, "\"%s\" moves only within %s", at,
                         home);
    }
    if (!find_list_position(editor, list, op, at, &position)) {
        return false;
    }
    const size_t old = resource_list_position(list, resource);
    if (position == old) {
        return error_set(editor->err, ERROR_CONFLICT, at, "it cannot come before itself");
    }
    edit_undo_by(editor, move_operation(at, home, name_at(list, old + 1)));
    position -= position > old;
    resource_list_remove(list, resource);
    resource_list_insert(list, resource, position);
    edit_did(editor, move_operation(at, home, name_at(list, position + 1)));
    return true;
}

/* --- operations --- */

bool edit_insert(struct editor *editor, const cJSON *op)
{
    const char *into = edit_member_text(op, "into");
    struct path path;

    if (!path_split(&path, into, editor->err)) {
        return false;
    }
    if (path.count == 2 && path_is(&path, 0, "nodes")) {
        return insert_node(editor, &path, into, op);
    }
    const struct resource_kind *kind = edit_find_kind(&path);
    if (path.count == 1 && kind) {
        return insert_resource(editor, kind, into, op);
    }
    return error_set(editor->err, ERROR_NOT_FOUND, into, "nothing can be inserted at this place");
}

bool edit_remove(struct editor *editor, const cJSON *op)
{
    const char *at = edit_member_text(op, "at");
    struct path path;

    if (!path_split(&path, at, editor->err)) {
        return false;
    }
    if (path.count == 2 && path_is(&path, 0, "nodes")) {
        return remove_node(editor, &path, at);
    }
    const struct resource_kind *kind = edit_find_kind(&path);
    if (path.count == 2 && kind) {
        return remove_resource(editor, kind, &path, at);
    }
    return error_set(editor->err, ERROR_NOT_FOUND, at, "nothing can be removed at this place");
}

bool edit_move(struct editor *editor, const cJSON *op)
{
    const char *at = edit_member_text(op, "at"), *into = edit_member_text(op, "into");
    struct path path;

    if (!path_split(&path, at, editor->err)) {
        return false;
    }
    if (path.count == 2 && path_is(&path, 0, "nodes")) {
        return move_node(editor, &path, at, into, op);
    }
    const struct resource_kind *kind = edit_find_kind(&path);
    if (path.count == 2 && kind) {
        return move_resource(editor, kind, &path, at, into, op);
    }
    return error_set(editor->err, ERROR_NOT_FOUND, at, "nothing can be moved from this place");
}
