/* SPDX-License-Identifier: MIT */
/* All of the engine that depends on LANES, the width of its vectors. */
#include "cubes.h"
#include "explored.h"
#include "matches.h"
#include "renderer/crash.h"
#include "renderer/image/half.h"

#include "spmd.h"

#include "spmd.c"

#include "interpret.c"
#include "points.c"
#include "siblings.c"

#include "renew.c"
#include "textures.c"
#include "tile.c"
#include "verify.c"

#include "environment_texels.c"
#include "passes.c"
#include "threads.c"

#include "explore.c"
#include "survey.c"

#include "explore_again.c"

#define CALL_ROW(row, base, size, one, function)
#define KERNEL_ROW(type, choices, kind, function)                                                  \
    {type, choices, KERNEL_##kind, (void (*)(void))function},
static const struct kernel_row kernels[] = {
#include "kernels.table"
};
#undef CALL_ROW
#undef KERNEL_ROW
#define CALL_ROW(row, base, size, one, function) {row, base, size, one, (void (*)(void))function},
#define KERNEL_ROW(type, choices, kind, function)
static const struct call_row calls[] = {
#include "kernels.table"
};

#define JOIN(a, b) a##b
#define NAME(lanes) JOIN(engine_, lanes)
const struct engine_width NAME(LANES) = {LANES,
                                         kernels,
                                         sizeof kernels / sizeof kernels[0],
                                         calls,
                                         sizeof calls / sizeof calls[0],
                                         draw,
                                         renew,
                                         hand_destroy,
                                         distances,
                                         explore,
                                         explore_again,
                                         make_map};
