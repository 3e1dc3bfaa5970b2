/* SPDX-License-Identifier: MIT */
/* The writes of a room to the store, and what follows their commits. Every function is called under
 * the hub's lock. */
#ifndef SERVER_ROOM_STORE_H
#define SERVER_ROOM_STORE_H

#include "room_state.h"
#include "server/store/store.h"

/* Queues a write of the room's newest state. Takes `text` and the members of `step`; both may be
 * NULL. */
void room_store_push(struct room *room, enum store_kind kind, const struct room_change *change,
                     char *text, const struct store_step *step);
/* Queue the creation of a new room's scene (takes `text`), and its deletion, after which the room
 * frees itself. */
void room_store_new(struct room *room, char *text, void (*then)(void *data), void *data);
void room_store_deleted(struct room *room, void (*then)(void *data), void *data);
/* Queues the new key of an author whose edits are older than keys. */
void room_store_author(struct room *room, struct author *author);

#endif
