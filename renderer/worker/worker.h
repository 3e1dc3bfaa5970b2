/* SPDX-License-Identifier: MIT */
/* The render process, at the other end of a socket on which packets go (worker_protocol.h). */
#ifndef RENDERER_WORKER_H
#define RENDERER_WORKER_H

#include "confine.h"
#include "renderer/crash.h"
#include "renderer/renderer.h"
#include "renderer/vigil.h"
#include "worker_protocol.h"

enum { WORKER_FD = 3, WORKER_PULSE_FD = 4 }; /* where the front leaves its child's sockets */

struct worker_params {
    struct renderer_params renderer;
    int pulse_fd;              /* for pings; -1: there are none */
    size_t memory_limit_bytes; /* RLIMIT_AS above what the driver needs; 0: none */
    enum confine_mode confine;
};

/* The whole life of the render process; returns its exit status. */
int worker_run(int fd, const struct worker_params *params);

/* Loads the driver in a process of its own, confined as the render process is. False: it cannot
 * draw there, and `err` says why. Before any other thread runs. */
bool worker_try(const struct worker_params *params, struct confinement *out, struct error *err);

#endif
