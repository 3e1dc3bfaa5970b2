/* SPDX-License-Identifier: MIT */
/* Who may edit a room as whom, and which numbers of edits are new. Every function is called under
 * the hub's lock, but for room_authors_load. */
#ifndef SERVER_ROOM_AUTHORS_H
#define SERVER_ROOM_AUTHORS_H

#include "room_state.h"

struct store_loaded;

void room_authors_load(struct room *room, const struct store_loaded *loaded);
/* The author that goes by `client`. Its key is in `out_key`: the one in `key`, or a new one where
 * `key` is "". NULL with ERROR_FORBIDDEN when somebody else has the key of this client. */
struct author *room_authors_admit(struct room *room, const char *client, const char *key,
                                  char out_key[MESSAGE_KEY_CHARACTERS + 1], struct error *err);
/* Its connection ends, or goes to another session. */
void room_authors_left(struct room *room, struct author *author);
/* The log has been cut, or will be by what is queued. */
void room_authors_cut(struct room *room);
/* ROOM_APPLIED: the number is new. ROOM_KNOWN: it is in the log, at `*out_revision`. Everything
 * else is ROOM_REFUSED: what is not in the log was never applied. */
enum room_outcome room_authors_check_number(const struct room *room,
                                            const struct room_change *change,
                                            uint64_t *out_revision, struct error *err);

#endif
