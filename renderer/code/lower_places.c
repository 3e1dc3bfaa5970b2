/* SPDX-License-Identifier: MIT */
/* Parts of values, and assigning to them. */
#include <string.h>

#include "lower.h"

/* What is at `index` of it, one of `count` of this type. */
static void spot_index(struct lower *lower, struct spot *spot, const struct expr *index)
{
    const int count = type_elements(spot->type);

    spot->type = type_element(spot->type);
    const int stride = type_components(spot->type);
    if (index->value) {
        spot->at = (uint16_t)(spot->at + (int)index->value[0] * stride);
        return;
    }
    struct step step = {.kind = STEP_INDEX,
                        .n = (uint16_t)stride,
                        .base = index->type.base,
                        .a = lower_value(lower, index),
                        .b = spot->offset,
                        .c = (uint16_t)count};
    step.out = lower_alloc(lower, 1);
    lower_step(lower, step);
    spot->offset = step.out;
}

static void spot_swizzle(struct spot *spot, const struct expr *expr)
{
    uint8_t old[4] = {0, 1, 2, 3};

    if (spot->count > 0) {
        memcpy(old, spot->swizzle, sizeof old);
    }
    for (int i = 0; i < expr->swizzle_count; i++) {
        spot->swizzle[i] = old[expr->swizzle[i]];
    }
    spot->count = expr->swizzle_count;
}

/* A swizzle that another part is taken of becomes a value first. */
static struct spot lower_spot_index(struct lower *lower, const struct expr *expr)
{
    struct spot spot = lower_spot(lower, expr->a);

    if (spot.count > 0) {
        struct type type = type_vector((enum base)spot.type.base, spot.count);
        spot = (struct spot){lower_load(lower, &spot), MACHINE_NOWHERE, type, 0, {0}};
    }
    spot_index(lower, &spot, expr->b);
    return spot;
}

struct spot lower_spot(struct lower *lower, const struct expr *expr)
{
    if (!expr->value && expr->kind == EXPR_INDEX) {
        return lower_spot_index(lower, expr);
    }
    if (!expr->value && expr->kind == EXPR_SWIZZLE) {
        struct spot spot = lower_spot(lower, expr->a);
        spot_swizzle(&spot, expr);
        return spot;
    }
    if (!expr->value && expr->kind == EXPR_PART) {
        struct spot spot = lower_spot(lower, expr->a);
        spot.at = (uint16_t)(spot.at + surface_members[expr->field].at);
        spot.type = expr->type;
        return spot;
    }
    return (struct spot){lower_value(lower, expr), MACHINE_NOWHERE, expr->type, 0, {0}};
}

/* Whether the swizzle takes numbers that lie in a row. */
static bool in_a_row(const struct spot *spot)
{
    for (int i = 1; i < spot->count; i++) {
        if (spot->swizzle[i] != spot->swizzle[0] + i) {
            return false;
        }
    }
    return true;
}

static uint8_t packed(const struct spot *spot)
{
    int bits = 0;

    for (int i = 0; i < spot->count; i++) {
        bits |= spot->swizzle[i] << (2 * i);
    }
    return (uint8_t)bits;
}

uint16_t lower_load(struct lower *lower, const struct spot *spot)
{
    uint16_t at = spot->at;

    if (spot->offset != MACHINE_NOWHERE) {
        const int count = type_components(spot->type);
        at = lower_alloc(lower, count);
        lower_step(lower, (struct step){.kind = STEP_LOAD,
                                        .n = (uint16_t)count,
                                        .out = at,
                                        .a = spot->at,
                                        .b = spot->offset});
    }
    if (spot->count == 0) {
        return at;
    }
    if (in_a_row(spot)) {
        return (uint16_t)(at + spot->swizzle[0]);
    }
    struct step step = {.kind = STEP_GATHER,
                        .extra = packed(spot),
                        .n = (uint16_t)spot->count,
                        .a = at,
                        .b = MACHINE_NOWHERE,
                        .c = MACHINE_NOWHERE};
    step.out = lower_alloc(lower, spot->count);
    lower_step(lower, step);
    return step.out;
}

void lower_store(struct lower *lower, const struct spot *spot, uint16_t from)
{
    const int count = spot->count > 0 ? spot->count : type_components(spot->type);

    if (spot->offset == MACHINE_NOWHERE && in_a_row(spot)) {
        const uint16_t first = spot->count > 0 ? spot->swizzle[0] : 0;
        lower_move(lower, (uint16_t)(spot->at + first), from, count);
        return;
    }
    uint16_t whole = spot->at;
    if (spot->offset != MACHINE_NOWHERE && spot->count > 0) {
        const struct spot all = {spot->at, spot->offset, spot->type, 0, {0}};
        whole = lower_load(lower, &all);
    }
    if (spot->count > 0) {
        lower_step(lower, (struct step){.kind = STEP_SCATTER,
                                        .extra = packed(spot),
                                        .n = (uint16_t)spot->count,
                                        .out = whole,
                                        .a = from});
        from = whole;
    }
    if (spot->offset != MACHINE_NOWHERE) {
        lower_step(lower, (struct step){.kind = STEP_STORE,
                                        .n = (uint16_t)type_components(spot->type),
                                        .out = spot->at,
                                        .a = from,
                                        .b = spot->offset});
    }
}

/* Gives the place that it assigned to, if that is `wanted`. */
uint16_t lower_assign(struct lower *lower, const struct expr *expr, bool wanted)
{
    struct spot spot = lower_spot(lower, expr->a);

    if (expr->op == OP_NONE) {
        lower_store(lower, &spot, lower_value(lower, expr->b));
        return wanted ? lower_load(lower, &spot) : 0;
    }
    struct type type = expr->type;
    const int count = type_components(type);
    struct operand left = {lower_load(lower, &spot), false};
    uint16_t out;
    if (lower_is_product(expr->op, type, expr->b->type)) {
        const uint16_t right = lower_value(lower, expr->b);
        lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
        out = lower_product(lower, type, left.at, expr->b->type, right);
    } else {
        struct operand right = lower_operand(lower, expr->b, count);
        lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
        out = lower_arithmetic(lower, expr->op, type, left, right);
    }
    lower_store(lower, &spot, out);
    return wanted ? lower_load(lower, &spot) : 0;
}

/* Gives the old or the new value, if it is wanted. */
uint16_t lower_increment(struct lower *lower, const struct expr *expr, bool wanted)
{
    static const double ones = 1;
    const int count = type_components(expr->type);
    struct spot spot = lower_spot(lower, expr->a);
    uint16_t old = lower_load(lower, &spot);

    if (expr->postfix && wanted) {
        const uint16_t copy = lower_alloc(lower, count);
        lower_move(lower, copy, old, count);
        old = copy;
    }
    lower->origin = (struct origin){expr->at, expr->op == OP_ADD ? "++" : "--"};
    const uint16_t one = lower_number(lower, (enum base)expr->type.base, &ones, 1);
    const uint16_t out = lower_arithmetic(lower, expr->op, expr->type, (struct operand){old, false},
                                          (struct operand){one, count > 1});
    lower_store(lower, &spot, out);
    return expr->postfix || !wanted ? old : lower_load(lower, &spot);
}
