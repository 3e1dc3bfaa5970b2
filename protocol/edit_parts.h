/* SPDX-License-Identifier: MIT */
/* What the operations of an edit share. Private to edit.c, edit_set.c and edit_list.c. */
#ifndef PROTOCOL_EDIT_PARTS_H
#define PROTOCOL_EDIT_PARTS_H

#include "edit.h"
#include "scene_parts.h"

enum { PLACE_PARTS = 4, PLACE_TEXT_BYTES = 200 };

/* "/nodes/body/params/radius" cut at its slashes. */
struct place {
    char text[PLACE_TEXT_BYTES + 1];
    const char *part[PLACE_PARTS];
    int count;
};

struct editor {
    struct scene *scene;
    cJSON *applied; /* canonical form of what was done */
    cJSON *inverse; /* in the order of undoing */
    bool lenient;   /* a missing `before` means last */
    struct error *err;
};

/* Each does its operation wholly and records it, or fails and changes nothing. */
bool edit_set(struct editor *editor, const cJSON *op);
bool edit_insert(struct editor *editor, const cJSON *op);
bool edit_remove(struct editor *editor, const cJSON *op);
bool edit_move(struct editor *editor, const cJSON *op);

bool place_split(struct place *place, const char *text, struct error *err);
bool place_is(const struct place *place, int index, const char *name);

const char *edit_member_text(const cJSON *op, const char *name);
/* NULL and an error where the id or name is not known. */
struct node *edit_find_node(const struct editor *editor, const char *id, const char *place);
struct resource *edit_find_resource(const struct editor *editor, const struct resource_list *list,
                                    const char *name, const char *place);
/* The list that the place is in; NULL: none. */
struct resource_list *edit_find_list(const struct editor *editor, const struct place *place);
bool edit_is_lights(const struct editor *editor, const struct resource_list *list);

/* A new operation with its place (`into` for insert, else `at`). */
cJSON *edit_operation(const char *name, const char *place);
/* Takes `value`; NULL means the default. */
cJSON *edit_set_operation(const char *at, cJSON *value);
/* Undoing goes backwards: each operation is put in front of those recorded before. */
void edit_undo_by(struct editor *editor, cJSON *op);
/* Takes the canonical form of what was done. */
void edit_did(struct editor *editor, cJSON *op);

#endif
