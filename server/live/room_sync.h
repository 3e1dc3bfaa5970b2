/* SPDX-License-Identifier: MIT */
/* What the worker is told of a room. A scene whose newest state has an error, or is tried again,
 * is told in its last good state first, so that there is something to show. Every function is
 * called under the hub's lock. */
#ifndef SERVER_ROOM_SYNC_H
#define SERVER_ROOM_SYNC_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

struct hub;
struct room;

/* A scene as the worker may have it; takes `document`. */
void room_sync_send_scene(struct hub *hub, const char *name, uint64_t revision, cJSON *document);

/* Before the first order of a worker that does not hold the scene. */
void room_sync_open(struct room *room);
/* The worker has come to an end with this revision: it can draw it, or never will. */
void room_sync_done(struct room *room, uint64_t revision);
/* After an edit gave the room a new revision; `text` is what `ops` print as. */
void room_sync_edit(struct room *room, const cJSON *ops, const char *text);
/* After another document did. */
void room_sync_replace(struct room *room);
/* A file is there from now on. True where the scene names it. */
bool room_sync_upload(struct room *room, const char *id);
/* The room goes. */
void room_sync_close(struct room *room);

#endif
