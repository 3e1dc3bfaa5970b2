/* SPDX-License-Identifier: MIT */
/* Files that scenes name by their SHA-256, as the renderer was given them: bytes, not yet read.
 * Belongs to the drawing thread. */
#ifndef RENDERER_ASSET_H
#define RENDERER_ASSET_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { ASSET_ID_CHARACTERS = 64 };

struct asset {
    char id[ASSET_ID_CHARACTERS + 1];
    uint8_t *bytes;
    size_t length;
    struct asset *next; /* the one given before */
};

/* Keeps a copy of the file. Files that `is_used` does not know give way, but the newest few. */
void assets_add(struct asset **assets, const char *id, const void *bytes, size_t length,
                bool (*is_used)(void *data, const char *id), void *data);
/* NULL: none of that name. */
const struct asset *assets_find(const struct asset *assets, const char *id);
void assets_finish(struct asset **assets);

#endif
