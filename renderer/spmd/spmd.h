/* SPDX-License-Identifier: MIT */
/* Our GLSL as C over vectors: one program, many lanes, each of which stands for an invocation of a
 * shader. A build step; nothing of this folder is in the program.
 *
 *   text --parser (renderer/code)--> tree --resolve--> types --vary--> what lanes share --emit--> C
 *
 * What all lanes share stays a scalar, and a branch that all take alike a branch; elsewhere a
 * mask `m` says which lanes are on, both sides of a branch are run, each where it has lanes, and a
 * loop goes on while one is left (Pharr and Mark: ispc, a SPMD compiler for high-performance CPU
 * programming, InPar 2012, section 5). renderer/engine/lanes.h has what the C calls.
 *
 * A value is a list of components, each a variable of C; GCC keeps them in registers. */
#ifndef RENDERER_SPMD_H
#define RENDERER_SPMD_H

#include <stdio.h>

#include "renderer/code/parser.h"

/* What a function of GLSL's own gives. */
enum gives {
    GIVES_SAME,  /* the shape of its largest argument */
    GIVES_FLOAT, /* a float */
    GIVES_BOOL,  /* a bool */
    GIVES_BOOLS, /* as many bools as its first argument has components */
    GIVES_FLOATS,
    GIVES_INTS,
    GIVES_UINTS,
    GIVES_VEC3,
    GIVES_VEC4,
    GIVES_IVEC2,
};

/* How it is written. */
enum written {
    WRITTEN_EACH,   /* component by component: vf_NAME(a, b) */
    WRITTEN_SPECIAL /* by a function of emit_builtins.c */
};

struct spmd_builtin {
    const char *name;
    enum gives gives;
    enum written written;
};

/* It gives one value to all lanes, whatever their arguments are. */
bool spmd_builtin_joins(const char *name);
/* NULL: none. */
const struct spmd_builtin *spmd_builtin_find(const char *name);

/* Sets variable, function and type of all that is reachable from the functions named, callees first
 * in tree->called. */
bool spmd_resolve(struct tree *tree, const char *const *entries, size_t count);
/* Sets `varying` of expressions, variables, statements and functions. Parameters of entries and of
 * functions without a body vary, but single whole numbers and bools that no call varies. */
void spmd_vary(struct tree *tree, const char *const *entries, size_t count);
/* The C of all functions in tree->called. An entry that ends with a star stands for all names that
 * begin so. */
bool spmd_emit(struct tree *tree, const char *const *entries, size_t count, FILE *out);
/* What goes before: struct lanes, and the functions between this C and ours. */
bool spmd_emit_header(struct tree *tree, const char *const *entries, size_t count, FILE *out);

bool spmd_is_entry(const struct function *function, const char *const *entries, size_t count);
/* Components of a type, structs flattened. */
int spmd_components(const struct tree *tree, struct type type);
/* The base of component i. */
enum base spmd_base(const struct tree *tree, struct type type, int i);
/* The member of this name; `*out_first`: components before it. NULL: none. */
const struct variable *spmd_member(const struct tree *tree, struct type type,
                                   const struct name *name, int *out_first);
/* A constant whole number such as the length of an array. */
bool spmd_constant(struct tree *tree, const struct expr *expr, int *out);

#endif
