/* SPDX-License-Identifier: MIT */
/* Registry: fractals, minimal surfaces and landscapes. */
#include "nodes_parts.h"

/* clang-format off */
const struct node_type node_fractals[] = {
    {.record = {.name = NULL}},
};
/* clang-format on */
