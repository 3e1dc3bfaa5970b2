/* SPDX-License-Identifier: MIT */
/* The front's end of the socket on which a worker answers pings (renderer/worker/pulse.h). Used on
 * the supervisor's thread alone. */
#ifndef SERVER_HEARTBEAT_H
#define SERVER_HEARTBEAT_H

#include <stdint.h>

#include "renderer/worker/worker.h"

struct heartbeat {
    int fd; /* -1: there is no worker, or it answers no more */
    struct packet_reader reader;
    uint64_t steps; /* steps of the drawing thread in the last answer */
};

void heartbeat_init(struct heartbeat *heartbeat, int fd); /* takes `fd` */
void heartbeat_finish(struct heartbeat *heartbeat);
void heartbeat_ask(struct heartbeat *heartbeat, int64_t now_ms);
/* Reads the bytes that have arrived. */
void heartbeat_receive(struct heartbeat *heartbeat);
/* The next complete answer; false: there is none. `*out_alive`: the drawing thread has made
 * progress since the previous answer, or is idle. Answers arrive even while the drawing thread
 * hangs. */
bool heartbeat_next(struct heartbeat *heartbeat, struct packet_pong *out, bool *out_alive);

#endif
