/* SPDX-License-Identifier: MIT */
/* The last state of a scene that a worker could draw. It is kept for scenes with users' code,
 * because their newest state may end workers. Every function is called under the hub's lock.
 *
 *     last_good.scene --- log of edits ---> proven --- log of edits ---> newest
 *
 * The copy is made before the first edit of a scene with code. It is brought forward only when it
 * is needed, or when the log grows too long. */
#ifndef SERVER_LAST_GOOD_H
#define SERVER_LAST_GOOD_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

struct room;
struct scene;

void last_good_finish(struct room *room);
/* Call it before the scene changes by `ops`. NULL: the operations bring no new code. Where the
 * document is copied, and has many nodes, it releases the lock. */
void last_good_before_edit(struct room *room, const cJSON *ops);
bool last_good_is_copied(const struct room *room, const cJSON *ops);
/* Call it before another scene replaces the room's. True: the old scene is kept here. */
bool last_good_before_replace(struct room *room, bool next_has_code);
/* Call it before the log drops this revision, its oldest one. */
void last_good_forget(struct room *room, uint64_t revision);
/* A worker can draw this revision. */
void last_good_proven(struct room *room, uint64_t revision);
/* The newest proven state and its revision. NULL: there is none older than the room's state. */
const struct scene *last_good_state(struct room *room, uint64_t *out_revision);
/* A copy of that state, which is made while the lock is free. */
struct scene *last_good_copy(struct room *room, const struct scene *good);

#endif
