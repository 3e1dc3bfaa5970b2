/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "hello.h"
#include "hub.h"
#include "picker.h"
#include "problem.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "room.h"
#include "room_authors.h"
#include "say.h"
#include "server/clock.h"
#include "server/log.h"

struct session *session_create(struct hub *hub, void (*wake)(void *connection), void *connection)
{
    struct session *session = memory_alloc(1, sizeof(*session));
    uint64_t number = 0;

    if (getrandom(&number, sizeof(number), 0) != sizeof(number)) {
        abort();
    }
    snprintf(session->id, sizeof(session->id), "%016" PRIx64, number);
    session->hub = hub;
    session->wake = wake;
    session->connection = connection;
    outbox_init(&session->outbox);
    frames_init(&session->frames);
    metric_add(&hub->metrics, METRIC_SESSIONS, 1);
    metric_add(&hub->metrics, METRIC_SESSIONS_TOTAL, 1);
    return session;
}

void session_leave_room(struct session *session)
{
    struct room *room = session->room;

    if (!room) {
        return;
    }
    struct session **link = &room->sessions;
    while (*link != session) {
        link = &(*link)->next;
    }
    *link = session->next;
    if (session->author) {
        room_authors_left(room, session->author);
        session->author = NULL;
    }
    session->next = NULL;
    session->room = NULL;
    room->session_count--;
    room->idle_since = clock_ms();
}

static void session_destroy(struct session *session)
{
    picker_forget(session);
    frames_finish(session);
    session_leave_room(session);
    outbox_finish(&session->outbox);
    metric_add(&session->hub->metrics, METRIC_SESSIONS, -1);
    free(session);
}

static void ignore(void *connection)
{
    (void)connection;
}

void session_leave(struct session *session)
{
    if (!session->working) {
        session_destroy(session);
        return;
    }
    session->left = true;
    session->close_code = CLOSE_GOING_AWAY;
    session->wake = ignore;
    picker_forget(session);
}

/* --- telling --- */

void session_send(struct session *session, struct blob *message)
{
    if (session->close_code) {
        return;
    }
    if (!outbox_text(&session->outbox, message)) {
        /* It can resume later; nothing more is kept for it. */
        log_info("session", "%s reads too slowly and is closed", session->id);
        session->close_code = CLOSE_TRY_LATER;
        session->close_now = true;
    }
    session->wake(session->connection);
}

void session_say(struct session *session, struct blob *message)
{
    session_send(session, message);
    blob_unref(message);
}

void session_close(struct session *session, int code, const char *reason, int retry_ms)
{
    if (session->close_code) {
        return;
    }
    session_say(session, say_bye(reason, retry_ms));
    session->close_code = code;
    picker_forget(session);
    if (session->frames.job) {
        renders_cancel(session->hub, session->frames.job);
        session->frames.job = 0;
    }
}

void session_error(struct session *session, const struct error *err)
{
    session_say(session, say_fault("error", error_kind_name(err->kind), err));
}

static void say_edit_state(struct session *session, int64_t edit, uint64_t revision,
                           const cJSON *skipped)
{
    size_t undo = 0, redo = 0;

    history_depth(session->room->history, session->client, &undo, &redo);
    session_say(session, say_applied(edit, revision, revision <= session->room->durable, undo, redo,
                                     skipped));
}

void session_tell_durable(struct session *session, int64_t edit, uint64_t revision)
{
    say_edit_state(session, edit, revision, NULL);
}

/* A frame was handed to the socket completely. */
static void count_frame(struct session *session, size_t bytes)
{
    metric_add(&session->hub->metrics, METRIC_FRAMES_SENT, 1);
    metric_add(&session->hub->metrics, METRIC_FRAME_BYTES, (int64_t)bytes);
    supervisor_wake(session->hub->supervisor);
}

bool session_next(struct session *session, uint8_t *out, struct outbox_piece *piece, int *out_code)
{
    if (session->close_now || !outbox_next(&session->outbox, out, piece)) {
        *out_code = session->close_code;
        return false;
    }
    if (piece->frame_done) {
        count_frame(session, piece->frame_bytes);
    }
    return true;
}

bool session_is_done(const struct session *session, int64_t *out_worked_us)
{
    *out_worked_us = session->worked_us;
    return !session->working;
}

bool session_said_hello(const struct session *session)
{
    return session->client[0];
}

void session_tell_rest(struct session *session, int wait_ms)
{
    struct error err = {0};

    error_set(&err, ERROR_SHARE, "",
              "What this page sent took much work: the server reads on in %.1f s",
              wait_ms / 1000.0);
    err.retry_ms = wait_ms;
    session_say(session, say_fault("info", error_kind_name(err.kind), &err));
}

/* --- messages --- */

/* Numbers may be left out, but nobody gets to where none is left. */
static bool use_number(struct session *session, int64_t number, struct error *err)
{
    const int64_t greatest = session->newest_edit + LIMIT_EDIT_JUMP;

    if (number > greatest) {
        return error_set(err, ERROR_LIMIT, "/edit",
                         "%" PRId64 " is above the maximum %" PRId64 ": %d above the newest",
                         number, greatest, LIMIT_EDIT_JUMP);
    }
    if (number > session->newest_edit) {
        session->newest_edit = number;
    }
    return true;
}

static enum room_outcome apply(struct session *session, const struct message *message,
                               const struct room_change *change, uint64_t *out_revision,
                               cJSON **out_skipped, struct error *err)
{
    struct room *room = session->room;

    if (!use_number(session, change->edit, err)) {
        metric_add(&session->hub->metrics, METRIC_EDITS_REJECTED, 1);
        return ROOM_REFUSED;
    }
    if (message->kind == MESSAGE_EDIT) {
        return room_edit(room, change, cJSON_GetObjectItemCaseSensitive(message->json, "ops"),
                         out_revision, err);
    }
    enum room_outcome outcome =
        room_undo(room, change, message->kind == MESSAGE_REDO, out_revision, out_skipped, err);
    if (outcome == ROOM_APPLIED) {
        session_say(session, room_changed_message(room, *out_revision, session->client));
    }
    return outcome;
}

static void edit(struct session *session, const struct message *message)
{
    struct error err = {0};
    uint64_t revision = 0;
    const struct room_change change = {
        .author = session->client,
        .by = session->author,
        .edit = (int64_t)json_member_number(message->json, "edit", 0),
        .group = json_member_text(message->json, "group", NULL),
        .label = json_member_text(message->json, "label", NULL),
        .session = session,
    };
    cJSON *skipped = NULL;
    const enum room_outcome outcome = apply(session, message, &change, &revision, &skipped, &err);

    if (outcome == ROOM_REFUSED) {
        session_say(session, say_rejected(change.edit, &err, skipped));
    } else {
        say_edit_state(session, change.edit, revision, skipped);
    }
    cJSON_Delete(skipped);
}

static void pick(struct session *session, const cJSON *message)
{
    struct error err = {0};

    if (!picker_ask(session, message, &err)) {
        session_error(session, &err);
    }
}

static void view(struct session *session, const cJSON *message)
{
    struct error err = {0};

    if (!frames_set_view(session, message, &err)) {
        session_error(session, &err);
    }
}

static void retry(struct session *session, const cJSON *message)
{
    struct error err = {0};

    if (!problem_retry(session->room, json_member_text(message, "place", NULL), &err)) {
        session_error(session, &err);
    }
}

static void handle(struct session *session, const struct message *message)
{
    if (!session->room) {
        struct error err = {0};

        error_set(&err, ERROR_INVALID, "/type", "the first message must be hello");
        session_error(session, &err);
        session_close(session, CLOSE_POLICY, "protocol", -1);
        return;
    }
    switch (message->kind) {
    case MESSAGE_VIEW:
        view(session, message->json);
        break;
    case MESSAGE_EDIT:
    case MESSAGE_UNDO:
    case MESSAGE_REDO:
        edit(session, message);
        break;
    case MESSAGE_PICK:
        pick(session, message->json);
        break;
    case MESSAGE_RETRY:
        retry(session, message->json);
        break;
    case MESSAGE_ACK:
        frames_acknowledge(session, (uint32_t)json_member_number(message->json, "frame", 0));
        break;
    default:
        break;
    }
    frames_pump(session, clock_ms());
}

/* A message that does not keep to the form; if it was an edit, its author waits for an answer. */
static void refuse(struct session *session, const char *text, size_t length,
                   const struct error *err)
{
    cJSON *json = json_parse(text, length, NULL);
    const char *type = json_member_text(json, "type", "");
    double number = json_member_number(json, "edit", 0);

    hub_lock(session->hub);
    if (number >= 1 && (!strcmp(type, "edit") || !strcmp(type, "undo") || !strcmp(type, "redo"))) {
        metric_add(&session->hub->metrics, METRIC_EDITS_REJECTED, 1);
        use_number(session, (int64_t)number, NULL);
        session_say(session, say_rejected((int64_t)number, err, NULL));
    } else {
        session_error(session, err);
    }
    hub_unlock(session->hub);
    cJSON_Delete(json);
}

static bool changes_document(enum message_kind kind)
{
    return kind == MESSAGE_EDIT || kind == MESSAGE_UNDO || kind == MESSAGE_REDO;
}

/* Under the lock: a step of undo or redo that is a task, however short its message is. */
static bool moves_much(const struct session *session, enum message_kind kind)
{
    return (kind == MESSAGE_UNDO || kind == MESSAGE_REDO) && session->room &&
           room_undo_is_heavy(session->room, session->client, kind == MESSAGE_REDO);
}

/* A change waits for those who hold the document. False, where it is not a task: it would wait, or
 * take long. */
static bool receive_checked(struct session *session, const struct message *message, bool apart)
{
    struct hub *hub = session->hub;
    bool done = true;

    hub_lock(hub);
    if (!apart && moves_much(session, message->kind)) {
        session->heavy = true;
        done = false;
    }
    while (changes_document(message->kind) && session->room && session->room->holds > 0 && done) {
        done = apart;
        if (apart) {
            pthread_cond_wait(&hub->released, &hub->lock);
        }
    }
    if (done && !session->close_code) {
        handle(session, message);
    }
    hub_unlock(hub);
    return done;
}

static bool receive(struct session *session, const char *scene, const char *text, size_t length,
                    bool apart)
{
    struct hub *hub = session->hub;
    struct message message;
    struct error err = {0};
    bool done = true;

    if (!message_read(text, length, &message, &err)) {
        refuse(session, text, length, &err);
        return true;
    }
    if (message.kind != MESSAGE_HELLO) {
        done = receive_checked(session, &message, apart);
    } else if (apart || hub_is_ready(hub, scene)) {
        hello_receive(session, scene, message.json); /* locks */
        hub_unlock(hub);
    } else {
        done = false;
    }
    message_finish(&message);
    return done;
}

bool session_receive(struct session *session, const char *scene, const char *text, size_t length)
{
    return length <= SESSION_LIGHT_BYTES && receive(session, scene, text, length, false);
}

/* --- messages that take long --- */

struct errand {
    struct session *session;
    char scene[LIMIT_ID_BYTES + 1];
    char *text;
    size_t length;
};

/* The errand is over; nobody knows a session that its connection has left. */
static void finish_errand(struct errand *errand, int64_t worked_us)
{
    struct session *session = errand->session;
    struct hub *hub = session->hub;

    hub_lock(hub);
    session->working = false;
    session->worked_us = worked_us;
    if (session->left) {
        session_destroy(session);
    } else {
        session->wake(session->connection);
    }
    hub_unlock(hub);
    free(errand->text);
    free(errand);
}

static void run_errand(void *data, bool dropped)
{
    struct errand *errand = data;
    const int64_t before = clock_thread_us();

    if (!dropped) {
        receive(errand->session, errand->scene, errand->text, errand->length, true);
    }
    finish_errand(errand, clock_thread_us() - before);
}

void session_receive_apart(struct session *session, const char *scene, char *text, size_t length)
{
    struct hub *hub = session->hub;
    struct errand *errand = memory_alloc(1, sizeof(*errand));

    *errand = (struct errand){.session = session, .text = text, .length = length};
    snprintf(errand->scene, sizeof(errand->scene), "%s", scene);
    hub_lock(hub);
    session->working = true;
    const bool heavy = session->heavy || length > SESSION_LIGHT_BYTES;
    session->heavy = false;
    hub_unlock(hub);
    if (!tasks_add(hub->tasks,
                   &(struct task_order){.scene = scene,
                                        .account = session->id,
                                        .heavy = heavy || hub_scene_is_heavy(hub, scene),
                                        .run = run_errand,
                                        .data = errand},
                   NULL)) {
        finish_errand(errand, 0); /* the server is shutting down */
    }
}
