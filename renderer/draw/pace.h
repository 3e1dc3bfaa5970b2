/* SPDX-License-Identifier: MIT */
/* The tile size of a scene. A tile is as large as can be drawn within a short time, so that other
 * pictures get their turn. The size is estimated from tile to tile for each quality level, and kept
 * with the scene. Small tiles cost more in total (a third more on a software driver), so they are
 * used only while others wait. The engine's tiles pause for others between their parts, and are
 * somewhat larger. Pixels do not depend on the size. Pure; one thread. */
#ifndef RENDERER_PACE_H
#define RENDERER_PACE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/picture.h"

enum pace_company {
    PACE_ALONE,
    PACE_SHARED,
    PACE_SHARED_PAUSING, /* and tiles pause */
    PACE_COMPANIES
};

enum {
    PACE_MIN = 8,          /* pixels: the smallest side, a work group */
    PACE_FIRST = 3,        /* doublings of the smallest side, where nothing is known */
    PACE_FIRST_SHARED = 1, /* in company, where one that is too large keeps others waiting */
    PACE_MAX = 6,
};

/* Of the row that is drawn: what was known when it began. */
struct pace_row {
    enum pace_company company;
    int doublings; /* of the smallest side */
    int64_t slowest_us;
};

/* Counted, since pictures under way outlive scenes. */
struct pace {
    int references;
    int doublings[PACE_COMPANIES][QUALITY_COUNT]; /* of the smallest side */
};

struct pace *pace_create(void);
struct pace *pace_ref(struct pace *pace);
void pace_unref(struct pace *pace);
/* The next row. */
struct pace_row pace_begin(const struct pace *pace, enum pace_company company,
                           enum quality_level level);
/* The smallest tiles, from the next row on. */
void pace_be_careful(struct pace *pace, enum quality_level level);
/* How wide the next tiles of the row are, `side` high: less than that where others have come since
 * it began, so that they wait as long as for any tile; `shared_side` is the side of theirs. */
int pace_width(const struct pace_row *row, enum pace_company company, int side, int shared_side);
/* A sample of a tile of the row took so long: too long halves the side of later ones. */
void pace_learn(struct pace *pace, enum quality_level level, struct pace_row *row, int64_t us);
/* All of the row is started: where each took little, the side of later ones is doubled. */
void pace_end(struct pace *pace, enum quality_level level, const struct pace_row *row);

#endif
