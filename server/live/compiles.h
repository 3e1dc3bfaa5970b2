/* SPDX-License-Identifier: MIT */
/* How long scenes take until their newest state can be drawn, and who is told to wait. Times are
 * those of the clock, waiting for others' compilers included: it is what a viewer sees. Every
 * function is called under the hub's lock. */
#ifndef SERVER_COMPILES_H
#define SERVER_COMPILES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct hub;
struct room;
struct session;

enum {
    COMPILES_TOLD_MS = 250, /* nobody is told of a shorter one */
    COMPILES_KEPT = 9,      /* of each class: the newest */
    COMPILES_CLASSES = 20,  /* by the number of nodes: one for each power of two */
};

struct compiles {
    struct {
        int64_t ms[COMPILES_KEPT];
        size_t count; /* ever */
    } classes[COMPILES_CLASSES];
};

void compiles_record(struct compiles *compiles, size_t nodes, int64_t ms);
/* The median of earlier ones of that size; -1: there was none. */
int64_t compiles_expected(const struct compiles *compiles, size_t nodes);

/* Looks whether the room's newest state is waited for, and tells its sessions once when that takes
 * long and when it is over; returns when to look again, clock_ms or 0. */
int64_t compiles_watch(struct room *room, int64_t now_ms);
/* For somebody who has just come; nothing where nobody waits. */
void compiles_tell(struct session *session, const struct room *room, int64_t now_ms);

#endif
