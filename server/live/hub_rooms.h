/* SPDX-License-Identifier: MIT */
/* Finds, loads, creates and deletes the rooms of the hub. */
#ifndef SERVER_HUB_ROOMS_H
#define SERVER_HUB_ROOMS_H

#include "hub.h"

/* Takes the lock and returns the room; loads it first where it was not open. NULL, without the
 * lock, when there is no such scene or it cannot be read. */
struct room *hub_lock_room(struct hub *hub, const char *id, struct error *err);
/* The same for a change of the document: waits while somebody holds it. Threads of tasks only. */
struct room *hub_lock_room_to_change(struct hub *hub, const char *id, struct error *err);
bool hub_has_scene(struct hub *hub, const char *id);
/* Whether reading, printing or copying the scene takes long. Takes the lock. */
bool hub_scene_is_heavy(struct hub *hub, const char *id);
/* Whether a request need not wait: the scene is in memory and light, or does not exist. Takes the
 * lock. */
bool hub_is_ready(struct hub *hub, const char *id);
/* Creates a scene. Takes the lock and returns with it, like hub_lock_room. Takes `scene` and `text`
 * (the printed scene), also on failure. An `id` of "" is replaced by a free one. `then` runs after
 * the commit, on the store's thread. */
struct room *hub_lock_new_room(struct hub *hub, const char *id, struct scene *scene, char *text,
                               void (*then)(void *data), void *data, struct error *err);
/* Deletes the scene. Under the lock. The room must not be used afterwards. */
void hub_delete_room(struct hub *hub, struct room *room, void (*then)(void *data), void *data);
/* Takes the room out of the list of open rooms. The caller then owns it. */
void hub_remove_room(struct hub *hub, struct room *room);

#endif
