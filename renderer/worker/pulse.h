/* SPDX-License-Identifier: MIT */
/* A thread that answers the front's pings, so that no answer waits for drawing. The answer holds
 * the progress of the drawing thread and whether it is idle. These values, not the answer itself,
 * are its sign of life. */
#ifndef RENDERER_PULSE_H
#define RENDERER_PULSE_H

#include "renderer/renderer.h"

struct pulse;

/* State that the drawing thread publishes each time before it waits. */
struct pulse_news {
    struct renderer_counters counters;
    double pace;
    bool idle; /* it waits for the front, and for nothing else */
};

/* `fd`: a stream socket, the caller's; -1: no thread. Dies without a thread (aborts). */
struct pulse *pulse_create(int fd);
void pulse_destroy(struct pulse *pulse); /* NULL: nothing */
/* Called by the drawing thread: it has made progress. */
void pulse_tell(struct pulse *pulse, const struct pulse_news *news);
void pulse_wake(struct pulse *pulse); /* it is no longer idle */

#endif
