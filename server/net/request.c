/* SPDX-License-Identifier: MIT */
/* What does not depend on the HTTP library; what needs the connection is in http.c. */
#include "request.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "protocol/json.h"
#include "protocol/memory.h"

static int hex_digit(char c)
{
    static const char digits[] = "0123456789abcdef";
    const char *at = c ? strchr(digits, c >= 'A' && c <= 'F' ? c + 32 : c) : NULL;

    return at ? (int)(at - digits) : -1;
}

/* NULL: a bad escape, or one for a control character. */
static char *decode(const char *text, size_t length, bool plus_is_space)
{
    char *out = memory_alloc(length + 1, 1);
    size_t used = 0;

    for (size_t i = 0; i < length; i++) {
        int c = (unsigned char)text[i];

        if (c == '%') {
            const int high = i + 2 < length ? hex_digit(text[i + 1]) : -1;
            const int low = i + 2 < length ? hex_digit(text[i + 2]) : -1;
            c = high < 0 || low < 0 ? 0 : high * 16 + low;
            i += 2;
        } else if (c == '+' && plus_is_space) {
            c = ' ';
        }
        if (c < ' ' || c == 0x7f) {
            free(out);
            return NULL;
        }
        out[used++] = (char)c;
    }
    return out;
}

static bool add_query(struct request *request, const char *text, size_t length, struct error *err)
{
    const char *equals = memchr(text, '=', length);
    const size_t name_length = equals ? (size_t)(equals - text) : length;

    if (length == 0) {
        return true;
    }
    if (request->query_count == REQUEST_QUERIES) {
        return error_set(err, ERROR_LIMIT, "?", "more than %d query parameters", REQUEST_QUERIES);
    }
    struct request_pair *pair = &request->query[request->query_count++];
    pair->name = decode(text, name_length, true);
    pair->value = equals ? decode(equals + 1, length - name_length - 1, true) : memory_text("");
    return (pair->name && pair->value) ||
           error_set(err, ERROR_SYNTAX, "?", "a percent escape is malformed");
}

bool request_parse_target(struct request *request, const char *target, struct error *err)
{
    if (strncasecmp(target, "http://", 7) == 0) {
        target += 7 + strcspn(target + 7, "/?");
    }
    size_t path_length = strcspn(target, "?");
    const char *query = target + path_length;

    if (path_length == 0) {
        target = "/";
        path_length = 1;
    }
    /* Who guards paths in front of us would take such a segment for one. */
    const char *slash = strcasestr(target, "%2f");
    if (slash && slash < target + path_length) {
        return error_set(err, ERROR_SYNTAX, "", "a path may not hold %%2F");
    }
    request->path = decode(target, path_length, false);
    if (!request->path) {
        return error_set(err, ERROR_SYNTAX, "", "a percent escape in the path is malformed");
    }
    while (*query) {
        query++;
        const size_t length = strcspn(query, "&");

        if (!add_query(request, query, length, err)) {
            return false;
        }
        query += length;
    }
    return true;
}

void request_finish(struct request *request)
{
    for (size_t i = 0; i < request->query_count; i++) {
        free(request->query[i].name);
        free(request->query[i].value);
    }
    free(request->path);
    free(request->body);
}

const char *request_header(const struct request *request, const char *name)
{
    return request->header(request, name);
}

const char *request_query(const struct request *request, const char *name)
{
    for (size_t i = 0; i < request->query_count; i++) {
        if (strcmp(request->query[i].name, name) == 0) {
            return request->query[i].value;
        }
    }
    return NULL;
}

bool request_check_query(const struct request *request, const char *const *names, struct error *err)
{
    for (size_t i = 0; i < request->query_count; i++) {
        const char *const *name = names;
        char place[100];

        while (*name && strcmp(*name, request->query[i].name) != 0) {
            name++;
        }
        snprintf(place, sizeof place, "?%s", request->query[i].name);
        if (!*name) {
            return error_set(err, ERROR_INVALID, place, "there is no such parameter");
        }
        if (request_query(request, *name) != request->query[i].value) {
            return error_set(err, ERROR_INVALID, place, "given twice");
        }
    }
    return true;
}

/* --- conditions (RFC 9110, 13.1) --- */

/* Behind the tag that `list` begins with, quotes and all. */
static const char *tag_end(const char *list)
{
    const char *end = list + strcspn(list, ", \t\"");

    if (*end == '"') {
        end++;
        end += strcspn(end, "\"");
        end += *end == '"';
    }
    return end;
}

/* `weak`: a tag that is weak (`W/`) names the same as one that is not. */
static bool is_listed(const char *list, const char *tag, bool weak)
{
    const size_t wanted = strlen(tag);

    while (list && *list) {
        const char *end = tag_end(list += strspn(list, ", \t"));

        list += weak && strncmp(list, "W/", 2) == 0 ? 2 : 0;
        if ((*list == '*' && list + 1 == end) ||
            ((size_t)(end - list) == wanted && strncmp(list, tag, wanted) == 0)) {
            return true;
        }
        list = end;
    }
    return false;
}

bool request_knows_tag(const struct request *request, const char *tag)
{
    return is_listed(request_header(request, "If-None-Match"), tag, true);
}

bool request_check_match(const struct request *request, const char *tag, struct error *err)
{
    const char *match = request_header(request, "If-Match");

    if (!tag) {
        return !match || error_set(err, ERROR_PRECONDITION, "If-Match", "there is nothing yet");
    }
    if (match && !is_listed(match, tag, false)) {
        return error_set(err, ERROR_PRECONDITION, "If-Match", "the tag is %s", tag);
    }
    return !request_knows_tag(request, tag) ||
           error_set(err, ERROR_PRECONDITION, "If-None-Match", "the tag is %s", tag);
}

/* --- codings (RFC 9110, 12.5.3) --- */

/* What may follow the name of a coding: `;q=0` refuses it. */
static bool has_weight(const char *after)
{
    after += strspn(after, "; \t");
    return strncasecmp(after, "q=", 2) != 0 || strtod(after + 2, NULL) > 0;
}

bool request_wants_gzip(const struct request *request)
{
    const char *list = request_header(request, "Accept-Encoding");
    bool others = false; /* those that are not named */

    while (list && *list) {
        list += strspn(list, ", \t");
        const size_t length = strcspn(list, ",; \t");

        if (length == 4 && strncasecmp(list, "gzip", length) == 0) {
            return has_weight(list + length);
        }
        if (length == 1 && *list == '*') {
            others = has_weight(list + length);
        }
        list += strcspn(list, ",");
    }
    return others;
}

/* --- responses --- */

void response_add(struct response *response, const char *name, const char *format, ...)
{
    va_list arguments;

    if (response->header_count == RESPONSE_HEADERS) {
        abort();
    }
    response->headers[response->header_count].name = name;
    va_start(arguments, format);
    vsnprintf(response->headers[response->header_count].value, sizeof response->headers->value,
              format, arguments);
    va_end(arguments);
    response->header_count++;
}

const char *response_title(int status)
{
    static const struct {
        int status;
        const char *title;
    } titles[] = {{400, "Bad Request"},
                  {401, "Unauthorized"},
                  {403, "Forbidden"},
                  {404, "Not Found"},
                  {405, "Method Not Allowed"},
                  {408, "Request Timeout"},
                  {409, "Conflict"},
                  {412, "Precondition Failed"},
                  {413, "Content Too Large"},
                  {415, "Unsupported Media Type"},
                  {422, "Unprocessable Content"},
                  {426, "Upgrade Required"},
                  {429, "Too Many Requests"},
                  {500, "Internal Server Error"},
                  {503, "Service Unavailable"},
                  {507, "Insufficient Storage"}};

    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        if (titles[i].status == status) {
            return titles[i].title;
        }
    }
    return "Error";
}

struct response response_text(int status, const char *type, char *text)
{
    return (struct response){.status = status, .type = type, .body = text, .length = strlen(text)};
}

struct response response_json(int status, cJSON *json)
{
    char *text = json_print(json, false);

    cJSON_Delete(json);
    return response_text(status, "application/json", text);
}

/* What `err` knows besides code, place and message is left out where it is 0. */
static struct response problem(int status, const char *code, const struct error *err)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "type", "about:blank");
    cJSON_AddStringToObject(json, "title", response_title(status));
    cJSON_AddNumberToObject(json, "status", status);
    cJSON_AddStringToObject(json, "detail", err->message);
    cJSON_AddStringToObject(json, "code", code);
    cJSON_AddStringToObject(json, "place", err->place);
    if (err->line > 0) {
        cJSON_AddNumberToObject(json, "line", err->line);
        cJSON_AddNumberToObject(json, "column", err->column);
    }
    if (err->limit_ms > 0) {
        cJSON_AddNumberToObject(json, "measured", err->measured_ms);
        cJSON_AddNumberToObject(json, "limit", err->limit_ms);
    }
    if (err->position > 0) {
        cJSON_AddNumberToObject(json, "position", err->position);
    }
    struct response response = response_json(status, json);
    response.type = "application/problem+json";
    if (status == 503 || status == 429) {
        response_add(&response, "Retry-After", "%d",
                     err->retry_ms > 0 ? (err->retry_ms + 999) / 1000 : 1);
    } else if (status == 401) {
        response_add(&response, "WWW-Authenticate", "Bearer realm=\"fieldcast\"");
    }
    return response;
}

struct response response_problem(int status, const char *code, const char *place,
                                 const char *detail)
{
    struct error err = {0};

    error_set(&err, ERROR_NONE, place, "%s", detail);
    return problem(status, code, &err);
}

struct response response_error(const struct error *err)
{
    return problem(error_kind_status(err->kind), error_kind_name(err->kind), err);
}

void request_reply_error(struct request *request, const struct error *err)
{
    struct response response = response_error(err);

    request_reply(request, &response);
}

void request_reply_json(struct request *request, int status, cJSON *json)
{
    struct response response = response_json(status, json);

    request_reply(request, &response);
}
