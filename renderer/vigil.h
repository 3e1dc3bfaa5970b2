/* SPDX-License-Identifier: MIT */
/* Whether a process or thread goes on, judged by what it does and not by how long that takes. Time
 * counts against it only while it is still: it neither uses the processor nor waits for one. So a
 * deadlock or a stopped process is found, and a slow one on a busy machine is not mistaken for it.
 * Pure but for vigil_use_of; times are milliseconds of any clock that does not jump back. */
#ifndef RENDERER_VIGIL_H
#define RENDERER_VIGIL_H

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

enum {
    VIGIL_LOOK_MS = 100,     /* looks that follow sooner change nothing */
    VIGIL_GAP_MS = 1000,     /* of a longer time between two looks so much counts */
    VIGIL_STILL_PERCENT = 5, /* of one processor: who uses less is still */
};

/* What it has done so far, and what it is about. */
struct vigil_use {
    int64_t cpu_ms;
    bool runnable; /* it has a processor, or waits for one */
};
/* Of all threads of a process; false: it is gone. `except`: a thread that does not count as
 * runnable, such as the one that asks; 0: none. */
bool vigil_use_of(pid_t process, pid_t except, struct vigil_use *out);

struct vigil {
    bool begun;
    struct vigil_use last;
    int64_t at_ms;    /* of the last look */
    int64_t still_ms; /* how long it has been still, without a break */
    int64_t spent_ms; /* of the processor, since the last sign of life */
};
/* A sign of life: all counts from here. */
void vigil_restart(struct vigil *vigil);
void vigil_look(struct vigil *vigil, int64_t now_ms, const struct vigil_use *use);

#endif
