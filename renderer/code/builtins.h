/* SPDX-License-Identifier: MIT */
/* THE TABLE of functions that users' code can call: name, arguments, GLSL, C.
 *
 * Both evaluators agree also where GLSL says nothing. What is outside of a function's domain is
 * moved to its nearest end (glsl/code.glsl): sqrt(-1) is 0, acos(2) is 0, log(0) is log(1e-30),
 * normalize of nothing is nothing, atan(0, 0) is 0. pow() takes the magnitude of its first
 * argument. What is divided by 0 is divided by 1e-30, but gives 0 inside of mod() and for whole
 * numbers.
 */
#ifndef RENDERER_CODE_BUILTINS_H
#define RENDERER_CODE_BUILTINS_H

#include "types.h"

/* What arguments a function takes. Where several are of one shape, a scalar is also taken for a
 * vector, and a whole number for a float. */
enum family {
    FAMILY_FLOAT,       /* floats or vectors of one shape, which the result has, too */
    FAMILY_SIGNED,      /* the same, or of int */
    FAMILY_NUMBER,      /* the same, or of uint */
    FAMILY_SELECT,      /* two of float and one of bool, of one shape, which the result has, too */
    FAMILY_TEST,        /* one of float; the result is of bool */
    FAMILY_COMPARE,     /* two vectors of numbers; the result is of bool */
    FAMILY_EQUAL,       /* the same, also of bool */
    FAMILY_LOGIC,       /* a vector of bool, which the result is, too */
    FAMILY_COUNT,       /* a vector of bool; the result is a bool */
    FAMILY_SCALAR,      /* floats or vectors of one shape; the result is a float */
    FAMILY_SHAPE,       /* the same, but as a whole; the result has their shape */
    FAMILY_REFRACT,     /* two of one shape and a float */
    FAMILY_CROSS,       /* of vec3, which the result is, too */
    FAMILY_PLACE,       /* a vec3; the result is a float */
    FAMILY_OCTAVES,     /* a vec3 and an int; the result is a float */
    FAMILY_MATRIX,      /* matrices of one size, which the result has, too */
    FAMILY_DETERMINANT, /* a matrix; the result is a float */
    FAMILY_OUTER,       /* two vectors of one size; the result is a matrix */
    FAMILY_PRODUCT,     /* mul() of HLSL, whose M[i] are rows: b * a */
    FAMILY_JET,         /* floats as `sizes` says; only our own code calls these (jets.h) */
};

enum { BUILTIN_ARGUMENTS = 3, BUILTIN_JET = 9 };

/* As in glsl/code.glsl. */
#define BUILTIN_TINY 1e-30

/* What stands for a divisor. */
static inline double builtin_nonzero(double divisor)
{
    return divisor == 0 ? BUILTIN_TINY : divisor;
}

struct builtin {
    const char *name;
    enum family family;
    int arguments;
    int weight; /* operations that it counts for in each component when it runs; 0: one */
    int load;   /* the same when it is compiled, as measured; 0: as `weight` */
    int trips;  /* iterations of loops in it, at most */
    /* A name to call, or a text where $0, $1, $2 are arguments, each at most once. NULL: `name`. */
    const char *glsl;
    /* One of these; NULL for the others. The first three go component by component. */
    double (*one)(double);
    double (*two)(double, double);
    double (*three)(double, double, double);
    /* `n` is the size of vectors and matrices. */
    void (*whole)(double *out, const double *const in[BUILTIN_ARGUMENTS], int n);
    /* Of FAMILY_JET: components of the result and of the arguments; BUILTIN_JET: a mat3. */
    uint8_t sizes[1 + BUILTIN_ARGUMENTS];
};

/* Ends with a row whose name is NULL. Of rows of one name the first that fits is called. */
extern const struct builtin builtin_table[];

/* The first of this name; NULL: none. `ours`: also of FAMILY_JET. */
const struct builtin *builtin_find(const char *name, bool ours);
/* The type of so many components as `sizes` has. */
struct type builtin_jet_type(uint8_t size);
/* What to do instead of calling a function that GLSL or HLSL has, and users' code has not; NULL:
 * nothing is known of it. */
const char *builtin_advice(const char *name);

#endif
