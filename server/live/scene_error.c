/* SPDX-License-Identifier: MIT */
#include "scene_error.h"

#include <stdbool.h>
#include <string.h>

#include "hub.h"
#include "room_state.h"
#include "server_message.h"
#include "session.h"

bool scene_error_is_refusal(const struct error *err)
{
    return err->kind == ERROR_TOO_SLOW || err->kind == ERROR_CRASHED;
}

/* Whatever rule is broken, it is the newest state that does not compile. */
static struct shared_buffer *message(const struct error *err)
{
    return message_fault(
        "error", error_kind_name(scene_error_is_refusal(err) ? err->kind : ERROR_COMPILE), err);
}

static void tell_all(const struct room *room, struct shared_buffer *text)
{
    for (struct session *session = room->sessions; session; session = session->next) {
        session_send(session, text);
    }
    shared_buffer_unref(text);
}

static void end(struct room *room)
{
    tell_all(room, message_notice("info", "compiled", room->scene_error.place,
                                  "The scene is drawn again."));
    room->scene_error = (struct error){0};
}

static bool is_same(const struct error *a, const struct error *b)
{
    /* Of a quarantine the next worker knows less than was told when it began. */
    return a->kind == b->kind && (scene_error_is_refusal(a) ||
                                  (strcmp(a->place, b->place) == 0 && a->line == b->line &&
                                   a->column == b->column && strcmp(a->message, b->message) == 0));
}

void scene_error_set(struct room *room, const struct error *err, uint64_t revision)
{
    const struct error *old = &room->scene_error;

    room->scene_error_revision = revision;
    if (is_same(old, err)) {
        return;
    }
    if (old->kind != ERROR_NONE && strcmp(old->place, err->place) != 0) {
        end(room);
    }
    room->scene_error = *err;
    tell_all(room, message(err));
}

/* A picture that is refused keeps nothing from being drawn, and is refused still. */
static bool is_of_image(const struct room *room)
{
    return scene_error_is_refusal(&room->scene_error) &&
           strcmp(record_text(&room->scene->environment, "image"), room->refused_key) == 0;
}

void scene_error_cure(struct room *room, uint64_t revision)
{
    if (room->scene_error.kind != ERROR_NONE && revision > room->scene_error_revision &&
        !is_of_image(room)) {
        end(room);
    }
}

void scene_error_tell_retry(const struct room *room, const char *place)
{
    tell_all(room, message_notice("info", "retrying", place, "It is tried again."));
}

void scene_error_suspend(struct room *room, const struct error *why)
{
    room->suspended = *why;
    tell_all(room, message_left_out(why));
}

void scene_error_resume(struct room *room)
{
    if (room->suspended.kind != ERROR_NONE) {
        scene_error_tell_retry(room, room->suspended.place);
    }
    room->suspended = (struct error){0};
    room->deaths = 0;
}

void scene_error_tell(struct session *session, const struct room *room)
{
    if (room->suspended.kind != ERROR_NONE) {
        session_say(session, message_left_out(&room->suspended));
    }
    if (room->scene_error.kind != ERROR_NONE) {
        session_say(session, message(&room->scene_error));
    }
}
