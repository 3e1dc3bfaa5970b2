/* SPDX-License-Identifier: MIT */
/* Equations over HTTP: those of parametric surfaces found and proved, those of a scene judged, and
 * texts typeset. */
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/nodes.h"
#include "protocol/typeset.h"
#include "routes.h"
#include "server/algebra.h"
#include "server/live/hub.h"
#include "server/live/scene_quality.h"

struct question {
    struct request *request;
    bool (*ask)(struct algebra *algebra, const struct question *question, cJSON **out,
                struct error *err);
    struct record asked; /* surface_question_type, or the parameters of an `implicit` */
};

static void question_destroy(struct question *question)
{
    record_finish(&question->asked);
    free(question);
}

/* "x" becomes "/x". */
static void reply_error(struct request *request, struct error *err)
{
    char place[ERROR_PLACE_BYTES];

    if (err->place[0] && err->place[0] != '/') {
        snprintf(err->place, sizeof err->place, "%s", error_place(place, "", err->place));
    }
    request_reply_error(request, err);
}

static void answer(void *data, bool dropped)
{
    struct question *question = data;
    struct error err = {0};
    cJSON *json = NULL;

    if (dropped) {
        error_set(&err, ERROR_UNAVAILABLE, "", "the server is shutting down");
        request_reply_error(question->request, &err);
    } else if (question->ask(question->request->hub->algebra, question, &json, &err)) {
        request_reply_json(question->request, 200, json);
    } else {
        reply_error(question->request, &err);
    }
    question_destroy(question);
}

static void wait_in_turn(struct request *request, struct question question,
                         bool (*read)(struct question *, const cJSON *, struct error *))
{
    struct error err = {0};
    struct question *kept = memory_alloc(1, sizeof *kept);
    cJSON *json = json_parse(request->body, request->body_length, &err);

    *kept = question;
    kept->request = request;
    const bool ok = json && read(kept, json, &err) &&
                    algebra_add(request->hub->algebra, request->client, answer, kept, &err);
    cJSON_Delete(json);
    if (!ok) {
        reply_error(request, &err);
        question_destroy(kept);
    }
}

/* --- implicitize --- */

static bool ask_equation(struct algebra *algebra, const struct question *question, cJSON **out,
                         struct error *err)
{
    return algebra_ask(algebra, &question->asked, NULL, NULL, out, err);
}

static bool read_asked(struct question *out, const cJSON *json, struct error *err)
{
    record_init(&out->asked, &surface_question_type);
    return surface_question_read(&out->asked, json, err);
}

/* The client looks at what it has begun. */
static void begin(struct request *request)
{
    struct error err = {0};
    struct question question = {.request = request};
    cJSON *json = json_parse(request->body, request->body_length, &err);

    if (json && read_asked(&question, json, &err)) {
        question_begin(request, "implicitize", &question.asked);
    } else {
        reply_error(request, &err);
    }
    record_finish(&question.asked);
    cJSON_Delete(json);
}

static bool read_wait(const struct request *request, bool *out, struct error *err)
{
    static const char *const queries[] = {"wait", NULL};
    const char *text = request_query(request, "wait");

    *out = !text || strcmp(text, "yes") == 0;
    return request_check_query(request, queries, err) &&
           (*out || strcmp(text, "no") == 0 ||
            error_set(err, ERROR_INVALID, "?wait", "%.40s is neither yes nor no", text));
}

void equations_implicitize(struct request *request)
{
    struct error err = {0};
    bool wait;

    if (!read_wait(request, &wait, &err)) {
        request_reply_error(request, &err);
    } else if (wait) {
        wait_in_turn(request, (struct question){.ask = ask_equation}, read_asked);
    } else {
        begin(request);
    }
}

/* --- verify --- */

static bool ask_verdict(struct algebra *algebra, const struct question *question, cJSON **out,
                        struct error *err)
{
    struct algebra_proof proof;

    if (!algebra_verify(algebra, &question->asked, &proof, err)) {
        return false;
    }
    *out = cJSON_CreateObject();
    cJSON_AddStringToObject(*out, "verdict", surface_verdicts[proof.verdict]);
    cJSON_AddStringToObject(*out, "reason", proof.reason);
    if (proof.coverage) {
        cJSON_AddItemToObject(*out, "coverage", proof.coverage);
    }
    return true;
}

static bool read_params(struct question *out, const cJSON *json, struct error *err)
{
    record_init(&out->asked, &node_type_find("implicit")->record);
    return record_read(&out->asked, json, "", err);
}

void equations_verify(struct request *request)
{
    wait_in_turn(request, (struct question){.ask = ask_verdict}, read_params);
}

/* --- judge --- */

void equations_judge(struct request *request)
{
    static const char *const queries[] = {"node", NULL};
    struct error err = {0};
    cJSON *json =
        request_check_query(request, queries, &err)
            ? scene_quality(request->hub, request->capture[0], request_query(request, "node"), &err)
            : NULL;

    if (json) {
        request_reply_json(request, 200, json);
    } else {
        request_reply_error(request, &err);
    }
}

/* --- typeset --- */

void equations_typeset(struct request *request)
{
    struct error err = {0};
    struct record asked;
    cJSON *json = json_parse(request->body, request->body_length, &err);

    record_init(&asked, &typeset_type);
    if (json && record_read(&asked, json, "", &err)) {
        request_reply_json(request, 200, typeset(&asked));
    } else {
        request_reply_error(request, &err);
    }
    record_finish(&asked);
    cJSON_Delete(json);
}
