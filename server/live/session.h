/* SPDX-License-Identifier: MIT */
/* One live connection: what its client says and is told. The connection itself is ws.c's. Every
 * function is called under the hub's lock. */
#ifndef SERVER_SESSION_H
#define SERVER_SESSION_H

#include "frames.h"
#include "server/net/outbox.h"
#include "server/net/ws.h"

struct author;
struct hub;
struct room;

enum { SESSION_LIGHT_BYTES = 8192 }; /* of a message; a longer one is a task */

enum { SESSION_LABELS = 100 }; /* steps of undo that are told by name */

struct session {
    struct hub *hub;
    struct room *room;
    struct session *next; /* in the room */
    char id[17];
    char client[LIMIT_ID_BYTES + 1]; /* "" before hello */
    struct author *author;           /* in the room; NULL: none, or another session's by now */
    int64_t newest_edit;             /* the greatest number used, of refused edits too */
    struct outbox outbox;
    struct frames frames;
    uint64_t pick_turn; /* of the picker, when it answered last */
    bool working;       /* a task has a message of it: the session stays until that is done */
    bool heavy;         /* that message may take long, though it is short */
    bool left;          /* meanwhile its connection has closed */
    int64_t worked_us;  /* what the last task took of a processor */
    int close_code;     /* > 0: close when the outbox is empty, or at once when it is full */
    bool close_now;
    /* Something is to be written or closed; any thread. */
    void (*wake)(void *connection);
    void *connection;
};

/* The connection is open; the scene's room is not asked for before hello. */
struct session *session_create(struct hub *hub, void (*wake)(void *connection), void *connection);
/* A whole text message. Takes the lock itself, since hello may load the scene. False: nothing was
 * done, because it may take long: session_receive_apart shall have it. */
bool session_receive(struct session *session, const char *scene, const char *text, size_t length);
/* The same as a task, whatever it takes; takes `text`. Nothing else of the session may be received
 * until `working` is false, of which `wake` tells. */
void session_receive_apart(struct session *session, const char *scene, char *text, size_t length);
/* The connection has closed. */
void session_leave(struct session *session);
/* Its messages took much time: none is read for so long. */
void session_tell_rest(struct session *session, int wait_ms);
/* For ws.c, as struct ws_app has them. */
bool session_is_done(const struct session *session, int64_t *out_worked_us);
bool session_said_hello(const struct session *session);
bool session_next(struct session *session, uint8_t *out, struct outbox_piece *piece, int *out_code);

void session_say(struct session *session, struct blob *message);  /* takes the reference */
void session_send(struct session *session, struct blob *message); /* borrows it */
/* A notice of what was wrong with a message. */
void session_error(struct session *session, const struct error *err);
void session_close(struct session *session, int code, const char *reason, int retry_ms);
/* The scene goes away; the connection closes by itself. */
void session_leave_room(struct session *session);
/* The commit of an edit of this session's client. */
void session_tell_durable(struct session *session, int64_t edit, uint64_t revision);

#endif
