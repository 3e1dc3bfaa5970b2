/* SPDX-License-Identifier: MIT */
/* The packets about a room that the worker gets. If the newest state has an error, or is tried
 * again, the worker first gets the last good state, so that viewers see a picture. Every function
 * is called under the hub's lock. */
#ifndef SERVER_ROOM_SYNC_H
#define SERVER_ROOM_SYNC_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

struct hub;
struct packet_scene;
struct room;
struct shared_buffer;

/* Sends a scene whose document has this text with its NUL, without code that is refused. Shares the
 * text. */
void room_sync_send_scene(struct hub *hub, const struct packet_scene *packet,
                          struct shared_buffer *text);

/* Sends the scene to a worker that does not hold it, before its first order. False: many nodes are
 * printed first; the supervisor is woken when the worker has the scene. */
bool room_sync_open(struct room *room);
/* The worker has a result for this revision: it can draw it, or never will. */
void room_sync_done(struct room *room, uint64_t revision);
/* Sends an edit that made a new revision; `text` is the printed `ops`. */
void room_sync_edit(struct room *room, const cJSON *ops, const char *text);
/* Sends a new document that made a new revision. */
void room_sync_replace(struct room *room);
/* An uploaded file is available now. True where the scene names it. */
bool room_sync_upload(struct room *room, const char *id);
/* Closes the scene in the worker. */
void room_sync_close(struct room *room);

#endif
