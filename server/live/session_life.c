/* SPDX-License-Identifier: MIT */
#include "session_life.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "hub.h"
#include "picker.h"
#include "protocol/memory.h"
#include "room_authors.h"
#include "server/clock.h"
#include "server_message.h"
#include "stream.h"
#include "thumbnails.h"

struct session *session_create(struct hub *hub, void (*wake)(void *connection), void *connection)
{
    struct session *session = memory_alloc(1, sizeof *session);
    uint64_t number = 0;

    if (getrandom(&number, sizeof number, 0) != sizeof number) {
        abort();
    }
    snprintf(session->id, sizeof session->id, "%016" PRIx64, number);
    session->hub = hub;
    session->wake = wake;
    session->connection = connection;
    send_queue_init(&session->send_queue);
    session->stream = memory_alloc(1, sizeof *session->stream);
    stream_init(session->stream);
    session->thumbnails = memory_alloc(1, sizeof *session->thumbnails);
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
    picker_forget(session); /* its questions are about the room */
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
    thumbnails_stop(session);
    stream_finish(session);
    free(session->stream);
    free(session->thumbnails);
    session_leave_room(session);
    send_queue_finish(&session->send_queue);
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

void session_close(struct session *session, int code, const char *reason, int retry_ms)
{
    if (session->close_code) {
        return;
    }
    session_say(session, message_bye(reason, retry_ms));
    session->close_code = code;
    picker_forget(session);
    thumbnails_stop(session);
    stream_stop(session);
}
