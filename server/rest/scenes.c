/* SPDX-License-Identifier: MIT */
/* Scenes over HTTP: list, create, read, replace, edit, delete. Changes are answered after their
 * commit. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/code_text.h"
#include "protocol/import/import.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "routes.h"
#include "server/embedded.h"
#include "server/live/catalog.h"
#include "server/live/hub_rooms.h"
#include "server/live/poster.h"
#include "server/live/room.h"
#include "server/net/ws.h"

/* A change on its way to the disk. */
struct waiting {
    struct request *request;
    int status;
    char id[LIMIT_ID_BYTES + 1];
    uint64_t revision;
    cJSON *notes; /* of an import; NULL: none */
};

static void add_etag(struct response *response, uint64_t revision)
{
    response_add(response, "ETag", "\"%" PRIu64 "\"", revision);
}

/* On the store's thread, or at once where nothing had to be stored. */
static void answer_change(void *data)
{
    struct waiting *waiting = data;
    struct response response = {.status = waiting->status, .body = "", .borrowed = true};

    if (waiting->status != 204) {
        cJSON *json = cJSON_CreateObject();

        cJSON_AddStringToObject(json, "id", waiting->id);
        cJSON_AddNumberToObject(json, "revision", (double)waiting->revision);
        if (waiting->notes) {
            cJSON_AddItemToObject(json, "notes", waiting->notes);
        }
        response = response_json(waiting->status, json);
        add_etag(&response, waiting->revision);
    }
    if (waiting->status == 201) {
        response_add(&response, "Location", "/v1/scenes/%s", waiting->id);
    }
    request_reply(waiting->request, &response);
    free(waiting);
}

static struct waiting *wait_for(struct request *request, int status, const char *id)
{
    struct waiting *waiting = memory_alloc(1, sizeof *waiting);

    waiting->request = request;
    waiting->status = status;
    snprintf(waiting->id, sizeof waiting->id, "%s", id);
    return waiting;
}

/* --- list, read --- */

static void time_text(int64_t ms, char out[40])
{
    time_t seconds = (time_t)(ms / 1000);
    struct tm parts;
    char date[32];

    gmtime_r(&seconds, &parts);
    strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &parts);
    snprintf(out, 40, "%s.%03dZ", date, (int)(ms % 1000));
}

struct listed {
    struct catalog_entry entry; /* a copy, with a name of its own */
    size_t viewers;
};

static int compare_ids(const void *id, const void *listed)
{
    return strcmp(id, ((const struct listed *)listed)->entry.id);
}

/* Whatever the number of scenes, others wait for a copy of the list alone. */
static struct listed *copy_list(struct hub *hub, size_t *out_count)
{
    hub_lock(hub);
    const struct catalog *catalog = hub->catalog;
    struct listed *list = memory_alloc(catalog->count + 1, sizeof *list);

    for (size_t i = 0; i < catalog->count; i++) {
        list[i].entry = *catalog->entries[i];
        list[i].entry.name = memory_text(catalog->entries[i]->name);
    }
    *out_count = catalog->count;
    for (const struct room *room = hub->rooms; room; room = room->next) {
        struct listed *found = room->session_count > 0
                                   ? bsearch(room->id, list, *out_count, sizeof *list, compare_ids)
                                   : NULL;
        if (found) {
            found->viewers = room->session_count;
        }
    }
    hub_unlock(hub);
    return list;
}

static cJSON *describe(const struct listed *listed)
{
    const struct catalog_entry *entry = &listed->entry;
    cJSON *item = cJSON_CreateObject();
    char modified[40];

    time_text(entry->modified_ms, modified);
    cJSON_AddStringToObject(item, "id", entry->id);
    cJSON_AddStringToObject(item, "name", entry->name);
    cJSON_AddNumberToObject(item, "revision", (double)entry->revision);
    cJSON_AddNumberToObject(item, "nodes", (double)entry->nodes);
    cJSON_AddStringToObject(item, "modified", modified);
    cJSON_AddNumberToObject(item, "viewers", (double)listed->viewers);
    return item;
}

void scenes_list(struct request *request)
{
    cJSON *json = cJSON_CreateObject();
    cJSON *scenes = cJSON_AddArrayToObject(json, "scenes");
    size_t count;
    struct listed *list = copy_list(request->hub, &count);

    for (size_t i = 0; i < count; i++) {
        cJSON_AddItemToArray(scenes, describe(&list[i]));
        free(list[i].entry.name);
    }
    free(list);
    request_reply_json(request, 200, json);
}

static void tag_of(const struct room *room, char out[32])
{
    snprintf(out, 32, "\"%" PRIu64 "\"", room->revision);
}

void scenes_read(struct request *request)
{
    struct error err = {0};
    struct room *room = hub_lock_room(request->hub, request->capture[0], &err);
    char tag[32];

    if (!room) {
        request_reply_error(request, &err);
        return;
    }
    tag_of(room, tag);
    struct response response = {.status = 304, .body = "", .borrowed = true};
    if (!request_knows_tag(request, tag)) {
        struct shared_buffer *text = room_text(room);

        response = (struct response){.status = 200, .type = "application/json", .shared = text};
        response.length = text->length - 1;
        response_add(&response, "Fieldcast-Revision", "%" PRIu64, room->revision);
    }
    hub_unlock(request->hub);
    response_add(&response, "ETag", "%s", tag);
    request_reply(request, &response);
}

/* The last picture that somebody has seen of it, whatever the camera. */
void scenes_poster(struct request *request)
{
    struct hub *hub = request->hub;
    struct shared_buffer *poster = poster_find(hub, request->capture[0]);
    struct response response = {.status = 204, .body = "", .borrowed = true};
    struct error err = {0};

    if (!poster && !hub_has_scene(hub, request->capture[0])) {
        error_set(&err, ERROR_NOT_FOUND, "", "there is no scene %s", request->capture[0]);
        request_reply_error(request, &err);
        return;
    }
    if (!poster) {
        request_reply(request, &response);
        return;
    }
    response = (struct response){
        .status = 200, .type = "image/jpeg", .shared = poster, .length = poster->length};
    response_add(&response, "Cache-Control", "no-cache");
    request_reply(request, &response);
}

/* --- change --- */

static bool check_match(const struct request *request, const struct room *room, struct error *err)
{
    char tag[32];

    tag_of(room, tag);
    return request_check_match(request, tag, err);
}

/* Takes `scene` and `notes`. `poster`: what it looks like; NULL: that is not known. */
static void create(struct request *request, const char *id, struct scene *scene, cJSON *notes,
                   struct shared_buffer *poster)
{
    struct error err = {0};
    struct waiting *waiting = wait_for(request, 201, id);
    struct room *room = NULL;

    waiting->notes = notes;
    if (hub_accepts_scene(request->hub, scene, &err)) {
        room = hub_lock_new_room(request->hub, id, scene, scene_print(scene, false), answer_change,
                                 waiting, &err);
    } else {
        scene_destroy(scene);
    }
    if (!room) {
        cJSON_Delete(notes);
        free(waiting);
        request_reply_error(request, &err);
        return;
    }
    /* The commit's answer cannot overtake this: it waits for the lock first. */
    snprintf(waiting->id, sizeof waiting->id, "%s", room->id);
    waiting->revision = room->revision;
    if (poster) {
        poster_set(room, poster);
        poster_store(room);
    }
    hub_unlock(request->hub);
}

static struct scene *copy_of_example(const char *id, struct error *err)
{
    const struct embedded *example = examples_find(id);

    if (!example) {
        error_set(err, ERROR_NOT_FOUND, "/from", "there is no example %s", id);
        return NULL;
    }
    return scene_parse((const char *)example->bytes, example->length, err);
}

static struct scene *copy_of_scene(struct hub *hub, const char *id, struct error *err)
{
    struct room *room = hub_lock_room(hub, id, err);

    if (!room) {
        return NULL;
    }
    room_hold(room);
    hub_unlock(hub);
    struct scene *scene = scene_copy(room->scene);
    hub_lock(hub);
    room_release(room);
    hub_unlock(hub);
    return scene;
}

static struct scene *scene_from(struct hub *hub, const cJSON *json, struct error *err)
{
    const cJSON *from = cJSON_GetObjectItemCaseSensitive(json, "from");

    if (!from) {
        return scene_read(json, err);
    }
    const char *text = cJSON_IsString(from) ? from->valuestring : "";
    if (from->next || json->child != from) {
        error_set(err, ERROR_INVALID, "/from", "stands alone: nothing may be beside it");
    } else if (strncmp(text, "example:", 8) == 0) {
        return copy_of_example(text + 8, err);
    } else if (strncmp(text, "scene:", 6) == 0) {
        return copy_of_scene(hub, text + 6, err);
    } else {
        error_set(err, ERROR_INVALID, "/from", "is \"example:ID\" or \"scene:ID\"");
    }
    return NULL;
}

/* Whether a large scene is copied: that takes as long as printing it, or reading it. */
static bool copies_much(struct hub *hub, const cJSON *json)
{
    const char *from = json_member_text(json, "from", "");

    return strncmp(from, "scene:", 6) == 0 && hub_scene_is_heavy(hub, from + 6);
}

/* Of what a new scene is made. */
static struct shared_buffer *poster_from(struct hub *hub, const cJSON *json)
{
    const char *from = json_member_text(json, "from", "");
    const struct embedded *card = strncmp(from, "example:", 8) == 0 ? cards_find(from + 8) : NULL;

    return card                              ? shared_buffer_create(card->bytes, card->length)
           : strncmp(from, "scene:", 6) == 0 ? poster_find(hub, from + 6)
                                             : NULL;
}

void scenes_create(struct request *request)
{
    static const char *const queries[] = {"id", NULL};
    struct error err = {0};
    const char *id = request_query(request, "id");
    cJSON *json = NULL;
    struct scene *scene = NULL;
    struct shared_buffer *poster = NULL;

    if (request_check_query(request, queries, &err)) {
        json = json_parse(request->body ? request->body : "", request->body_length, &err);
        if (json && copies_much(request->hub, json) && request_becomes_heavy(request)) {
            cJSON_Delete(json);
            return;
        }
        scene = json ? scene_from(request->hub, json, &err) : NULL;
        poster = scene ? poster_from(request->hub, json) : NULL;
    }
    cJSON_Delete(json);
    if (!scene) {
        request_reply_error(request, &err);
        return;
    }
    create(request, id ? id : "", scene, NULL, poster);
    if (poster) {
        shared_buffer_unref(poster);
    }
}

/* {"files": {path: text}, "name", "scene"}; `source` points into the JSON. */
static bool read_import(const cJSON *json, struct import_source *source, struct import_file *files,
                        struct error *err)
{
    const cJSON *member, *file;

    if (!cJSON_IsObject(json)) {
        return error_set(err, ERROR_SYNTAX, "", "the body must be an object");
    }
    cJSON_ArrayForEach(member, json)
    {
        char place[80];

        snprintf(place, sizeof place, "/%.64s", member->string);
        if (strcmp(member->string, "files") == 0 && cJSON_IsObject(member)) {
            cJSON_ArrayForEach(file, member)
            {
                if (!cJSON_IsString(file)) {
                    return error_set(err, ERROR_INVALID, place, "must be texts by their paths");
                }
                files[source->count++] = (struct import_file){file->string, file->valuestring,
                                                              strlen(file->valuestring)};
            }
        } else if (strcmp(member->string, "name") == 0 && cJSON_IsString(member)) {
            source->title = member->valuestring;
        } else if (strcmp(member->string, "scene") == 0 && cJSON_IsString(member)) {
            source->scene = member->valuestring;
        } else {
            return error_set(err, ERROR_INVALID, place,
                             "expected files (an object), name and scene (texts)");
        }
    }
    return cJSON_HasObjectItem(json, "files") ||
           error_set(err, ERROR_INVALID, "/files", "is missing");
}

void scenes_import(struct request *request)
{
    static const char *const queries[] = {"id", NULL};
    struct error err = {0};
    const char *id = request_query(request, "id");
    cJSON *json = NULL, *notes = NULL;
    struct scene *scene = NULL;

    if (request_check_query(request, queries, &err)) {
        json = json_parse(request->body ? request->body : "", request->body_length, &err);
    }
    if (json) {
        const cJSON *list = cJSON_GetObjectItemCaseSensitive(json, "files");
        struct import_file *files = memory_alloc((size_t)cJSON_GetArraySize(list), sizeof *files);
        struct import_source source = {.files = files};

        if (read_import(json, &source, files, &err)) {
            scene = import_scene(&source, &notes, &err);
        }
        free(files);
    }
    cJSON_Delete(json);
    if (!scene) {
        request_reply_error(request, &err);
        return;
    }
    if (!notes->child) {
        cJSON_Delete(notes);
        notes = NULL;
    }
    create(request, id ? id : "", scene, notes, NULL);
}

static void forget_texts(const struct room_document *document)
{
    free(document->text);
    shared_buffer_unref(document->kept);
}

void scenes_replace(struct request *request)
{
    struct error err = {0};
    struct hub *hub = request->hub;
    const char *id = request->capture[0];
    struct scene *scene =
        scene_parse(request->body ? request->body : "", request->body_length, &err);

    if (!scene || !hub_accepts_scene(hub, scene, &err)) {
        scene_destroy(scene);
        request_reply_error(request, &err);
        return;
    }
    char *text = scene_print(scene, false);
    const struct room_document document = {scene, text, room_text_to_keep(scene, text),
                                           code_text_in_scene(scene)};
    struct room *room = hub_lock_room_to_change(hub, id, &err);
    if (!room && err.kind == ERROR_NOT_FOUND && !request_header(request, "If-Match")) {
        forget_texts(&document);
        create(request, id, scene, NULL, NULL);
        return;
    }
    if (!room || !check_match(request, room, &err) || !room_check_bytes(strlen(text), &err)) {
        if (room) {
            hub_unlock(hub);
        }
        scene_destroy(scene);
        forget_texts(&document);
        if (err.kind == ERROR_NOT_FOUND) {
            err.kind = ERROR_PRECONDITION; /* If-Match, and there is nothing that could match */
        }
        request_reply_error(request, &err);
        return;
    }
    struct waiting *waiting = wait_for(request, 200, id);
    waiting->revision = room->revision + 1;
    struct scene *before = room_replace(
        room, &document,
        &(struct room_change){.author = "rest", .then = answer_change, .data = waiting});
    hub_unlock(hub);
    scene_destroy(before);
}

void scenes_edit(struct request *request)
{
    struct error err = {0};
    cJSON *ops = json_parse(request->body ? request->body : "", request->body_length, &err);
    const bool plain = ops && !code_text_find(ops, NULL);
    struct room *room = ops && edit_check(ops, &err)
                            ? hub_lock_room_to_change(request->hub, request->capture[0], &err)
                            : NULL;
    struct waiting *waiting = wait_for(request, 200, request->capture[0]);
    bool applied = false;

    if (room) {
        const struct room_change change = {
            .author = "rest", .then = answer_change, .data = waiting, .plain = plain};

        applied = check_match(request, room, &err) &&
                  room_edit(room, &change, ops, &waiting->revision, &err) == ROOM_APPLIED;
        hub_unlock(request->hub);
    }
    cJSON_Delete(ops);
    if (!applied) {
        free(waiting);
        request_reply_error(request, &err);
    }
}

void scenes_delete(struct request *request)
{
    struct error err = {0};
    struct room *room = hub_lock_room_to_change(request->hub, request->capture[0], &err);

    if (!room) {
        request_reply_error(request, &err);
        return;
    }
    const bool ok = check_match(request, room, &err);
    if (ok) {
        hub_delete_room(request->hub, room, answer_change,
                        wait_for(request, 204, request->capture[0]));
    }
    hub_unlock(request->hub);
    if (!ok) {
        request_reply_error(request, &err);
    }
}

/* Reached only by what the acceptor did not take for a good WebSocket handshake. */
void scenes_live(struct request *request)
{
    struct hub *hub = request->hub;
    struct response response;

    if (!hub_has_scene(hub, request->capture[0])) {
        response = response_problem(404, "not_found", "", "there is no such scene");
    } else if (ws_count(hub->ws) >= LIMIT_SESSIONS) {
        metric_add(&hub->metrics, METRIC_SESSIONS_OVER_LIMIT, 1);
        response = response_problem(503, "unavailable", "", "too many live connections are open");
    } else {
        response = response_problem(
            426, "invalid", "Upgrade",
            "this address speaks WebSocket, version 13, subprotocol " WS_SUBPROTOCOL
            ", on a connection of its own");
        response_add(&response, "Upgrade", "websocket");
        response_add(&response, "Sec-WebSocket-Version", "13");
    }
    response_add(&response, "Connection", "close");
    request_reply(request, &response);
}
