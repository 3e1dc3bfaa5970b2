/* SPDX-License-Identifier: MIT */
/* The files that scenes may name: those that clients sent, and those built in. What is known of
 * them is kept here; their bytes are in the store, or in the program. Under the hub's lock but for
 * uploads_load. */
#ifndef SERVER_UPLOADS_H
#define SERVER_UPLOADS_H

#include "server/store/store.h"

struct hub;
struct scene;

struct upload {
    char id[ASSET_ID_CHARACTERS + 1];
    char type[32];
    int width, height;
    size_t length;
};

struct uploads {
    struct upload *items; /* oldest first */
    size_t count;
    size_t bytes;                        /* of those that clients sent */
    size_t pending_count, pending_bytes; /* on their way to the disk */
};

/* What the store lists; `data` is the uploads. */
void uploads_add(void *data, const struct store_asset *asset);
void uploads_add_embedded(struct uploads *uploads);
void uploads_remove(struct uploads *uploads, const char *id);
/* Whether one more file may be kept. */
bool uploads_have_room(const struct uploads *uploads, size_t length);
void uploads_finish(struct uploads *uploads);
/* NULL: there is no such file. */
const struct upload *uploads_find(const struct uploads *uploads, const char *id);

/* Any thread, without the lock: reads a file. Caller frees; NULL and `err`: there is none. */
void *uploads_load(struct hub *hub, const char *id, size_t *out_length, struct error *err);

/* Sends the worker a file, before the first scene that names it. None of that name: nothing. */
void uploads_send(struct hub *hub, const char *id);

#endif
