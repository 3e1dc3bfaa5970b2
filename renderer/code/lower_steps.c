/* SPDX-License-Identifier: MIT */
/* The frame, constants, and steps one after the other. */
#include <string.h>

#include "lower.h"
#include "protocol/memory.h"

uint16_t lower_alloc(struct lower *lower, int count)
{
    if (lower->top + count > MACHINE_VALUES) {
        lower->full = true;
        return 0;
    }
    const uint16_t at = lower->top;
    lower->top = (uint16_t)(lower->top + count);
    lower->peak = lower->top > lower->peak ? lower->top : lower->peak;
    return at;
}

/* Whether `count` constants from `at` on are these. */
static bool are_constants(const struct machine_code *code, size_t at, enum base base,
                          const double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (code->constant_bases[at + i] != base) {
            return false;
        }
    }
    return memcmp(code->constants + at, numbers, count * sizeof *numbers) == 0;
}

static void constants_room(struct machine_code *code, size_t count)
{
    while (code->constant_capacity < code->constant_count + count) {
        code->constant_capacity = code->constant_capacity > 0 ? 2 * code->constant_capacity : 64;
        code->constants =
            memory_resize(code->constants, code->constant_capacity, sizeof *code->constants);
        code->constant_bases =
            memory_resize(code->constant_bases, code->constant_capacity, sizeof(uint8_t));
    }
}

uint16_t lower_number(struct lower *lower, enum base base, const double *numbers, int count)
{
    enum { LOOKED_AT = 64 };
    struct machine_code *code = lower->code;
    const size_t size = (size_t)count, have = code->constant_count;
    for (size_t back = size; back <= have && back <= size + LOOKED_AT; back++) {
        if (are_constants(code, have - back, base, numbers, size)) {
            return (uint16_t)(MACHINE_VALUES + have - back);
        }
    }
    if (have + size > MACHINE_CONSTANTS) {
        lower->full = true;
        return MACHINE_VALUES;
    }
    constants_room(code, size);
    memcpy(code->constants + have, numbers, size * sizeof *numbers);
    memset(code->constant_bases + have, (int)base, size);
    code->constant_count += size;
    return (uint16_t)(MACHINE_VALUES + have);
}

size_t lower_step(struct lower *lower, struct step step)
{
    struct machine_code *code = lower->code;

    if (code->step_count == code->step_capacity) {
        code->step_capacity = code->step_capacity > 0 ? 2 * code->step_capacity : 64;
        code->steps = memory_resize(code->steps, code->step_capacity, sizeof *code->steps);
        code->origins = memory_resize(code->origins, code->step_capacity, sizeof *code->origins);
    }
    code->steps[code->step_count] = step;
    code->origins[code->step_count] = lower->origin;
    lower->full |= code->step_count >= UINT16_MAX;
    return code->step_count++;
}

size_t lower_jump(struct lower *lower, enum step_kind kind, uint16_t condition)
{
    return lower_step(lower, (struct step){.kind = (uint8_t)kind, .a = condition});
}

void lower_land(struct lower *lower, size_t jump)
{
    lower->label = lower->code->step_count;
    lower->code->steps[jump].out = (uint16_t)lower->label;
}

/* How many numbers come of it; 0: not all are made by it alone. */
static int results(const struct step *s)
{
    switch ((enum step_kind)s->kind) {
    case STEP_LOAD:
    case STEP_STORE:
    case STEP_SCATTER:
    case STEP_INDEX:
    case STEP_JUMP:
    case STEP_UNLESS:
    case STEP_LOOP:
    case STEP_CALL:
    case STEP_RETURN:
        return 0;
    case STEP_EQUAL:
        return 1;
    case STEP_PRODUCT:
        return s->parts;
    case STEP_TOGETHER:
        return s->parts > 0 ? s->parts : 1;
    default:
        return s->n;
    }
}

/* Whether the step still computes the same when its result goes to `to`, which its operands may
 * overlap. */
static bool may_go_to(const struct step *s, uint16_t to)
{
    enum { REACH_MAX = 16 };
    const uint16_t operands[] = {s->a, s->b, s->c};
    const bool each = s->kind != STEP_GATHER && s->kind != STEP_PRODUCT &&
                      s->kind != STEP_TOGETHER && s->kind != STEP_EQUAL;
    const bool jets = s->kind == STEP_TOGETHER && builtin_table[s->extra].family == FAMILY_JET;
    const int used = s->kind == STEP_PRODUCT ? 2 : 3; /* c is no operand there */
    for (int i = 0; i < used && !(each && s->n == 1); i++) {
        const int from = operands[i], reach = each   ? s->n
                                              : jets ? builtin_table[s->extra].sizes[1 + i]
                                                     : REACH_MAX;
        const bool same_place = each && from == to && !(s->flags & (SPREAD_A << i));
        const bool apart = from >= to + results(s) || from + reach <= to;
        if (from != MACHINE_NOWHERE && !same_place && !apart) {
            return false;
        }
    }
    return true;
}

/* Where the last step only made the value that is moved, it puts it there itself. */
void lower_move(struct lower *lower, uint16_t to, uint16_t from, int count)
{
    struct machine_code *code = lower->code;

    if (to == from) {
        return;
    }
    if (code->step_count > lower->label && from >= lower->locals && from < MACHINE_VALUES) {
        struct step *last = &code->steps[code->step_count - 1];
        if (last->out == from && results(last) == count && may_go_to(last, to)) {
            last->out = to;
            return;
        }
    }
    lower_step(lower, (struct step){.kind = STEP_MOVE,
                                    .n = (uint16_t)count,
                                    .out = to,
                                    .a = from,
                                    .b = MACHINE_NOWHERE,
                                    .c = MACHINE_NOWHERE});
}
