/* SPDX-License-Identifier: MIT */
/* What the parts share that write an equation as code. Private to the files equation_*.c here.
 *
 * Of each node without x, y and z there is a number sI; of each other one (gradient, value) gI at
 * the point, and a jet jI in the box around it. */
#ifndef RENDERER_EQUATION_WRITER_H
#define RENDERER_EQUATION_WRITER_H

#include <stdio.h>

#include "equation_rules.h"

struct equation_writer {
    const struct equation *equation;      /* all of its nodes are needed */
    const char *const *letters;           /* names that are read for them; NULL: see `places` */
    int places[LIMIT_EQUATION_NODES + 1]; /* of letters and numbers in vec4s; 0: none */
    FILE *out;
};

static inline const struct equation_node *node_of(const struct equation_writer *w, size_t index)
{
    return &w->equation->nodes[index];
}

static inline bool varies(const struct equation_writer *w, size_t index)
{
    return node_of(w, index)->varies;
}

/* Powers are negative where 1 / x is taken of them. */
static inline int size_of_power(const struct equation_node *node)
{
    return (int)(node->value < 0 ? -node->value : node->value);
}

/* Of these jets and duals are functions of jets.h. */
static inline bool equation_is_exp(const struct equation_node *node)
{
    return node->op == EQUATION_CALL && node->which == EQUATION_EXP;
}

static inline bool equation_is_wave(const struct equation_node *node)
{
    return node->op == EQUATION_CALL &&
           (node->which == EQUATION_SIN || node->which == EQUATION_COS);
}

/* A rule's text for an argument, such as g3.w. */
void equation_write_rule(const struct equation_writer *w, const char *text, const char *argument);
/* TYPE to = from^n;, by squaring; n > 0, and `from` is one name. */
void equation_write_power(FILE *out, const char *type, const char *to, const char *from, int n);
/* The statements that make sI, gI and jI. */
void equation_write_scalar(const struct equation_writer *w, size_t index);
void equation_write_gradient(const struct equation_writer *w, size_t index);
void equation_write_jet(const struct equation_writer *w, size_t index);

#endif
