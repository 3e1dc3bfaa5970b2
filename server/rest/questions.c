/* SPDX-License-Identifier: MIT */
/* Questions of the algebra over HTTP: begun, looked at while they are answered, cancelled. */
#include <errno.h>
#include <stdlib.h>

#include "protocol/ideal.h"
#include "protocol/json.h"
#include "protocol/surface.h"
#include "routes.h"
#include "server/live/hub.h"
#include "server/questions.h"

static void reply_begun(struct request *request, const char *road, const char *id)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "id", id);
    struct response response = response_json(202, json);
    response_add(&response, "Location", "/v1/%s/%s", road, id);
    request_reply(request, &response);
}

void question_begin(struct request *request, const char *road, const struct record *asked)
{
    struct error err = {0};
    char id[QUESTION_ID_BYTES];

    if (questions_add(request->hub->questions, request->client, asked, id, &err)) {
        reply_begun(request, road, id);
    } else {
        request_reply_error(request, &err);
    }
}

static void reply_missing(struct request *request)
{
    struct error err = {0};

    error_set(&err, ERROR_NOT_FOUND, "", "there is no question %s; the newest %d are kept",
              request->capture[0], LIMIT_ALGEBRA_KEPT);
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

static void look(struct request *request, const struct record_type *type)
{
    struct error err = {0};
    size_t from;

    if (!read_from(request, &from, &err)) {
        request_reply_error(request, &err);
        return;
    }
    cJSON *json = questions_look(request->hub->questions, type, request->capture[0], from);
    if (json) {
        request_reply_json(request, 200, json);
    } else {
        reply_missing(request);
    }
}

static void cancel(struct request *request, const struct record_type *type)
{
    const struct response done = {.status = 204, .body = "", .borrowed = true};

    if (questions_cancel(request->hub->questions, type, request->capture[0])) {
        request_reply(request, &done);
    } else {
        reply_missing(request);
    }
}

/* --- Groebner bases --- */

void groebner_begin(struct request *request)
{
    struct error err = {0};
    struct record asked;
    cJSON *json = json_parse(request->body, request->body_length, &err);

    record_init(&asked, &ideal_type);
    if (json && record_read(&asked, json, "", &err)) {
        question_begin(request, "groebner", &asked);
    } else {
        request_reply_error(request, &err);
    }
    record_finish(&asked);
    cJSON_Delete(json);
}

void groebner_look(struct request *request)
{
    look(request, &ideal_type);
}

void groebner_cancel(struct request *request)
{
    cancel(request, &ideal_type);
}

/* --- equations of parametric surfaces --- */

void implicitize_look(struct request *request)
{
    look(request, &surface_question_type);
}

void implicitize_cancel(struct request *request)
{
    cancel(request, &surface_question_type);
}
