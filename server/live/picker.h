/* SPDX-License-Identifier: MIT */
/* Picks: which node is under the pointer; and bounds: how large nodes are. A thread of its own
 * answers them without the worker, so that a click never waits for a picture. Each session has an
 * account of the thread's time, and the one that took the least is next (protocol/accounts.h). Who
 * asks without end has half of the time at most, also where nobody else asks, because drawing needs
 * the processors too. */
#ifndef SERVER_PICKER_H
#define SERVER_PICKER_H

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stdint.h>

#include "protocol/id_set.h"

struct error;
struct hub;
struct message;
struct picker;
struct room;
struct session;

enum { PICKER_WAITING = 8 }; /* of a kind, of one session; one more drops its oldest */

struct picker *picker_create(struct hub *hub, struct error *err);
/* Ends the thread. Waiting picks are never answered. */
void picker_destroy(struct picker *picker); /* NULL: nothing */

/* Under the hub's lock. */

/* Queues a checked `pick` message; the session gets the answer. False and `err`: it has no view
 * yet. */
bool picker_ask(struct session *session, const cJSON *message, struct error *err);
/* The same of a `bounds` message, for which it needs no view. */
void picker_ask_bounds(struct session *session, const struct message *message);
/* Drops all picks of the session. */
void picker_forget(struct session *session);
void picker_finish_room(struct room *room);

#endif
