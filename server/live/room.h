/* SPDX-License-Identifier: MIT */
/* A room is one open scene. This file creates and destroys rooms and orders their edits; no other
 * file changes documents. Every function is called under the hub's lock. */
#ifndef SERVER_ROOM_H
#define SERVER_ROOM_H

#include "room_apart.h"
#include "room_state.h"

struct store_loaded;

/* Takes `scene`. */
struct room *room_create(struct hub *hub, const char *id, struct scene *scene, uint64_t revision);
/* Opens a room in the newest state that the store holds. */
struct room *room_load(struct hub *hub, const char *id, const struct store_loaded *loaded,
                       struct error *err);
void room_destroy(struct room *room);
/* Checks, orders, applies, stores and announces one edit. `then` runs only after ROOM_APPLIED.
 * Nobody may hold the room. Some edits release the lock (room_edit_releases); they belong on
 * threads of tasks, and `change` has to stay valid meanwhile. */
enum room_outcome room_edit(struct room *room, const struct room_change *change, const cJSON *ops,
                            uint64_t *out_revision, struct error *err);
/* Undoes or redoes the author's newest step. `*out_skipped`: operations left out because others
 * have set their places since; NULL: none. It is set with ROOM_REFUSED too. The caller frees it. */
enum room_outcome room_undo(struct room *room, const struct room_change *change, bool redo,
                            uint64_t *out_revision, cJSON **out_skipped, struct error *err);
/* Whether room_edit or room_undo would release the lock: the edit is heavy, or many nodes are
 * copied before it. Then call them on threads of tasks alone. */
bool room_edit_releases(const struct room *room, const cJSON *ops);
bool room_undo_releases(const struct room *room, const char *author, bool redo);
/* A document that replaces the room's, with what takes long to find out: made without the lock. */
struct room_document {
    struct scene *scene;
    char *text;                 /* the printed scene */
    struct shared_buffer *kept; /* room_text_to_keep of it */
    bool has_code;
};
/* Takes the document's scene and texts. Returns the old scene, which the caller destroys; NULL: the
 * room still needs it. Releases the lock for many nodes: on threads of tasks alone. */
struct scene *room_replace(struct room *room, const struct room_document *document,
                           const struct room_change *change);

/* The `document` message, made of room_text; caller unrefs. Releases the lock as that does. */
struct shared_buffer *room_document_message(struct room *room);
/* The `changed` message of a logged revision for `client`. It has `edit` only if `client` is the
 * author. Caller unrefs. */
struct shared_buffer *room_changed_message(const struct room *room, uint64_t revision,
                                           const char *client);
/* Sends a notice to all sessions of the room. */
void room_tell_all(struct room *room, const char *level, const char *code, const char *place,
                   const char *text);

#endif
