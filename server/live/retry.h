/* SPDX-License-Identifier: MIT */
/* Second chances that somebody asks for. Under the hub's lock. */
#ifndef SERVER_RETRY_H
#define SERVER_RETRY_H

#include <stdbool.h>

#include "protocol/error.h"

struct room;

/* What was refused, or the suspended scene, is tried again with more time. `place`: of the
 * error; NULL: whatever it is. False and `err` where nothing there waits for it. */
bool retry_place(struct room *room, const char *place, struct error *err);

#endif
