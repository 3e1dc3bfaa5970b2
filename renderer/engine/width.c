/* SPDX-License-Identifier: MIT */
/* All of the engine that depends on LANES, the width of its vectors. */
#include "lanes_parts.h"

#include "spmd.h"

#include "spmd.c"

#include "interpret.c"
#include "textures.c"
#include "tile.c"

#include "threads.c"

#define KERNEL(type, choices, kind, function)                                                      \
    {type, choices, KERNEL_##kind, (void (*)(void))function},
static const struct kernel_row kernels[] = {
#include "kernels.table"
};

#define JOIN(a, b) a##b
#define NAME(lanes) JOIN(engine_, lanes)
const struct engine_width NAME(LANES) = {LANES, kernels, sizeof kernels / sizeof kernels[0], draw};
