/* SPDX-License-Identifier: MIT */
/* Elements of MathML (Core), numbers and names, as text. Pure. */
#ifndef PROTOCOL_MATHML_H
#define PROTOCOL_MATHML_H

#include <stdbool.h>

#include "equation_internal.h"

#define MATHML_MINUS "\u2212"

struct mathml {
    struct equation_text out;
    int depth; /* of elements within a row; 0: a line may be broken here */
};

void mathml_put(struct mathml *m, const char *text);
void mathml_open(struct mathml *m, const char *tag);
void mathml_close(struct mathml *m, const char *tag);
void mathml_element(struct mathml *m, const char *tag, const char *text);
/* `form`: "prefix" or "postfix". */
void mathml_fence(struct mathml *m, const char *form, const char *sign, bool stretches);
/* A sign between two operands, even where a new line begins with it. */
void mathml_infix(struct mathml *m, const char *sign);
void mathml_minus(struct mathml *m);
void mathml_thin_space(struct mathml *m);
/* A line may be broken here. */
void mathml_break(struct mathml *m);

void mathml_whole(struct mathml *m, double value);
/* 1.5e+20 is 1.5 times 10 to the power of 20. */
void mathml_number(struct mathml *m, double value);
/* A Greek letter for its name; an index, as 1 in x1 and x_1, below. */
void mathml_name(struct mathml *m, const char *name);
/* Whether a name has more than one letter before its index. */
bool mathml_is_word(const char *name);

#endif
