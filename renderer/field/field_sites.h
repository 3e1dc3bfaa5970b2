/* SPDX-License-Identifier: MIT */
/* Where each node stands in a program, and what it came to. With that the code that made the
 * program runs again for those nodes alone whose numbers have changed, and for what is around them:
 * the others are taken as they were. Private to this folder; field_patch.h is the way in.
 *
 *  root .------------------------------------------.    Sites are in the order in which nodes were
 *       | a .--------. b .-----------. c .-------. |    compiled, so those of a subtree follow each
 *       |   | a1 a2  |   | b1 [b2] b3|   | c1 c2 | |    other. Where b2 has changed, root, b and b2
 *       '------------------------------------------'    run again; a, b1, b3 and c are passed over.
 *
 * A node of a model has a site for each instance. */
#ifndef RENDERER_FIELD_SITES_H
#define RENDERER_FIELD_SITES_H

#include "field_shape.h"

enum { SITES_NONE = UINT32_MAX };

/* What has changed about a node. */
enum site_change {
    SITE_SAME,
    SITE_INSIDE, /* its own parameters, or something below it */
    SITE_ALL,    /* where it stands, and so all that is below it */
};

/* How far the program was. */
struct site_place {
    uint32_t instructions, vec4s, arguments, index, loops;
    uint64_t trips;
};

struct site {
    const struct node *node;
    uint32_t parent, end; /* sites: the one around it, and the first behind its subtree */
    uint32_t same;        /* another one of this node; SITES_NONE: none */
    uint32_t position;    /* among the operands of a union; SITES_NONE: it is none of one */
    uint32_t last;        /* its last operand; */
    uint32_t first_changed, last_changed; /* those that have changed; SITES_NONE: none */
    enum site_change change;
    bool guarded;                  /* its first instruction is a FIELD_GUARD */
    double scale;                  /* of the lengths inside a domain modifier */
    struct site_place start, stop; /* of `stop`, loops and trips are those of the subtree */
    struct result result;
    struct result before; /* what the operands of the union before it came to */
};

enum sites_list { SITES_PARAMS /* vec4s */, SITES_ARGUMENTS, SITES_LISTS };
enum { SITES_RANGES_MAX = 64, SITES_PATCHES = 8 };

/* What a patch has written. */
struct sites_patch {
    struct sites_range {
        size_t first, end;
    } ranges[SITES_LISTS][SITES_RANGES_MAX];
    size_t counts[SITES_LISTS];
    bool all; /* more ranges than are kept */
};

struct field_sites {
    struct site *at;
    size_t count, capacity;
    uint32_t *table; /* sites by the address of their node, made with the first patch */
    size_t table_size;
    struct builder_material_shader *material_shaders; /* as of the builder */
    size_t slot_count;                                /* of materials, with the default's */
    bool *transmissive;          /* of each material's slot, whether light goes through, */
    bool *repaint;               /* and whether its numbers have changed */
    bool changed, floor_changed; /* anything of the field; the floor */
    size_t material_arguments;   /* where those of materials begin */
    struct sites_patch patches[SITES_PATCHES]; /* the last ones; patch n is in n % SITES_PATCHES */
    uint64_t version;                          /* patches so far */
};

struct field_sites *sites_create(void);
void sites_destroy(struct field_sites *sites); /* NULL: nothing */

/* --- while a program is made, or made again --- all do nothing where builder.sites is NULL */

/* A node begins, and ends. */
uint32_t sites_open(struct builder *b, const struct node *node);
void sites_close(struct builder *b, uint32_t index, const struct result *result);
/* The node has no part in the program. */
void sites_leave_out(struct builder *b);
/* The next operand of a union is the child at `index`, and those before came to `own`. Returns the
 * next that has to be looked at, with what came to be until there. */
size_t sites_operand(struct builder *b, size_t index, struct result *own);
/* Whether the scale is another than before. */
bool sites_set_scale(struct builder *b, double scale);
/* Returns whether there is a guard around the node: `guarded`. */
bool sites_set_guarded(struct builder *b, bool guarded);
/* Its guard, which is written last, stands before the node. */
void sites_pass_guard(struct builder *b);
/* An instruction was put before those of the node. */
void sites_shift(struct builder *b);

/* --- while it is made again --- */

/* Whether the next node has a part in the program. */
bool sites_has(const struct builder *b, const struct node *node);
/* Whether the next node has to be looked at; whether it is empty space, whatever its numbers are:
 * then it has none in the program, since what was made of it was taken back. */
bool sites_has_changed(const struct builder *b);
bool sites_is_empty(const struct builder *b);
/* Passes over it. */
struct result sites_take(struct builder *b);
/* Fails unless this instruction is there. */
void sites_compare(struct builder *b, size_t index, const struct field_instruction *instruction);
enum { SITES_ROOM = 2 * SDF_NUMBERS_MAX }; /* no block has more numbers, nor vec4s */
/* Some of the list are going to be written: returns the first. Fails where they are not there:
 * returns 0, where any block has room. */
size_t sites_touch(struct builder *b, enum sites_list list, size_t first, size_t count);

/* All sites of the node; false: there is none. */
bool sites_mark(struct field_sites *sites, const struct node *node, enum site_change change);
/* Those alone that are in a site of `around`. */
void sites_mark_within(struct field_sites *sites, const struct node *node,
                       const struct node *around, enum site_change change);

/* Writes the numbers of what has changed (field_compile.c). The field has the base's shape and what
 * the numbers were before. False: not only numbers have changed, or the scene is no field now; then
 * neither the field nor the sites are of use. */
bool field_run_again(struct field *field, struct field_sites *sites, const struct scene *scene);

#endif
