/* SPDX-License-Identifier: MIT */
/* How long scenes take until their newest state can be drawn, and which sessions are told to wait.
 * Times are wall times and include waiting for other compilers, as a viewer sees them. Every
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
    COMPILES_TOLD_MS = 250, /* shorter ones are not reported */
    COMPILES_KEPT = 9,      /* the newest times of each class */
    COMPILES_CLASSES = 20,  /* one for each power of two of the number of nodes */
};

struct compiles {
    struct {
        int64_t ms[COMPILES_KEPT];
        size_t count; /* recorded ever */
    } classes[COMPILES_CLASSES];
};

void compiles_record(struct compiles *compiles, size_t nodes, int64_t ms);
/* The median time of scenes of that size; -1: none was recorded. */
int64_t compiles_expected(const struct compiles *compiles, size_t nodes);

/* Checks whether the room waits for its newest state. Tells its sessions once when that takes long,
 * and once when it is over. Returns the time of the next check (clock_ms; 0: none is needed). */
int64_t compiles_watch(struct room *room, int64_t now_ms);
/* Tells a new session of a compilation under way, if there is one. */
void compiles_tell(struct session *session, const struct room *room, int64_t now_ms);

#endif
