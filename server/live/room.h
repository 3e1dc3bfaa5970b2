/* SPDX-License-Identifier: MIT */
/* One open scene: how it comes and goes, and the one place where edits get their order. Every
 * function is called under the hub's lock. */
#ifndef SERVER_ROOM_H
#define SERVER_ROOM_H

#include "room_apart.h"
#include "room_state.h"

struct store_loaded;

/* Takes `scene`. */
struct room *room_create(struct hub *hub, const char *id, struct scene *scene, uint64_t revision);
/* The newest state of what the store holds. */
struct room *room_load(struct hub *hub, const char *id, const struct store_loaded *loaded,
                       struct error *err);
void room_destroy(struct room *room);
/* Checks, orders, applies, stores and tells one edit. `then` runs only after ROOM_APPLIED. Nobody
 * may hold the room. Many operations are applied to a copy, for which the lock is let go; only on
 * threads of tasks, where `change` stays valid meanwhile. */
enum room_outcome room_edit(struct room *room, const struct room_change *change, const cJSON *ops,
                            uint64_t *out_revision, struct error *err);
/* `*out_skipped`: operations that were left out because others have set their places since; NULL:
 * none. Of ROOM_REFUSED too. The caller frees it. */
enum room_outcome room_undo(struct room *room, const struct room_change *change, bool redo,
                            uint64_t *out_revision, cJSON **out_skipped, struct error *err);
/* Whether it would let go of the lock: then only on threads of tasks, as with room_edit. */
bool room_undo_is_heavy(const struct room *room, const char *author, bool redo);
/* Puts another document in place; takes `scene` and `text`, which is what it prints as. Returns the
 * one before, to be destroyed; NULL: it is still needed. */
struct scene *room_replace(struct room *room, struct scene *scene, char *text,
                           const struct room_change *change);

/* The `document` message, made of room_text; caller unrefs. */
struct shared_buffer *room_document_message(struct room *room);
/* The `changed` message of a logged revision for `client`: `edit` only where that is the author.
 * Caller unrefs. */
struct shared_buffer *room_changed_message(const struct room *room, uint64_t revision,
                                           const char *client);
void room_tell_all(struct room *room, const char *level, const char *code, const char *place,
                   const char *text);

#endif
