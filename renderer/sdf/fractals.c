/* SPDX-License-Identifier: MIT */
/* Fractals, minimal surfaces, landscapes: what has loops in it. */
#include "tools.h"

const struct sdf sdf_fractals[] = {
    {.type = NULL},
};
