/* SPDX-License-Identifier: MIT */
/* Nodes become instructions. Private to this folder. */
#ifndef RENDERER_FIELD_EMIT_H
#define RENDERER_FIELD_EMIT_H

#include "field_shape.h"

/* What a slot holds already: nothing, the distance of what is not seen, or of what is. */
enum field_before { FIELD_NOTHING, FIELD_UNSEEN, FIELD_SEEN };

/* Leaves the distance of the subtree in `slot`. Where that holds a distance already a union with
 * the subtree takes its place; unions of unions thus are one. The result's boxes are the subtree's
 * alone, in the space that `outer` is in. */
struct result field_emit(struct builder *b, const struct node *node, const struct node_frame *outer,
                         uint16_t slot, enum field_before before);

/* The union of `slot` and the one behind it. */
struct field_instruction field_union_at(const struct builder *b, uint16_t slot);

#endif
