/* SPDX-License-Identifier: MIT */
#include "problem.h"

#include <string.h>

#include "room.h"
#include "say.h"
#include "session.h"

/* Whatever rule is broken, it is the newest state that does not compile. */
static struct blob *message(const struct error *err)
{
    const enum error_kind kind = err->kind == ERROR_QUARANTINED ? err->kind : ERROR_COMPILE;

    return say_fault("error", error_kind_name(kind), err);
}

static void tell_all(const struct room *room, struct blob *text)
{
    for (struct session *session = room->sessions; session; session = session->next) {
        session_send(session, text);
    }
    blob_unref(text);
}

static void end(struct room *room)
{
    tell_all(room,
             say_notice("info", "compiled", room->problem.place, "The scene is drawn again."));
    room->problem = (struct error){0};
}

static bool is_same(const struct error *a, const struct error *b)
{
    /* Of a quarantine the next worker knows less than was told when it began. */
    return a->kind == b->kind && (a->kind == ERROR_QUARANTINED ||
                                  (strcmp(a->place, b->place) == 0 && a->line == b->line &&
                                   a->column == b->column && strcmp(a->message, b->message) == 0));
}

void problem_set(struct room *room, const struct error *err, uint64_t revision)
{
    const struct error *old = &room->problem;

    room->problem_revision = revision;
    if (is_same(old, err)) {
        return;
    }
    if (old->kind != ERROR_NONE && strcmp(old->place, err->place) != 0) {
        end(room);
    }
    room->problem = *err;
    tell_all(room, message(err));
}

void problem_cure(struct room *room, uint64_t revision)
{
    if (room->problem.kind != ERROR_NONE && revision > room->problem_revision) {
        end(room);
    }
}

void problem_tell(struct session *session, const struct room *room)
{
    if (room->problem.kind != ERROR_NONE) {
        session_say(session, message(&room->problem));
    }
}
