/* SPDX-License-Identifier: MIT */
/* Operators as steps. */
#include "lower.h"

/* As `count` components. */
struct operand lower_operand(struct lower *lower, const struct expr *expr, int count)
{
    const int own = type_components(expr->type);

    if (expr->value && own > 1) {
        bool same = true;
        for (int i = 1; i < own; i++) {
            same = same && expr->value[i] == expr->value[0];
        }
        if (same) {
            return (struct operand){lower_number(lower, (enum base)expr->type.base, expr->value, 1),
                                    true};
        }
    }
    const bool spreads = !expr->value && expr->kind == EXPR_CONSTRUCT &&
                         type_is_vector(expr->type) && expr->arg_count == 1 &&
                         type_is_scalar(expr->args->type) &&
                         expr->args->type.base == expr->type.base;
    if (spreads) {
        return (struct operand){lower_value(lower, expr->args), count > 1};
    }
    return (struct operand){lower_value(lower, expr), own == 1 && count > 1};
}

uint8_t lower_spread_flags(struct operand a, struct operand b)
{
    return (uint8_t)((a.spread ? SPREAD_A : 0) | (b.spread ? SPREAD_B : 0));
}

uint16_t lower_join(struct lower *lower, enum step_kind kind, int count, struct operand a,
                    struct operand b, struct step more)
{
    more.kind = (uint8_t)kind;
    more.n = (uint16_t)count;
    more.a = a.at;
    more.b = b.at;
    more.c = MACHINE_NOWHERE;
    more.flags |= lower_spread_flags(a, b);
    more.out = lower_alloc(lower, kind == STEP_EQUAL ? 1 : count);
    lower_step(lower, more);
    return more.out;
}

static uint16_t negated(struct lower *lower, uint16_t at)
{
    return lower_join(lower, STEP_NOT, 1, (struct operand){at, false},
                      (struct operand){MACHINE_NOWHERE, false}, (struct step){0});
}

/* --- operators --- */

/* a op b, of numbers of one base, whose components go together or are one for all. */
uint16_t lower_arithmetic(struct lower *lower, enum op op, struct type result, struct operand a,
                          struct operand b)
{
    const int count = type_components(result);

    if (type_is_integer(result)) {
        uint8_t flags = result.base == BASE_UINT ? STEP_UNSIGNED : 0;
        return lower_join(lower, STEP_WHOLE, count, a, b,
                          (struct step){.extra = (uint8_t)op, .flags = flags});
    }
    const enum step_kind kind = op == OP_ADD        ? STEP_ADD
                                : op == OP_SUBTRACT ? STEP_SUBTRACT
                                : op == OP_MULTIPLY ? STEP_MULTIPLY
                                                    : STEP_DIVIDE;
    return lower_join(lower, kind, count, a, b, (struct step){.parts = (uint8_t)count});
}

bool lower_is_product(enum op op, struct type a, struct type b)
{
    return op == OP_MULTIPLY && !type_is_scalar(a) && !type_is_scalar(b) &&
           (type_is_matrix(a) || type_is_matrix(b));
}

uint16_t lower_product(struct lower *lower, struct type a_type, uint16_t a, struct type b_type,
                       uint16_t b)
{
    const bool row = type_is_vector(a_type); /* v * M: the vector is a row */
    const int rows = row ? 1 : a_type.rows, inner = row ? a_type.rows : a_type.columns;
    struct step step = {.kind = STEP_PRODUCT,
                        .n = (uint16_t)rows,
                        .a = a,
                        .b = b,
                        .c = (uint16_t)inner,
                        .extra = b_type.columns};

    step.parts = (uint8_t)(rows * b_type.columns);
    step.out = lower_alloc(lower, step.parts);
    lower_step(lower, step);
    return step.out;
}

static uint16_t compare(struct lower *lower, enum op op, struct type type, struct operand a,
                        struct operand b)
{
    const struct step of = {.base = type.base};
    const int count = type_components(type);
    uint16_t out;

    switch (op) {
    case OP_LESS:
        return lower_join(lower, STEP_LESS, 1, a, b, of);
    case OP_GREATER:
        return lower_join(lower, STEP_LESS, 1, b, a, of);
    case OP_LESS_EQUAL:
        return lower_join(lower, STEP_LESS_EQUAL, 1, a, b, of);
    case OP_GREATER_EQUAL:
        return lower_join(lower, STEP_LESS_EQUAL, 1, b, a, of);
    default:
        out = lower_join(lower, STEP_EQUAL, count, a, b, of);
        return op == OP_EQUAL ? out : negated(lower, out);
    }
}

/* && and ||: the second is looked at only where it matters. */
static uint16_t lower_logic(struct lower *lower, const struct expr *expr)
{
    const uint16_t out = lower_alloc(lower, 1);
    const uint16_t a = lower_value(lower, expr->a);

    lower_move(lower, out, a, 1);
    const uint16_t skip_unless = expr->op == OP_AND ? out : negated(lower, out);
    const size_t jump = lower_jump(lower, STEP_UNLESS, skip_unless);
    const uint16_t b = lower_value(lower, expr->b);
    lower_move(lower, out, b, 1);
    lower_land(lower, jump);
    return out;
}

uint16_t lower_binary(struct lower *lower, const struct expr *expr)
{
    struct type a_type = expr->a->type, b_type = expr->b->type;

    if (expr->op == OP_AND || expr->op == OP_OR) {
        return lower_logic(lower, expr);
    }
    if (lower_is_product(expr->op, a_type, b_type)) {
        const uint16_t a = lower_value(lower, expr->a);
        return lower_product(lower, a_type, a, b_type, lower_value(lower, expr->b));
    }
    const bool compares = expr->op >= OP_LESS && expr->op <= OP_XOR;
    const int count = type_components(compares ? a_type : expr->type);
    struct operand a, b;
    if (expr->op == OP_EQUAL || expr->op == OP_UNEQUAL) {
        a = (struct operand){lower_value(lower, expr->a), false};
        b = (struct operand){lower_value(lower, expr->b), false};
    } else {
        a = lower_operand(lower, expr->a, count);
        b = lower_operand(lower, expr->b, count);
    }
    lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
    return compares ? compare(lower, expr->op, a_type, a, b)
                    : lower_arithmetic(lower, expr->op, expr->type, a, b);
}

uint16_t lower_unary(struct lower *lower, const struct expr *expr)
{
    static const double zero = 0, ones = -1;
    const int count = type_components(expr->type);
    struct operand nothing = {MACHINE_NOWHERE, false};
    struct operand a = {lower_value(lower, expr->a), false};
    const bool whole = type_is_integer(expr->type);

    lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
    if (expr->op == OP_PLUS) {
        return a.at;
    }
    if (expr->op == OP_NOT) {
        return negated(lower, a.at);
    }
    if (expr->op == OP_INVERT) {
        return lower_arithmetic(
            lower, OP_BIT_XOR, expr->type, a,
            (struct operand){lower_number(lower, (enum base)expr->type.base, &ones, 1), true});
    }
    if (whole) {
        return lower_arithmetic(
            lower, OP_SUBTRACT, expr->type,
            (struct operand){lower_number(lower, (enum base)expr->type.base, &zero, 1), true}, a);
    }
    return lower_join(lower, STEP_NEGATE, count, a, nothing,
                      (struct step){.parts = (uint8_t)count});
}

uint16_t lower_choice(struct lower *lower, const struct expr *expr)
{
    const int count = type_components(expr->type);
    const uint16_t out = lower_alloc(lower, count);
    const size_t no = lower_jump(lower, STEP_UNLESS, lower_value(lower, expr->a));

    lower_move(lower, out, lower_value(lower, expr->b), count);
    const size_t end = lower_jump(lower, STEP_JUMP, 0);
    lower_land(lower, no);
    lower_move(lower, out, lower_value(lower, expr->c), count);
    lower_land(lower, end);
    return out;
}
