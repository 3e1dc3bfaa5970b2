/* SPDX-License-Identifier: MIT */
/* Types of users' code: what GLSL calls vec3, under all names that it goes by. */
#ifndef RENDERER_CODE_TYPES_H
#define RENDERER_CODE_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum base {
    BASE_VOID,
    BASE_FLOAT,
    BASE_INT,
    BASE_UINT,
    BASE_BOOL,
    BASE_PRIMITIVE, /* Primitive3D: holds nothing of its own, stands for the declared parameters */
    BASE_FRAGMENT,  /* FragmentProperties: stands for the point that is shaded */
    BASE_SURFACE,   /* Surface: all that a shader may say of a point */
    /* Only in the whole language (tree.h): */
    BASE_STRUCT,  /* `rows`: which of the tree's structs */
    BASE_SAMPLER, /* sampler2D */
};

struct type {
    uint8_t base;    /* enum base */
    uint8_t rows;    /* of a vector, or of a matrix' columns; 1: a scalar */
    uint8_t columns; /* 1: no matrix */
    uint8_t count;   /* of an array; 0: none */
};

enum { TYPE_NAME_BYTES = 32 };

/* A member of Surface: floats from `at` on among its numbers, as in struct code_surface. */
struct surface_member {
    const char *name;
    uint8_t rows, at;
    double low, high; /* what is outside of these is moved to the nearest */
};
enum { SURFACE_MEMBERS = 8, SURFACE_NUMBERS = 14 };
extern const struct surface_member surface_members[SURFACE_MEMBERS];
extern const double surface_defaults[SURFACE_NUMBERS]; /* of a Surface that was given nothing */

/* The type of this name, be it GLSL's or HLSL's. */
bool type_find(const char *text, size_t length, struct type *out);
/* GLSL's name; returns `out`. */
const char *type_name(struct type type, char out[TYPE_NAME_BYTES]);
/* All names, for hints; NULL at the end. */
const char *type_name_at(size_t index);

struct type type_vector(enum base base, int rows); /* 1 row: a scalar */
struct type type_matrix(int size);
struct type type_element(struct type type); /* of an array, matrix (a column) or vector */
/* What type_element takes one of. */
int type_elements(struct type type);
bool type_equal(struct type a, struct type b);
/* Numbers in it, 0 for what holds nothing. */
int type_components(struct type type);
bool type_is_scalar(struct type type);
bool type_is_vector(struct type type);
bool type_is_matrix(struct type type);
bool type_is_handle(struct type type);  /* Primitive3D or FragmentProperties */
bool type_is_number(struct type type);  /* float, int, uint, and vectors and matrices of them */
bool type_is_integer(struct type type); /* int, uint, and vectors of them */
bool type_is_surface(struct type type);
bool type_is(struct type type, enum base base); /* a scalar of this base */

#endif
