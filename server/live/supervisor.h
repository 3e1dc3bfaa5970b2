/* SPDX-License-Identifier: MIT */
/* The life of the render process: starts it, speaks packets with it, notices that it died or hangs,
 * starts another. Knows nothing of scenes or pictures. */
#ifndef SERVER_SUPERVISOR_H
#define SERVER_SUPERVISOR_H

#include <stdint.h>

#include "renderer/worker.h"
#include "server/metrics.h"

struct supervisor;

struct supervisor_params {
    const char *const *argv; /* of the worker, NULL at the end; borrowed */
    int silence_ms;          /* killed after so long without a sign of life */
    struct metrics *metrics;
    void *data;
    /* All are called on the supervisor's thread, holding nothing. */
    void (*on_ready)(void *data, const cJSON *ready);
    void (*on_packet)(void *data, const char *type, const struct packet *packet);
    /* `hung`: it was silent. True: it is known what ended it, and kept from the next, which need
     * not wait. */
    bool (*on_down)(void *data, const char *reason, bool hung);
    /* The first worker ended by itself before it was ready: here nothing can be drawn. No other is
     * started. */
    void (*on_hopeless)(void *data);
    /* Called after everything that happens; returns when to be called again at the latest
     * (clock_ms; 0: no wish). */
    int64_t (*on_tick)(void *data, int64_t now_ms);
    /* A file for supervisor_send_file, which frees it; NULL: there is none. */
    void *(*load_file)(void *data, const char *id, size_t *out_length);
};

/* Starts the thread, which starts the worker. Dies without a thread (aborts). */
struct supervisor *supervisor_create(const struct supervisor_params *params);
/* Any thread; never waits. Dropped while no worker is ready. */
void supervisor_send(struct supervisor *supervisor, const cJSON *packet);
/* The same with a file as the payload, read when its turn comes: nobody waits for it here. */
void supervisor_send_file(struct supervisor *supervisor, const cJSON *packet, const char *id);
/* Any thread: have on_tick called soon. */
void supervisor_wake(struct supervisor *supervisor);
/* Ends worker and thread: no event comes afterwards, and what is sent is dropped. */
void supervisor_stop(struct supervisor *supervisor);
void supervisor_destroy(struct supervisor *supervisor);

#endif
