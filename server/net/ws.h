/* SPDX-License-Identifier: MIT */
/* The WebSocket side: an adapter to libwebsockets with one thread of its own. It gets sockets whose
 * handshake the acceptor has accepted. It moves bytes between sockets and sessions, and decides
 * nothing. */
#ifndef SERVER_WS_H
#define SERVER_WS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "http_head.h"
#include "protocol/error.h"

#define WS_SUBPROTOCOL "fieldcast.v1"

enum {
    CLOSE_NORMAL = 1000, /* RFC 6455, 7.4.1 */
    CLOSE_GOING_AWAY = 1001,
    CLOSE_POLICY = 1008,
    CLOSE_TOO_BIG = 1009,
    CLOSE_TRY_LATER = 1013,
};

struct hub;
struct metrics;
struct send_queue_piece;
struct session;
struct ws;

/* The layer above: it has one session for each connection. All functions but `receive` and
 * `receive_apart` are called under the lock. */
struct ws_app {
    struct hub *hub; /* opaque */
    struct metrics *metrics;
    void (*lock)(struct hub *hub);
    void (*unlock)(struct hub *hub);
    /* A connection is open. The session calls `wake` (any thread) when it has something to write or
     * to close. */
    struct session *(*open)(struct hub *hub, void (*wake)(void *connection), void *connection);
    void (*leave)(struct session *session); /* the connection has closed */
    /* Handles a whole message. False: it may take long. Then `receive_apart` gets it and takes the
     * text; nothing else is read until `is_done`. */
    bool (*receive)(struct session *session, const char *scene, const char *text, size_t length);
    void (*receive_apart)(struct session *session, const char *scene, char *text, size_t length);
    /* Whether `receive_apart` is done, and its processor time. */
    bool (*is_done)(const struct session *session, int64_t *out_worked_us);
    void (*tell_rest)(struct session *session, int wait_ms); /* nothing is read for so long */
    bool (*said_hello)(const struct session *session);
    /* The next piece to write. False: there is none. Then a `*out_code` other than 0 closes the
     * connection with that code. */
    bool (*next)(struct session *session, uint8_t *out, struct send_queue_piece *piece,
                 int *out_code);
    void (*close)(struct session *session, int code, const char *reason, int retry_ms);
};

struct ws *ws_create(const struct ws_app *app, struct error *err);
/* Any thread; takes `fd`, from which the head has been read. */
void ws_adopt(struct ws *ws, int fd, const struct http_head *head, const char *scene);
/* The number of open connections; any thread. */
int ws_count(const struct ws *ws);
/* Says bye to all clients and waits at most `wait_ms` until they have left. */
void ws_drain(struct ws *ws, int wait_ms);
/* Closes what is open and ends the thread. Threads that use sessions may still wake connections. */
void ws_stop(struct ws *ws);
/* When those have ended too. */
void ws_destroy(struct ws *ws);

#endif
