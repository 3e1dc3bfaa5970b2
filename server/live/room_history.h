/* SPDX-License-Identifier: MIT */
/* A room's newest edits, in memory: for sessions that resume, for the worker, and for the last good
 * state. Every function is called under the hub's lock. */
#ifndef SERVER_ROOM_HISTORY_H
#define SERVER_ROOM_HISTORY_H

#include "room_state.h"

void room_history_clear(struct room *room);
/* Adds the newest revision; `ops` are its operations as text, copied. */
void room_history_add(struct room *room, const struct room_change *change, const char *ops);
/* The author's edit with this number; NULL: it is not in the log. */
const struct room_entry *room_history_find(const struct room *room, const char *author,
                                           int64_t edit);
/* Operations of all revisions above `from`, which is at least room->log_from. Caller deletes. */
cJSON *room_history_since(const struct room *room, uint64_t from);

#endif
