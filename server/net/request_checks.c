/* SPDX-License-Identifier: MIT */
#include "request_checks.h"

#include <inttypes.h>
#include <microhttpd.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "access.h"
#include "http_app.h"
#include "http_head.h"
#include "route.h"

/* --- framing --- */

enum { SINGLE_HOST, SINGLE_LENGTH, SINGLE_CODING, SINGLE_COUNT };
static const char *const single[SINGLE_COUNT] = {"Host", "Content-Length", "Transfer-Encoding"};

struct field_check {
    struct http_head_fault fault;
    bool seen[SINGLE_COUNT];
    bool ok;
};

/* libmicrohttpd puts a line that continues a field behind the field's name, in a copy at the end of
 * its memory, and leaves the value where it was: "Content-Length: 3" with " 0" below is another
 * field, and the body would be read as the next request. */
static bool is_folded(const char *name, size_t name_length, const char *value)
{
    return value && (uintptr_t)value < (uintptr_t)(name + name_length);
}

static enum MHD_Result check_field(void *data, enum MHD_ValueKind kind, const char *name,
                                   size_t name_length, const char *value, size_t value_length)
{
    struct field_check *check = data;

    (void)kind;
    check->ok =
        http_head_field_check(name, name_length, value ? value : "", value_length, &check->fault);
    if (check->ok && is_folded(name, name_length, value)) {
        check->fault = (struct http_head_fault){400, "a header is folded over lines"};
        check->ok = false;
    }
    for (int i = 0; i < SINGLE_COUNT && check->ok; i++) {
        if (strcasecmp(name, single[i]) != 0) {
            continue;
        }
        if (check->seen[i]) {
            check->fault = (struct http_head_fault){400, "a header that may come once comes twice"};
            check->ok = false;
        }
        check->seen[i] = true;
    }
    return check->ok ? MHD_YES : MHD_NO;
}

bool request_checks_framing(const struct request *request, struct MHD_Connection *connection,
                            const char *version, struct response *out)
{
    struct field_check check = {.ok = true};
    const char *values[SINGLE_COUNT] = {NULL};

    MHD_get_connection_values_n(connection, MHD_HEADER_KIND, check_field, &check);
    for (int i = 0; i < SINGLE_COUNT; i++) {
        const char *value = check.seen[i] ? request_header(request, single[i]) : NULL;

        values[i] = check.seen[i] && !value ? "" : value;
    }
    if (check.ok &&
        http_head_framing_check(values[SINGLE_HOST], values[SINGLE_LENGTH], values[SINGLE_CODING],
                                strcmp(version, "HTTP/1.0") != 0, &check.fault)) {
        return true;
    }
    *out = response_problem(check.fault.status, "syntax", "", check.fault.message);
    response_add(out, "Connection", "close");
    return false;
}

/* --- bodies --- */

size_t request_checks_body_limit(const struct route *route)
{
    const enum route_body body = route ? route->body : BODY_NONE;

    return body == BODY_FILE       ? LIMIT_ASSET_BYTES
           : body == BODY_QUESTION ? LIMIT_QUESTION_BYTES
                                   : LIMIT_DOCUMENT_BYTES;
}

uint64_t request_checks_announced_bytes(const struct request *request)
{
    const char *length = request_header(request, "Content-Length");

    return length ? strtoull(length, NULL, 10) : 0;
}

bool request_checks_has_body(const struct request *request)
{
    return request_checks_announced_bytes(request) > 0 ||
           request_header(request, "Transfer-Encoding") != NULL;
}

static bool is_json(const char *type)
{
    if (!type) {
        return true;
    }
    const size_t length = strcspn(type, "; \t");

    return (length == 16 && strncasecmp(type, "application/json", 16) == 0) ||
           (length > 5 && strncasecmp(type, "application/", 12) == 0 &&
            strncasecmp(type + length - 5, "+json", 5) == 0);
}

static bool check_body(const struct request *request, const struct route *route,
                       struct response *out)
{
    const uint64_t length = request_checks_announced_bytes(request);
    char detail[100];

    if (route->body == BODY_NONE && request_checks_has_body(request)) {
        *out = response_problem(400, "syntax", "", "this request takes no body");
    } else if (length > request_checks_body_limit(route)) {
        snprintf(detail, sizeof detail, "the body of %" PRIu64 " bytes is above the maximum %zu",
                 length, request_checks_body_limit(route));
        *out = response_problem(413, "too_large", "", detail);
    } else if ((route->body == BODY_JSON || route->body == BODY_QUESTION) &&
               !is_json(request_header(request, "Content-Type"))) {
        *out =
            response_problem(415, "invalid", "Content-Type", "the body must be application/json");
    } else {
        return true;
    }
    return false;
}

/* --- who and what --- */

static bool is_navigation(const struct request *request)
{
    const char *mode = request_header(request, "Sec-Fetch-Mode");
    const char *dest = request_header(request, "Sec-Fetch-Dest");

    return mode && strcmp(mode, "navigate") == 0 && dest && strcmp(dest, "document") == 0;
}

static bool check_access(const struct access *access, const struct request *request, bool open,
                         bool page, struct response *out)
{
    struct access_request values = {
        .host = request_header(request, "Host"),
        .origin = request_header(request, "Origin"),
        .authorization = request_header(request, "Authorization"),
        .protocols = request_header(request, "Sec-WebSocket-Protocol"),
        .site = request_header(request, "Sec-Fetch-Site"),
        .to_page = page && is_navigation(request),
    };
    struct error err = {0};
    const int status = access_check(access, &values, open, &err);

    if (status) {
        *out = response_problem(status, status == 401 ? "unauthorized" : error_kind_name(err.kind),
                                err.place, err.message);
    }
    return status == 0;
}

/* Another site's page that may use this server asks first what it may do. */
static struct response preflight(void)
{
    struct response response = {.status = 204, .body = "", .borrowed = true};

    response_add(&response, "Access-Control-Allow-Methods", "GET, POST, PUT, PATCH, DELETE");
    response_add(&response, "Access-Control-Allow-Headers",
                 "Authorization, Content-Type, If-Match, If-None-Match");
    response_add(&response, "Access-Control-Max-Age", "600");
    return response;
}

bool request_checks_pass(const struct http_app *app, struct request *request, const char *target,
                         const struct route **out_route, struct response *out)
{
    struct error err = {0};

    *out_route = NULL;
    if (!target || !request_parse_target(request, target, &err)) {
        *out = response_problem(400, "syntax", err.place, err.message);
        return false;
    }
    const struct route *route = route_find(app->routes, request, out);
    *out_route = route;
    const bool is_preflight = strcmp(request->method, "OPTIONS") == 0 &&
                              request_header(request, "Origin") &&
                              request_header(request, "Access-Control-Request-Method");
    struct response refusal;
    if (!check_access(app->access, request, is_preflight || (route && route->access != GUARDED),
                      route && route->access == PAGE, &refusal)) {
        if (!route) {
            free(out->body);
        }
        *out = refusal;
        return false;
    }
    if (is_preflight) {
        free(out->body);
        *out = preflight();
        return false;
    }
    if (!route) {
        return false;
    }
    if (atomic_load(app->draining) && route->access == GUARDED) {
        *out = response_problem(503, "unavailable", "", "the server is shutting down");
        return false;
    }
    return check_body(request, route, out);
}
