/* SPDX-License-Identifier: MIT */
/* Distance functions in C, one row per row of the registry: the oracle of the GLSL functions of the
 * same name in renderer/glsl/, and what picking runs. Pure, double precision.
 *
 * Numbers (`n`) are a node's parameters in the order of the registry, after the row's `prepare`:
 * vectors as two to four, a choice as its index, a list of points as their count and then x, y of
 * each (at the end: such a parameter is the last). Texts are left out.
 *
 * In GLSL a choice is a literal int, and so part of the program; a list of points is a vec2 to be
 * read by points_count and points_at of glsl/points.glsl; all else floats and vectors. */
#ifndef RENDERER_SDF_H
#define RENDERER_SDF_H

#include "bounds.h"
#include "protocol/nodes.h"

enum {
    SDF_PARAMS_MAX = 24,               /* of one node, in values */
    SDF_NUMBERS_MAX = 24 + 1 + 2 * 64, /* and in numbers, with a list of points */
    SDF_CUT_NUMBERS = 7,               /* in front of those of polynomials and patches: field.h */
    SDF_DOMAIN_VEC4S_MAX = 4,
    SDF_REPEAT_CELLS_MAX = 125, /* that one repeat looks at for one point */
};

/* A twisted or bent child without an end is cut off at this distance from the axis: the bound falls
 * with the radius, so there is none without an end. */
#define SDF_TURN_RADIUS_MAX 32.0

/* What an operation makes of its operands. */
enum sdf_rule {
    SDF_ANY,   /* in any of them, so an empty one changes nothing */
    SDF_ALL,   /* in all of them, so an empty one leaves nothing */
    SDF_FIRST, /* the first without the others, so an empty first leaves nothing */
};

/* A change of the point that the children see. `n` holds vec4s numbers times four, computed by
 * `prepare` from the parameters (registry order), the children's box in the changed space, and the
 * factor from local lengths to lengths of the scene. */
struct sdf_domain {
    int vec4s;
    void (*prepare)(const double *params, const struct bounds *child, double scale, double *out_n);
    /* The box of the whole, from the children's. */
    struct bounds (*box)(const double *params, const struct bounds *child);
    /* NULL: children see the point as it is (displace). */
    void (*map)(const double p[3], const double *n, double out[3]);
    /* What makes the children's distance one of the whole; NULL where it is one already. */
    double (*after)(double d, const double p[3], const double *n);
    /* Loop iterations in the GLSL function of `after`, from the parameters; NULL: no loops. */
    int (*trips)(const double *params);
    /* Only where children are evaluated in several cells: `first` and `last` cell, steps of 1 per
     * axis; `map` is NULL and `cell` gives the point in a cell; `cells` the most there can be. */
    void (*range)(const double p[3], const double *n, double out_first[3], double out_last[3]);
    void (*cell)(const double p[3], const double cell[3], const double *n, double out[3]);
    int (*cells)(const double *n);
    /* Which number is 1 where more cells matter than are looked at, so that the distance jumps from
     * point to point; 0: none. */
    int partial;
};

struct sdf {
    const char *type; /* name of the registry row */
    /* Makes the numbers ready: unit vectors, limits. May be NULL. */
    void (*prepare)(double *n);

    /* KIND_SHAPE, KIND_FLAT (which leaves p[2] alone and has a box without an end along Z) */
    double (*shape)(const double p[3], const double *n);
    struct bounds (*box)(const double *n);
    /* Largest gradient length of `shape`, where the registry row says 0. The field is divided by
     * it. */
    double (*lipschitz)(const double *n);
    /* Loop iterations in the GLSL function; NULL: no loops. */
    int (*trips)(const double *n);

    /* KIND_COMBINE: `*out_share` is the derivative by `b`, in magnitude; `a` has the rest. */
    double (*combine)(double a, double b, const double *n, double *out_share);
    enum sdf_rule rule;
    bool soft; /* shares between 0 and 1 occur */
    /* SDF_ANY only: whether an operand that is FIELD_FAR away changes the other in double
     * precision; NULL: no. Depends on choices alone. */
    bool (*feels_far)(const double *n);
    size_t operands; /* only the first so many children count; 0: all */
    /* How much farther than the other an operand is from where it stops to matter: then the
     * result is the other alone, to the bit. INFINITY, or NULL: it always matters. Of all in an
     * intersection, and of what a difference takes away, distances count from the inside. */
    double (*reach)(const double *n);

    /* KIND_DISTANCE */
    double (*change)(double d, const double *n);

    /* KIND_COMBINE and KIND_DISTANCE, of numbers as they are in the document. All may be NULL. */
    /* Takes them from local lengths to lengths of the scene; NULL: every UNIT_LENGTH is multiplied
     * by the scale. */
    void (*scale)(double *n, double scale);
    /* How much the field of `count` operands may be lowered; NULL: not at all. */
    double (*lowered)(const double *n, size_t count);
    /* How many times a field above 0 may be too small; NULL: once. */
    double (*stretched)(const double *n, size_t count);

    const struct sdf_domain *domain; /* KIND_DOMAIN */
};

const struct sdf *sdf_at(size_t index); /* NULL behind the last */
/* The row for a registry row; NULL: not written yet (a test fails then). */
const struct sdf *sdf_find(const struct node_type *type);
/* The numbers of a node, of the values that belong to `params` (ending with a row whose name is
 * NULL); returns how many. */
int sdf_numbers(const struct param *params, const struct value *values,
                double out_n[SDF_NUMBERS_MAX]);

/* Each ends with a row whose type is NULL. */
extern const struct sdf sdf_shapes[], sdf_solids[], sdf_flat[], sdf_fractals[], sdf_operations[],
    sdf_modifiers[], sdf_repeats[], sdf_warps[];

#endif
