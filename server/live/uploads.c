/* SPDX-License-Identifier: MIT */
#include "uploads.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "protocol/memory.h"
#include "server/embedded.h"

void uploads_add(void *data, const struct store_asset *asset)
{
    struct uploads *uploads = data;
    struct upload *upload;

    if (uploads_find(uploads, asset->id)) {
        return;
    }
    uploads->items = memory_resize(uploads->items, uploads->count + 1, sizeof(*uploads->items));
    upload = &uploads->items[uploads->count++];
    uploads->bytes += example_files_find(asset->id) ? 0 : asset->length;
    *upload = (struct upload){
        .width = asset->info.width, .height = asset->info.height, .length = asset->length};
    snprintf(upload->id, sizeof(upload->id), "%s", asset->id);
    snprintf(upload->type, sizeof(upload->type), "%s", asset->info.type);
}

void uploads_add_embedded(struct uploads *uploads)
{
    for (size_t i = 0; i < example_files_count; i++) {
        const struct embedded *file = &example_files_table[i];
        struct store_asset asset = {.length = file->length};

        snprintf(asset.id, sizeof(asset.id), "%s", file->path);
        if (asset_inspect(file->bytes, file->length, &asset.info, NULL)) {
            uploads_add(uploads, &asset);
        }
    }
}

void uploads_remove(struct uploads *uploads, const char *id)
{
    for (size_t i = 0; i < uploads->count; i++) {
        if (strcmp(uploads->items[i].id, id) == 0) {
            uploads->bytes -= uploads->items[i].length;
            uploads->count--;
            memmove(uploads->items + i, uploads->items + i + 1,
                    (uploads->count - i) * sizeof(*uploads->items));
            return;
        }
    }
}

bool uploads_have_room(const struct uploads *uploads, size_t length)
{
    return uploads->count + uploads->pending_count < LIMIT_ASSETS &&
           uploads->bytes + uploads->pending_bytes + length <= LIMIT_ASSETS_BYTES;
}

void uploads_finish(struct uploads *uploads)
{
    free(uploads->items);
}

const struct upload *uploads_find(const struct uploads *uploads, const char *id)
{
    for (size_t i = 0; i < uploads->count; i++) {
        if (strcmp(uploads->items[i].id, id) == 0) {
            return &uploads->items[i];
        }
    }
    return NULL;
}

void *uploads_load(struct hub *hub, const char *id, size_t *out_length, struct error *err)
{
    const struct embedded *file = example_files_find(id);
    void *bytes = NULL;

    if (file) {
        *out_length = file->length;
        return memcpy(memory_alloc(file->length, 1), file->bytes, file->length);
    }
    return store_load_asset(hub->store, id, &bytes, out_length, err) ? bytes : NULL;
}

void uploads_send(struct hub *hub, const char *id)
{
    if (uploads_find(hub->uploads, id)) {
        supervisor_send_asset(hub->supervisor, id);
    }
}
