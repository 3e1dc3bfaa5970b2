/* SPDX-License-Identifier: MIT */
/* The growing parts of a field program while it is compiled: instructions, numbers, leaves. What is
 * put together out of them is decided in field_compile.c. */
#ifndef RENDERER_BUILDER_H
#define RENDERER_BUILDER_H

#include "field.h"

/* A list of points that has no place in the buffer yet. */
struct builder_points {
    uint32_t vec4;     /* where its place and count are written, */
    int component;     /* from this component on */
    uint32_t argument; /* where the C evaluator has it: the count, then x, y of each */
};

/* The code that a material is shaded by. */
struct builder_material_shader {
    const char *text;        /* NULL: none; else what it is found by */
    const struct shade *own; /* of the registry; NULL: the document's */
    bool unlit;
    bool transmissive; /* light may go through what it shades */
    int index;         /* in the field's shaders, -1: none, or it does not compile */
    int first;         /* of the material's parameters that it reads */
};

struct result;
struct instance_values;

struct builder {
    struct field *field;
    const struct scene *scene;
    const struct field *drawn; /* hidden nodes that stand in it are kept; NULL: none */
    struct builder_material_shader *material_shaders; /* one for each material of the scene */
    const struct isolation *isolation;                /* NULL: all nodes are seen */
    const struct node_type *union_type; /* of unions that no node asks for by its name */
    const struct sdf *union_sdf;
    size_t instruction_capacity, vec4_capacity, argument_count, argument_capacity, leaf_capacity,
        member_capacity;
    struct builder_points *points;
    size_t points_count, points_capacity;
    uint32_t index;    /* pre-order in the scene's tree, of the next node */
    uint32_t instance; /* number of the outermost `model` node around, 0: none */
    const struct node *instance_node;
    const struct instance_values *values; /* of the innermost one; NULL: none */
    bool cutting;           /* what comes is taken away from something else, or bounds it; */
    bool cuts_transmissive; /* and light goes through that */
    bool measured;          /* what is around draws where the distance of what comes is not 0 */
    bool hiding;            /* a node around is hidden */
    bool within;            /* what comes is not to be looked for in `isolation` */
    bool ended;             /* what has no end is not to be seen */
    size_t depth;           /* nodes around, through models */
    size_t emitted;         /* nodes so far; those of models count for each use */
    size_t surface_rows;    /* numbers of surfaces so far, by fours */
    uint64_t trips;         /* loop iterations so far, in the current loop */
    size_t loops;           /* whose iterations these are, and of which something is seen */
    bool failed;            /* what follows may be left out */
    struct error err;       /* the first, once failed */

    /* Where nodes stand (field_sites.h); NULL: that is not kept. */
    struct field_sites *sites;
    /* The program is there: what is added is found in its place, and numbers are overwritten. The
     * counts of `field` are places in it. What is not as it was fails, without an error. */
    bool again;
    bool whole;         /* again: all nodes from here on, not only those that have changed */
    uint32_t site;      /* around what comes */
    uint32_t next_site; /* of the next node */
    uint32_t position;  /* of that among the operands of a union */
    const struct result *before; /* what these came to so far; NULL: it is none of a union */
};

/* FNV-1a (Fowler, Noll, Vo), 64 bits, over the bytes of a word. */
#define BUILDER_HASH_START UINT64_C(0xcbf29ce484222325)
uint64_t builder_hash(uint64_t state, uint32_t word);

/* Keeps the first error, at `place`. */
void builder_fail(struct builder *b, const struct error *err, const char *place);

/* A loop of so many iterations; 0: none. */
void builder_add_trips(struct builder *b, uint64_t trips);
/* `count` new vec4s of zeros, or again what they hold; returns the first. */
uint32_t builder_add_vec4s(struct builder *b, size_t count);
/* Room for as many numbers of the C evaluator; returns the first. */
uint32_t builder_add_arguments(struct builder *b, size_t count);
void builder_add_instruction(struct builder *b, struct field_instruction instruction);
void builder_insert_instruction(struct builder *b, size_t position,
                                struct field_instruction instruction);
void builder_add_leaf(struct builder *b, uint32_t number, const char *id);
void builder_add_member(struct builder *b, uint64_t hash);
/* Of one that is finished. */
bool field_has_member(const struct field *field, uint64_t hash);

/* Writes `count` numbers to the buffer and, as rounded there, to the arguments. */
void builder_put(struct builder *b, uint32_t vec4, int component, uint32_t argument, int count,
                 const double *numbers);
/* The parameters of a node, from `vec4` on, where the first `used` components are taken. Lengths
 * are multiplied by `scale`. `sdf` may be NULL: nothing is prepared. */
void builder_put_params(struct builder *b, const struct param *params, const struct value *values,
                        const struct sdf *sdf, double scale, uint32_t vec4, int used,
                        uint32_t argument);
/* Gives the lists of points their places, behind all that the program reads by constant index. */
void builder_place_points(struct builder *b);

/* What is taken back when something turns out to be empty space. */
struct builder_mark {
    size_t instructions, vec4s, arguments, leaves, points, shapes, members;
    size_t loops, surface_rows;
    uint64_t trips;
};
struct builder_mark builder_mark(const struct builder *b);
void builder_rewind(struct builder *b, struct builder_mark mark);
/* Nothing is seen of what was added since. */
void builder_hide(struct builder *b, struct builder_mark mark);

#endif
