/* SPDX-License-Identifier: MIT */
/* Pictures over HTTP: of a scene, of an example, of an entry of the library, of a document sent
 * along. All become the same order to the worker. */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "routes.h"
#include "server/digest.h"
#include "server/embedded.h"
#include "server/live/asset_index.h"
#include "server/live/hub_rooms.h"
#include "server/live/image_cache.h"
#include "server/live/image_queue.h"
#include "server/live/library.h"
#include "server/live/render_queue.h"
#include "server/live/room.h"
#include "server/net/shared_buffer.h"

/* A picture on its way to a client. */
struct waiting {
    struct request *request;
    struct hub *hub;
    uint32_t job;
    int width, height;
    char *key;         /* all that the picture depends on */
    uint64_t revision; /* that was wanted */
};

static void waiting_destroy(struct waiting *waiting)
{
    free(waiting->key);
    free(waiting);
}

/* What is to be drawn: one of `room` and `document` is given. */
struct subject {
    struct room *room;
    char *document;                       /* taken */
    char digest[ASSET_ID_CHARACTERS + 1]; /* of the document */
    const char *image;                    /* file of its environment; NULL: none counts */
    bool portrait; /* of the document only the tree counts (renderer/portrait.h) */
};

/* Whether the file of its environment is there: without it one colour is drawn in its place. */
static bool has_image(const struct hub *hub, const struct subject *subject)
{
    const struct room *room = subject->room;
    const char *image = room ? record_text(&room->scene->environment, "image") : subject->image;

    return image && asset_index_find(hub->assets, image);
}

/* The scene's state and the request, as text. */
static char *make_key(const struct hub *hub, const struct render_request *asked,
                      const struct subject *subject)
{
    const struct room *room = subject->room;
    cJSON *members = render_request_print(asked);
    char *text = json_print(members, false), *key = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&key, &length);

    fprintf(out, "%s %d ", text, has_image(hub, subject));
    if (room) {
        fprintf(out, "%s %s %" PRIu64, room->id, room->epoch, room->revision);
    } else {
        fprintf(out, "%s%s", subject->portrait ? "portrait " : "", subject->digest);
    }
    fclose(out);
    free(text);
    cJSON_Delete(members);
    return key;
}

/* FNV-1a (Fowler, Noll, Vo), 64 bits: only a client compares these, with its own. */
static void make_tag(const struct waiting *waiting, uint64_t revision, char out[48])
{
    uint64_t hash = 0xcbf29ce484222325;

    for (const char *c = waiting->key; *c; c++) {
        hash = (hash ^ (unsigned char)*c) * 0x100000001b3;
    }
    snprintf(out, 48, "\"%" PRIu64 "-%016" PRIx64 "\"", revision, hash);
}

/* Takes a reference. */
static void reply_picture(const struct waiting *waiting, uint64_t revision, enum codec codec,
                          struct shared_buffer *picture)
{
    struct response response = {.status = 200,
                                .type = codec_mime(codec),
                                .length = picture->length,
                                .shared = shared_buffer_ref(picture)};
    char tag[48];

    make_tag(waiting, revision, tag);
    response_add(&response, "ETag", "%s", tag);
    response_add(&response, "Fieldcast-Revision", "%" PRIu64, revision);
    response_add(&response, "Fieldcast-Size", "%dx%d", waiting->width, waiting->height);
    response_add(&response, "Fieldcast-Renderer", "%s", waiting->hub->renderer.name);
    request_reply(waiting->request, &response);
}

static void on_picture(void *data, const struct picture_answer *answer, const struct error *err)
{
    struct waiting *waiting = data;

    if (answer) {
        const uint64_t revision = answer->frame->revision;
        struct shared_buffer *picture = shared_buffer_create(answer->bytes, answer->length);

        if (revision == waiting->revision) {
            image_cache_add(waiting->hub->image_cache, waiting->key, answer->frame->codec, revision,
                            picture);
        }
        reply_picture(waiting, revision, answer->frame->codec, picture);
        shared_buffer_unref(picture);
    } else {
        request_reply_error(waiting->request, err);
    }
    waiting_destroy(waiting);
}

/* Under the hub's lock. */
static void on_gone(void *data)
{
    struct waiting *waiting = data;
    struct error err = {0};

    render_queue_cancel(waiting->hub, waiting->job);
    error_set(&err, ERROR_UNAVAILABLE, "", "the client left");
    request_reply_error(waiting->request, &err);
    waiting_destroy(waiting);
}

/* The client has it, or it was drawn before. */
static bool reply_at_once(const struct waiting *waiting)
{
    const struct cached_image *picture;
    char tag[48];

    make_tag(waiting, waiting->revision, tag);
    if (request_knows_tag(waiting->request, tag)) {
        struct response response = {.status = 304, .body = "", .borrowed = true};

        response_add(&response, "ETag", "%s", tag);
        request_reply(waiting->request, &response);
        return true;
    }
    picture = image_cache_find(waiting->hub->image_cache, waiting->key);
    if (picture) {
        metric_add(&waiting->hub->metrics, METRIC_PICTURES_REUSED, 1);
        reply_picture(waiting, picture->revision, picture->codec, picture->bytes);
    }
    return picture != NULL;
}

/* Under the hub's lock. Takes what is in `asked`, and the document. */
static void order(struct request *request, struct render_request *asked,
                  const struct subject *subject)
{
    struct error err = {0};
    struct waiting *waiting = memory_alloc(1, sizeof *waiting);
    struct render_order order = {.room = subject->room,
                                 .document = subject->document,
                                 .portrait = subject->portrait,
                                 .request = *asked,
                                 .priority = RENDER_IMAGE,
                                 .account = request->client,
                                 .again = true,
                                 .on_done = on_picture,
                                 .data = waiting};

    snprintf(order.image, sizeof order.image, "%s", subject->image ? subject->image : "");
    *asked = (struct render_request){0};
    waiting->request = request;
    waiting->hub = request->hub;
    render_request_size(&order.request, &waiting->width, &waiting->height);
    waiting->revision = subject->room ? subject->room->revision : 1;
    waiting->key = make_key(request->hub, &order.request, subject);
    if (reply_at_once(waiting)) {
        render_request_finish(&order.request);
        free(order.document);
        waiting_destroy(waiting);
        return;
    }
    waiting->job = render_queue_submit(request->hub, &order, &err);
    if (!waiting->job) {
        request_reply_error(request, &err);
        waiting_destroy(waiting);
        return;
    }
    request_on_gone(request, on_gone, waiting);
}

static void order_of_room(struct request *request, struct render_request *asked, const char *id)
{
    struct error err = {0};

    if (hub_scene_is_heavy(request->hub, id) && request_becomes_heavy(request)) {
        return;
    }
    struct room *room = hub_lock_room(request->hub, id, &err);
    if (!room) {
        request_reply_error(request, &err);
        return;
    }
    render_request_see_from(asked, &room->scene->camera);
    order(request, asked, &(struct subject){.room = room});
    hub_unlock(request->hub);
}

/* Takes what is in `asked`, and the document. What is long is done before the lock. */
static void order_text(struct request *request, struct render_request *asked,
                       struct subject *subject)
{
    digest_text(subject->document, strlen(subject->document), subject->digest);
    hub_lock(request->hub);
    order(request, asked, subject);
    hub_unlock(request->hub);
}

/* Takes `scene`, which may be NULL with `err` saying why. */
static void order_of_document(struct request *request, struct render_request *asked,
                              struct scene *scene, struct error *err)
{
    if (!scene || !hub_accepts_scene(request->hub, scene, err)) {
        request_reply_error(request, err);
    } else {
        render_request_see_from(asked, &scene->camera);
        order_text(request, asked,
                   &(struct subject){.document = scene_print(scene, false),
                                     .image = record_text(&scene->environment, "image")});
    }
    scene_destroy(scene);
}

/* --- what is asked --- */

/* `format`: the extension that the path ends with. */
static bool read_query(const struct request *request, const char *format,
                       struct render_request *out, struct error *err)
{
    for (size_t i = 0; i < request->query_count; i++) {
        const char *name = request->query[i].name, *text = request->query[i].value;

        if (request_query(request, name) != text) {
            char place[ERROR_PLACE_BYTES];

            snprintf(place, sizeof place, "?%.64s", name);
            return error_set(err, ERROR_INVALID, place, "given twice");
        }
        if (!render_request_set_text(out, REQUEST_QUERY, name, text, err)) {
            return false;
        }
    }
    out->codec = codec_find(format);
    if (!out->codec) {
        return error_set(err, ERROR_NOT_FOUND, "?format", "%.40s is not " CODEC_CHOICES, format);
    }
    record_put(&out->delivery, "exact", true);
    return render_request_check(out, REQUEST_QUERY, err);
}

/* The body but for its member `scene`. */
static bool read_body(const cJSON *members, struct render_request *out, struct error *err)
{
    record_put(&out->delivery, "exact", true);
    return render_request_read(out, members, err) && render_request_check(out, REQUEST_JSON, err);
}

/* --- routes --- */

void images_of_scene(struct request *request)
{
    struct error err = {0};
    struct render_request asked;

    render_request_init(&asked);
    if (read_query(request, request->capture[1], &asked, &err)) {
        order_of_room(request, &asked, request->capture[0]);
    } else {
        request_reply_error(request, &err);
    }
    render_request_finish(&asked);
}

void images_of_example(struct request *request)
{
    struct error err = {0};
    struct render_request asked;
    const struct embedded *example = examples_find(request->capture[0]);

    if (!example) {
        error_set(&err, ERROR_NOT_FOUND, "", "there is no example %s", request->capture[0]);
        request_reply_error(request, &err);
        return;
    }
    render_request_init(&asked);
    if (read_query(request, request->capture[1], &asked, &err)) {
        order_of_document(request, &asked,
                          scene_parse((const char *)example->bytes, example->length, &err), &err);
    } else {
        request_reply_error(request, &err);
    }
    render_request_finish(&asked);
}

/* The width in pixels; the height is that of a thumbnail. */
static bool read_width(const struct request *request, struct render_request *out, struct error *err)
{
    static const char *const queries[] = {"width", NULL};
    const char *text = request_query(request, "width");

    record_put(&out->picture, "width", THUMBNAIL_WIDTH);
    if (!request_check_query(request, queries, err) ||
        (text && !render_request_set_text(out, REQUEST_QUERY, "width", text, err))) {
        return false;
    }
    const int width = render_request_int(out, "width");
    if (width < THUMBNAIL_LEAST || width > THUMBNAIL_LARGEST) {
        return error_set(err, ERROR_INVALID, "?width", "%d is not within %d and %d", width,
                         THUMBNAIL_LEAST, THUMBNAIL_LARGEST);
    }
    record_put(&out->picture, "height", thumbnail_height(width));
    record_put(&out->delivery, "exact", true);
    out->codec = codec_find("png");
    return true;
}

/* Takes `text`. */
static void order_portrait(struct request *request, struct render_request *asked, char *text)
{
    struct error err = {0};
    struct scene *scene = scene_parse(text, strlen(text), &err);

    if (scene && hub_accepts_scene(request->hub, scene, &err)) {
        order_text(request, asked, &(struct subject){.document = text, .portrait = true});
    } else {
        request_reply_error(request, &err);
        free(text);
    }
    scene_destroy(scene);
}

void images_of_entry(struct request *request)
{
    struct hub *hub = request->hub;
    struct error err = {0};
    struct render_request asked;

    hub_lock(hub);
    const struct library_item *item = library_find(hub->library, request->capture[0]);
    char *text = item ? memory_text(item->text) : NULL;
    hub_unlock(hub);
    render_request_init(&asked);
    if (!text) {
        error_set(&err, ERROR_NOT_FOUND, "", "the library has no entry %s", request->capture[0]);
    } else if (read_width(request, &asked, &err)) {
        order_portrait(request, &asked, text);
        text = NULL;
    }
    if (err.kind != ERROR_NONE) {
        request_reply_error(request, &err);
    }
    free(text);
    render_request_finish(&asked);
}

/* A picture of `scene`: a document, or the id of a scene. */
static void render_body(struct request *request, const cJSON *members, const cJSON *scene)
{
    struct error err = {0};
    struct render_request asked;

    render_request_init(&asked);
    if (!read_body(members, &asked, &err)) {
        request_reply_error(request, &err);
    } else if (cJSON_IsString(scene)) {
        order_of_room(request, &asked, scene->valuestring);
    } else if (cJSON_IsObject(scene)) {
        order_of_document(request, &asked, scene_read(scene, &err), &err);
    } else {
        error_set(&err, ERROR_INVALID, "/scene", "must be a document or the id of a scene");
        request_reply_error(request, &err);
    }
    render_request_finish(&asked);
}

void images_render(struct request *request)
{
    struct error err = {0};
    cJSON *json = json_parse(request->body ? request->body : "", request->body_length, &err);

    if (!json) {
        request_reply_error(request, &err);
    } else if (!cJSON_IsObject(json)) {
        error_set(&err, ERROR_SYNTAX, "", "the body must be an object");
        request_reply_error(request, &err);
    } else {
        cJSON *scene = cJSON_DetachItemFromObjectCaseSensitive(json, "scene");

        render_body(request, json, scene);
        cJSON_Delete(scene);
    }
    cJSON_Delete(json);
}

static void add_place(void *data, const struct image_place *place)
{
    cJSON *item = cJSON_CreateObject();

    cJSON_AddItemToObject(item, "scene",
                          place->scene ? cJSON_CreateString(place->scene) : cJSON_CreateNull());
    cJSON_AddNumberToObject(item, "width", place->width);
    cJSON_AddNumberToObject(item, "height", place->height);
    cJSON_AddNumberToObject(item, "position", place->position);
    cJSON_AddNumberToObject(item, "waited_ms", (double)place->waited_ms);
    cJSON_AddNumberToObject(item, "expected_ms", (double)place->expected_ms);
    cJSON_AddItemToArray(data, item);
}

/* Where the pictures of this client stand. */
void images_queue(struct request *request)
{
    struct hub *hub = request->hub;
    cJSON *json = cJSON_CreateObject();

    hub_lock(hub);
    cJSON_AddNumberToObject(json, "waiting",
                            (double)metric_get(&hub->metrics, METRIC_IMAGES_WAITING));
    cJSON_AddNumberToObject(json, "limit", LIMIT_IMAGE_QUEUE);
    cJSON_AddNumberToObject(json, "clients", image_queue_clients(hub));
    cJSON_AddNumberToObject(json, "own_limit", LIMIT_IMAGE_SHARE);
    image_queue_each(hub, request->client, add_place, cJSON_AddArrayToObject(json, "own"));
    hub_unlock(hub);
    request_reply_json(request, 200, json);
}
