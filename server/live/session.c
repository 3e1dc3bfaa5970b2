/* SPDX-License-Identifier: MIT */
#include "session.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "room_state.h"
#include "server/log.h"
#include "server_message.h"

void session_send(struct session *session, struct shared_buffer *message)
{
    if (session->close_code) {
        return;
    }
    if (session->greeted) {
        send_queue_greeting(&session->send_queue, message);
    } else if (!send_queue_text(&session->send_queue, message)) {
        /* It can resume later; nothing more is kept for it. */
        log_info("session", "%s reads too slowly and is closed", session->id);
        session->close_code = CLOSE_TRY_LATER;
        session->close_now = true;
    }
    session->wake(session->connection);
}

void session_say(struct session *session, struct shared_buffer *message)
{
    session_send(session, message);
    shared_buffer_unref(message);
}

void session_error(struct session *session, const struct error *err)
{
    session_say(session, message_fault("error", error_kind_name(err->kind), err));
}

void session_tell_edit(struct session *session, int64_t edit, uint64_t revision,
                       const cJSON *skipped)
{
    size_t undo = 0, redo = 0;

    history_depth(session->room->history, session->client, &undo, &redo);
    session_say(session, message_applied(edit, revision, revision <= session->room->durable, undo,
                                         redo, skipped));
}

void session_tell_durable(struct session *session, int64_t edit, uint64_t revision)
{
    session_tell_edit(session, edit, revision, NULL);
}

/* A frame was handed to the socket completely. */
static void count_frame(struct session *session, size_t bytes)
{
    metric_add(&session->hub->metrics, METRIC_FRAMES_SENT, 1);
    metric_add(&session->hub->metrics, METRIC_FRAME_BYTES, (int64_t)bytes);
    supervisor_wake(session->hub->supervisor);
}

bool session_next(struct session *session, uint8_t *out, struct send_queue_piece *piece,
                  int *out_code)
{
    if (session->close_now || !send_queue_next(&session->send_queue, out, piece)) {
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
    session_say(session, message_fault("info", error_kind_name(err.kind), &err));
}
