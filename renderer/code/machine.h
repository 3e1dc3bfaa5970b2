/* SPDX-License-Identifier: MIT */
/* Users' code as a list of steps over one frame of numbers, and what runs them for one point. Every
 * value of every function has a place of its own in the frame, as nothing calls itself.
 *
 * Whole numbers and booleans are doubles here, too, always within what their type holds. Steps and
 * constants tell their types, for renderer/engine, which runs them for a vector of points. */
#ifndef RENDERER_CODE_MACHINE_H
#define RENDERER_CODE_MACHINE_H

#include "builtins.h"
#include "code.h"
#include "tree.h"

/* The frame: values, then constants, so many at most. */
enum {
    MACHINE_VALUES = 8192,
    MACHINE_CONSTANTS = 8192,
    MACHINE_FRAME = MACHINE_VALUES + MACHINE_CONSTANTS,
    MACHINE_FRAME_SMALL = 400, /* does for most code, and fits into a page of the stack */
    MACHINE_NOWHERE = 0xffff,  /* no place in the frame */
    MACHINE_NUMBERS = 4 * LIMIT_DECLARED,
};

/* `n` components each. An operand whose bit of `flags` is set is one number, for all of them. */
enum step_kind {
    STEP_MOVE,    /* out = a */
    STEP_ZERO,    /* out = 0 */
    STEP_GATHER,  /* out[i] = a[two bits i of extra] */
    STEP_SCATTER, /* out[two bits i of extra] = a[i] */
    STEP_ADD,
    STEP_SUBTRACT,
    STEP_MULTIPLY,
    STEP_DIVIDE,
    STEP_NEGATE,
    STEP_LESS,       /* a < b */
    STEP_LESS_EQUAL, /* a <= b */
    STEP_EQUAL,      /* all of a == b; one result */
    STEP_NOT,
    STEP_WHOLE,   /* enum op `extra` of whole numbers; unsigned: of uint */
    STEP_CONVERT, /* to enum base `extra`; not between int and uint */
    STEP_PRODUCT, /* of matrices of `n` rows: c columns of a, c rows of b, `extra` columns of b */
    STEP_ONE,     /* functions of builtins.h, row c */
    STEP_TWO,
    STEP_THREE,    /* c: third operand, row `extra` */
    STEP_TOGETHER, /* the same; `n` is the size */
    STEP_INDEX,    /* out = (a kept in 0 ... c - 1) * n, plus b unless that is nowhere */
    STEP_LOAD,     /* out = n numbers at a, further by the number in b */
    STEP_STORE,    /* n numbers at out, further by the number in b = a */
    STEP_JUMP,     /* to step `out` */
    STEP_UNLESS,   /* to step `out` where a is 0 */
    STEP_LOOP,     /* a += 1; to step `out` where that is less than b; floats */
    STEP_CALL,     /* of the function at step `out` */
    STEP_RETURN,
};

enum { SPREAD_A = 1, SPREAD_B = 2, SPREAD_C = 4, STEP_UNSIGNED = 8 };

struct step {
    uint8_t kind, extra, flags;
    uint8_t parts; /* floats that come of it, at `out` */
    uint8_t base;  /* enum base of a (and b), where the step is for several */
    uint16_t n, out, a, b, c;
};

/* Where a step comes from, for messages. */
struct origin {
    struct at at;
    const char *what; /* "/", "pow" */
};

struct machine_code {
    struct step *steps;
    struct origin *origins; /* one for each step */
    size_t step_count, step_capacity;
    double *constants;
    uint8_t *constant_bases; /* enum base of each */
    size_t constant_count, constant_capacity;
    size_t value_count; /* the constants lie behind them */
    size_t entry;       /* the step to begin with */
    /* In the frame, what the code is given: a point, the numbers of what it declares, the same as
     * an array of floats (`data_count`, maybe 0; the rest is 0), struct code_shading (maybe
     * MACHINE_NOWHERE); and what it gives. */
    uint16_t point, numbers, data, shading, result;
    int number_count, data_count, result_count;
    uint8_t number_bases[MACHINE_NUMBERS]; /* enum base of each */
};

void machine_code_finish(struct machine_code *code);
/* Numbers in a frame of the code. */
size_t machine_frame_size(const struct machine_code *code);
/* The constants, into their places. */
void machine_prepare(const struct machine_code *code, double *frame);
/* From this step to the RETURN that belongs to it. With a `fault`, numbers that no float holds
 * become infinite, as in a driver, and the first that is none or infinite is noted. */
void machine_run(const struct machine_code *code, size_t first, double *frame,
                 struct code_fault *fault);

/* An operator of whole numbers, modulo 2^32. */
uint32_t machine_whole(enum op op, uint32_t a, uint32_t b, bool is_unsigned);

#endif
