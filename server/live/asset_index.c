/* SPDX-License-Identifier: MIT */
#include "asset_index.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "protocol/memory.h"
#include "server/embedded.h"
#include "server/net/shared_buffer.h"

void asset_index_add(void *data, const struct store_asset *asset)
{
    struct asset_index *assets = data;
    struct asset_entry *entry;

    if (asset_index_find(assets, asset->id)) {
        return;
    }
    assets->items = memory_one_more(assets->items, assets->count, sizeof *assets->items);
    entry = &assets->items[assets->count++];
    assets->bytes += example_files_find(asset->id) ? 0 : asset->length;
    *entry = (struct asset_entry){
        .width = asset->info.width, .height = asset->info.height, .length = asset->length};
    snprintf(entry->id, sizeof entry->id, "%s", asset->id);
    snprintf(entry->type, sizeof entry->type, "%s", asset->info.type);
}

void asset_index_add_embedded(struct asset_index *assets)
{
    for (size_t i = 0; i < example_files_count; i++) {
        const struct embedded *file = &example_files_table[i];
        struct store_asset asset = {.length = file->length};

        snprintf(asset.id, sizeof asset.id, "%s", file->path);
        if (asset_inspect(file->bytes, file->length, &asset.info, NULL)) {
            asset_index_add(assets, &asset);
        }
    }
}

void asset_index_remove(struct asset_index *assets, const char *id)
{
    for (size_t i = 0; i < assets->count; i++) {
        if (strcmp(assets->items[i].id, id) == 0) {
            assets->bytes -= assets->items[i].length;
            assets->count--;
            memmove(assets->items + i, assets->items + i + 1,
                    (assets->count - i) * sizeof *assets->items);
            return;
        }
    }
}

bool asset_index_have_room(const struct asset_index *assets, size_t length)
{
    return assets->count + assets->pending_count < LIMIT_ASSETS &&
           assets->bytes + assets->pending_bytes + length <= LIMIT_ASSETS_BYTES;
}

void asset_index_finish(struct asset_index *assets)
{
    for (size_t i = 0; i < assets->loaded_count; i++) {
        shared_buffer_unref(assets->loaded[i].bytes);
    }
    free(assets->loaded);
    free(assets->items);
}

const struct asset_entry *asset_index_find(const struct asset_index *assets, const char *id)
{
    for (size_t i = 0; i < assets->count; i++) {
        if (strcmp(assets->items[i].id, id) == 0) {
            return &assets->items[i];
        }
    }
    return NULL;
}

void *asset_index_load(struct hub *hub, const char *id, size_t *out_length, struct error *err)
{
    const struct embedded *file = example_files_find(id);
    void *bytes = NULL;

    if (file) {
        *out_length = file->length;
        return memcpy(memory_alloc(file->length, 1), file->bytes, file->length);
    }
    return store_load_asset(hub->store, id, &bytes, out_length, err) ? bytes : NULL;
}

/* Under the lock, with a reference; NULL: it is not in memory. */
static struct shared_buffer *find_loaded(const struct asset_index *assets, const char *id)
{
    for (size_t i = 0; i < assets->loaded_count && asset_index_find(assets, id); i++) {
        if (strcmp(assets->loaded[i].id, id) == 0) {
            return shared_buffer_ref(assets->loaded[i].bytes);
        }
    }
    return NULL;
}

static void keep_loaded(struct asset_index *assets, const char *id, struct shared_buffer *bytes)
{
    assets->loaded = memory_one_more(assets->loaded, assets->loaded_count, sizeof *assets->loaded);
    struct asset_loaded *loaded = &assets->loaded[assets->loaded_count++];
    snprintf(loaded->id, sizeof loaded->id, "%s", id);
    loaded->bytes = shared_buffer_ref(bytes);
}

struct shared_buffer *asset_index_share(struct hub *hub, const char *id, struct error *err)
{
    size_t length;

    hub_lock(hub);
    struct shared_buffer *shared = find_loaded(hub->assets, id);
    hub_unlock(hub);
    void *bytes = shared ? NULL : asset_index_load(hub, id, &length, err);
    if (!bytes) {
        return shared;
    }
    hub_lock(hub);
    shared = find_loaded(hub->assets, id);
    if (shared) { /* somebody else was as fast */
        free(bytes);
    } else {
        shared = shared_buffer_take(bytes, length);
        keep_loaded(hub->assets, id, shared);
        supervisor_wake(hub->supervisor); /* asset_index_forget is called by its timer */
    }
    hub_unlock(hub);
    return shared;
}

bool asset_index_forget(struct asset_index *assets)
{
    size_t kept = 0;

    for (size_t i = 0; i < assets->loaded_count; i++) {
        if (assets->loaded[i].bytes->references == 1) {
            shared_buffer_unref(assets->loaded[i].bytes);
        } else {
            assets->loaded[kept++] = assets->loaded[i];
        }
    }
    assets->loaded_count = kept;
    return kept > 0;
}

void asset_index_send(struct hub *hub, const char *id)
{
    if (asset_index_find(hub->assets, id)) {
        supervisor_send_asset(hub->supervisor, id);
    }
}
