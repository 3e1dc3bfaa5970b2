/* SPDX-License-Identifier: MIT */
/* From a checked tree to steps of machine.h. */
#ifndef RENDERER_CODE_LOWER_H
#define RENDERER_CODE_LOWER_H

#include "machine.h"

/* The entry of the tree and all that it calls. False: the tree's error says that it is too much. */
bool lower_tree(struct tree *tree, struct machine_code *out);

/* The components of an expression all of whose parts are constants. `scratch` is kept from call to
 * call and finished by the caller. False: it is too much. */
bool lower_constant(const struct expr *expr, struct machine_code *scratch, double *out);

/* --- between the files of lower --- */

struct jumps {
    size_t *steps;
    size_t count, capacity;
};

struct lower {
    struct machine_code *code;
    uint16_t top, peak;               /* of the frame: what is in use; the most that ever was */
    uint16_t locals;                  /* from here on there are only intermediate values */
    size_t label;                     /* the last step that is jumped to */
    bool keep;                        /* constants of variables stay where they are */
    bool full;                        /* the frame or the constants did not suffice */
    struct origin origin;             /* of the steps that come */
    struct jumps *breaks, *continues; /* of the innermost loop */
    const struct function *function;
};

/* An operand; `spread`: one number, which stands for all components. */
struct operand {
    uint16_t at;
    bool spread;
};

/* Something that can be assigned to, or a part of any value: numbers at `at`, further by the number
 * at `offset` unless that is nowhere; of these the components of the swizzle, if there is one. */
struct spot {
    uint16_t at, offset;
    struct type type; /* before the swizzle */
    int count;        /* of the swizzle; 0: none */
    uint8_t swizzle[4];
};

/* lower_steps.c: places in the frame; a constant's; the index of a new step. Operands that a step
 * has not are MACHINE_NOWHERE. */
uint16_t lower_alloc(struct lower *lower, int count);
uint16_t lower_number(struct lower *lower, enum base base, const double *numbers, int count);
size_t lower_step(struct lower *lower, struct step step);
void lower_move(struct lower *lower, uint16_t to, uint16_t from, int count);
/* A jump, and where it goes: to the next step. */
size_t lower_jump(struct lower *lower, enum step_kind kind, uint16_t condition);
void lower_land(struct lower *lower, size_t jump);

/* lower_operators.c. a op b are numbers of one base, whose components go together, or one is for
 * all. */
struct operand lower_operand(struct lower *lower, const struct expr *expr, int count);
uint8_t lower_spread_flags(struct operand a, struct operand b);
uint16_t lower_join(struct lower *lower, enum step_kind kind, int count, struct operand a,
                    struct operand b, struct step more);
uint16_t lower_arithmetic(struct lower *lower, enum op op, struct type result, struct operand a,
                          struct operand b);
bool lower_is_product(enum op op, struct type a, struct type b); /* of matrices */
uint16_t lower_product(struct lower *lower, struct type a_type, uint16_t a, struct type b_type,
                       uint16_t b);
uint16_t lower_binary(struct lower *lower, const struct expr *expr);
uint16_t lower_unary(struct lower *lower, const struct expr *expr);
uint16_t lower_choice(struct lower *lower, const struct expr *expr);

/* lower_places.c */
struct spot lower_spot(struct lower *lower, const struct expr *expr);
uint16_t lower_load(struct lower *lower, const struct spot *spot);
void lower_store(struct lower *lower, const struct spot *spot, uint16_t from);
/* They give the value of the expression, if that is `wanted`. */
uint16_t lower_assign(struct lower *lower, const struct expr *expr, bool wanted);
uint16_t lower_increment(struct lower *lower, const struct expr *expr, bool wanted);

/* lower_values.c: where the expression's value is, which may be a variable's own place: parts of an
 * expression do not assign to what others use (check_order). */
uint16_t lower_value(struct lower *lower, const struct expr *expr);
/* A constructor whose arguments follow one another, into a place that none of them is in. */
bool lower_has_parts(const struct expr *expr);
void lower_parts(struct lower *lower, const struct expr *expr, uint16_t out);
/* Of a statement, whose value is not used. */
void lower_effect(struct lower *lower, const struct expr *expr);

#endif
