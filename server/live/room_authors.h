/* SPDX-License-Identifier: MIT */
/* The authors of a room: which client may edit as which author, and which edit numbers are new.
 * Every function but room_authors_load is called under the hub's lock. */
#ifndef SERVER_ROOM_AUTHORS_H
#define SERVER_ROOM_AUTHORS_H

#include "room_state.h"

struct store_loaded;

void room_authors_load(struct room *room, const struct store_loaded *loaded);
/* The author with the id `client`; creates it if needed. `out_key` gets its key: `key`, or a new
 * one where `key` is "". NULL with ERROR_FORBIDDEN when this author has another key. */
struct author *room_authors_admit(struct room *room, const char *client, const char *key,
                                  char out_key[MESSAGE_KEY_CHARACTERS + 1], struct error *err);
/* The author's connection ends, or passes to another session. */
void room_authors_left(struct room *room, struct author *author);
/* Between room_authors_hold and room_authors_release the author stays, also while the lock is free:
 * an edit of theirs is being applied. */
void room_authors_hold(struct author *author);
void room_authors_release(struct room *room, struct author *author);
/* Call it when the log has been cut, or when a queued write will cut it. */
void room_authors_cut(struct room *room);
/* ROOM_APPLIED: the number is new. ROOM_KNOWN: it is in the log, at `*out_revision`. ROOM_REFUSED:
 * the number is old and not in the log, so that edit was never applied. */
enum room_outcome room_authors_check_number(const struct room *room,
                                            const struct room_change *change,
                                            uint64_t *out_revision, struct error *err);

#endif
