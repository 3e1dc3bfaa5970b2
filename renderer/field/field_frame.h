/* SPDX-License-Identifier: MIT */
/* Where a node stands while its field is compiled. Private to this folder. */
#ifndef RENDERER_FIELD_FRAME_H
#define RENDERER_FIELD_FRAME_H

#include "protocol/scene.h"
#include "renderer/sdf/bounds.h"

/* A node sees the point in one of the program's point slots: local = matrix * point. */
struct node_frame {
    double matrix[12], back[12]; /* back: from local to the slot's space */
    double scale;                /* from local lengths to the scene's */
    double slot_scale;           /* from the slot's lengths to the scene's */
    uint16_t point;
    size_t material; /* the slot that it inherits */
};

/* A frame whose local space is that of the point slot. */
struct node_frame node_frame_create(uint16_t point, double scale, size_t material);

/* Inside `outer`, by the node's transform. `out_from` takes local points to the space of `outer`,
 * `*out_ratio` tells how much more it stretches one way than another. */
struct node_frame node_frame_enter(const struct node_frame *outer, const struct node *node,
                                   double out_from[12], double *out_ratio);

/* Far inside what a float holds: products of two such numbers must not overflow. */
bool node_frame_is_sane(const struct node_frame *frame);

#endif
