/* SPDX-License-Identifier: MIT */
/* The library over HTTP: list, read, put, delete; all of it as a file, and a file into it. Changes
 * are answered after their commit. */
#include "server/live/library.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "routes.h"
#include "server/live/hub.h"

/* An answer on its way to the disk. */
struct waiting {
    struct request *request;
    struct response response;
};

/* On the store's thread. */
static void answer(void *data)
{
    struct waiting *waiting = data;

    request_reply(waiting->request, &waiting->response);
    free(waiting);
}

static struct waiting *wait_for(struct request *request, const struct response *response)
{
    struct waiting *waiting = memory_alloc(1, sizeof *waiting);

    *waiting = (struct waiting){request, *response};
    return waiting;
}

static const struct library_item *find(const struct request *request, struct error *err)
{
    const char *id = request->capture[0];
    const struct library_item *item = library_find(request->hub->library, id);

    if (!item) {
        error_set(err, ERROR_NOT_FOUND, "", "the library has no entry %s", id);
    }
    return item;
}

/* --- list, read --- */

static cJSON *describe(const struct library_item *item)
{
    cJSON *json = cJSON_CreateObject();
    const time_t seconds = (time_t)(item->modified_ms / 1000);
    struct tm parts;
    char date[32];

    gmtime_r(&seconds, &parts);
    strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &parts);
    cJSON_AddStringToObject(json, "id", item->id);
    cJSON_AddStringToObject(json, "kind", library_kind_name(item->kind));
    cJSON_AddStringToObject(json, "name", item->name);
    cJSON_AddNumberToObject(json, "nodes", (double)item->nodes);
    cJSON_AddStringToObject(json, "modified", date);
    return json;
}

void library_list(struct request *request)
{
    struct hub *hub = request->hub;
    cJSON *json = cJSON_CreateObject();
    cJSON *list = cJSON_AddArrayToObject(json, "entries");

    hub_lock(hub);
    for (size_t i = 0; i < hub->library->count; i++) {
        cJSON_AddItemToArray(list, describe(&hub->library->items[i]));
    }
    hub_unlock(hub);
    request_reply_json(request, 200, json);
}

void library_read(struct request *request)
{
    struct response response = {.status = 304, .body = "", .borrowed = true};
    struct error err = {0};

    hub_lock(request->hub);
    const struct library_item *item = find(request, &err);
    if (item) {
        if (!request_knows_tag(request, item->tag)) {
            response = (struct response){.status = 200, .type = "application/json"};
            response.body = library_print_item(item, &response.length);
        }
        response_add(&response, "ETag", "%s", item->tag);
    }
    hub_unlock(request->hub);
    if (item) {
        request_reply(request, &response);
    } else {
        request_reply_error(request, &err);
    }
}

void library_export(struct request *request)
{
    struct response response = {.status = 200, .type = "application/json"};

    hub_lock(request->hub);
    response.body = library_print_file(request->hub->library, &response.length);
    hub_unlock(request->hub);
    response_add(&response, "Content-Disposition", "attachment; filename=\"library.json\"");
    request_reply(request, &response);
}

/* --- change --- */

static bool check_id(const char *id, const char *place, struct error *err)
{
    return hub_id_is_valid(id) || error_set(err, ERROR_INVALID, place,
                                            "an id has 1 to %d of a-z, 0-9 and -", LIMIT_ID_BYTES);
}

/* The entry of a body, for the id in the path. */
static bool read_entry(const struct request *request, const cJSON *json, struct library_entry *out,
                       struct error *err)
{
    const char *id = request->capture[0];

    if (!check_id(id, "", err) || !library_entry_read(json, "", out, err)) {
        return false;
    }
    const bool ok =
        (!out->id || strcmp(out->id, id) == 0 ||
         error_set(err, ERROR_INVALID, "/id", "\"%.64s\" is not the id in the path", out->id)) &&
        hub_accepts_scene(request->hub, out->scene, err);

    if (!ok) {
        library_entry_finish(out);
    }
    return ok;
}

/* Under the lock. */
static bool put(struct request *request, const struct library_entry *entry, struct error *err)
{
    struct library *library = request->hub->library;
    const char *id = request->capture[0];
    const struct library_item *old = library_find(library, id);
    const size_t freed = old ? strlen(old->text) : 0, length = strlen(entry->text);
    struct response response;

    if (!request_check_match(request, old ? old->tag : NULL, err) ||
        !library_has_room(library, !old, length > freed ? length - freed : 0, err)) {
        return false;
    }
    struct store_write *write = library_set(library, id, entry);
    const struct library_item *item = library_find(library, id);
    response = response_json(old ? 200 : 201, describe(item));
    response_add(&response, "ETag", "%s", item->tag);
    response_add(&response, "Location", "/v1/library/%s", id);
    write->on_durable = answer;
    write->data = wait_for(request, &response);
    store_push(request->hub->store, write);
    return true;
}

void library_put(struct request *request)
{
    struct error err = {0};
    struct library_entry entry = {0};
    cJSON *json = json_parse(request->body ? request->body : "", request->body_length, &err);
    bool ok = json && read_entry(request, json, &entry, &err);

    if (ok) {
        hub_lock(request->hub);
        ok = put(request, &entry, &err);
        hub_unlock(request->hub);
        library_entry_finish(&entry);
    }
    if (!ok) {
        request_reply_error(request, &err);
    }
    cJSON_Delete(json);
}

void library_delete(struct request *request)
{
    const struct response response = {.status = 204, .body = "", .borrowed = true};
    struct hub *hub = request->hub;
    struct error err = {0};

    hub_lock(hub);
    const struct library_item *item = find(request, &err);
    const bool ok = item && request_check_match(request, item->tag, &err);
    if (ok) {
        struct store_write *write = library_remove(hub->library, request->capture[0]);

        write->on_durable = answer;
        write->data = wait_for(request, &response);
        store_push(hub->store, write);
    }
    hub_unlock(hub);
    if (!ok) {
        request_reply_error(request, &err);
    }
}

/* --- a file into it --- */

struct file {
    struct library_entry *entries;
    size_t count;
};

static bool check_entries(const struct request *request, const struct file *file, struct error *err)
{
    for (size_t i = 0; i < file->count; i++) {
        const struct library_entry *entry = &file->entries[i];
        char place[48];

        snprintf(place, sizeof place, "/entries/%zu/id", i);
        if ((entry->id && !check_id(entry->id, place, err)) ||
            !hub_accepts_scene(request->hub, entry->scene, err)) {
            return false;
        }
    }
    return true;
}

/* What is there already under its own id. */
static const struct library_item *known(const struct library *library,
                                        const struct library_entry *entry)
{
    const struct library_item *item = entry->id ? library_find(library, entry->id) : NULL;

    return item && library_is_same(item, entry) ? item : NULL;
}

static bool check_room(const struct library *library, const struct file *file, struct error *err)
{
    size_t count = 0, bytes = 0;

    for (size_t i = 0; i < file->count; i++) {
        if (!known(library, &file->entries[i])) {
            count++;
            bytes += strlen(file->entries[i].text);
        }
    }
    return library_has_room(library, count, bytes, err);
}

/* Under the lock. Adds one where it is new, and says under which id it is there. */
static struct store_write *take(struct library *library, const struct library_entry *entry,
                                cJSON *list)
{
    const struct library_item *item = known(library, entry);
    struct store_write *write = NULL;
    char id[LIMIT_ID_BYTES + 1];

    if (!item) {
        if (entry->id && !library_find(library, entry->id)) {
            snprintf(id, sizeof id, "%s", entry->id);
        } else {
            library_free_id(library, entry, id);
        }
        write = library_set(library, id, entry);
        item = library_find(library, id);
    }
    cJSON *json = describe(item);
    cJSON_AddBoolToObject(json, "added", write != NULL);
    cJSON_AddItemToArray(list, json);
    return write;
}

static bool add(struct request *request, const struct file *file, struct error *err)
{
    struct library *library = request->hub->library;
    struct store_write *first = NULL, **end = &first, *last = NULL;

    if (!check_room(library, file, err)) {
        return false;
    }
    cJSON *json = cJSON_CreateObject();
    cJSON *list = cJSON_AddArrayToObject(json, "entries");
    for (size_t i = 0; i < file->count; i++) {
        struct store_write *write = take(library, &file->entries[i], list);

        if (write) {
            *end = last = write;
            end = &write->next;
        }
    }
    const struct response response = response_json(last ? 201 : 200, json);
    if (last) {
        last->on_durable = answer;
        last->data = wait_for(request, &response);
        store_push_all(request->hub->store, first);
    } else {
        request_reply(request, &response);
    }
    return true;
}

void library_import(struct request *request)
{
    struct error err = {0};
    struct file file = {0};
    cJSON *json = json_parse(request->body ? request->body : "", request->body_length, &err);

    if (json) {
        file.entries = library_entries_read(json, &file.count, &err);
    }
    bool ok = file.entries && check_entries(request, &file, &err);
    if (ok) {
        hub_lock(request->hub);
        ok = add(request, &file, &err);
        hub_unlock(request->hub);
    }
    if (!ok) {
        request_reply_error(request, &err);
    }
    library_entries_destroy(file.entries, file.count);
    cJSON_Delete(json);
}
