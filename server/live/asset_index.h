/* SPDX-License-Identifier: MIT */
/* The files that scenes may name: uploaded ones and built-in ones. The index holds their types and
 * sizes; their bytes are in the store or in the program. Every function but asset_index_load and
 * asset_index_share is called under the hub's lock. */
#ifndef SERVER_ASSET_INDEX_H
#define SERVER_ASSET_INDEX_H

#include "server/store/store.h"

struct hub;
struct shared_buffer;
struct scene;

struct asset_entry {
    char id[ASSET_ID_CHARACTERS + 1];
    char type[32];
    int width, height;
    size_t length;
};

/* One whose bytes are in memory, for those who read it. */
struct asset_loaded {
    char id[ASSET_ID_CHARACTERS + 1];
    struct shared_buffer *bytes;
};

struct asset_index {
    struct asset_entry *items; /* oldest first */
    size_t count;
    size_t bytes;                        /* of uploaded files */
    size_t pending_count, pending_bytes; /* being written to the disk */
    struct asset_loaded *loaded;
    size_t loaded_count;
};

/* Adds a file that the store lists; `data` is the index. */
void asset_index_add(void *data, const struct store_asset *asset);
void asset_index_add_embedded(struct asset_index *assets);
void asset_index_remove(struct asset_index *assets, const char *id);
/* Whether one more file may be kept. */
bool asset_index_have_room(const struct asset_index *assets, size_t length);
void asset_index_finish(struct asset_index *assets);
/* NULL: there is no such file. */
const struct asset_entry *asset_index_find(const struct asset_index *assets, const char *id);

/* Reads a file. Any thread, without the lock. Caller frees. NULL and `err`: there is no such
 * file. */
void *asset_index_load(struct hub *hub, const char *id, size_t *out_length, struct error *err);

/* The same for an uploaded file, in one copy for all who have it at a time. Takes the lock. */
struct shared_buffer *asset_index_share(struct hub *hub, const char *id, struct error *err);
/* Forgets copies that nobody has any more. Whether some are left. */
bool asset_index_forget(struct asset_index *assets);

/* Sends a file to the worker, before the first scene that names it. Does nothing for an unknown
 * id. */
void asset_index_send(struct hub *hub, const char *id);

#endif
