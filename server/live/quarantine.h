/* SPDX-License-Identifier: MIT */
/* Code of users that ended a worker. The worker names whose code it is about to compile, or to draw
 * with. What was being compiled when it ended is never compiled again, and its scene falls back to
 * its last good state until it is edited; drawing counts against a scene (renders.h). Every
 * function is called under the hub's lock. */
#ifndef SERVER_QUARANTINE_H
#define SERVER_QUARANTINE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/limits.h"
#include "renderer/worker.h"

struct hub;

enum { QUARANTINE_SHAPES = 256 }; /* the oldest are forgotten: they may try again */

/* "" in `scene`: nobody. */
struct suspect {
    char scene[LIMIT_ID_BYTES + 16];
    uint64_t revision;
    char shape[17];
};

struct quarantine {
    struct suspect compiling, drawing;
    bool named;                         /* the last worker to end had named somebody */
    struct suspect drawn;               /* what drawing may have ended it */
    char shapes[QUARANTINE_SHAPES][17]; /* a ring */
    size_t count;                       /* ever */
};

/* A packet of type compiling or drawing. */
void quarantine_named(struct hub *hub, const struct packet *packet);
/* Tells a new worker what not to compile. */
void quarantine_worker_ready(struct hub *hub);
/* `hung`: it was silent, rather than ended by itself. True: it had named somebody. */
bool quarantine_worker_down(struct hub *hub, bool hung);
/* Whether the worker that has just ended may have done so by drawing this. Where it had named
 * nobody, all that it was asked for is suspect: `asked`. */
bool quarantine_blames(const struct hub *hub, const char *scene, bool asked);

#endif
