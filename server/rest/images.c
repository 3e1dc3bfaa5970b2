/* SPDX-License-Identifier: MIT */
/* Pictures over HTTP: of a scene, of an example, of a document sent along. All become the same
 * order to the worker. */
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "embedded.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "routes.h"
#include "server/live/hub.h"
#include "server/live/room.h"

enum { DEFAULT_WIDTH = 1280, DEFAULT_HEIGHT = 720 };

/* What is asked of a picture, from a query or from JSON. */
struct wish {
    int width, height, samples, quality;
    int aov, format;
    cJSON *camera; /* members that differ from the scene's camera; NULL: none */
};

/* The whole numbers among them, for both readers. */
static const struct whole {
    const char *name;
    size_t offset;
    int min, max, fallback;
} wholes[] = {
    {"width", offsetof(struct wish, width), 1, LIMIT_IMAGE_SIDE, DEFAULT_WIDTH},
    {"height", offsetof(struct wish, height), 1, LIMIT_IMAGE_SIDE, DEFAULT_HEIGHT},
    {"samples", offsetof(struct wish, samples), 1, 4, 0},   /* 0: the scene's */
    {"quality", offsetof(struct wish, quality), 1, 100, 0}, /* 0: the encoder's */
};
enum { WHOLE_COUNT = sizeof(wholes) / sizeof(*wholes) };

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

static void wish_finish(struct wish *wish)
{
    cJSON_Delete(wish->camera);
    wish->camera = NULL;
}

static bool set_whole(struct wish *wish, const struct whole *whole, double value, const char *place,
                      struct error *err)
{
    if (value != floor(value)) {
        return error_set(err, ERROR_INVALID, place, "%g is not a whole number", value);
    }
    if (value < whole->min || value > whole->max) {
        return error_set(err, ERROR_INVALID, place, "%g is %s %d", value,
                         value < whole->min ? "below the minimum" : "above the maximum",
                         value < whole->min ? whole->min : whole->max);
    }
    *(int *)((char *)wish + whole->offset) = (int)value;
    return true;
}

static void set_defaults(struct wish *wish)
{
    memset(wish, 0, sizeof(*wish));
    for (int i = 0; i < WHOLE_COUNT; i++) {
        *(int *)((char *)wish + wholes[i].offset) = wholes[i].fallback;
    }
}

static bool set_names(struct wish *wish, const char *aov, const char *format, const char *prefix,
                      struct error *err)
{
    char place[16];

    snprintf(place, sizeof(place), "%saov", prefix);
    wish->aov = aov_find(aov);
    if (wish->aov < 0) {
        return error_set(err, ERROR_INVALID, place, "%.40s is not color, depth, normal or id", aov);
    }
    snprintf(place, sizeof(place), "%sformat", prefix);
    wish->format = image_format_find(format);
    if (wish->format < 0) {
        return error_set(err, *prefix == '/' ? ERROR_INVALID : ERROR_NOT_FOUND, place,
                         "%.40s is not png, jpg or npy", format);
    }
    return true;
}

static bool check_pixels(const struct wish *wish, struct error *err)
{
    int64_t pixels = (int64_t)wish->width * wish->height;

    return pixels <= LIMIT_IMAGE_PIXELS ||
           error_set(err, ERROR_LIMIT, "", "%d x %d = %" PRId64 " pixels are above the maximum %d",
                     wish->width, wish->height, pixels, LIMIT_IMAGE_PIXELS);
}

/* --- from a query --- */

static bool parse_numbers(const char *text, int count, double *out)
{
    for (int i = 0; i < count; i++) {
        char *end;

        /* strtod would take hexadecimal, blanks and names of infinities too. */
        if (!strchr("+-.0123456789", *text) || !*text || text[strcspn(text, "xXnN")] != '\0') {
            return false;
        }
        out[i] = strtod(text, &end);
        if (end == text || !isfinite(out[i]) || *end != (i + 1 < count ? ',' : '\0')) {
            return false;
        }
        text = end + 1;
    }
    return true;
}

static bool query_camera(struct wish *wish, const struct request *request, struct error *err)
{
    static const struct {
        const char *name;
        int count;
    } members[] = {{"position", 3}, {"target", 3}, {"fov", 1}};

    for (size_t i = 0; i < sizeof(members) / sizeof(*members); i++) {
        const char *text = request_query(request, members[i].name);
        char place[16];
        double values[3];

        if (!text) {
            continue;
        }
        if (!parse_numbers(text, members[i].count, values)) {
            snprintf(place, sizeof(place), "?%s", members[i].name);
            return error_set(err, ERROR_INVALID, place, "%.60s is not %s", text,
                             members[i].count == 1 ? "a number" : "three numbers x,y,z");
        }
        if (!wish->camera) {
            wish->camera = cJSON_CreateObject();
        }
        cJSON_AddItemToObject(wish->camera, members[i].name,
                              members[i].count == 1
                                  ? cJSON_CreateNumber(values[0])
                                  : cJSON_CreateDoubleArray(values, members[i].count));
    }
    return true;
}

static bool wish_from_query(struct wish *wish, const struct request *request, const char *format,
                            struct error *err)
{
    static const char *const names[] = {"width",    "height", "aov", "samples", "quality",
                                        "position", "target", "fov", NULL};
    const char *aov = request_query(request, "aov");

    set_defaults(wish);
    if (!request_check_query(request, names, err) ||
        !set_names(wish, aov ? aov : "color", format, "?", err)) {
        return false;
    }
    for (int i = 0; i < WHOLE_COUNT; i++) {
        const char *text = request_query(request, wholes[i].name);
        char place[16];
        double value;

        snprintf(place, sizeof(place), "?%s", wholes[i].name);
        if (!text) {
            continue;
        }
        if (!parse_numbers(text, 1, &value)) {
            return error_set(err, ERROR_INVALID, place, "%.60s is not a whole number", text);
        }
        if (!set_whole(wish, &wholes[i], value, place, err)) {
            return false;
        }
    }
    return query_camera(wish, request, err) && check_pixels(wish, err);
}

/* --- from JSON --- */

static bool wish_member(struct wish *wish, const cJSON *member, struct error *err)
{
    static const char *const others[] = {"scene", "camera", "format", "aov"};
    char place[80];

    snprintf(place, sizeof(place), "/%.64s", member->string);
    for (int i = 0; i < WHOLE_COUNT; i++) {
        if (strcmp(member->string, wholes[i].name) == 0) {
            return cJSON_IsNumber(member)
                       ? set_whole(wish, &wholes[i], member->valuedouble, place, err)
                       : error_set(err, ERROR_INVALID, place, "must be a number");
        }
    }
    for (size_t i = 0; i < sizeof(others) / sizeof(*others); i++) {
        if (strcmp(member->string, others[i]) == 0) {
            return true;
        }
    }
    return error_set(err, ERROR_INVALID, place, "unknown member");
}

static const char *member_text(const cJSON *json, const char *name, const char *fallback)
{
    const cJSON *member = cJSON_GetObjectItemCaseSensitive(json, name);

    return !member ? fallback : cJSON_IsString(member) ? member->valuestring : "?";
}

static bool wish_from_json(struct wish *wish, const cJSON *json, struct error *err)
{
    const cJSON *camera = cJSON_GetObjectItemCaseSensitive(json, "camera");
    const cJSON *member;

    set_defaults(wish);
    if (!cJSON_IsObject(json)) {
        return error_set(err, ERROR_SYNTAX, "", "the body must be an object");
    }
    cJSON_ArrayForEach(member, json)
    {
        if (!wish_member(wish, member, err)) {
            return false;
        }
    }
    if (camera && !cJSON_IsObject(camera)) {
        return error_set(err, ERROR_INVALID, "/camera", "must be an object");
    }
    wish->camera = camera ? cJSON_Duplicate(camera, true) : NULL;
    return set_names(wish, member_text(json, "aov", "color"), member_text(json, "format", "png"),
                     "/", err) &&
           check_pixels(wish, err);
}

/* --- to the worker --- */

/* The scene's camera with the members asked for; NULL: the scene's as it is. */
static bool build_camera(const struct scene *scene, const struct wish *wish, bool whole,
                         cJSON **out, struct error *err)
{
    struct record camera;
    const cJSON *member;
    bool ok = true;

    *out = NULL;
    if (!wish->camera) {
        return true;
    }
    if (whole) {
        record_init(&camera, &camera_type);
    } else {
        record_copy(&camera, &scene->camera);
    }
    cJSON_ArrayForEach(member, wish->camera)
    {
        int index = record_type_find(&camera_type, member->string);
        char place[100];

        snprintf(place, sizeof(place), "%s%.64s", whole ? "/camera/" : "?", member->string);
        ok = ok && (index >= 0 ? record_set(&camera, index, member, place, err)
                               : error_set(err, ERROR_INVALID, place, "unknown member"));
    }
    if (ok) {
        *out = cJSON_CreateObject();
        record_print(&camera, *out);
    }
    record_finish(&camera);
    return ok;
}

static const char *format_name(int format)
{
    static const char *const names[] = {
        [IMAGE_PNG] = "png", [IMAGE_JPEG] = "jpg", [IMAGE_NPY] = "npy"};

    return names[format];
}

static cJSON *wish_fields(const struct wish *wish, cJSON *camera)
{
    cJSON *fields = cJSON_CreateObject();

    cJSON_AddNumberToObject(fields, "width", wish->width);
    cJSON_AddNumberToObject(fields, "height", wish->height);
    if (camera) {
        cJSON_AddItemToObject(fields, "camera", camera);
    }
    cJSON_AddStringToObject(fields, "aov", aov_name((enum aov)wish->aov));
    cJSON_AddNumberToObject(fields, "samples", wish->samples);
    cJSON_AddStringToObject(fields, "format", format_name(wish->format));
    cJSON_AddNumberToObject(fields, "quality", wish->quality);
    cJSON_AddBoolToObject(fields, "chroma_halved", false);
    cJSON_AddBoolToObject(fields, "fast", false);
    cJSON_AddBoolToObject(fields, "exact", true);
    return fields;
}

/* The scene's state and the fields of the order, as text. */
static char *make_key(const cJSON *fields, const struct room *room, const char *document)
{
    char *text = json_print(fields, false), *key = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&key, &length);

    fputs(text, out);
    if (room) {
        fprintf(out, "%s %s %" PRIu64, room->id, room->epoch, room->revision);
    } else {
        fputs(document, out);
    }
    fclose(out);
    free(text);
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

static void reply_picture(const struct waiting *waiting, uint64_t revision, const char *mime,
                          const void *bytes, size_t length)
{
    struct response response = {.status = 200, .type = mime, .length = length};
    char tag[48];

    make_tag(waiting, revision, tag);
    response.body = memory_alloc(length, 1);
    memcpy(response.body, bytes, length);
    response_add(&response, "ETag", "%s", tag);
    response_add(&response, "Fieldcast-Revision", "%" PRIu64, revision);
    response_add(&response, "Fieldcast-Size", "%dx%d", waiting->width, waiting->height);
    response_add(&response, "Fieldcast-Renderer", "%s", waiting->hub->renderer.name);
    request_reply(waiting->request, &response);
}

static void on_picture(void *data, const struct packet *answer, const struct error *err)
{
    struct waiting *waiting = data;

    if (answer) {
        const char *mime = json_member_text(answer->json, "mime", "application/octet-stream");
        uint64_t revision = (uint64_t)json_member_number(answer->json, "revision", 0);

        if (revision == waiting->revision) {
            pictures_add(&waiting->hub->pictures, waiting->key, mime, revision, answer->payload,
                         answer->payload_length);
        }
        reply_picture(waiting, revision, mime, answer->payload, answer->payload_length);
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

    renders_cancel(waiting->hub, waiting->job);
    error_set(&err, ERROR_UNAVAILABLE, "", "the client left");
    request_reply_error(waiting->request, &err);
    waiting_destroy(waiting);
}

/* The client has it, or it was drawn before. */
static bool reply_at_once(const struct waiting *waiting)
{
    const struct picture *picture;
    char tag[48];

    make_tag(waiting, waiting->revision, tag);
    if (request_tag_listed(request_header(waiting->request, "If-None-Match"), tag)) {
        struct response response = {.status = 304, .body = "", .borrowed = true};

        response_add(&response, "ETag", "%s", tag);
        request_reply(waiting->request, &response);
        return true;
    }
    picture = pictures_find(&waiting->hub->pictures, waiting->key);
    if (picture) {
        metric_add(&waiting->hub->metrics, METRIC_PICTURES_REUSED, 1);
        reply_picture(waiting, picture->revision, picture->mime, picture->bytes, picture->length);
    }
    return picture != NULL;
}

/* Under the hub's lock. One of `room` and `document` is given. */
static void order(struct request *request, const struct wish *wish, cJSON *camera,
                  struct room *room, const char *document)
{
    struct error err = {0};
    struct waiting *waiting = memory_alloc(1, sizeof(*waiting));
    struct render_order render = {.type = "render",
                                  .room = room,
                                  .document = document,
                                  .fields = wish_fields(wish, camera),
                                  .priority = RENDER_IMAGE,
                                  .again = true,
                                  .on_done = on_picture,
                                  .data = waiting};

    waiting->request = request;
    waiting->hub = request->hub;
    waiting->width = wish->width;
    waiting->height = wish->height;
    waiting->revision = room ? room->revision : 1;
    waiting->key = make_key(render.fields, room, document);
    if (reply_at_once(waiting)) {
        cJSON_Delete(render.fields);
        waiting_destroy(waiting);
        return;
    }
    waiting->job = renders_submit(request->hub, &render, &err);
    if (!waiting->job) {
        request_reply_error(request, &err);
        waiting_destroy(waiting);
        return;
    }
    request_on_gone(request, on_gone, waiting);
}

static void order_of_room(struct request *request, const struct wish *wish, const char *id,
                          bool whole_camera)
{
    struct error err = {0};
    cJSON *camera = NULL;
    struct room *room = hub_lock_room(request->hub, id, &err);

    if (!room) {
        request_reply_error(request, &err);
        return;
    }
    if (build_camera(room->scene, wish, whole_camera, &camera, &err)) {
        order(request, wish, camera, room, NULL);
    } else {
        request_reply_error(request, &err);
    }
    hub_unlock(request->hub);
}

/* Takes `scene`, which may be NULL with `err` saying why. */
static void order_of_document(struct request *request, const struct wish *wish, struct scene *scene,
                              bool whole_camera, struct error *err)
{
    cJSON *camera = NULL;

    if (!scene || !hub_accepts_scene(request->hub, scene, err) ||
        !build_camera(scene, wish, whole_camera, &camera, err)) {
        request_reply_error(request, err);
    } else {
        char *document = scene_print(scene, false);

        hub_lock(request->hub);
        order(request, wish, camera, NULL, document);
        hub_unlock(request->hub);
        free(document);
    }
    scene_destroy(scene);
}

/* --- routes --- */

void images_of_scene(struct request *request)
{
    struct error err = {0};
    struct wish wish;

    if (wish_from_query(&wish, request, request->capture[1], &err)) {
        order_of_room(request, &wish, request->capture[0], false);
    } else {
        request_reply_error(request, &err);
    }
    wish_finish(&wish);
}

void images_of_example(struct request *request)
{
    struct error err = {0};
    struct wish wish;
    const struct embedded *example = examples_find(request->capture[0]);

    if (!example) {
        error_set(&err, ERROR_NOT_FOUND, "", "there is no example %s", request->capture[0]);
        request_reply_error(request, &err);
        return;
    }
    if (wish_from_query(&wish, request, request->capture[1], &err)) {
        order_of_document(request, &wish,
                          scene_parse((const char *)example->bytes, example->length, &err), false,
                          &err);
    } else {
        request_reply_error(request, &err);
    }
    wish_finish(&wish);
}

void images_render(struct request *request)
{
    struct error err = {0};
    struct wish wish;
    cJSON *json = json_parse(request->body ? request->body : "", request->body_length, &err);

    memset(&wish, 0, sizeof(wish));
    if (!json || !wish_from_json(&wish, json, &err)) {
        request_reply_error(request, &err);
    } else {
        const cJSON *scene = cJSON_GetObjectItemCaseSensitive(json, "scene");

        if (cJSON_IsString(scene)) {
            order_of_room(request, &wish, scene->valuestring, true);
        } else if (cJSON_IsObject(scene)) {
            order_of_document(request, &wish, scene_read(scene, &err), true, &err);
        } else {
            error_set(&err, ERROR_INVALID, "/scene", "must be a document or the id of a scene");
            request_reply_error(request, &err);
        }
    }
    wish_finish(&wish);
    cJSON_Delete(json);
}
