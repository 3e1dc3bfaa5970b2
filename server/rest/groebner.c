/* SPDX-License-Identifier: MIT */
/* Groebner bases over HTTP: begun, looked at while they are made, cancelled. */
#include <errno.h>
#include <stdlib.h>

#include "protocol/ideal.h"
#include "protocol/json.h"
#include "routes.h"
#include "server/bases.h"
#include "server/live/hub.h"

static void reply_begun(struct request *request, const char *id)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "id", id);
    struct response response = response_json(202, json);
    response_add(&response, "Location", "/v1/groebner/%s", id);
    request_reply(request, &response);
}

void groebner_begin(struct request *request)
{
    struct error err = {0};
    struct record asked;
    char id[BASIS_ID_BYTES];
    cJSON *json = json_parse(request->body, request->body_length, &err);

    record_init(&asked, &ideal_type);
    const bool ok = json && record_read(&asked, json, "", &err) &&
                    bases_add(request->hub->bases, request->client, &asked, id, &err);
    record_finish(&asked);
    cJSON_Delete(json);
    if (ok) {
        reply_begun(request, id);
    } else {
        request_reply_error(request, &err);
    }
}

static void reply_missing(struct request *request)
{
    struct error err = {0};

    error_set(&err, ERROR_NOT_FOUND, "", "there is no basis %s; the newest %d are kept",
              request->capture[0], LIMIT_GROEBNER_KEPT);
    request_reply_error(request, &err);
}

static bool read_from(const struct request *request, size_t *out, struct error *err)
{
    static const char *const queries[] = {"from", NULL};
    const char *text = request_query(request, "from");
    char *end = NULL;

    if (!request_check_query(request, queries, err)) {
        return false;
    }
    errno = 0;
    *out = text ? strtoul(text, &end, 10) : 0;
    return !text || (text[0] >= '0' && text[0] <= '9' && !*end && !errno) ||
           error_set(err, ERROR_INVALID, "?from", "%.40s is no number of a step", text);
}

void groebner_look(struct request *request)
{
    struct error err = {0};
    size_t from;

    if (!read_from(request, &from, &err)) {
        request_reply_error(request, &err);
        return;
    }
    cJSON *json = bases_look(request->hub->bases, request->capture[0], from);
    if (json) {
        request_reply_json(request, 200, json);
    } else {
        reply_missing(request);
    }
}

void groebner_cancel(struct request *request)
{
    const struct response done = {.status = 204, .body = "", .borrowed = true};

    if (bases_cancel(request->hub->bases, request->capture[0])) {
        request_reply(request, &done);
    } else {
        reply_missing(request);
    }
}
