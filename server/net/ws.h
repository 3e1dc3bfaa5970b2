/* SPDX-License-Identifier: MIT */
/* The WebSocket side: an adapter to libwebsockets, with one thread of its own. It gets sockets
 * whose handshake the acceptor has judged, moves bytes between them and sessions, and decides
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

/* Who is behind the connections: one session each. All but `receive` and `receive_apart` are called
 * under the lock. */
struct ws_app {
    struct hub *hub; /* nothing is known of it */
    struct metrics *metrics;
    void (*lock)(struct hub *hub);
    void (*unlock)(struct hub *hub);
    /* The connection is open. `wake`: something is to be written or closed; any thread. */
    struct session *(*open)(struct hub *hub, void (*wake)(void *connection), void *connection);
    void (*leave)(struct session *session); /* it has closed */
    /* A whole message. False: it may take long, and `receive_apart` shall have it, which takes the
     * text; nothing else is read until it is done. */
    bool (*receive)(struct session *session, const char *scene, const char *text, size_t length);
    void (*receive_apart)(struct session *session, const char *scene, char *text, size_t length);
    /* Whether that is done, and what it took of a processor. */
    bool (*is_done)(const struct session *session, int64_t *out_worked_us);
    void (*tell_rest)(struct session *session, int wait_ms); /* it is not read for so long */
    bool (*said_hello)(const struct session *session);
    /* The next piece to write. False: there is none, and the connection is to be closed with
     * `*out_code`, if that is not 0. */
    bool (*next)(struct session *session, uint8_t *out, struct send_queue_piece *piece,
                 int *out_code);
    void (*close)(struct session *session, int code, const char *reason, int retry_ms);
};

struct ws *ws_create(const struct ws_app *app, struct error *err);
/* Any thread; takes `fd`, from which the head has been read. */
void ws_adopt(struct ws *ws, int fd, const struct http_head *head, const char *scene);
/* Connections adopted and not yet gone; any thread. */
int ws_count(const struct ws *ws);
/* Says goodbye to everybody and waits at most `wait_ms` for them to go. */
void ws_drain(struct ws *ws, int wait_ms);
void ws_destroy(struct ws *ws);

#endif
