/* SPDX-License-Identifier: MIT */
#include "session_messages.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "hello.h"
#include "hub_rooms.h"
#include "picker.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "retry.h"
#include "room.h"
#include "room_authors.h"
#include "server/clock.h"
#include "server_message.h"
#include "session_life.h"
#include "stream.h"
#include "thumbnails.h"

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
        .plain = message->plain,
    };
    struct room *room = session->room;
    cJSON *skipped = NULL;

    room_authors_hold(change.by);
    const enum room_outcome outcome = apply(session, message, &change, &revision, &skipped, &err);
    room_authors_release(room, change.by);
    if (outcome == ROOM_REFUSED) {
        session_say(session, message_rejected(change.edit, &err, skipped));
    } else {
        session_tell_edit(session, change.edit, revision, skipped);
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

static void retry(struct session *session, const cJSON *message)
{
    struct error err = {0};

    if (!retry_place(session->room, json_member_text(message, "place", NULL), &err)) {
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
        stream_set_view(session, message);
        break;
    case MESSAGE_EDIT:
    case MESSAGE_UNDO:
    case MESSAGE_REDO:
        edit(session, message);
        break;
    case MESSAGE_PICK:
        pick(session, message->json);
        break;
    case MESSAGE_BOUNDS:
        picker_ask_bounds(session, message);
        break;
    case MESSAGE_RETRY:
        retry(session, message->json);
        break;
    case MESSAGE_ACK:
        stream_acknowledge(session, (uint32_t)json_member_number(message->json, "frame", 0));
        break;
    case MESSAGE_THUMBNAILS:
        thumbnails_ask(session, message);
        break;
    case MESSAGE_ACK_THUMBNAILS:
        thumbnails_acknowledge(session, (uint32_t)json_member_number(message->json, "number", 0));
        break;
    case MESSAGE_HELLO: /* hello_receive */
    case MESSAGE_COUNT:
        break;
    }
    stream_pump(session, clock_ms());
}

/* A message that does not keep to the form; if it was an edit, its author waits for an answer. */
static void refuse(struct session *session, const char *text, size_t length,
                   const struct error *err)
{
    cJSON *json = json_parse(text, length, NULL);
    const char *type = json_member_text(json, "type", "");
    const double number = json_member_number(json, "edit", 0);

    hub_lock(session->hub);
    if (number >= 1 && (!strcmp(type, "edit") || !strcmp(type, "undo") || !strcmp(type, "redo"))) {
        metric_add(&session->hub->metrics, METRIC_EDITS_REJECTED, 1);
        use_number(session, (int64_t)number, NULL);
        session_say(session, message_rejected((int64_t)number, err, NULL));
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

/* Under the lock: an edit or step that is a task, however short its message is. */
static bool is_heavy(const struct session *session, const struct message *message)
{
    const struct room *room = session->room;

    if (!room || !changes_document(message->kind)) {
        return false;
    }
    return message->kind == MESSAGE_EDIT
               ? room_edit_releases(room, cJSON_GetObjectItemCaseSensitive(message->json, "ops"))
               : room_undo_releases(room, session->client, message->kind == MESSAGE_REDO);
}

/* A change waits for those who hold the document. False, where it is not a task: it would wait, or
 * take long. */
static bool receive_checked(struct session *session, const struct message *message, bool apart)
{
    struct hub *hub = session->hub;
    bool done = true;

    hub_lock(hub);
    if (!apart && is_heavy(session, message)) {
        session->heavy = true;
        done = false;
    }
    while (changes_document(message->kind) && session->room && session->room->holds > 0 && done) {
        done = apart;
        if (apart) {
            hub_wait(hub, &hub->released);
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
        session_leave(session);
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
    struct errand *errand = memory_alloc(1, sizeof *errand);

    errand->session = session;
    errand->text = text;
    errand->length = length;
    snprintf(errand->scene, sizeof errand->scene, "%s", scene);
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
