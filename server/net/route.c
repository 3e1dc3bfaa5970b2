/* SPDX-License-Identifier: MIT */
#include "route.h"

#include <stdio.h>
#include <string.h>

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
    const size_t used = strlen(list);

    snprintf(list + used, size - used, "%s%s", used ? ", " : "", method);
}

const struct route *route_find(const struct route_table *table, struct request *request,
                               struct response *out)
{
    char allowed[80] = "";

    for (size_t i = 0; i < table->count; i++) {
        const struct route *route = &table->rows[i];

        if (!match(route->pattern, request)) {
            continue;
        }
        if (method_fits(route, request->method)) {
            return route;
        }
        add_method(allowed, sizeof allowed, route->method);
        if (strcmp(route->method, "GET") == 0) {
            add_method(allowed, sizeof allowed, "HEAD");
        }
    }
    const bool under_api =
        strncmp(request->path, "/v1/", 4) == 0 || strcmp(request->path, "*") == 0;
    if (!*allowed && !under_api && method_fits(table->file, request->method)) {
        return table->file;
    }
    if (*allowed || !under_api) {
        *out = response_problem(405, "invalid", "", "this address does not know the method");
        response_add(out, "Allow", "%s", *allowed ? allowed : "GET, HEAD");
    } else {
        *out = response_problem(404, "not_found", "", "there is nothing at this address");
    }
    return NULL;
}
