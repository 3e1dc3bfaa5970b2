/* SPDX-License-Identifier: MIT */
/* The life of the hub: start, events of the worker, timers, end. */
#ifndef SERVER_HUB_LIFE_H
#define SERVER_HUB_LIFE_H

#include "hub.h"

struct hub_params {
    struct access access;
    const char *data_dir;
    const char *web_dir;
    const char *const *worker_argv;
    int worker_silence_ms, worker_busy_ms;
    bool code_refused;
};

/* Opens the store, reads the list of scenes, starts the worker. */
struct hub *hub_create(const struct hub_params *params, struct error *err);
/* Refuses edits from now on. Commits all that is pending, with snapshots, and waits for it. */
void hub_drain(struct hub *hub);
/* Ends the worker and its thread. Sessions may still leave afterwards. */
void hub_stop(struct hub *hub);
/* Call it when all threads that call the hub have stopped. */
void hub_destroy(struct hub *hub);

#endif
