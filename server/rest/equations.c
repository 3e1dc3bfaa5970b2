/* SPDX-License-Identifier: MIT */
/* Equations of parametric surfaces over HTTP. */
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "routes.h"
#include "server/algebra.h"
#include "server/live/hub.h"

static const char *const parts[] = {"x", "y", "z", NULL};

struct question {
    struct request *request;
    char *texts[3];
};

static void question_destroy(struct question *question)
{
    for (int i = 0; i < 3; i++) {
        free(question->texts[i]);
    }
    free(question);
}

static bool read_question(const struct request *request, struct question *out, struct error *err)
{
    const cJSON *found[3] = {NULL};
    cJSON *json = json_parse(request->body, request->body_length, err);
    bool ok = json && json_sort_members(json, parts, found, "", err);
    for (int i = 0; ok && i < 3; i++) {
        const char *text;
        ok = json_read_text(found[i], &text, "", parts[i], err);
        out->texts[i] = ok ? memory_text(text) : NULL;
    }
    cJSON_Delete(json);
    return ok;
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
    } else if (algebra_implicitize(question->request->hub->algebra,
                                   (const char *const *)question->texts, &json, &err)) {
        request_reply_json(question->request, 200, json);
    } else {
        reply_error(question->request, &err);
    }
    question_destroy(question);
}

void equations_implicitize(struct request *request)
{
    struct error err = {0};
    struct question *question = memory_alloc(1, sizeof *question);
    question->request = request;
    if (!read_question(request, question, &err) ||
        !algebra_add(request->hub->algebra, request->client, answer, question, &err)) {
        request_reply_error(request, &err);
        question_destroy(question);
    }
}
