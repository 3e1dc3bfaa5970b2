/* SPDX-License-Identifier: MIT */
/* Registry: two-dimensional shapes, children of extrude and revolve. */
#include "nodes_parts.h"

/* clang-format off */
const struct node_type node_flat[] = {
    {.record = {.name = NULL}},
};
/* clang-format on */
