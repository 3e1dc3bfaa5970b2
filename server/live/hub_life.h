/* SPDX-License-Identifier: MIT */
/* The life of the hub: its start, what the worker tells it, its timers, its end. */
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
/* From here on edits are refused; commits what there is, with snapshots, and waits for it. */
void hub_drain(struct hub *hub);
/* Ends the worker and its thread; sessions may still go. */
void hub_stop(struct hub *hub);
/* After everybody who calls into the hub has stopped. */
void hub_destroy(struct hub *hub);

#endif
