/* SPDX-License-Identifier: MIT */
/* What is done with a room's document outside the hub's lock, while nobody changes it: printing one
 * of many nodes, applying many operations to a copy. Every function is called under the lock; those
 * that let go of it say so. */
#ifndef SERVER_ROOM_APART_H
#define SERVER_ROOM_APART_H

#include "room_state.h"

enum { ROOM_LIGHT_OPERATIONS = 256 }; /* of an edit or step; more are applied to a copy */

/* What is to be done: operations, or a step of undo or redo that was taken from the history. */
struct room_order {
    const struct room_change *change;
    const cJSON *ops;
    struct history_move *move; /* NULL: the operations */
    size_t count;              /* of operations, in either case */
};

/* What an edit made. */
struct room_work {
    cJSON *applied;
    struct step *step; /* of operations */
    char *applied_text, *inverse_text;
    struct scene *before; /* that the copy took the place of; NULL: none did */
};

/* Whether printing or copying it takes long. */
bool room_is_heavy(const struct room *room);
/* Between these two the document is as it was, without the lock too, and the room stays. */
void room_hold(struct room *room);
void room_release(struct room *room);

/* What the document prints as. One of many nodes is printed without the lock and kept until the
 * next edit; only on threads of tasks then. A text with its NUL; caller unrefs. */
struct shared_buffer *room_text(struct room *room);
/* Nobody may hold the room. With many operations it lets go of the lock. */
bool room_apply(struct room *room, const struct room_order *order, struct room_work *out,
                struct error *err);
/* Frees what nobody has taken; lets go of the lock if that takes long. */
void room_work_finish(struct room *room, struct room_work *work);
/* `text` is what the document prints as now; kept where printing takes long. */
void room_keep_text(struct room *room, const char *text);
void room_forget_text(struct room *room);
#endif
