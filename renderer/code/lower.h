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

/* Where the expression's value is. Nothing may be assigned before it is used; lower_stable copies
 * it where `next` would assign to something. */
uint16_t lower_value(struct lower *lower, const struct expr *expr);
uint16_t lower_stable(struct lower *lower, const struct expr *expr, bool effects_follow);
uint16_t lower_alloc(struct lower *lower, int count);
uint16_t lower_number(struct lower *lower, const double *numbers, int count);
/* The index of the step; unused operands are MACHINE_NOWHERE. */
size_t lower_step(struct lower *lower, struct step step);
void lower_move(struct lower *lower, uint16_t to, uint16_t from, int count);
/* A jump, and where it goes: to the next step. */
size_t lower_jump(struct lower *lower, enum step_kind kind, uint16_t condition);
void lower_land(struct lower *lower, size_t jump);
/* Runs the step of an expression statement, whose value nobody reads. */
void lower_effect(struct lower *lower, const struct expr *expr);

#endif
