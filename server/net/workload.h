/* SPDX-License-Identifier: MIT */
/* How much of the front's time one connection takes: after WORKLOAD_FREE_US of work it rests for as
 * long as it has worked, so that it never takes more than half of a thread that others need too.
 * Time that passes pays for work. Pure; one thread. */
#ifndef SERVER_WORKLOAD_H
#define SERVER_WORKLOAD_H

#include <stdint.h>

enum {
    WORKLOAD_FREE_US = 20000,
    WORKLOAD_REST_MAX_US = 2000000, /* the other side shall not take it for dead */
};

/* Zero-initialise. */
struct workload {
    int64_t us, at_us; /* not yet paid for, at that time */
};

/* It has worked for `spent_us` until `now_us`. Returns how long it rests, in us; 0: not at all. */
int64_t workload_charge(struct workload *workload, int64_t now_us, int64_t spent_us);

#endif
