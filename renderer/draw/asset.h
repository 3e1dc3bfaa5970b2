/* SPDX-License-Identifier: MIT */
/* Files that scenes name by their SHA-256: the bytes that the renderer received, not yet decoded.
 * Belongs to the drawing thread. */
#ifndef RENDERER_ASSET_H
#define RENDERER_ASSET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/asset.h"

struct asset {
    char id[ASSET_ID_CHARACTERS + 1];
    uint8_t *bytes;
    size_t length;
    struct error problem; /* why it is no picture; ERROR_NONE: none is known */
    int references;       /* of the list, and of who reads it */
    struct asset *next;
};

/* Adds a copy of the file to the list, which begins with the newest. False: the list has it
 * already. Drops unused files (`is_used`) but for the newest few. */
bool assets_add(struct asset **assets, const char *id, const void *bytes, size_t length,
                bool (*is_used)(void *data, const char *id), void *data);
/* NULL: none of that name. */
struct asset *assets_find(struct asset *assets, const char *id);
void assets_finish(struct asset **assets);
struct asset *asset_ref(struct asset *asset);
void asset_unref(struct asset *asset);

#endif
