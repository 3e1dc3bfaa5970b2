/* SPDX-License-Identifier: MIT */
/* One live connection: what its client is told. The connection itself is ws.c's. Every function is
 * called under the hub's lock. */
#ifndef SERVER_SESSION_H
#define SERVER_SESSION_H

#include "server/net/send_queue.h"
#include "server/net/ws.h"

struct author;
struct stream;
struct hub;
struct room;

enum { SESSION_LABELS = 100 }; /* steps of undo that are told by name */

struct session {
    struct hub *hub;
    struct room *room;
    struct session *next; /* in the room */
    char id[17];
    char client[LIMIT_ID_BYTES + 1]; /* "" before hello */
    struct author *author;           /* in the room; NULL: none, or another session's by now */
    int64_t newest_edit;             /* the greatest number used, of refused edits too */
    struct send_queue send_queue;
    struct stream *stream;
    uint64_t pick_turn; /* of the picker, when it answered last */
    bool working;       /* a task has a message of it: the session stays until that is done */
    bool heavy;         /* that message may take long, though it is short */
    bool left;          /* meanwhile its connection has closed */
    int64_t worked_us;  /* what the last task took of a processor */
    int close_code;     /* > 0: close when the queue is empty, or at once when it is full */
    bool close_now;
    /* Something is to be written or closed; any thread. */
    void (*wake)(void *connection);
    void *connection;
};

/* Its messages took much time: none is read for so long. */
void session_tell_rest(struct session *session, int wait_ms);
/* For ws.c, as struct ws_app has them. */
bool session_is_done(const struct session *session, int64_t *out_worked_us);
bool session_said_hello(const struct session *session);
bool session_next(struct session *session, uint8_t *out, struct send_queue_piece *piece,
                  int *out_code);

void session_say(struct session *session, struct shared_buffer *message);  /* takes the reference */
void session_send(struct session *session, struct shared_buffer *message); /* borrows it */
/* A notice of what was wrong with a message. */
void session_error(struct session *session, const struct error *err);
/* What has become of an edit, and what can be undone now. */
void session_tell_edit(struct session *session, int64_t edit, uint64_t revision,
                       const cJSON *skipped);
/* The commit of an edit of this session's client. */
void session_tell_durable(struct session *session, int64_t edit, uint64_t revision);

#endif
