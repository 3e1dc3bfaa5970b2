/* SPDX-License-Identifier: MIT */
/* The last state of a scene that a worker could draw, for a scene with code of users: its newest
 * state may be one that ends workers. Every function is called under the hub's lock.
 *
 *     fallback.scene --- log of edits ---> proven --- log of edits ---> newest
 *
 * The copy is made before the first edit of a scene with code, and brought nearer only when it is
 * needed or the log grows too long. */
#ifndef SERVER_FALLBACK_H
#define SERVER_FALLBACK_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

struct room;
struct scene;

void fallback_finish(struct room *room);
/* The scene is about to change; `ops` NULL: by what was there before. */
void fallback_before_edit(struct room *room, const cJSON *ops);
/* `next` is about to take the place of the room's scene; true: that one is kept here. */
bool fallback_before_replace(struct room *room, const struct scene *next);
/* The log is about to forget this revision, the oldest that it has. */
void fallback_forget(struct room *room, uint64_t revision);
void fallback_proven(struct room *room, uint64_t revision);
/* The newest proven state, if that is older than the room's, and its revision; NULL: none. */
const struct scene *fallback_state(struct room *room, uint64_t *out_revision);

#endif
