/* SPDX-License-Identifier: MIT */
/* Snapshots: the whole document goes to the store, which then needs no older edits to load it.
 * Every function is called under the hub's lock. */
#ifndef SERVER_ROOM_SNAPSHOT_H
#define SERVER_ROOM_SNAPSHOT_H

#include "room_state.h"

void room_snapshot(struct room *room);
/* Prints a large document without the lock: on threads of tasks alone. */
void room_snapshot_apart(struct room *room);
/* Stores a snapshot: at once where that is quick, else by a task. */
void room_snapshot_soon(struct room *room);

#endif
