/* SPDX-License-Identifier: MIT */
/* Shapes in a field while it is compiled: the registry's and users'. Private to this folder. */
#ifndef RENDERER_FIELD_SHAPE_H
#define RENDERER_FIELD_SHAPE_H

#include "builder.h"
#include "field_frame.h"

struct result {
    bool hidden;       /* not drawn at all: an operation does not see it */
    bool apart;        /* nor because others are isolated */
    bool solid;        /* there is an instruction for it; else empty space */
    bool shown;        /* and something of it is seen; else it is as good as empty space */
    struct bounds box; /* of what is shown, or any where nothing is, in the space of the
                                frame that it was emitted in */
    bool transmissive; /* light goes through some of it, */
    struct bounds transmissive_box; /* which is in here */
};

/* Joins what is transmissive in both. */
void field_join_transmissive(struct result *to, const struct result *from);
/* Takes an operand of a union in. */
void field_join(struct result *to, const struct result *from);

/* Adds the instruction that leaves the distance of the node's own shape in `slot`; `number` is its
 * leaf's. The node is of KIND_SHAPE, KIND_FLAT, KIND_CODE, KIND_EQUATION or
 * KIND_SURFACE. */
struct result field_emit_shape(struct builder *b, const struct node *node,
                               const struct node_frame *frame, uint16_t slot, uint32_t number);

/* The indices of all choices, eight bits each: they are part of the program. */
uint32_t field_choices(const struct record *params);

#endif
