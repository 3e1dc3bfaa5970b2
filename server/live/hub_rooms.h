/* SPDX-License-Identifier: MIT */
/* The rooms of the hub: found, loaded, made, deleted. */
#ifndef SERVER_HUB_ROOMS_H
#define SERVER_HUB_ROOMS_H

#include "hub.h"

/* Takes the lock and gives the open room, loaded if it was not. NULL, and the lock not held, when
 * there is no such scene or it cannot be read. */
struct room *hub_lock_room(struct hub *hub, const char *id, struct error *err);
/* The same for who changes the document: waits while somebody holds it. Threads of tasks only. */
struct room *hub_lock_room_to_change(struct hub *hub, const char *id, struct error *err);
bool hub_has_scene(struct hub *hub, const char *id);
/* Whether reading, printing or copying the scene takes long. Takes the lock. */
bool hub_scene_is_heavy(struct hub *hub, const char *id);
/* Whether it is in memory, or nowhere, and not heavy. Takes the lock. */
bool hub_is_ready(struct hub *hub, const char *id);
/* Creates a scene; takes the lock, returns holding it, like hub_lock_room. Takes `scene` and
 * `text`, which is what it prints as, in any case. `id` "" finds one. `then` runs after the commit
 * on the store's thread. */
struct room *hub_lock_new_room(struct hub *hub, const char *id, struct scene *scene, char *text,
                               void (*then)(void *data), void *data, struct error *err);
/* Under the lock: forgets and deletes the scene; the room is gone afterwards. */
void hub_delete_room(struct hub *hub, struct room *room, void (*then)(void *data), void *data);
/* From the list; it stays the caller's. */
void hub_remove_room(struct hub *hub, struct room *room);

#endif
