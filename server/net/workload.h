/* SPDX-License-Identifier: MIT */
/* The work that one connection causes in the front. After WORKLOAD_FREE_US of work, the connection
 * rests for as long as it has worked. So it takes at most half of a thread that others need too.
 * Passing time pays off the work. Pure; one thread. */
#ifndef SERVER_WORKLOAD_H
#define SERVER_WORKLOAD_H

#include <stdint.h>

enum {
    WORKLOAD_FREE_US = 20000,
    WORKLOAD_REST_MAX_US = 2000000, /* longer, and the client would take the server for dead */
};

/* Zero-initialise. */
struct workload {
    int64_t us, at_us; /* work not yet paid off, at that time */
};

/* Adds `spent_us` of work that ended at `now_us`. Returns the rest in microseconds; 0: none. */
int64_t workload_charge(struct workload *workload, int64_t now_us, int64_t spent_us);

#endif
