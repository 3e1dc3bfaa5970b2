/* SPDX-License-Identifier: MIT */
#include "hello.h"

#include <stdlib.h>
#include <string.h>

#include "compiles.h"
#include "hub_rooms.h"
#include "protocol/json.h"
#include "protocol/messages.h"
#include "room.h"
#include "room_authors.h"
#include "scene_error.h"
#include "server/clock.h"
#include "server/log.h"
#include "server_message.h"
#include "session_life.h"
#include "stream.h"

/* --- welcome --- */

static void add_limits(cJSON *welcome)
{
    cJSON *limits = cJSON_AddObjectToObject(welcome, "limits");
    size_t count = 0;
    const struct limit *table = limits_table(&count);

    for (size_t i = 0; i < count; i++) {
        cJSON_AddNumberToObject(limits, table[i].name, (double)table[i].value);
    }
}

/* What the newest steps are called, the newest first. */
static void add_labels(cJSON *welcome, const struct session *session, const char *name, bool redo)
{
    cJSON *labels = cJSON_AddArrayToObject(welcome, name);

    for (size_t i = 0; i < SESSION_LABELS; i++) {
        const char *label = history_label(session->room->history, session->client, redo, i);

        if (!label) {
            return;
        }
        cJSON_AddItemToArray(labels, cJSON_CreateString(label));
    }
}

static void send_welcome(struct session *session, const char *key)
{
    struct room *room = session->room;
    const struct renderer_info *info = &session->hub->renderer;
    cJSON *welcome = message_begin("welcome");
    size_t undo = 0, redo = 0;

    history_depth(room->history, session->client, &undo, &redo);
    cJSON_AddStringToObject(welcome, "session", session->id);
    cJSON_AddStringToObject(welcome, "scene", room->id);
    cJSON_AddNumberToObject(welcome, "revision", (double)room->revision);
    cJSON_AddStringToObject(welcome, "epoch", room->epoch);
    cJSON_AddStringToObject(welcome, "author", session->author->name);
    cJSON_AddStringToObject(welcome, "key", key);
    cJSON *renderer = cJSON_AddObjectToObject(welcome, "renderer");
    cJSON_AddStringToObject(renderer, "name", info->name);
    cJSON_AddStringToObject(renderer, "version", info->version);
    cJSON_AddBoolToObject(renderer, "software", info->software);
    cJSON_AddStringToObject(renderer, "stage", render_stage_names[info->stage]);
    cJSON_AddStringToObject(renderer, "device", info->device);
    cJSON_AddNumberToObject(welcome, "last_edit", (double)session->author->edit);
    cJSON_AddNumberToObject(welcome, "undo", (double)undo);
    cJSON_AddNumberToObject(welcome, "redo", (double)redo);
    add_labels(welcome, session, "undo_labels", false);
    add_labels(welcome, session, "redo_labels", true);
    add_limits(welcome);
    session_say(session, message_print(welcome));
}

/* --- hello --- */

/* Whether the log holds what the client missed, and that is less than may wait for a client. */
static bool misses_little(const struct room *room, uint64_t known)
{
    size_t bytes = 0;

    if (known < room->log_from || known > room->revision || known == 0) {
        return false;
    }
    for (uint64_t r = known + 1; r <= room->revision && bytes <= SEND_QUEUE_TEXT_BYTES; r++) {
        bytes += strlen(room_entry_of(room, r)->ops);
    }
    return bytes <= SEND_QUEUE_TEXT_BYTES;
}

/* What the client missed, or the document. */
static void bring_up_to_date(struct session *session, const cJSON *hello)
{
    struct room *room = session->room;
    const uint64_t known = (uint64_t)json_member_number(hello, "revision", 0);
    const bool resumes = strcmp(json_member_text(hello, "epoch", ""), room->epoch) == 0 &&
                         misses_little(room, known);

    if (!resumes) {
        session_say(session, room_document_message(room));
        return;
    }
    for (uint64_t r = known + 1; r <= room->revision; r++) {
        session_say(session, room_changed_message(room, r, session->client));
    }
}

static void enter_room(struct session *session, struct room *room, struct author *author)
{
    struct session *other = author->session;

    if (other) {
        session_close(other, CLOSE_NORMAL, "replaced", -1);
        other->author = NULL;
    }
    snprintf(session->client, sizeof session->client, "%s", author->id);
    session->author = author;
    session->newest_edit = author->edit;
    author->session = session;
    session->room = room;
    session->next = room->sessions;
    room->sessions = session;
    room->session_count++;
    room->idle_since = 0;
}

static void refuse(struct session *session, const struct error *err)
{
    session_error(session, err);
    session_close(session, CLOSE_POLICY, error_kind_name(err->kind), -1);
}

static void greet(struct session *session, const cJSON *hello, const char *key)
{
    struct room *room = session->room;
    struct hub *hub = session->hub;
    struct error err = {0};

    session->greeted = true;
    send_welcome(session, key);
    bring_up_to_date(session, hello);
    scene_error_tell(session, room);
    compiles_tell(session, room, clock_ms());
    if (!hub_accepts_scene(hub, room->scene, &err)) {
        error_set(&err, ERROR_FORBIDDEN, err.place,
                  "this server runs no code: what has some is not shown as it is meant");
        session_say(session, message_fault("warning", "code_off", &err));
    }
    session->greeted = false;
}

void hello_receive(struct session *session, const char *scene, const cJSON *message)
{
    struct hub *hub = session->hub;
    struct error err = {0};
    struct room *room = hub_lock_room(hub, scene, &err);
    char key[MESSAGE_KEY_CHARACTERS + 1];

    if (!room) {
        hub_lock(hub);
        refuse(session, &err);
        return;
    }
    if (session->close_code) {
        return;
    }
    if (session->room) {
        error_set(&err, ERROR_INVALID, "/type", "hello was said already");
        session_error(session, &err);
        return;
    }
    struct author *author = room_authors_admit(room, json_member_text(message, "client", ""),
                                               json_member_text(message, "key", ""), key, &err);
    if (!author) {
        refuse(session, &err);
        return;
    }
    enter_room(session, room, author);
    greet(session, message, key);
    log_debug("session", "%s entered %s as %s", session->id, room->id, author->name);
}
