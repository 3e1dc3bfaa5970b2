/* SPDX-License-Identifier: MIT */
/* What the operations of an edit share. Private to edit*.c. */
#ifndef PROTOCOL_EDIT_INTERNAL_H
#define PROTOCOL_EDIT_INTERNAL_H

#include "edit.h"
#include "scene_internal.h"

enum { PATH_PARTS = 4, PATH_TEXT_BYTES = 200 };

/* "/nodes/body/params/radius" cut at its slashes. */
struct path {
    char text[PATH_TEXT_BYTES + 1];
    const char *part[PATH_PARTS];
    int count;
};

struct editor {
    struct scene *scene;
    const cJSON *next; /* the operation after this one; one that does both moves it on */
    cJSON *applied;    /* canonical form of what was done */
    cJSON *inverse;    /* in the order of undoing */
    bool lenient;      /* a missing `before` means last */
    struct error *err;
};

/* Each does its operation wholly and records it, or fails and changes nothing. */
bool edit_set(struct editor *editor, const cJSON *op);
bool edit_insert(struct editor *editor, const cJSON *op);
bool edit_remove(struct editor *editor, const cJSON *op);
bool edit_move(struct editor *editor, const cJSON *op);

bool path_split(struct path *path, const char *text, struct error *err);
bool path_is(const struct path *path, int index, const char *name);

const char *edit_member_text(const cJSON *op, const char *name);
/* NULL and an error where the id or name is not known. */
struct node *edit_find_node(const struct editor *editor, const char *id, const char *place);
/* The kind of resource whose list the path is in; NULL: none. */
const struct resource_kind *edit_find_kind(const struct path *path);
struct resource *edit_find_resource(const struct editor *editor, const struct resource_kind *kind,
                                    const char *name, const char *place);

/* Sets what decides of which type a record is: values that the new type knows and accepts stay, and
 * the inverse restores the others (edit_type.c). A node's type is set at once with its primitive or
 * model where the next operation names that. */
bool edit_set_node_type(struct editor *editor, struct node *node, const char *at,
                        const cJSON *value);
/* The name of a primitive or model. */
bool edit_set_declaring(struct editor *editor, struct node *node, int index, const char *at,
                        const cJSON *value);
bool edit_set_resource_type(struct editor *editor, const struct resource_kind *kind,
                            struct resource *resource, const char *at, const cJSON *value);
bool edit_set_rows(struct editor *editor, const struct resource_kind *kind,
                   struct resource *resource, int index, const char *at, const cJSON *value);

/* A new operation with its path (`into` for insert, else `at`). */
cJSON *edit_operation(const char *name, const char *at);
/* Takes `value`; NULL means the default. */
cJSON *edit_set_operation(const char *at, cJSON *value);
/* Undoing goes backwards: each operation is put in front of those recorded before. */
void edit_undo_by(struct editor *editor, cJSON *op);
/* Takes the canonical form of what was done. */
void edit_did(struct editor *editor, cJSON *op);

#endif
