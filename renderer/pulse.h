/* SPDX-License-Identifier: MIT */
/* Answers the front's pings by a thread of its own, so that an answer never waits for what is
 * drawn. It says how far the drawing thread has come, and whether it waits for something to do:
 * that, and not the answer, is its sign of life. */
#ifndef RENDERER_PULSE_H
#define RENDERER_PULSE_H

#include "renderer.h"

struct pulse;

/* What the drawing thread tells of itself each time before it waits. */
struct pulse_news {
    struct renderer_counters counters;
    double pace;
    bool idle; /* it waits for the front, and for nothing else */
};

/* `fd`: a stream socket, the caller's; -1: no thread. Dies without a thread (aborts). */
struct pulse *pulse_create(int fd);
void pulse_destroy(struct pulse *pulse); /* NULL: nothing */
/* The drawing thread's: it has gone on. */
void pulse_tell(struct pulse *pulse, const struct pulse_news *news);
void pulse_wake(struct pulse *pulse); /* it is no longer idle */

#endif
