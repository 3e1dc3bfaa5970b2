/* SPDX-License-Identifier: MIT */
/* How large the tiles of a scene are: as large as can be drawn in a moment, so that others get
 * their turn. Learned from tile to tile, for each quality level, and kept as long as the scene is
 * held. Pixels do not depend on it. Pure; one thread. */
#ifndef RENDERER_PACE_H
#define RENDERER_PACE_H

#include "protocol/picture.h"

enum {
    PACE_LONG_US = 20000, /* a sample of a tile that takes longer halves the side of later ones */
    PACE_SHORT_US = 4000, /* where all of a row take less it is doubled */
    PACE_FIRST = 3,       /* doublings of the smallest side, where nothing is known */
    PACE_MOST = 6,
};

/* Counted, since pictures under way outlive scenes. */
struct pace {
    int references;
    int doublings[QUALITY_COUNT]; /* of the smallest side */
};

struct pace *pace_create(void);
struct pace *pace_ref(struct pace *pace);
void pace_unref(struct pace *pace);
/* A sample of a tile took too long, or all of a row of tiles took little, whose side was the
 * smallest one doubled so many times. */
void pace_shrink(struct pace *pace, enum quality_level level, int doublings);
void pace_grow(struct pace *pace, enum quality_level level, int doublings);

#endif
