/* SPDX-License-Identifier: MIT */
/* Long work on a room's document: printing many nodes, applying heavy edits to a copy. It runs
 * without the hub's lock, while nobody changes the document. Every function is called under the
 * lock; those that release it say so. */
#ifndef SERVER_ROOM_APART_H
#define SERVER_ROOM_APART_H

#include "room_state.h"

enum {
    ROOM_LIGHT_WEIGHT = 512,   /* edit_weight of an edit or step; heavier ones work on a copy */
    ROOM_LIGHT_BYTES = 1 << 20 /* others add less to the document, whatever has to be escaped */
};

/* The work: operations, or a step of undo or redo taken from the history. */
struct room_order {
    const struct room_change *change;
    const cJSON *ops;
    struct history_move *move; /* NULL: the operations */
    bool heavy;                /* room_edit_is_heavy of either; only that may be refused space */
};

/* The results of an edit. */
struct room_work {
    cJSON *applied;
    struct step *step; /* of operations */
    char *applied_text, *inverse_text;
    size_t bytes;         /* of the document then, at most */
    struct scene *before; /* replaced by the copy; NULL: there was no copy */
};

/* Whether printing or copying the document takes long. */
bool room_is_heavy(const struct room *room);
/* Whether applying the operations takes long: they are many, or the document may have to be printed
 * to know how long it becomes. NULL: no. */
bool room_edit_is_heavy(const struct room *room, const cJSON *ops);
/* Between room_hold and room_release the room stays and the document does not change, also while
 * the lock is free. */
void room_hold(struct room *room);
void room_release(struct room *room);

/* The printed document with its NUL; caller unrefs. A document of many nodes is printed without the
 * lock, on threads of tasks alone, and the text is kept until the next edit. */
struct shared_buffer *room_text(struct room *room);
/* A copy of the document. Releases the lock for one of many nodes. */
struct scene *room_copy(struct room *room);
/* The same for who edits the document next, before the lock is released again. Nobody may hold the
 * room; who has come to hold it meanwhile is waited for. */
struct scene *room_copy_to_edit(struct room *room);
/* Destroy a scene that was the room's, steps that its history has dropped, and a room that nobody
 * knows any more; large ones on a thread of tasks. The last one needs no lock. */
void room_drop_scene(struct hub *hub, struct scene *scene);
void room_drop_steps(struct room *room);
void room_drop(struct room *room);
/* False and `err` where a document of so many bytes is longer than a scene may be. */
bool room_check_bytes(size_t bytes, struct error *err);
/* Applies the order, unless the document would be too long. Nobody may hold the room. Releases the
 * lock for a heavy order. */
bool room_apply(struct room *room, const struct room_order *order, struct room_work *out,
                struct error *err);
/* Frees the results that nobody has taken. Releases the lock if that takes long. */
void room_work_finish(struct room *room, struct room_work *work);
/* What the room keeps of a printed document: a copy, if printing it takes long; else NULL. Needs no
 * lock. */
struct shared_buffer *room_text_to_keep(const struct scene *scene, const char *text);
/* Takes `kept`, which may be NULL. */
void room_keep_text(struct room *room, struct shared_buffer *kept);
void room_forget_text(struct room *room);
#endif
