/* SPDX-License-Identifier: MIT */
/* The files that scenes may name: those that clients sent, and those built in. What is known of
 * them is kept here; their bytes are in the store, or in the program. Under the hub's lock but for
 * asset_index_load. */
#ifndef SERVER_ASSET_INDEX_H
#define SERVER_ASSET_INDEX_H

#include "server/store/store.h"

struct hub;
struct scene;

struct asset_entry {
    char id[ASSET_ID_CHARACTERS + 1];
    char type[32];
    int width, height;
    size_t length;
};

struct asset_index {
    struct asset_entry *items; /* oldest first */
    size_t count;
    size_t bytes;                        /* of those that clients sent */
    size_t pending_count, pending_bytes; /* on their way to the disk */
};

/* What the store lists; `data` is the index. */
void asset_index_add(void *data, const struct store_asset *asset);
void asset_index_add_embedded(struct asset_index *assets);
void asset_index_remove(struct asset_index *assets, const char *id);
/* Whether one more file may be kept. */
bool asset_index_have_room(const struct asset_index *assets, size_t length);
void asset_index_finish(struct asset_index *assets);
/* NULL: there is no such file. */
const struct asset_entry *asset_index_find(const struct asset_index *assets, const char *id);

/* Any thread, without the lock: reads a file. Caller frees; NULL and `err`: there is none. */
void *asset_index_load(struct hub *hub, const char *id, size_t *out_length, struct error *err);

/* Sends the worker a file, before the first scene that names it. None of that name: nothing. */
void asset_index_send(struct hub *hub, const char *id);

#endif
