/* SPDX-License-Identifier: MIT */
/* The poster of a scene: the last picture that one of its viewers saw, as JPEG. A page shows it
 * until it has a picture of its own. The room holds it and writes it to the store when the room
 * closes; a killed daemon loses it. All functions but poster_find are called under the hub's
 * lock. */
#ifndef SERVER_POSTER_H
#define SERVER_POSTER_H

#include <stddef.h>
#include <stdint.h>

struct shared_buffer;
struct hub;
struct room;

/* Takes a reference. Ignores pictures above LIMIT_POSTER_BYTES. */
void poster_set(struct room *room, struct shared_buffer *jpeg);
/* Queues a write if the poster is new. */
void poster_store(struct room *room);
void poster_finish(struct room *room);
/* Takes the lock. The caller gets a reference; NULL: there is no poster. */
struct shared_buffer *poster_find(struct hub *hub, const char *scene);

#endif
