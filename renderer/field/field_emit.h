/* SPDX-License-Identifier: MIT */
/* Nodes become instructions. Private to this folder. */
#ifndef RENDERER_FIELD_EMIT_H
#define RENDERER_FIELD_EMIT_H

#include "field_shape.h"

/* Leaves the distance of the subtree in `slot`. `joined`: the slot holds a distance already, whose
 * place a union with the subtree takes; unions of unions thus are one. The result's boxes are the
 * subtree's alone, in the space that `outer` is in. */
struct result field_emit(struct builder *b, const struct node *node, const struct frame *outer,
                         uint16_t slot, bool joined);

/* The union of `slot` and the one behind it. */
struct field_instruction field_union_at(const struct builder *b, uint16_t slot);

#endif
