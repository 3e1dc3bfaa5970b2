/* SPDX-License-Identifier: MIT */
/* The life of the render process: starts it, speaks packets with it, notices that it died or hangs,
 * starts another. Knows nothing of scenes or pictures.
 *
 * It hangs when it gave no sign of life and was still all the while (renderer/vigil.h), or used
 * more of the processor than any tile should. Signs of life are bytes of a packet, and pongs that
 * say that the drawing thread went on, or has nothing to do. A process that is slow,
 * or does not get the processor, is left alone however long it takes. */
#ifndef SERVER_SUPERVISOR_H
#define SERVER_SUPERVISOR_H

#include <stdint.h>

#include "renderer/worker.h"
#include "server/metrics.h"

struct supervisor;

enum supervisor_end_kind {
    SUPERVISOR_ENDED, /* by itself */
    SUPERVISOR_STILL, /* killed: it waited for nothing that would come */
    SUPERVISOR_BUSY,  /* killed: it was at work for too long */
};

/* How a worker came to its end. */
struct supervisor_end {
    enum supervisor_end_kind kind;
    int64_t measured_ms, limit_ms; /* what it used, and might have; 0 where it ended by itself */
    char text[160];
};

struct supervisor_params {
    const char *const *argv; /* of the worker, NULL at the end; borrowed */
    int silence_ms;          /* of being still without a sign of life: it is replaced */
    int busy_ms;             /* of the processor, used without a sign of life: the same */
    struct metrics *metrics;
    void *data;
    /* All are called on the supervisor's thread, holding nothing. */
    void (*on_ready)(void *data, const struct packet_ready *ready);
    void (*on_packet)(void *data, const struct packet *packet); /* any other but pongs */
    /* True: it is known what ended it, and kept from the next, which need not wait. */
    bool (*on_down)(void *data, const struct supervisor_end *end);
    /* How slow this machine compiles, as a worker measured it. */
    void (*on_pace)(void *data, double pace);
    /* The first worker ended by itself before it was ready: here nothing can be drawn. No other is
     * started. */
    void (*on_hopeless)(void *data);
    /* Called after everything that happens; returns when to be called again at the latest
     * (clock_ms; 0: no wish). */
    int64_t (*on_tick)(void *data, int64_t now_ms);
    /* A file for supervisor_send_asset, which frees it; NULL: there is none. */
    void *(*load_file)(void *data, const char *id, size_t *out_length);
};

/* Starts the thread, which starts the worker. Dies without a thread (aborts). */
struct supervisor *supervisor_create(const struct supervisor_params *params);
/* Any thread; never waits. Dropped while no worker is ready. */
void supervisor_send(struct supervisor *supervisor, const struct packet *packet);
/* The same of a file, read when its turn comes: nobody waits for it here. */
void supervisor_send_asset(struct supervisor *supervisor, const char *id);
/* Any thread: what the worker is at may take so many times `busy_ms`. */
void supervisor_set_patience(struct supervisor *supervisor, int times);
/* Any thread: have on_tick called soon. */
void supervisor_wake(struct supervisor *supervisor);
/* Ends worker and thread: no event comes afterwards, and what is sent is dropped. */
void supervisor_stop(struct supervisor *supervisor);
void supervisor_destroy(struct supervisor *supervisor);

#endif
