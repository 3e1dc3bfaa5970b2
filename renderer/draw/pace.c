/* SPDX-License-Identifier: MIT */
#include "pace.h"

#include <stdlib.h>

#include "protocol/memory.h"

/* A tile takes four times as long as one of half its side: in company it takes some 5 ms. Who
 * comes to one that was alone waits for its tile once. */
static const struct {
    int64_t long_us, short_us;
} bounds[PACE_COMPANIES] = {[PACE_ALONE] = {80000, 20000},
                            [PACE_SHARED] = {7500, 1800},
                            [PACE_SHARED_PAUSING] = {40000, 10000}};

struct pace *pace_create(void)
{
    struct pace *pace = memory_alloc(1, sizeof *pace);

    pace->references = 1;
    for (int i = 0; i < QUALITY_COUNT; i++) {
        pace->doublings[PACE_ALONE][i] = PACE_FIRST;
        pace->doublings[PACE_SHARED][i] = PACE_FIRST_SHARED;
        pace->doublings[PACE_SHARED_PAUSING][i] = PACE_FIRST;
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

struct pace_row pace_begin(const struct pace *pace, enum pace_company company,
                           enum quality_level level)
{
    return (struct pace_row){.company = company, .doublings = pace->doublings[company][level]};
}

int pace_width(const struct pace_row *row, enum pace_company company, int side, int shared_side)
{
    const int width = shared_side * shared_side / side / PACE_MIN * PACE_MIN; /* as many pixels */

    return row->company != PACE_ALONE || company == PACE_ALONE || shared_side >= side ? side
           : width > PACE_MIN                                                         ? width
                                                                                      : PACE_MIN;
}

void pace_be_careful(struct pace *pace, enum quality_level level)
{
    for (int i = 0; i < PACE_COMPANIES; i++) {
        pace->doublings[i][level] = 0;
    }
}

void pace_learn(struct pace *pace, enum quality_level level, struct pace_row *row, int64_t us)
{
    int *doublings = &pace->doublings[row->company][level];

    row->slowest_us = us > row->slowest_us ? us : row->slowest_us;
    if (us > bounds[row->company].long_us && *doublings >= row->doublings && row->doublings > 0) {
        *doublings = row->doublings - 1;
    }
}

void pace_end(struct pace *pace, enum quality_level level, const struct pace_row *row)
{
    int *doublings = &pace->doublings[row->company][level];

    if (row->slowest_us < bounds[row->company].short_us && *doublings <= row->doublings &&
        row->doublings < PACE_MAX) {
        *doublings = row->doublings + 1;
    }
}
