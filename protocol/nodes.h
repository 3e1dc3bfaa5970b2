/* SPDX-License-Identifier: MIT */
/* THE REGISTRY: one row per node type. Validation, defaults, parameter layout, shader calls, JSON
 * Schema, the editor's palette and forms are derived from it and nowhere written twice. */
#ifndef PROTOCOL_NODES_H
#define PROTOCOL_NODES_H

#include <stdbool.h>
#include <stddef.h>

#include "record.h"

enum node_group {
    GROUP_PRIMITIVE,
    GROUP_SHAPE, /* two-dimensional, made for extrude and revolve */
    GROUP_OPERATION,
    GROUP_MODIFIER,
    GROUP_STRUCTURE,
};

/* What the renderer does with a row; the renderer has one case per kind, never one per type. */
enum node_kind {
    KIND_SHAPE,    /* distance from a point and parameters: GLSL float NAME(vec3 p, ...) */
    KIND_FLAT,     /* the same in two dimensions, endless along Z: float NAME(vec2 p, ...) */
    KIND_COMBINE,  /* folds the distances of its children */
    KIND_DISTANCE, /* changes the distance of its (united) children: round, shell */
    KIND_DOMAIN,   /* changes the point its children see: mirror, repeat, twist */
    KIND_GROUP,    /* union, nothing of its own */
    KIND_MODEL,    /* an instance of a model of the scene */
    KIND_CODE,     /* a distance function written by a user */
    KIND_EQUATION, /* the zero set of an equation written by a user */
    KIND_SURFACE,  /* a parametric surface written by a user */
};

enum node_exactness { EXACT, BOUND };

enum { NODE_NUMBERS = 500 }; /* every row's number is below */

struct node_type {
    struct record_type record; /* name, doc, params */
    int number;                /* saved in binary forms and hashes; never changes, never reused */
    enum node_group group;
    enum node_kind kind;
    enum node_exactness exactness;
    /* Largest gradient length of the raw function; the renderer divides by it. 0 means that a rule
     * computed from parameters and bounds gives it (twist, terrain). */
    double lipschitz;
    /* It has creases within every pixel, however near the eye is. So a pixel's normal is that of
     * some place in it, and its depth is right to two pixels' width. */
    bool creased;
    const char *glsl;   /* name of the GLSL function */
    const char *words;  /* search synonyms for the palette: "donut ring" */
    const char *source; /* where the formula comes from */
};

const char *node_group_name(enum node_group group);
size_t node_type_count(void);
const struct node_type *node_type_at(size_t index);
const struct node_type *node_type_find(const char *name); /* NULL: none */

/* The other tables of a document; each ends with a row whose name is NULL where it is a list. */
extern const struct record_type node_common_type; /* name, material, visible */
extern const struct record_type transform_type;   /* translation, rotation, scale */
extern const struct record_type scene_info_type;  /* name */
extern const struct record_type camera_type;
extern const struct record_type environment_type;
extern const struct record_type render_type;
extern const struct record_type light_types[];
extern const struct record_type volume_types[];
extern const struct record_type shader_types[];
extern const struct record_type primitive_type; /* of a document's `primitives` */
extern const struct record_type shader_type;    /* of its `shaders` */
extern const struct record_type model_type;     /* of its `models`, beside the tree */
const struct record_type *record_type_in(const struct record_type *table, const char *name);

#endif
