/* SPDX-License-Identifier: MIT */
/* Two-dimensional shapes, in the plane of X and Y. */
#include "tools.h"

const struct sdf sdf_flat[] = {
    {.type = NULL},
};
