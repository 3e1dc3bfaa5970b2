/* SPDX-License-Identifier: MIT */
/* Where an equation changes its sign and is 0 nowhere near: at a pole, as 1/x, or at a jump, as
 * floor(x). What is drawn has a wall there, since a wall is what parts the signs. Pure. */
#ifndef RENDERER_EQUATION_POLE_H
#define RENDERER_EQUATION_POLE_H

#include "protocol/equation.h"

/* Tries lines by chance, the same ones each time, in a box around the origin. False: none has
 * one. */
bool equation_pole(const struct equation *equation, const double *letters, const double half[3],
                   double out_at[3]);

#endif
