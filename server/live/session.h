/* SPDX-License-Identifier: MIT */
/* A session is one live connection: its client, its room, its messages. ws.c owns the connection
 * itself. Every function is called under the hub's lock. */
#ifndef SERVER_SESSION_H
#define SERVER_SESSION_H

#include "server/net/send_queue.h"
#include "server/net/workload.h"
#include "server/net/ws.h"

struct author;
struct stream;
struct thumbnail_list;
struct hub;
struct room;

enum { SESSION_LABELS = 100 }; /* steps of undo whose labels are sent */

struct session {
    struct hub *hub;
    struct room *room;
    struct session *next; /* in the room */
    char id[17];
    char client[LIMIT_ID_BYTES + 1]; /* "" before hello */
    struct author *author;           /* in the room; NULL: none, or it has another session now */
    int64_t newest_edit;             /* the greatest edit number used, refused edits included */
    struct send_queue send_queue;
    struct stream *stream;
    struct thumbnail_list *thumbnails;
    bool working;      /* a task works on its message; the session stays meanwhile */
    bool heavy;        /* that short message may take long */
    bool left;         /* its connection has closed meanwhile */
    int64_t worked_us; /* processor time of the last task */
    struct workload picks;
    int64_t picks_rest_us; /* clock_us until which none of its picks is answered */
    int close_code;        /* > 0: close when the queue is empty, or at once when it is full */
    bool close_now;
    bool greeted; /* its hello is being answered */
    /* Call it when something has to be written or closed; any thread. */
    void (*wake)(void *connection);
    void *connection;
};

/* Tells that its messages took too much time, and that none is read for `wait_ms`. */
void session_tell_rest(struct session *session, int wait_ms);
/* For ws.c: members of struct ws_app. */
bool session_is_done(const struct session *session, int64_t *out_worked_us);
bool session_said_hello(const struct session *session);
bool session_next(struct session *session, uint8_t *out, struct send_queue_piece *piece,
                  int *out_code);

void session_say(struct session *session, struct shared_buffer *message);  /* takes the reference */
void session_send(struct session *session, struct shared_buffer *message); /* borrows it */
/* Sends a notice about an error in one of its messages. */
void session_error(struct session *session, const struct error *err);
/* Tells that an edit is applied, and how many steps can be undone now. */
void session_tell_edit(struct session *session, int64_t edit, uint64_t revision,
                       const cJSON *skipped);
/* Tells that an edit of this session's client is committed. */
void session_tell_durable(struct session *session, int64_t edit, uint64_t revision);

#endif
