/* SPDX-License-Identifier: MIT */
/* The whole document into the store, after which its older edits are not needed. Every function is
 * called under the hub's lock. */
#ifndef SERVER_ROOM_SNAPSHOT_H
#define SERVER_ROOM_SNAPSHOT_H

#include "room_state.h"

void room_snapshot(struct room *room);
/* Stores a snapshot soon, or at once where that is quick. */
void room_snapshot_soon(struct room *room);

#endif
