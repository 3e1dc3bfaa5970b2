/* SPDX-License-Identifier: MIT */
#include "asset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

enum { UNUSED_KEPT = 4 }; /* a file is given before the scene that names it */

struct asset *asset_ref(struct asset *asset)
{
    asset->references++;
    return asset;
}

void asset_unref(struct asset *asset)
{
    if (--asset->references == 0) {
        free(asset->bytes);
        free(asset);
    }
}

static void drop(struct asset **at)
{
    struct asset *gone = *at;

    *at = gone->next;
    asset_unref(gone);
}

static struct asset **find(struct asset **at, const char *id)
{
    while (*at && strcmp((*at)->id, id) != 0) {
        at = &(*at)->next;
    }
    return at;
}

static struct asset *create(const char *id, const void *bytes, size_t length)
{
    struct asset *asset = memory_alloc(1, sizeof *asset);

    snprintf(asset->id, sizeof asset->id, "%s", id);
    asset->bytes = memory_alloc(length, 1);
    memcpy(asset->bytes, bytes, length);
    asset->length = length;
    asset->references = 1;
    return asset;
}

bool assets_add(struct asset **assets, const char *id, const void *bytes, size_t length,
                bool (*is_used)(void *data, const char *id), void *data)
{
    struct asset **at = find(assets, id), *asset = *at;
    const bool known = asset != NULL;
    int unused = 0;

    if (known) {
        *at = asset->next;
    } else {
        asset = create(id, bytes, length);
    }
    asset->next = *assets;
    *assets = asset;
    for (at = assets; *at;) {
        if (!is_used(data, (*at)->id) && ++unused > UNUSED_KEPT) {
            drop(at);
        } else {
            at = &(*at)->next;
        }
    }
    return !known;
}

struct asset *assets_find(struct asset *assets, const char *id)
{
    while (assets && strcmp(assets->id, id) != 0) {
        assets = assets->next;
    }
    return assets;
}

void assets_finish(struct asset **assets)
{
    while (*assets) {
        drop(assets);
    }
}
