/* SPDX-License-Identifier: MIT */
#include "picker.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "last_good.h"
#include "protocol/accounts.h"
#include "protocol/code_text.h"
#include "protocol/memory.h"
#include "renderer/pick.h"
#include "room_apart.h"
#include "server/clock.h"
#include "server_message.h"
#include "session.h"
#include "stream.h"

struct question {
    struct question *next;
    struct session *session; /* NULL: it asks no longer */
    struct account *account; /* of the session */
    double number;           /* by which its answer is known */
    bool bounds;             /* of what `view` isolates; else what is at x, y */
    double x, y;
    bool through;
    struct render_request view;
};

struct picker {
    struct hub *hub;
    pthread_t thread;
    pthread_cond_t work; /* with the hub's lock */
    bool stop;
    struct question *first;   /* in order of asking */
    struct question *current; /* the thread's; its session may go meanwhile */
    uint64_t turns;           /* questions so far */
    struct accounts accounts;
};

static void question_destroy(struct picker *picker, struct question *question)
{
    accounts_leave(&picker->accounts, question->account);
    render_request_finish(&question->view);
    free(question);
}

/* --- asking --- */

/* Gives up the oldest of a session that has too many of a kind: the answer to a newer one tells the
 * client that this one has none. */
static void make_room(struct picker *picker, const struct session *session, bool bounds)
{
    struct question **oldest = NULL;
    int count = 0;

    for (struct question **at = &picker->first; *at; at = &(*at)->next) {
        if ((*at)->session == session && (*at)->bounds == bounds) {
            oldest = oldest ? oldest : at;
            count++;
        }
    }
    if (count >= PICKER_WAITING) {
        struct question *gone = *oldest;

        *oldest = gone->next;
        question_destroy(picker, gone);
        metric_add(&picker->hub->metrics, METRIC_PICKS_GIVEN_UP, 1);
    }
}

/* `kind`: the member of `message` that has its number. */
static struct question *add_question(struct session *session, const cJSON *message,
                                     const char *kind, bool bounds)
{
    struct picker *picker = session->hub->picker;

    make_room(picker, session, bounds);
    struct question *question = memory_alloc(1, sizeof *question);
    struct question **end = &picker->first;
    question->session = session;
    question->account = accounts_join(&picker->accounts, session->id);
    question->number = json_member_number(message, kind, 0);
    question->bounds = bounds;
    while (*end) {
        end = &(*end)->next;
    }
    *end = question;
    pthread_cond_signal(&picker->work);
    return question;
}

bool picker_ask(struct session *session, const cJSON *message, struct error *err)
{
    const struct stream_view *view =
        stream_find_view(session->stream, (uint32_t)json_member_number(message, "seq", 0));

    if (!view) {
        return error_set(err, ERROR_INVALID, "/seq", "there was no view yet");
    }
    struct question *question = add_question(session, message, "pick", false);
    question->x = json_member_number(message, "x", 0);
    question->y = json_member_number(message, "y", 0);
    question->through = json_member_bool(message, "through", false);
    render_request_copy(&question->view, &view->picture);
    render_request_see_from(&question->view, &session->room->scene->camera);
    return true;
}

void picker_ask_bounds(struct session *session, const struct message *message)
{
    struct question *question = add_question(session, message->json, "bounds", true);

    id_set_copy(&question->view.isolate, &message->nodes);
}

void picker_forget(struct session *session)
{
    struct picker *picker = session->hub->picker;

    if (picker->current && picker->current->session == session) {
        picker->current->session = NULL;
    }
    for (struct question **at = &picker->first; *at;) {
        struct question *question = *at;

        if (question->session != session) {
            at = &question->next;
            continue;
        }
        *at = question->next;
        question_destroy(picker, question);
    }
}

static void empty_field(struct picker_field *picks)
{
    pick_field_unref(picks->field);
    id_set_finish(&picks->isolate);
    *picks = (struct picker_field){0};
}

void picker_finish_room(struct room *room)
{
    for (int i = 0; i < PICKER_FIELDS; i++) {
        empty_field(&room->picks[i]);
    }
}

/* --- the state --- */

/* A copy of the state that is picked in: the newest, for which it may let go of the lock, or the
 * last good one where that is what is shown. NULL: it is of the revision `tried`. */
static struct scene *copy_scene(struct room *room, uint64_t tried, uint64_t *out_revision)
{
    const struct scene *good =
        room->scene_error.kind != ERROR_NONE ? last_good_state(room, out_revision) : NULL;

    if (!good) {
        *out_revision = room->revision;
    }
    if (*out_revision == tried) {
        return NULL;
    }
    if (good) {
        return last_good_copy(room, good);
    }
    return room_copy(room);
}

/* Without the code, where the server runs none. Takes `scene`. */
static struct scene *without_code(struct scene *scene)
{
    cJSON *document = scene_to_json(scene);

    scene_destroy(scene);
    code_text_remove(document);
    scene = scene_read(document, NULL);
    cJSON_Delete(document);
    return scene;
}

/* Takes `scene`. NULL where nothing can be read of it. */
static struct scene *admit(const struct hub *hub, struct scene *scene)
{
    return hub->code_refused && code_text_in_scene(scene) ? without_code(scene) : scene;
}

/* --- the field --- */

/* What the room has for this question, or the least recently used, which is emptied for it. */
static struct picker_field *find_field(struct picker *picker, const struct question *question)
{
    struct picker_field *all = question->session->room->picks, *best = all;

    for (int i = 0; i < PICKER_FIELDS; i++) {
        if (all[i].last_use > 0 && id_set_equal(&all[i].isolate, &question->view.isolate)) {
            return &all[i];
        }
        best = all[i].last_use < best->last_use ? &all[i] : best;
    }
    empty_field(best);
    id_set_copy(&best->isolate, &question->view.isolate);
    best->last_use = picker->turns;
    return best;
}

/* Takes `scene`. NULL where it is no field. */
static struct pick_field *make_field(const struct hub *hub, struct scene *scene,
                                     const struct id_set *isolate)
{
    struct pick_field *field = NULL;

    scene = admit(hub, scene);
    if (scene) {
        field = pick_field_create(scene, (const char *const *)isolate->ids, isolate->count, NULL);
    }
    scene_destroy(scene);
    return field;
}

/* Brings the room's field up to date, unless its session goes meanwhile. Under the lock, which it
 * lets go for the work. A state that is no field leaves the one before. */
static void renew(struct picker *picker, const struct question *question)
{
    struct room *room = question->session->room;
    struct picker_field *picks = find_field(picker, question);
    uint64_t revision = 0;
    struct scene *scene = copy_scene(room, picks->tried, &revision);

    picks->last_use = picker->turns;
    if (!scene) {
        return;
    }
    hub_unlock(picker->hub);
    struct pick_field *field = make_field(picker->hub, scene, &question->view.isolate);
    hub_lock(picker->hub);
    if (!question->session || question->session->room != room) {
        pick_field_unref(field);
        return;
    }
    picks->tried = revision;
    if (field) {
        pick_field_unref(picks->field);
        picks->field = field;
        picks->revision = revision;
    }
}

/* --- answering --- */

static struct pick_result look(const struct pick_field *field, const struct question *question)
{
    const struct record *camera = &question->view.camera, *section = &question->view.section;
    const struct pick_question asked = {
        .camera = record_is_empty(camera) ? NULL : camera,
        .section = record_is_empty(section) ? NULL : section,
        .width = render_request_int(&question->view, "width"),
        .height = render_request_int(&question->view, "height"),
        .x = question->x,
        .y = question->y,
        .through = question->through,
    };

    return field ? pick_at(field, &asked) : (struct pick_result){0};
}

static cJSON *vector_or_null(bool known, const double v[3])
{
    return known ? cJSON_CreateDoubleArray(v, 3) : cJSON_CreateNull();
}

static cJSON *through(const struct pick_result *result)
{
    cJSON *ids = cJSON_CreateArray();

    for (int i = 0; i < result->through_count; i++) {
        cJSON_AddItemToArray(ids, cJSON_CreateString(result->through[i]));
    }
    return ids;
}

static cJSON *answer_begin(const char *type, const char *number, const struct question *question,
                           uint64_t revision)
{
    cJSON *message = message_begin(type);

    cJSON_AddNumberToObject(message, number, question->number);
    cJSON_AddNumberToObject(message, "revision", (double)revision);
    return message;
}

static struct shared_buffer *picked_message(const struct question *question, uint64_t revision,
                                            const struct pick_result *result)
{
    cJSON *message = answer_begin("picked", "pick", question, revision);

    cJSON_AddItemToObject(message, "node",
                          *result->node ? cJSON_CreateString(result->node) : cJSON_CreateNull());
    cJSON_AddItemToObject(message, "position", vector_or_null(result->hit, result->position));
    cJSON_AddItemToObject(message, "normal", vector_or_null(result->hit, result->normal));
    cJSON_AddItemToObject(message, "distance",
                          result->hit ? cJSON_CreateNumber(result->distance) : cJSON_CreateNull());
    if (question->through) {
        cJSON_AddItemToObject(message, "through", through(result));
    }
    return message_print(message);
}

/* Takes `scene`. */
static struct shared_buffer *bounded_message(const struct hub *hub, const struct question *question,
                                             struct scene *scene, uint64_t revision)
{
    const struct id_set *isolate = &question->view.isolate;
    cJSON *message = answer_begin("bounded", "bounds", question, revision);
    double low[3], high[3];

    scene = admit(hub, scene);
    const bool known =
        scene && pick_bounds(scene, (const char *const *)isolate->ids, isolate->count, low, high);
    scene_destroy(scene);
    cJSON_AddItemToObject(message, "low", vector_or_null(known, low));
    cJSON_AddItemToObject(message, "high", vector_or_null(known, high));
    return message_print(message);
}

static void say(const struct question *question, struct shared_buffer *message)
{
    if (question->session) {
        session_say(question->session, message);
    } else {
        shared_buffer_unref(message);
    }
}

/* Under the lock, which it lets go for the work; as answer_pick. Nothing of it is kept: who asks
 * wants to look at something, once. */
static void answer_bounds(struct picker *picker, const struct question *question)
{
    uint64_t revision = 0;
    struct scene *scene = copy_scene(question->session->room, UINT64_MAX, &revision);

    hub_unlock(picker->hub);
    struct shared_buffer *message = bounded_message(picker->hub, question, scene, revision);
    hub_lock(picker->hub);
    say(question, message);
}

static void answer_pick(struct picker *picker, const struct question *question)
{
    renew(picker, question);
    if (!question->session || !question->session->room) {
        return;
    }
    const struct picker_field *picks = find_field(picker, question);
    const uint64_t revision = picks->field ? picks->revision : picks->tried;
    struct pick_field *field = picks->field ? pick_field_ref(picks->field) : NULL;

    hub_unlock(picker->hub);
    const struct pick_result result = look(field, question);
    struct shared_buffer *message = picked_message(question, revision, &result);
    pick_field_unref(field);
    hub_lock(picker->hub);
    say(question, message);
}

/* The oldest of the session that took the least time. NULL: all rest, one until `*out_until`. */
static struct question *take(struct picker *picker, int64_t *out_until)
{
    struct question **best = NULL;
    const int64_t now_us = clock_us();

    *out_until = 0;
    for (struct question **at = &picker->first; *at; at = &(*at)->next) {
        const int64_t rest_us = (*at)->session->picks_rest_us;

        if (rest_us > now_us) {
            *out_until = clock_earlier(*out_until, rest_us);
        } else if (!best || account_is_before((*at)->account, (*best)->account)) {
            best = at;
        }
    }
    if (!best) {
        return NULL;
    }
    struct question *question = *best;
    *best = question->next;
    accounts_begin(&picker->accounts, question->account);
    picker->turns++;
    return question;
}

static void charge(struct picker *picker, struct question *question, int64_t spent_us)
{
    struct session *session = question->session;
    const int64_t now_us = clock_us();

    accounts_charge(question->account, spent_us);
    if (session) {
        const int64_t rest_us = workload_charge(&session->picks, now_us, spent_us);

        session->picks_rest_us = now_us + rest_us;
        metric_add(&picker->hub->metrics, METRIC_PICK_RESTS, rest_us > 0);
    }
}

static void serve(struct picker *picker, struct question *question)
{
    const int64_t begun_us = clock_thread_us();

    picker->current = question;
    if (question->bounds) {
        answer_bounds(picker, question);
    } else {
        answer_pick(picker, question);
    }
    charge(picker, question, clock_thread_us() - begun_us);
    question_destroy(picker, question);
    picker->current = NULL;
}

static void *run(void *data)
{
    struct picker *picker = data;

    hub_lock(picker->hub);
    while (!picker->stop) {
        int64_t until_us;
        struct question *question = take(picker, &until_us);

        if (question) {
            serve(picker, question);
        } else if (until_us) {
            hub_wait_until(picker->hub, &picker->work, until_us);
        } else {
            hub_wait(picker->hub, &picker->work);
        }
    }
    hub_unlock(picker->hub);
    return NULL;
}

/* --- life --- */

struct picker *picker_create(struct hub *hub, struct error *err)
{
    struct picker *picker = memory_alloc(1, sizeof *picker);

    picker->hub = hub;
    pthread_cond_init(&picker->work, NULL);
    if (pthread_create(&picker->thread, NULL, run, picker) != 0) {
        error_set(err, ERROR_INTERNAL, "picker", "its thread cannot be started");
        pthread_cond_destroy(&picker->work);
        free(picker);
        return NULL;
    }
    return picker;
}

void picker_destroy(struct picker *picker)
{
    if (!picker) {
        return;
    }
    hub_lock(picker->hub);
    picker->stop = true;
    pthread_cond_signal(&picker->work);
    hub_unlock(picker->hub);
    pthread_join(picker->thread, NULL);
    while (picker->first) {
        struct question *question = picker->first;

        picker->first = question->next;
        question_destroy(picker, question);
    }
    accounts_finish(&picker->accounts);
    pthread_cond_destroy(&picker->work);
    free(picker);
}
