/* SPDX-License-Identifier: MIT */
/* The first message of a connection: who the client is, and what it is told of the scene. */
#ifndef SERVER_HELLO_H
#define SERVER_HELLO_H

#include <cjson/cJSON.h>

struct session;

/* Takes the hub's lock and keeps it. */
void hello_receive(struct session *session, const char *scene, const cJSON *message);

#endif
