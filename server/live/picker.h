/* SPDX-License-Identifier: MIT */
/* What is under the pointer, answered by a thread of its own and without the worker, so that a
 * click never waits for a picture. Where many wait, the session whose turn was longest ago comes
 * first. */
#ifndef SERVER_PICKER_H
#define SERVER_PICKER_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

#include "protocol/id_set.h"

struct error;
struct hub;
struct picker;
struct room;
struct session;

enum { PICKER_WAITING = 8 }; /* questions of one session; beyond them its oldest is given up */

struct picker *picker_create(struct hub *hub, struct error *err);
/* Ends the thread; what waits is never answered. */
void picker_destroy(struct picker *picker); /* NULL: nothing */

/* Under the hub's lock. */

/* The checked `pick` message; the answer is told to the session. False and `err`: no view yet. */
bool picker_ask(struct session *session, const cJSON *message, struct error *err);
/* The session asks no longer. */
void picker_forget(struct session *session);
void picker_finish_room(struct room *room);

#endif
