/* SPDX-License-Identifier: MIT */
/* Nodes of an equation while it is read. Private to equation*.c. */
#ifndef PROTOCOL_EQUATION_PARTS_H
#define PROTOCOL_EQUATION_PARTS_H

#include "equation.h"

/* The index of a node like this one, which is added unless it is there. False: there are too
 * many, LIMIT_EQUATION_NODES, or LIMIT_EQUATION_WEIGHT of them written out. */
bool equation_add(struct equation *equation, struct equation_node node, uint16_t *out);

#endif
