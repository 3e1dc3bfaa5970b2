/* SPDX-License-Identifier: MIT */
/* The uploaded files that scenes name now. Stored and open scenes count. */
#ifndef SERVER_ASSET_USES_H
#define SERVER_ASSET_USES_H

#include <stdbool.h>
#include <stddef.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"

struct hub;

struct asset_use {
    char id[ASSET_ID_CHARACTERS + 1];
    char scene[LIMIT_ID_BYTES + 1]; /* a scene that names it; "": none */
};

/* The files that existed when the list was read, oldest first. */
struct asset_uses {
    struct asset_use *items;
    size_t count;
};

/* Reads every scene and waits for the disk. Without the hub's lock, on threads of tasks alone. */
bool asset_uses_read(struct hub *hub, struct asset_uses *out, struct error *err);
void asset_uses_finish(struct asset_uses *names);
/* Adds what open scenes have named since. Under the hub's lock. */
void asset_uses_add_open(struct asset_uses *names, const struct hub *hub);
/* A scene that names the file; NULL: none. The answer is "" for a file newer than the list. */
const char *asset_uses_scene(const struct asset_uses *names, const char *id);

#endif
