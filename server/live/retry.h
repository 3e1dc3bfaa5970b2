/* SPDX-License-Identifier: MIT */
/* Retries that a user asks for. Called under the hub's lock. */
#ifndef SERVER_RETRY_H
#define SERVER_RETRY_H

#include <stdbool.h>

#include "protocol/error.h"

struct room;

/* Tries a refused key or a suspended scene again, with more time. `place` is the place of the
 * error; NULL means any place. False and `err` where nothing waits for a retry. */
bool retry_place(struct room *room, const char *place, struct error *err);

#endif
