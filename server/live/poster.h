/* SPDX-License-Identifier: MIT */
/* The last picture of a scene as one of its viewers saw it, a JPEG: who opens the scene looks at it
 * until there is a picture of their own. Kept with the room, written to the store when the room
 * closes; lost where the daemon is killed. All but poster_find is called under the hub's lock. */
#ifndef SERVER_POSTER_H
#define SERVER_POSTER_H

#include <stddef.h>
#include <stdint.h>

struct shared_buffer;
struct hub;
struct room;

/* Takes a reference. A picture above LIMIT_POSTER_BYTES is passed over. */
void poster_set(struct room *room, struct shared_buffer *jpeg);
/* Queues a write where there is a new one. */
void poster_store(struct room *room);
void poster_finish(struct room *room);
/* Takes the lock. A reference for the caller; NULL: there is none. */
struct shared_buffer *poster_find(struct hub *hub, const char *scene);

#endif
