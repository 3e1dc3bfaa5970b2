/* SPDX-License-Identifier: MIT */
/* The WebSocket side: an adapter to libwebsockets, with one thread of its own. It gets sockets
 * whose handshake the acceptor has judged, moves bytes between them and sessions, and decides
 * nothing. */
#ifndef SERVER_WS_H
#define SERVER_WS_H

#include "head.h"
#include "protocol/error.h"

#define WS_SUBPROTOCOL "fieldcast.v1"

struct hub;
struct ws;

struct ws *ws_create(struct hub *hub, struct error *err);
/* Any thread; takes `fd`, from which the head has been read. */
void ws_adopt(struct ws *ws, int fd, const struct head *head, const char *scene);
/* Connections adopted and not yet gone; any thread. */
int ws_count(const struct ws *ws);
/* Says goodbye to everybody and waits at most `wait_ms` for them to go. */
void ws_drain(struct ws *ws, int wait_ms);
void ws_destroy(struct ws *ws);

#endif
