/* SPDX-License-Identifier: MIT */
/* The front's end of the socket on which a worker answers pings (renderer/pulse.h). Belongs to the
 * supervisor's thread. */
#ifndef SERVER_HEARTBEAT_H
#define SERVER_HEARTBEAT_H

#include <stdint.h>

#include "renderer/worker.h"

struct heartbeat {
    int fd; /* -1: no worker, or one that does not answer any more */
    struct packet_reader reader;
    uint64_t steps; /* of the drawing thread, by the last answer */
};

void heartbeat_init(struct heartbeat *heartbeat, int fd); /* takes `fd` */
void heartbeat_finish(struct heartbeat *heartbeat);
void heartbeat_ask(struct heartbeat *heartbeat, int64_t now_ms);
/* Takes the bytes that are there. */
void heartbeat_receive(struct heartbeat *heartbeat);
/* The next answer; false: none is whole. `*out_alive`: by its words the drawing thread has gone on
 * since the last one, or has nothing to do. Answers come also while that thread hangs. */
bool heartbeat_next(struct heartbeat *heartbeat, struct packet_pong *out, bool *out_alive);

#endif
