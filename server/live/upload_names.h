/* SPDX-License-Identifier: MIT */
/* Which uploaded files are named by scenes as they are now, stored or open. */
#ifndef SERVER_UPLOAD_NAMES_H
#define SERVER_UPLOAD_NAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"

struct hub;

struct upload_name {
    char id[ASSET_ID_CHARACTERS + 1];
    char scene[LIMIT_ID_BYTES + 1]; /* one that names it; "": none does */
};

/* The files that were there when it was read, oldest first. */
struct upload_names {
    struct upload_name *items;
    size_t count;
};

/* Without the hub's lock; reads every scene, and waits for the disk. */
bool upload_names_read(struct hub *hub, struct upload_names *out, struct error *err);
void upload_names_finish(struct upload_names *names);
/* Under the hub's lock: adds what open scenes name since. */
void upload_names_add_open(struct upload_names *names, const struct hub *hub);
/* A scene that names it; NULL: none. A file that was not there yet counts as named by "". */
const char *upload_names_scene(const struct upload_names *names, const char *id);

#endif
