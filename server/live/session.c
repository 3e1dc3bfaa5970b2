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

void session_destroy(struct session *session)
{
    if (!session) {
        return;
    }
    picker_forget(session);
    frames_finish(session);
    session_leave_room(session);
    outbox_finish(&session->outbox);
    metric_add(&session->hub->metrics, METRIC_SESSIONS, -1);
    free(session);
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

void session_frame_written(struct session *session, uint32_t frame, size_t bytes)
{
    (void)frame;
    metric_add(&session->hub->metrics, METRIC_FRAMES_SENT, 1);
    metric_add(&session->hub->metrics, METRIC_FRAME_BYTES, (int64_t)bytes);
    supervisor_wake(session->hub->supervisor);
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

    if (number >= 1 && (!strcmp(type, "edit") || !strcmp(type, "undo") || !strcmp(type, "redo"))) {
        metric_add(&session->hub->metrics, METRIC_EDITS_REJECTED, 1);
        use_number(session, (int64_t)number, NULL);
        session_say(session, say_rejected((int64_t)number, err, NULL));
    } else {
        session_error(session, err);
    }
    cJSON_Delete(json);
}

void session_receive(struct session *session, const char *scene, const char *text, size_t length)
{
    struct hub *hub = session->hub;
    struct message message;
    struct error err = {0};

    if (!message_read(text, length, &message, &err)) {
        hub_lock(hub);
        refuse(session, text, length, &err);
        hub_unlock(hub);
        return;
    }
    if (message.kind == MESSAGE_HELLO) {
        hello_receive(session, scene, message.json); /* locks */
    } else {
        hub_lock(hub);
        if (!session->close_code) {
            handle(session, &message);
        }
    }
    hub_unlock(hub);
    message_finish(&message);
}
