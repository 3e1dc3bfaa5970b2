/* SPDX-License-Identifier: MIT */
#include "pace.h"

#include <stdlib.h>

#include "protocol/memory.h"

struct pace *pace_create(void)
{
    struct pace *pace = memory_alloc(1, sizeof *pace);

    pace->references = 1;
    for (int i = 0; i < QUALITY_COUNT; i++) {
        pace->doublings[i] = PACE_FIRST;
    }
    return pace;
}

struct pace *pace_ref(struct pace *pace)
{
    pace->references++;
    return pace;
}

void pace_unref(struct pace *pace)
{
    if (pace && --pace->references == 0) {
        free(pace);
    }
}

void pace_shrink(struct pace *pace, enum quality_level level, int doublings)
{
    if (pace->doublings[level] >= doublings && doublings > 0) {
        pace->doublings[level] = doublings - 1;
    }
}

void pace_grow(struct pace *pace, enum quality_level level, int doublings)
{
    if (pace->doublings[level] <= doublings && doublings < PACE_MOST) {
        pace->doublings[level] = doublings + 1;
    }
}
