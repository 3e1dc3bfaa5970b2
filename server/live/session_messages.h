/* SPDX-License-Identifier: MIT */
/* What a client says on a live connection. */
#ifndef SERVER_SESSION_MESSAGES_H
#define SERVER_SESSION_MESSAGES_H

#include "session.h"

enum { SESSION_LIGHT_BYTES = 8192 }; /* of a message; a longer one is a task */

/* A whole text message. Takes the lock itself, since hello may load the scene. False: nothing was
 * done, because it may take long: session_receive_apart shall have it. */
bool session_receive(struct session *session, const char *scene, const char *text, size_t length);
/* The same as a task, whatever it takes; takes `text`. Nothing else of the session may be received
 * until `working` is false, of which `wake` tells. */
void session_receive_apart(struct session *session, const char *scene, char *text, size_t length);

#endif
