/* SPDX-License-Identifier: MIT */
/* How live connections come and go. Every function is called under the hub's lock. */
#ifndef SERVER_SESSION_LIFE_H
#define SERVER_SESSION_LIFE_H

#include "session.h"

/* The connection is open; the scene's room is not asked for before hello. */
struct session *session_create(struct hub *hub, void (*wake)(void *connection), void *connection);
/* The connection has closed. */
void session_leave(struct session *session);
void session_close(struct session *session, int code, const char *reason, int retry_ms);
/* The scene goes away; the connection closes by itself. */
void session_leave_room(struct session *session);

#endif
