/* SPDX-License-Identifier: MIT */
/* What is not about one scene: the page, examples, schema, health, metrics. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "routes.h"
#include "server/embedded.h"
#include "server/live/hub_rooms.h"
#include "server/live/render_queue.h"

enum { WEB_FILE_BYTES = 67108864 };

/* A browser that shows the answer gets a page, all others JSON. */
static void reply_not_found(struct request *request)
{
    static const char page[] = "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\">"
                               "<title>Not found</title><h1>There is nothing at this address</h1>"
                               "<p><a href=\"/\">The scenes of this server</a></p></html>\n";
    const char *accept = request_header(request, "Accept");
    struct response response =
        accept && strstr(accept, "text/html")
            ? response_text(404, "text/html; charset=utf-8", memory_text(page))
            : response_problem(404, "not_found", "", "there is nothing at this address");

    response_add(&response, "Vary", "Accept");
    request_reply(request, &response);
}

/* --- the page --- */

/* Files whose name holds a hash of their content never change. */
static void add_caching(struct response *response, const char *path)
{
    if (strncmp(path, "/assets/", 8) == 0) {
        response_add(response, "Cache-Control", "public, max-age=31536000, immutable");
    }
}

static const char *mime_of(const char *path)
{
    static const char *const types[][2] = {{".html", "text/html; charset=utf-8"},
                                           {".js", "text/javascript; charset=utf-8"},
                                           {".css", "text/css; charset=utf-8"},
                                           {".svg", "image/svg+xml"},
                                           {".png", "image/png"},
                                           {".json", "application/json"},
                                           {".webmanifest", "application/json"},
                                           {".woff2", "font/woff2"},
                                           {".wasm", "application/wasm"}};
    const char *dot = strrchr(path, '.');

    for (size_t i = 0; dot && i < sizeof types / sizeof *types; i++) {
        if (strcmp(types[i][0], dot) == 0) {
            return types[i][1];
        }
    }
    return "application/octet-stream";
}

/* A regular file below `directory`, links resolved; NULL: none. */
static char *read_below(const char *directory, const char *path, size_t *out_length)
{
    char wanted[PATH_MAX], root[PATH_MAX], real[PATH_MAX];
    struct stat status;
    char *bytes = NULL;

    if (snprintf(wanted, sizeof wanted, "%s%s", directory, path) >= (int)sizeof wanted ||
        !realpath(directory, root) || !realpath(wanted, real) ||
        strncmp(real, root, strlen(root)) != 0 || real[strlen(root)] != '/') {
        return NULL;
    }
    const int fd = open(real, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd >= 0 && fstat(fd, &status) == 0 && S_ISREG(status.st_mode) &&
        status.st_size <= WEB_FILE_BYTES) {
        bytes = memory_alloc((size_t)status.st_size + 1, 1);
        *out_length = (size_t)status.st_size;
        if (read(fd, bytes, *out_length) != (ssize_t)*out_length) {
            free(bytes);
            bytes = NULL;
        }
    }
    if (fd >= 0) {
        close(fd);
    }
    return bytes;
}

/* A compressed file is sent as it is to those who ask for that. */
static struct response built_in(const struct request *request, const struct embedded *file)
{
    struct response response = {.status = 200,
                                .type = file->mime,
                                .body = (void *)file->bytes,
                                .length = file->length,
                                .borrowed = true};

    if (!file->gzip) {
        return response;
    }
    response_add(&response, "Vary", "Accept-Encoding");
    if (request_wants_gzip(request)) {
        response_add(&response, "Content-Encoding", "gzip");
    } else {
        response.body = embedded_unpack(file, &response.length);
        response.borrowed = false;
    }
    return response;
}

static bool reply_file(struct request *request, const char *path)
{
    struct response response = {.status = 200};

    if (request->hub->web_dir) {
        response.body = read_below(request->hub->web_dir, path, &response.length);
        response.type = mime_of(path);
        if (!response.body) {
            return false;
        }
    } else {
        const struct embedded *asset = page_find(path);

        if (!asset) {
            return false;
        }
        response = built_in(request, asset);
    }
    add_caching(&response, path);
    request_reply(request, &response);
    return true;
}

void site_app(struct request *request)
{
    if (!reply_file(request, "/index.html")) {
        struct response response = response_problem(
            404, "not_found", "", "this fieldcast was built without the page; see /v1/schema.json");

        request_reply(request, &response);
    }
}

void site_asset(struct request *request)
{
    if (!reply_file(request, request->path)) {
        reply_not_found(request);
    }
}

/* --- examples --- */

/* What an example is there for: to be seen, to be read in this order, or one topic each. */
enum { SHOWPIECE, LESSON, SHAPE, COMBINE, MODIFY, REPEAT, SURFACE, EXAMPLE_GROUPS };
static const char *const example_groups[EXAMPLE_GROUPS] = {
    "showpiece", "lesson", "shape", "combine", "modify", "repeat", "surface"};

/* In the order in which they are listed. */
static const struct {
    const char *id;
    int group;
} example_rows[] = {
    {"portrait", SHOWPIECE},
    {"sunset-temple", SHOWPIECE},
    {"still-life", SHOWPIECE},
    {"lighthouse", SHOWPIECE},
    {"glass", SHOWPIECE},
    {"foggy-valley", SHOWPIECE},
    {"chess", SHOWPIECE},
    {"mirrors", SHOWPIECE},
    {"studio-portrait", SHOWPIECE},
    {"coloured-glass", SHOWPIECE},
    {"island", SHOWPIECE},
    {"planetary-gear", SHOWPIECE},
    {"robot", SHOWPIECE},
    {"temple", SHOWPIECE},
    {"snail", SHOWPIECE},
    {"duck", SHOWPIECE},
    {"frog", SHOWPIECE},
    {"snowman", SHOWPIECE},
    {"flange", SHOWPIECE},
    {"first-steps", LESSON},
    {"lecture-1-shapes", LESSON},
    {"lecture-2-booleans", LESSON},
    {"lecture-3-light", LESSON},
    {"lecture-4-transforms", LESSON},
    {"lecture-5-camera", LESSON},
    {"own-code", LESSON},
    {"primitives", SHAPE},
    {"flat-shapes", SHAPE},
    {"revolve", SHAPE},
    {"gyroid", SHAPE},
    {"fractals", SHAPE},
    {"csg", COMBINE},
    {"smooth-booleans", COMBINE},
    {"blend", COMBINE},
    {"blend-kernels", COMBINE},
    {"round-shell", MODIFY},
    {"elongate", MODIFY},
    {"twist", MODIFY},
    {"bend", MODIFY},
    {"displace", MODIFY},
    {"mirror", REPEAT},
    {"repeat-limited", REPEAT},
    {"repeat-polar", REPEAT},
    {"repeat-infinite", REPEAT},
    {"surface-barth", SURFACE},
    {"surface-heart", SURFACE},
    {"surface-clebsch", SURFACE},
    {"surface-kummer", SURFACE},
    {"surface-chmutov", SURFACE},
    {"surface-cayley", SURFACE},
    {"surface-tanglecube", SURFACE},
    {"surface-chair", SURFACE},
    {"surface-dingdong", SURFACE},
    {"surface-whitney", SURFACE},
    {"surface-steiner", SURFACE},
    {"surface-boy", SURFACE},
    {"surface-enneper", SURFACE},
    {"surface-moebius", SURFACE},
    {"surface-klein", SURFACE},
    {"surface-dupin", SURFACE},
    {"surface-schwarz-p", SURFACE},
    {"surface-schwarz-d", SURFACE},
    {"surface-gyroid", SURFACE},
    {"surface-blobs", SURFACE},
    {"surface-bottle", SURFACE},
    {"surface-shell", SURFACE},
    {"surface-helicoid", SURFACE},
    {"surface-bicubic", SURFACE},
    {"surface-rim", SURFACE},
    {"surface-decocube", SURFACE},
    {"surface-octic", SURFACE},
    {"surface-endrass", SURFACE},
    {"surface-togliatti", SURFACE},
};
enum { EXAMPLE_ROWS = sizeof example_rows / sizeof example_rows[0] };

/* One line about a scene, from what is in it. */
static void describe(const struct scene *scene, char *out, size_t size)
{
    snprintf(out, size, "%zu node%s, %zu light%s, %zu material%s", scene->node_count,
             scene->node_count == 1 ? "" : "s", scene->lights.count,
             scene->lights.count == 1 ? "" : "s", scene->materials.count,
             scene->materials.count == 1 ? "" : "s");
}

static void add_example(cJSON *list, const struct embedded *example, int group)
{
    struct scene *scene = scene_parse((const char *)example->bytes, example->length, NULL);
    char description[120];

    if (!scene) {
        return; /* a test reads them all */
    }
    cJSON *item = cJSON_CreateObject();
    describe(scene, description, sizeof description);
    cJSON_AddStringToObject(item, "id", example->path);
    cJSON_AddStringToObject(item, "name", record_text(&scene->info, "name"));
    cJSON_AddStringToObject(item, "description", description);
    cJSON_AddStringToObject(item, "group", example_groups[group]);
    cJSON_AddItemToArray(list, item);
    scene_destroy(scene);
}

void site_examples(struct request *request)
{
    cJSON *json = cJSON_CreateObject();
    cJSON *list = cJSON_AddArrayToObject(json, "examples");

    for (size_t i = 0; i < EXAMPLE_ROWS; i++) {
        const struct embedded *example = examples_find(example_rows[i].id);
        if (example) {
            add_example(list, example, example_rows[i].group);
        }
    }
    request_reply_json(request, 200, json);
}

void site_example(struct request *request)
{
    const struct embedded *example = examples_find(request->capture[0]);

    if (!example) {
        reply_not_found(request);
        return;
    }
    const struct response response = built_in(request, example);

    request_reply(request, &response);
}

static void reply_picture(struct request *request, const struct embedded *picture)
{
    if (!picture) {
        reply_not_found(request);
        return;
    }
    struct response response = built_in(request, picture);

    response_add(&response, "Cache-Control", "max-age=3600");
    request_reply(request, &response);
}

void site_card(struct request *request)
{
    reply_picture(request, cards_find(request->capture[0]));
}

void site_reference(struct request *request)
{
    reply_picture(request, references_find(request->capture[0]));
}

/* --- about the server --- */

void site_schema(struct request *request)
{
    struct hub *hub = request->hub;
    struct response response = {.status = 304, .body = "", .borrowed = true};

    if (!request_knows_tag(request, hub->schema_tag)) {
        response = (struct response){.status = 200,
                                     .type = "application/schema+json",
                                     .body = hub->schema,
                                     .length = strlen(hub->schema),
                                     .borrowed = true};
    }
    response_add(&response, "ETag", "%s", hub->schema_tag);
    request_reply(request, &response);
}

void site_health(struct request *request)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "status", "alive");
    cJSON_AddStringToObject(json, "version", FIELDCAST_VERSION);
    request_reply_json(request, 200, json);
}

void site_ready(struct request *request)
{
    struct hub *hub = request->hub;
    struct renderer_info info;

    hub_lock(hub);
    const bool ready = hub->render_queue->ready;
    info = hub->renderer;
    hub_unlock(hub);
    const char *damage = store_damage(hub->store);
    if (*damage) {
        char detail[300];

        snprintf(detail, sizeof detail, "the database is damaged: %s", damage);
        struct response response = response_problem(503, "unavailable", "store", detail);
        request_reply(request, &response);
        return;
    }
    if (!ready || atomic_load(&hub->draining)) {
        struct response response = response_problem(503, "unavailable", "",
                                                    ready ? "the server is shutting down"
                                                          : "the render process is not ready");

        request_reply(request, &response);
        return;
    }
    cJSON *json = cJSON_CreateObject();
    cJSON_AddStringToObject(json, "status", "ready");
    cJSON_AddStringToObject(json, "renderer", info.name);
    cJSON_AddBoolToObject(json, "software", info.software);
    cJSON_AddStringToObject(json, "stage", render_stage_names[info.stage]);
    request_reply_json(request, 200, json);
}

void site_metrics(struct request *request)
{
    struct response response = response_text(200, "text/plain; version=0.0.4; charset=utf-8",
                                             metrics_print(&request->hub->metrics));

    request_reply(request, &response);
}
