/* SPDX-License-Identifier: MIT */
#include "doorbell.h"

#include <stdbool.h>

enum { MOST = 4 }; /* that wait at once; more ring at once */

static _Thread_local struct {
    bool held;
    int count;
    const struct doorbell *waiting[MOST];
} own;

static bool waits(const struct doorbell *bell)
{
    int i = 0;

    while (i < own.count && own.waiting[i] != bell) {
        i++;
    }
    return i < own.count;
}

void doorbell_ring(const struct doorbell *bell)
{
    if (!own.held || (!waits(bell) && own.count == MOST)) {
        bell->ring(bell->data);
    } else if (!waits(bell)) {
        own.waiting[own.count++] = bell;
    }
}

void doorbells_hold(void)
{
    own.held = true;
}

void doorbells_release(void)
{
    own.held = false;
    while (own.count > 0) {
        doorbell_ring(own.waiting[--own.count]);
    }
}
