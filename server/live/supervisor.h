/* SPDX-License-Identifier: MIT */
/* The supervisor starts the worker (the render process), exchanges packets with it, notices that it
 * ended or hangs, and starts the next one. It knows nothing of scenes or pictures.
 * A worker hangs in two cases: it gave no sign of life and was still for `silence_ms`
 * (renderer/vigil.h), or it used `busy_ms` of processor time without a sign of life. Signs of life
 * are bytes of a packet, and pongs which say that the drawing thread made progress or is idle. A
 * worker that is slow, or that gets no processor, may take any time. */
#ifndef SERVER_SUPERVISOR_H
#define SERVER_SUPERVISOR_H

#include <stdint.h>

#include "renderer/worker/worker.h"
#include "server/metrics.h"

struct shared_buffer;
struct supervisor;

enum supervisor_end_kind {
    SUPERVISOR_ENDED, /* by itself */
    SUPERVISOR_STILL, /* killed: it was still */
    SUPERVISOR_BUSY,  /* killed: it used too much processor time */
};

/* How a worker ended. */
struct supervisor_end {
    enum supervisor_end_kind kind;
    enum crash_work crash;         /* what it was at for sure; CRASH_ANYWHERE: not known */
    int64_t measured_ms, limit_ms; /* time used, and allowed; 0 where it ended by itself */
    char text[160];
};

struct supervisor_params {
    const char *const *argv; /* of the worker, NULL at the end; borrowed */
    int silence_ms;          /* still without a sign of life for so long: replaced */
    int busy_ms;             /* processor time without a sign of life: the same */
    struct metrics *metrics;
    void *data;
    /* All are called on the supervisor's thread, without locks. */
    void (*on_ready)(void *data, const struct packet_ready *ready);
    void (*on_packet)(void *data, const struct packet *packet); /* all but pongs */
    /* True: the cause is known and avoided, so the next worker starts at once. */
    bool (*on_down)(void *data, const struct supervisor_end *end);
    /* How slow this machine compiles, as a worker measured it. */
    void (*on_pace)(void *data, double pace);
    /* The first worker ended by itself before it was ready: no device can draw. No other worker is
     * started. */
    void (*on_hopeless)(void *data);
    /* Called after every event. Returns the latest time of the next call (clock_ms; 0: any
     * time). */
    int64_t (*on_tick)(void *data, int64_t now_ms);
    /* A file for supervisor_send_asset, which frees it; NULL: there is none. */
    void *(*load_file)(void *data, const char *id, size_t *out_length);
};

/* Starts the thread, which starts the worker. Aborts where there is no thread. */
struct supervisor *supervisor_create(const struct supervisor_params *params);
/* Any thread; never waits. The packet is dropped while no worker is ready. */
void supervisor_send(struct supervisor *supervisor, const struct packet *packet);
/* The same with a payload that is not copied: the first `payload_length` bytes of `payload`. */
void supervisor_send_shared(struct supervisor *supervisor, const struct packet *packet,
                            struct shared_buffer *payload);
/* The same for a file. The supervisor's thread reads it, so the caller does not wait. */
void supervisor_send_asset(struct supervisor *supervisor, const char *id);
/* Any thread: multiplies `busy_ms` for the current work by `times`. */
void supervisor_set_patience(struct supervisor *supervisor, int times);
/* Any thread: on_tick is called soon. */
void supervisor_wake(struct supervisor *supervisor);
/* Ends worker and thread. No event follows, and packets are dropped. */
void supervisor_stop(struct supervisor *supervisor);
void supervisor_destroy(struct supervisor *supervisor);

#endif
