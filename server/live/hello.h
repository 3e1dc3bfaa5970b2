/* SPDX-License-Identifier: MIT */
/* The first message of a connection. It names the client; the answer brings the scene. */
#ifndef SERVER_HELLO_H
#define SERVER_HELLO_H

#include <cjson/cJSON.h>

struct session;

/* Takes the hub's lock. The lock is still held on return. */
void hello_receive(struct session *session, const char *scene, const cJSON *message);

#endif
