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

enum { PICKER_FIELDS = 4 }; /* that a room keeps: all that is seen, and what viewers isolate */

struct picker_field {
    struct id_set isolate;    /* none: all that is there */
    uint64_t last_use;        /* 0: never */
    struct pick_field *field; /* NULL: none yet */
    uint64_t revision;        /* of `field` */
    uint64_t tried;           /* newest of which one was to be made */
};

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
