/* SPDX-License-Identifier: MIT */
/* Wakes another thread, but not while the caller holds a lock that this thread will want: it would
 * take the processor from the caller, and then wait for it. */
#ifndef SERVER_DOORBELL_H
#define SERVER_DOORBELL_H

struct doorbell {
    void (*ring)(void *data); /* on any thread, any number of times */
    void *data;
};

/* Rings now, or when the calling thread stops holding doorbells, which outlive that. */
void doorbell_ring(const struct doorbell *bell);
/* The calling thread's doorbells wait from here on; */
void doorbells_hold(void);
/* those that were rung since then ring, each once. */
void doorbells_release(void);

#endif
