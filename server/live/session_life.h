/* SPDX-License-Identifier: MIT */
/* The life of sessions. Every function is called under the hub's lock. */
#ifndef SERVER_SESSION_LIFE_H
#define SERVER_SESSION_LIFE_H

#include "session.h"

/* For a new connection. The session gets its room with hello. */
struct session *session_create(struct hub *hub, void (*wake)(void *connection), void *connection);
/* The connection has closed. Frees the session, or leaves that to its task. */
void session_leave(struct session *session);
void session_close(struct session *session, int code, const char *reason, int retry_ms);
/* Takes the session out of its room. The connection stays open. */
void session_leave_room(struct session *session);

#endif
