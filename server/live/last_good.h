/* SPDX-License-Identifier: MIT */
/* The last state of a scene that a worker could draw, for a scene with code of users: its newest
 * state may be one that ends workers. Every function is called under the hub's lock.
 *
 *     last_good.scene --- log of edits ---> proven --- log of edits ---> newest
 *
 * The copy is made before the first edit of a scene with code, and brought nearer only when it is
 * needed or the log grows too long. */
#ifndef SERVER_LAST_GOOD_H
#define SERVER_LAST_GOOD_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

struct room;
struct scene;

void last_good_finish(struct room *room);
/* The scene is about to change; `ops` NULL: by what was there before. */
void last_good_before_edit(struct room *room, const cJSON *ops);
/* `next` is about to take the place of the room's scene; true: that one is kept here. */
bool last_good_before_replace(struct room *room, const struct scene *next);
/* The log is about to forget this revision, the oldest that it has. */
void last_good_forget(struct room *room, uint64_t revision);
void last_good_proven(struct room *room, uint64_t revision);
/* The newest proven state, if that is older than the room's, and its revision; NULL: none. */
const struct scene *last_good_state(struct room *room, uint64_t *out_revision);

#endif
