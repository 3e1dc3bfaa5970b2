/* SPDX-License-Identifier: MIT */
/* Files that scenes name by their SHA-256, over HTTP: sent, listed, read. */
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "routes.h"
#include "server/digest.h"
#include "server/embedded.h"
#include "server/live/asset_index.h"
#include "server/live/asset_uses.h"
#include "server/live/hub_rooms.h"
#include "server/live/room.h"
#include "server/live/room_sync.h"
#include "server/live/session.h"
#include "server/live/stream.h"
#include "server/net/shared_buffer.h"

/* A file on its way to the disk. */
struct waiting {
    struct request *request;
    struct hub *hub;
    struct store_asset asset; /* without its bytes, which the store may have freed */
};

static cJSON *describe(const struct asset_entry *entry)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "id", entry->id);
    cJSON_AddStringToObject(json, "type", entry->type);
    cJSON_AddNumberToObject(json, "width", entry->width);
    cJSON_AddNumberToObject(json, "height", entry->height);
    cJSON_AddNumberToObject(json, "bytes", (double)entry->length);
    return json;
}

void assets_list(struct request *request)
{
    struct hub *hub = request->hub;
    cJSON *json = cJSON_CreateObject();
    cJSON *list = cJSON_AddArrayToObject(json, "assets");

    hub_lock(hub);
    for (size_t i = 0; i < hub->assets->count; i++) {
        cJSON_AddItemToArray(list, describe(&hub->assets->items[i]));
    }
    hub_unlock(hub);
    request_reply_json(request, 200, json);
}

/* Under the hub's lock: scenes that named the file before it was there get to show it. */
static void tell_rooms(struct hub *hub, const char *id)
{
    for (struct room *room = hub->rooms; room; room = room->next) {
        if (!room_sync_upload(room, id)) {
            continue;
        }
        for (struct session *session = room->sessions; session; session = session->next) {
            stream_changed(session);
        }
    }
}

static void reply(struct request *request, int status, cJSON *json, const char *id)
{
    struct response response = response_json(status, json);

    response_add(&response, "Location", "/v1/assets/%s", id);
    request_reply(request, &response);
}

/* On the store's thread. */
static void on_stored(void *data)
{
    struct waiting *waiting = data;
    struct hub *hub = waiting->hub;
    cJSON *json;

    hub_lock(hub);
    hub->assets->pending_count--;
    hub->assets->pending_bytes -= waiting->asset.length;
    asset_index_add(hub->assets, &waiting->asset);
    tell_rooms(hub, waiting->asset.id);
    json = describe(asset_index_find(hub->assets, waiting->asset.id));
    hub_unlock(hub);
    reply(waiting->request, 201, json, waiting->asset.id);
    free(waiting);
}

/* Takes `asset`. */
static void store_asset(struct request *request, struct store_asset *asset)
{
    struct waiting *waiting = memory_alloc(1, sizeof *waiting);
    struct store_write *write = memory_alloc(1, sizeof *write);

    hub_lock(request->hub);
    request->hub->assets->pending_count++;
    request->hub->assets->pending_bytes += asset->length;
    hub_unlock(request->hub);
    *waiting = (struct waiting){request, request->hub, *asset};
    *write = (struct store_write){
        .kind = STORE_ASSET, .asset = asset, .on_durable = on_stored, .data = waiting};
    store_push(request->hub->store, write);
}

/* Under the hub's lock; `on_durable` may be NULL. */
static void remove_asset(struct hub *hub, const char *id, void (*on_durable)(void *data),
                         void *data)
{
    struct store_write *write = memory_alloc(1, sizeof *write);

    *write = (struct store_write){.kind = STORE_ASSET_DELETE,
                                  .asset = memory_alloc(1, sizeof *write->asset),
                                  .on_durable = on_durable,
                                  .data = data};
    snprintf(write->asset->id, sizeof write->asset->id, "%s", id);
    asset_index_remove(hub->assets, id);
    store_push(hub->store, write);
}

/* Under the hub's lock: removes what no scene names, oldest first, until there is room. */
static void remove_unnamed(struct hub *hub, const struct asset_uses *names, size_t length)
{
    for (size_t i = 0; i < names->count && !asset_index_have_room(hub->assets, length); i++) {
        const char *id = names->items[i].id;

        if (!asset_uses_scene(names, id) && !example_files_find(id) &&
            asset_index_find(hub->assets, id)) {
            remove_asset(hub, id, NULL, NULL);
        }
    }
}

/* False and `err`: all that is kept is named by scenes. */
static bool make_room(struct hub *hub, size_t length, struct error *err)
{
    struct asset_uses names;

    hub_lock(hub);
    bool room = asset_index_have_room(hub->assets, length);
    hub_unlock(hub);
    if (room) {
        return true;
    }
    if (!asset_uses_read(hub, &names, err)) {
        return false;
    }
    hub_lock(hub);
    asset_uses_add_open(&names, hub);
    remove_unnamed(hub, &names, length);
    room = asset_index_have_room(hub->assets, length) ||
           error_set(err, ERROR_FULL, "/v1/assets",
                     "%zu files of %zu bytes, all named by scenes, are kept; the limits are %d "
                     "files and %d bytes",
                     hub->assets->count, hub->assets->bytes, LIMIT_ASSETS, LIMIT_ASSETS_BYTES);
    hub_unlock(hub);
    asset_uses_finish(&names);
    return room;
}

void assets_create(struct request *request)
{
    static const char *const queries[] = {NULL};
    struct hub *hub = request->hub;
    struct store_asset *asset = memory_alloc(1, sizeof *asset);
    struct error err = {0};
    cJSON *known = NULL;

    if (request_check_query(request, queries, &err) &&
        asset_inspect((const uint8_t *)request->body, request->body_length, &asset->info, &err)) {
        digest_text(request->body, request->body_length, asset->id);
        hub_lock(hub);
        const struct asset_entry *entry = asset_index_find(hub->assets, asset->id);
        known = entry ? describe(entry) : NULL;
        hub_unlock(hub);
    }
    if (known) {
        reply(request, 200, known, asset->id);
    } else if (err.kind != ERROR_NONE || !make_room(hub, request->body_length, &err)) {
        request_reply_error(request, &err);
    } else {
        asset->bytes = request->body;
        asset->length = request->body_length;
        request->body = NULL;
        store_asset(request, asset);
        return;
    }
    free(asset);
}

/* What a file is named by never changes. Only clients keep it: a cache that several share does not
 * ask them for the token. */
void assets_read(struct request *request)
{
    struct hub *hub = request->hub;
    const struct embedded *file = example_files_find(request->capture[0]);
    struct response response = {.status = 200};
    struct error err = {0};
    char type[sizeof hub->assets->items->type] = "";

    hub_lock(hub);
    const struct asset_entry *entry = asset_index_find(hub->assets, request->capture[0]);
    if (entry) {
        memcpy(type, entry->type, sizeof type);
    }
    hub_unlock(hub);
    if (file) {
        response = (struct response){
            .status = 200, .body = (void *)file->bytes, .length = file->length, .borrowed = true};
    } else {
        response.shared = asset_index_share(hub, request->capture[0], &err);
        response.length = response.shared ? response.shared->length : 0;
    }
    if (err.kind != ERROR_NONE) {
        request_reply_error(request, &err);
        return;
    }
    response.type = type;
    response_add(&response, "Cache-Control", "private, max-age=31536000, immutable");
    request_reply(request, &response);
}

static void on_removed(void *data)
{
    struct response response = {.status = 204, .body = "", .borrowed = true};

    request_reply(data, &response);
}

/* Under the hub's lock. Whether the file may go; `names` is NULL where nothing was read yet. */
static bool check_removal(struct hub *hub, const char *id, const struct asset_uses *names,
                          struct error *err)
{
    const char *scene = names ? asset_uses_scene(names, id) : NULL;

    if (!asset_index_find(hub->assets, id)) {
        return error_set(err, ERROR_NOT_FOUND, "", "there is no asset %s", id);
    }
    if (example_files_find(id)) {
        return error_set(err, ERROR_CONFLICT, "", "examples name this file");
    }
    return !scene || error_set(err, ERROR_CONFLICT, "", "the scene %s names this file", scene);
}

void assets_delete(struct request *request)
{
    struct hub *hub = request->hub;
    const char *id = request->capture[0];
    struct asset_uses names = {0};
    struct error err = {0};

    hub_lock(hub);
    const bool ok = check_removal(hub, id, NULL, &err);
    hub_unlock(hub);
    if (ok && asset_uses_read(hub, &names, &err)) {
        hub_lock(hub);
        asset_uses_add_open(&names, hub);
        if (check_removal(hub, id, &names, &err)) {
            remove_asset(hub, id, on_removed, request);
        }
        hub_unlock(hub);
        asset_uses_finish(&names);
    }
    if (err.kind != ERROR_NONE) {
        request_reply_error(request, &err);
    }
}
