/* SPDX-License-Identifier: MIT */
#include "questions.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "protocol/json.h"
#include "protocol/limits.h"
#include "protocol/memory.h"

enum state { WAITING, RUNNING, DONE, FAILED, CANCELLED };

static const char *const state_names[] = {"waiting", "running", "done", "failed", "cancelled"};

struct question {
    struct questions *questions;
    char id[QUESTION_ID_BYTES];
    char *client;
    struct record asked;
    enum state state;
    bool in_hands; /* of a thread, or of the tasks */
    char **steps;  /* JSON, as the program has printed it */
    size_t count;
    char *answer; /* JSON; NULL: none yet */
    struct error err;
    struct question *next;
};

struct questions {
    struct algebra *algebra;
    pthread_mutex_t lock;   /* guards all that follows, and the questions in it */
    struct question *first; /* the newest */
};

struct questions *questions_create(struct algebra *algebra)
{
    struct questions *questions = memory_alloc(1, sizeof *questions);

    questions->algebra = algebra;
    pthread_mutex_init(&questions->lock, NULL);
    return questions;
}

static void question_destroy(struct question *question)
{
    for (size_t i = 0; i < question->count; i++) {
        free(question->steps[i]);
    }
    free(question->steps);
    free(question->answer);
    record_finish(&question->asked);
    free(question->client);
    free(question);
}

void questions_destroy(struct questions *questions)
{
    if (!questions) {
        return;
    }
    while (questions->first) {
        struct question *next = questions->first->next;
        question_destroy(questions->first);
        questions->first = next;
    }
    pthread_mutex_destroy(&questions->lock);
    free(questions);
}

static struct question *find(const struct questions *questions, const struct record_type *type,
                             const char *id)
{
    struct question *question = questions->first;

    while (question && (question->asked.type != type || strcmp(question->id, id) != 0)) {
        question = question->next;
    }
    return question;
}

/* --- answering one --- */

static void keep_step(void *data, const char *line)
{
    struct question *question = data;

    pthread_mutex_lock(&question->questions->lock);
    question->steps = memory_open_slot(question->steps, question->count, question->count);
    question->steps[question->count++] = memory_text(line);
    const bool cancelled = question->state == CANCELLED;
    pthread_mutex_unlock(&question->questions->lock);
    if (cancelled) { /* before the process had started */
        algebra_cancel(question->questions->algebra, question);
    }
}

/* True: it is to be answered. */
static bool begin(struct question *question, bool dropped)
{
    pthread_mutex_lock(&question->questions->lock);
    const bool wanted = !dropped && question->state == WAITING;
    question->state = wanted ? RUNNING : CANCELLED;
    pthread_mutex_unlock(&question->questions->lock);
    return wanted;
}

/* Takes `answer`. */
static void end(struct question *question, bool made, cJSON *answer, const struct error *err)
{
    char *text = made ? json_print(answer, false) : NULL;

    cJSON_Delete(answer);
    pthread_mutex_lock(&question->questions->lock);
    if (question->state == RUNNING) {
        question->state = made ? DONE : FAILED;
        question->answer = text;
        question->err = *err;
        text = NULL;
    }
    question->in_hands = false;
    pthread_mutex_unlock(&question->questions->lock);
    free(text);
}

static void answer(void *data, bool dropped)
{
    struct question *question = data;
    struct error err = {0};
    cJSON *found = NULL;
    const bool made =
        begin(question, dropped) && algebra_ask(question->questions->algebra, &question->asked,
                                                keep_step, question, &found, &err);

    end(question, made, found, &err);
}

/* --- the list --- */

static bool make_id(char out[QUESTION_ID_BYTES], struct error *err)
{
    unsigned char bytes[(QUESTION_ID_BYTES - 1) / 2];

    if (getrandom(bytes, sizeof bytes, 0) != sizeof bytes) {
        return error_set(err, ERROR_INTERNAL, "", "no random numbers");
    }
    for (size_t i = 0; i < sizeof bytes; i++) {
        snprintf(out + 2 * i, 3, "%02x", bytes[i]);
    }
    return true;
}

/* The link to the oldest one that is over, of `client`; NULL: of anybody. `*out_count`: how many
 * there are. NULL: none is over. */
static struct question **find_oldest(struct questions *questions, const char *client,
                                     int *out_count)
{
    struct question **oldest = NULL;

    *out_count = 0;
    for (struct question **at = &questions->first; *at; at = &(*at)->next) {
        if (!client || strcmp((*at)->client, client) == 0) {
            oldest = (*at)->in_hands ? oldest : at;
            ++*out_count;
        }
    }
    return oldest;
}

static void drop(struct question **at)
{
    struct question *over = *at;

    *at = over->next;
    question_destroy(over);
}

/* Drops the oldest one that is over where there are as many as are kept, of the client or of all.
 * Under the lock. */
static bool make_room(struct questions *questions, const char *client, struct error *err)
{
    int count;
    struct question **oldest = find_oldest(questions, client, &count);

    if (count >= LIMIT_ALGEBRA_SHARE) {
        if (!oldest) {
            err->retry_ms = 1000;
            return error_set(err, ERROR_SHARE, "",
                             "%d questions are being answered for this client (algebra_share)",
                             LIMIT_ALGEBRA_SHARE);
        }
        drop(oldest);
    }
    oldest = find_oldest(questions, NULL, &count);
    if (count < LIMIT_ALGEBRA_KEPT) {
        return true;
    }
    if (!oldest) {
        return error_set(err, ERROR_UNAVAILABLE, "",
                         "%d questions are being answered (algebra_kept)", LIMIT_ALGEBRA_KEPT);
    }
    drop(oldest);
    return true;
}

bool questions_add(struct questions *questions, const char *client, const struct record *asked,
                   char out_id[QUESTION_ID_BYTES], struct error *err)
{
    struct question *question = memory_alloc(1, sizeof *question);

    question->questions = questions;
    question->client = memory_text(client);
    record_copy(&question->asked, asked);
    pthread_mutex_lock(&questions->lock);
    bool ok = make_id(question->id, err) && make_room(questions, client, err);
    if (ok) {
        question->in_hands = true;
        question->next = questions->first;
        questions->first = question;
    }
    pthread_mutex_unlock(&questions->lock);
    if (!ok) {
        question_destroy(question);
        return false;
    }
    snprintf(out_id, QUESTION_ID_BYTES, "%s", question->id);
    ok = algebra_add(questions->algebra, client, answer, question, err);
    if (!ok) {
        end(question, false, NULL, err); /* nobody knows its id */
    }
    return ok;
}

/* --- looking on --- */

static cJSON *describe_error(const struct error *err)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "code", error_kind_name(err->kind));
    cJSON_AddStringToObject(json, "place", err->place);
    cJSON_AddStringToObject(json, "message", err->message);
    if (err->line) {
        cJSON_AddNumberToObject(json, "line", err->line);
        cJSON_AddNumberToObject(json, "column", err->column);
    }
    return json;
}

/* Under the lock: what is JSON already is only copied. */
static cJSON *describe(const struct question *question, size_t from)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "state", state_names[question->state]);
    cJSON *steps = cJSON_AddArrayToObject(json, "steps");
    for (size_t i = from; i < question->count; i++) {
        cJSON_AddItemToArray(steps, cJSON_CreateRaw(question->steps[i]));
    }
    cJSON_AddNumberToObject(json, "next", (double)question->count);
    if (question->state == DONE) {
        cJSON_AddRawToObject(json, "answer", question->answer);
    } else if (question->state == FAILED) {
        cJSON_AddItemToObject(json, "error", describe_error(&question->err));
    }
    return json;
}

cJSON *questions_look(struct questions *questions, const struct record_type *type, const char *id,
                      size_t from)
{
    pthread_mutex_lock(&questions->lock);
    const struct question *question = find(questions, type, id);
    cJSON *json = question ? describe(question, from) : NULL;
    pthread_mutex_unlock(&questions->lock);
    return json;
}

bool questions_cancel(struct questions *questions, const struct record_type *type, const char *id)
{
    pthread_mutex_lock(&questions->lock);
    struct question *question = find(questions, type, id);
    const bool runs = question && question->state == RUNNING;
    if (question && (runs || question->state == WAITING)) {
        question->state = CANCELLED;
    }
    pthread_mutex_unlock(&questions->lock);
    if (runs) {
        algebra_cancel(questions->algebra, question);
    }
    return question != NULL;
}
