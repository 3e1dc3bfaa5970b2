/* SPDX-License-Identifier: MIT */
/* How well the equations of a document are drawn: what bounds their distances, where they have no
 * zero though the sign changes, and how many rays end where no zero is proved. And its parametric
 * surfaces: how far their patches are off. */
#ifndef RENDERER_FIELD_QUALITY_H
#define RENDERER_FIELD_QUALITY_H

#include "protocol/limits.h"
#include "protocol/scene.h"
#include "renderer/sdf/bounds.h"

enum equation_quality_kind {
    QUALITY_POLYNOMIAL, /* the distance is bounded by its coefficients */
    QUALITY_SAFE,       /* the same by intervals; no sampled line meets a pole or a jump */
    QUALITY_POLE,       /* a wall is drawn, which no one has asked for */
    QUALITY_JUMP,       /* the same */
    QUALITY_SAMPLED,    /* a parametric surface, drawn by patches */
    QUALITY_UNKNOWN,    /* it cannot be read or drawn */
};

struct equation_quality {
    char node[LIMIT_ID_BYTES + 1];
    char place[ERROR_PLACE_BYTES]; /* of the equation, or the surface */
    enum equation_quality_kind kind;
    int degree;     /* of a polynomial */
    double at[3];   /* of a pole or a jump, in the node's own coordinates */
    int rays;       /* through the clip, followed to where they are drawn to end */
    int unresolved; /* of them: there the sign of the equation does not change, as at double roots,
                     * or the bound is so small that they hardly go on */
    /* Of a parametric surface: */
    int patches, left_out; /* all that it has; of them not finite, so they are holes */
    double error;          /* the greatest way from a point of a patch to that of the surface with
                              the same parameters, of four points of each: an estimate */
    bool thin;             /* that is more than half of the thickness */
    struct bounds box;     /* of the sheet, in the node's own coordinates */
};

enum { QUALITY_TEXT_BYTES = 160 };

/* Of each node with an equation or a surface, also of hidden ones and of models, in the document's
 * order; `node` is the only one, NULL: all. Rays are followed by the distance that is drawn, in
 * double precision. The same result each time. One takes a second at most, a tenth as a rule. Any
 * thread. */
void field_qualities(const struct scene *scene, const char *node,
                     void (*tell)(void *data, const struct equation_quality *quality), void *data);

/* "exact polynomial of degree 4", "safe, 12 % unresolved", "unsafe: pole at (0, 1, 0)", "1024
 * patches, off by 2.1e-06". */
const char *equation_quality_text(const struct equation_quality *quality,
                                  char out[QUALITY_TEXT_BYTES]);

#endif
