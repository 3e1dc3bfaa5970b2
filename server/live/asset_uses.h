/* SPDX-License-Identifier: MIT */
/* Which uploaded files are named by scenes as they are now, stored or open. */
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
    char scene[LIMIT_ID_BYTES + 1]; /* one that names it; "": none does */
};

/* The files that were there when it was read, oldest first. */
struct asset_uses {
    struct asset_use *items;
    size_t count;
};

/* Without the hub's lock; reads every scene, and waits for the disk. */
bool asset_uses_read(struct hub *hub, struct asset_uses *out, struct error *err);
void asset_uses_finish(struct asset_uses *names);
/* Under the hub's lock: adds what open scenes name since. */
void asset_uses_add_open(struct asset_uses *names, const struct hub *hub);
/* A scene that names it; NULL: none. A file that was not there yet counts as named by "". */
const char *asset_uses_scene(const struct asset_uses *names, const char *id);

#endif
