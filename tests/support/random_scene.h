/* SPDX-License-Identifier: MIT */
/* Random scenes, the same on every machine. All generated nodes lie within some units
 * of the origin. */
#ifndef TESTS_SUPPORT_RANDOM_SCENE_H
#define TESTS_SUPPORT_RANDOM_SCENE_H

#include <stdint.h>
#include <stdio.h>

#include "protocol/scene.h"

struct random {
    uint64_t state;
};

/* Uniform in [low, high). */
double random_between(struct random *random, double low, double high);
size_t random_below(struct random *random, size_t count);
void random_direction(struct random *random, double out[3]);

/* What scenes may hold. Instances and users' code are left out. */
struct random_limits {
    int depth;    /* of operations and modifiers; 0: only shapes */
    bool bounded; /* below the root nothing goes on without end */
    bool exact;   /* only shapes with exact distances and uniform scales */
    bool plain;   /* no transforms */
    bool lean;    /* few children, and the first alone goes deeper, down to `depth` */
    bool inner;   /* not the root; random_node sets it for what is below */
};

/* Writes {'type': ..., 'params': ..., 'transform': ..., 'children': ...} without id, as for
 * json_text. */
void random_node(struct random *random, FILE *out, const struct node_type *type,
                 const struct random_limits *limits);
/* A type of this kind, by chance. */
const struct node_type *random_type(struct random *random, enum node_kind kind,
                                    const struct random_limits *limits);
/* A scene with three materials and a random tree whose root has this type. */
struct scene *random_scene(struct random *random, const struct node_type *type,
                           const struct random_limits *limits);
/* Sets every number of every node's parameters and transform to other ones; types, choices, texts
 * and how many points a list has stay, and with them the program. */
void random_numbers(struct random *random, struct node *node, const struct random_limits *limits);

#endif
