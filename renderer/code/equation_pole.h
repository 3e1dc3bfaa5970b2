/* SPDX-License-Identifier: MIT */
/* Where an equation changes its sign and is 0 nowhere near: at a pole, as 1/x, or at a jump, as
 * floor(x). What is drawn has a wall there, since a wall is what parts the signs. Pure. */
#ifndef RENDERER_EQUATION_POLE_H
#define RENDERER_EQUATION_POLE_H

#include "protocol/equation.h"

/* Around the origin. */
struct equation_clip {
    double half[3]; /* of the box; each is the radius of a ball */
    bool ball;
};

/* Line n of a sequence that fills the clip evenly, from one point of it to another; the same one
 * each time. */
void equation_line(const struct equation_clip *clip, int n, double out_from[3], double out_way[3]);

enum equation_break {
    EQUATION_UNBROKEN, /* none of some lines meets one */
    EQUATION_POLE,     /* it grows without bound on both sides */
    EQUATION_JUMP,
};
/* Tries lines of the clip, up to the first that meets one. */
enum equation_break equation_pole(const struct equation *equation, const double *letters,
                                  const struct equation_clip *clip, double out_at[3]);

#endif
