/* SPDX-License-Identifier: MIT */
/* What the files of the registry's rows share. Private to this folder and nodes.c. */
#ifndef PROTOCOL_ROWS_H
#define PROTOCOL_ROWS_H

#include "protocol/limits.h"
#include "protocol/nodes.h"

#define PARAMS(...) ((const struct param[]){__VA_ARGS__, {.name = NULL}})

/* Sources that many rows share. */
#define QUILEZ_DISTANCE "Inigo Quilez, Distance functions, iquilezles.org/articles/distfunctions"
#define QUILEZ_SMIN "Inigo Quilez, Smooth minimum, iquilezles.org/articles/smin"
#define QUILEZ_REPEAT "Inigo Quilez, Domain repetition, iquilezles.org/articles/sdfrepetition"
#define HART "John C. Hart, Sphere tracing, The Visual Computer 12 (1996)"

/* A length that must not be zero. */
#define SIZE UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .above_min = true, .step = 0.05
/* A length that may be zero. */
#define REACH UNIT_LENGTH, .min = 0, .max = LIMIT_COORDINATE, .step = 0.01
/* A place. */
#define PLACE UNIT_LENGTH, .step = 0.05

/* Handles that many rows share. */
#define POINT(P) P ".x, " P ".y, " P ".z"
#define BOX_HANDLES "size.x/2, 0, 0; 0, size.y/2, 0; 0, 0, size.z/2"
/* Out of the surface, by a length. */
#define OUT(BY) "skin.x + out.x*" BY ", skin.y + out.y*" BY ", skin.z + out.z*" BY
/* How far the middle of an edge of this radius lies behind both sides. */
#define ROUNDED(RADIUS) RADIUS "*(1 - sqrt(1/2))"

/* Each ends with a row whose name is NULL. */
extern const struct node_type node_shapes[];     /* numbers 1 to 39 */
extern const struct node_type node_solids[];     /* 40 to 69 */
extern const struct node_type node_fractals[];   /* 70 to 99 */
extern const struct node_type node_operations[]; /* 101 to 199 */
extern const struct node_type node_modifiers[];  /* 201 to 299 */
extern const struct node_type node_structure[];  /* 301 to 399 */
extern const struct node_type node_flat[];       /* 401 to 499 */

/* A table without rows, of parameters. */
static const struct param no_params[] = {{.name = NULL}};

#endif
