/* SPDX-License-Identifier: MIT */
#include "retry.h"

#include <string.h>

#include "hub.h"
#include "quarantine.h"
#include "room_state.h"
#include "scene_error.h"
#include "session.h"
#include "stream.h"

static bool is_meant(const struct error *err, const char *place)
{
    return scene_error_is_refusal(err) && (!place || strcmp(err->place, place) == 0);
}

/* The worker is told at once; if it does not hold the scene, when it is. */
static bool retry_refused(struct room *room)
{
    const struct error old = room->scene_error;

    if (!quarantine_pardon(room->hub, room->refused_key)) {
        return false;
    }
    room->scene_error = (struct error){0};
    scene_error_tell_retry(room, old.place);
    return true;
}

static void retry_suspended(struct room *room)
{
    room->patience = room->patience < LIMIT_RETRY_TIMES ? room->patience * LIMIT_RETRY_FACTOR
                                                        : LIMIT_RETRY_TIMES;
    scene_error_resume(room);
    for (struct session *session = room->sessions; session; session = session->next) {
        stream_changed(session);
    }
}

bool retry_place(struct room *room, const char *place, struct error *err)
{
    const bool out = is_meant(&room->suspended, place);
    const bool refused = is_meant(&room->scene_error, place) && retry_refused(room);

    if (out) {
        retry_suspended(room);
    }
    return out || refused ||
           error_set(err, ERROR_NOT_FOUND, "/place", "nothing at \"%s\" waits to be tried again",
                     place ? place : "");
}
