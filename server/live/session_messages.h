/* SPDX-License-Identifier: MIT */
/* The messages of a client on a live connection. */
#ifndef SERVER_SESSION_MESSAGES_H
#define SERVER_SESSION_MESSAGES_H

#include "session.h"

enum { SESSION_LIGHT_BYTES = 8192 }; /* of a message; a longer one becomes a task */

/* Handles a whole text message. Takes the lock itself, because hello may load the scene. False: the
 * message may take long and was not handled; pass it to session_receive_apart. */
bool session_receive(struct session *session, const char *scene, const char *text, size_t length);
/* Handles the message as a task; takes `text`. Pass no other message of the session until `working`
 * is false. `wake` is called then. */
void session_receive_apart(struct session *session, const char *scene, char *text, size_t length);

#endif
