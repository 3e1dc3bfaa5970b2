/* SPDX-License-Identifier: MIT */
#include "routes.h"

#include <string.h>

static const struct route table[] = {
    {"GET", "/v1/scenes", scenes_list, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/scenes", scenes_create, BODY_JSON, GUARDED, SCENE_NEW},
    {"POST", "/v1/import", scenes_import, BODY_JSON, GUARDED, SCENE_NEW},
    {"GET", "/v1/scenes/{}", scenes_read, BODY_NONE, GUARDED, SCENE_NAMED},
    {"PUT", "/v1/scenes/{}", scenes_replace, BODY_JSON, GUARDED, SCENE_NAMED},
    {"PATCH", "/v1/scenes/{}", scenes_edit, BODY_JSON, GUARDED, SCENE_NAMED},
    {"DELETE", "/v1/scenes/{}", scenes_delete, BODY_NONE, GUARDED, SCENE_NAMED},
    {"GET", "/v1/scenes/{}/live", scenes_live, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/scenes/{}/poster.jpg", scenes_poster, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/scenes/{}/image.{}", images_of_scene, BODY_NONE, GUARDED, SCENE_NAMED},
    {"GET", "/v1/assets", assets_list, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/assets", assets_create, BODY_FILE, GUARDED, SCENE_NONE},
    {"GET", "/v1/assets/{}", assets_read, BODY_NONE, GUARDED, SCENE_NONE},
    {"DELETE", "/v1/assets/{}", assets_delete, BODY_NONE, GUARDED, SCENE_NONE},
    {"POST", "/v1/render", images_render, BODY_JSON, GUARDED, SCENE_NEW},
    {"GET", "/v1/queue", images_queue, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples", pages_examples, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples/{}", pages_example, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples/{}/card.jpg", pages_card, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/examples/{}/image.{}", images_of_example, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/reference/{}.jpg", pages_reference, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/v1/schema.json", pages_schema, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/metrics", pages_metrics, BODY_NONE, GUARDED, SCENE_NONE},
    {"GET", "/healthz", pages_health, BODY_NONE, OPEN, SCENE_NONE},
    {"GET", "/readyz", pages_ready, BODY_NONE, OPEN, SCENE_NONE},
    {"GET", "/", pages_app, BODY_NONE, PAGE, SCENE_NONE},
    {"GET", "/s/{}", pages_app, BODY_NONE, PAGE, SCENE_NONE},
};
enum { ROUTE_COUNT = sizeof(table) / sizeof(*table) };

/* Everything else that can be read is a file of the page. */
static const struct route asset_route = {"GET", "", pages_asset, BODY_NONE, OPEN, SCENE_NONE};

static bool match(const char *pattern, struct request *request)
{
    const char *path = request->path;
    int captures = 0;

    while (*pattern) {
        if (*pattern != '{') {
            if (*pattern++ != *path++) {
                return false;
            }
            continue;
        }
        size_t length = strcspn(path, "/"), after = strcspn(pattern + 2, "/");
        length = length > after ? length - after : 0;
        if (length == 0 || length > LIMIT_ID_BYTES) {
            return false;
        }
        memcpy(request->capture[captures], path, length);
        request->capture[captures++][length] = '\0';
        path += length;
        pattern += 2;
    }
    return *path == '\0';
}

static bool method_fits(const struct route *route, const char *method)
{
    return strcmp(route->method, method) == 0 ||
           (strcmp(method, "HEAD") == 0 && strcmp(route->method, "GET") == 0);
}

static void add_method(char *list, size_t size, const char *method)
{
    size_t used = strlen(list);

    snprintf(list + used, size - used, "%s%s", used ? ", " : "", method);
}

const struct route *routes_find(struct request *request, struct response *out)
{
    char allowed[80] = "";

    for (size_t i = 0; i < ROUTE_COUNT; i++) {
        if (!match(table[i].pattern, request)) {
            continue;
        }
        if (method_fits(&table[i], request->method)) {
            return &table[i];
        }
        add_method(allowed, sizeof(allowed), table[i].method);
        if (strcmp(table[i].method, "GET") == 0) {
            add_method(allowed, sizeof(allowed), "HEAD");
        }
    }
    bool under_api = strncmp(request->path, "/v1/", 4) == 0 || strcmp(request->path, "*") == 0;
    if (!*allowed && !under_api && method_fits(&asset_route, request->method)) {
        return &asset_route;
    }
    if (*allowed || !under_api) {
        *out = response_problem(405, "invalid", "", "this address does not know the method");
        response_add(out, "Allow", "%s", *allowed ? allowed : "GET, HEAD");
    } else {
        *out = response_problem(404, "not_found", "", "there is nothing at this address");
    }
    return NULL;
}
