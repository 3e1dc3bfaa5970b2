/* SPDX-License-Identifier: MIT */
/* Expressions as steps. */
#include <assert.h>
#include <string.h>

#include "lower.h"
#include "protocol/memory.h"

/* Something that can be assigned to, or a part of any value: numbers at `at`, further by the number
 * at `offset` unless that is nowhere; of these the components of the swizzle, if there is one. */
struct spot {
    uint16_t at, offset;
    struct type type; /* before the swizzle */
    int count;        /* of the swizzle; 0: none */
    uint8_t swizzle[4];
};

static uint16_t lower_product(struct lower *lower, struct type a_type, uint16_t a,
                              struct type b_type, uint16_t b);

/* --- the frame, constants, steps --- */

uint16_t lower_alloc(struct lower *lower, int count)
{
    if (lower->top + count > MACHINE_VALUES) {
        lower->full = true;
        return 0;
    }
    uint16_t at = lower->top;
    lower->top = (uint16_t)(lower->top + count);
    lower->peak = lower->top > lower->peak ? lower->top : lower->peak;
    return at;
}

static bool same_bits(const double *a, const double *b, size_t count)
{
    return memcmp(a, b, count * sizeof *a) == 0;
}

uint16_t lower_number(struct lower *lower, const double *numbers, int count)
{
    enum { LOOKED_AT = 64 };
    struct machine_code *code = lower->code;
    size_t size = (size_t)count, have = code->constant_count;
    for (size_t back = size; back <= have && back <= size + LOOKED_AT; back++) {
        if (same_bits(code->constants + have - back, numbers, size)) {
            return (uint16_t)(MACHINE_VALUES + have - back);
        }
    }
    if (have + size > MACHINE_CONSTANTS) {
        lower->full = true;
        return MACHINE_VALUES;
    }
    while (code->constant_capacity < have + size) {
        code->constant_capacity = code->constant_capacity > 0 ? 2 * code->constant_capacity : 64;
        code->constants =
            memory_resize(code->constants, code->constant_capacity, sizeof *code->constants);
    }
    memcpy(code->constants + have, numbers, size * sizeof *numbers);
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
    bool each = s->kind != STEP_GATHER && s->kind != STEP_PRODUCT && s->kind != STEP_TOGETHER &&
                s->kind != STEP_EQUAL;
    int used = s->kind == STEP_PRODUCT ? 2 : 3; /* c is no operand there */
    for (int i = 0; i < used && !(each && s->n == 1); i++) {
        int from = operands[i], reach = each ? s->n : REACH_MAX;
        bool same_place = each && from == to && !(s->flags & (SPREAD_A << i));
        bool apart = from >= to + results(s) || from + reach <= to;
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

uint16_t lower_stable(struct lower *lower, const struct expr *expr, bool effects_follow)
{
    uint16_t at = lower_value(lower, expr);
    if (effects_follow && !expr->value) {
        int count = type_components(expr->type);
        uint16_t copy = lower_alloc(lower, count);
        lower_move(lower, copy, at, count);
        return copy;
    }
    return at;
}

/* --- operands that one number may stand for --- */

struct operand {
    uint16_t at;
    bool spread;
};

/* As `count` components. */
static struct operand operand(struct lower *lower, const struct expr *expr, int count,
                              bool effects_follow)
{
    int own = type_components(expr->type);
    if (expr->value && own > 1) {
        bool same = true;
        for (int i = 1; i < own; i++) {
            same = same && expr->value[i] == expr->value[0];
        }
        if (same) {
            return (struct operand){lower_number(lower, expr->value, 1), true};
        }
    }
    bool spreads = !expr->value && expr->kind == EXPR_CONSTRUCT && type_is_vector(expr->type) &&
                   expr->arg_count == 1 && type_is_scalar(expr->args->type) &&
                   expr->args->type.base == expr->type.base;
    if (spreads) {
        return (struct operand){lower_stable(lower, expr->args, effects_follow), count > 1};
    }
    return (struct operand){lower_stable(lower, expr, effects_follow), own == 1 && count > 1};
}

static uint8_t spread_flags(struct operand a, struct operand b)
{
    return (uint8_t)((a.spread ? SPREAD_A : 0) | (b.spread ? SPREAD_B : 0));
}

static uint16_t join(struct lower *lower, enum step_kind kind, int count, struct operand a,
                     struct operand b, struct step more)
{
    more.kind = (uint8_t)kind;
    more.n = (uint16_t)count;
    more.a = a.at;
    more.b = b.at;
    more.c = MACHINE_NOWHERE;
    more.flags |= spread_flags(a, b);
    more.out = lower_alloc(lower, kind == STEP_EQUAL ? 1 : count);
    lower_step(lower, more);
    return more.out;
}

static uint16_t negated(struct lower *lower, uint16_t at)
{
    return join(lower, STEP_NOT, 1, (struct operand){at, false},
                (struct operand){MACHINE_NOWHERE, false}, (struct step){0});
}

/* --- operators --- */

/* a op b, of numbers of one base, whose components go together or are one for all. */
static uint16_t arithmetic(struct lower *lower, enum op op, struct type result, struct operand a,
                           struct operand b)
{
    int count = type_components(result);
    if (type_is_integer(result)) {
        uint8_t flags = result.base == BASE_UINT ? STEP_UNSIGNED : 0;
        return join(lower, STEP_WHOLE, count, a, b,
                    (struct step){.extra = (uint8_t)op, .flags = flags});
    }
    enum step_kind kind = op == OP_ADD        ? STEP_ADD
                          : op == OP_SUBTRACT ? STEP_SUBTRACT
                          : op == OP_MULTIPLY ? STEP_MULTIPLY
                                              : STEP_DIVIDE;
    return join(lower, kind, count, a, b, (struct step){.parts = (uint8_t)count});
}

static bool is_product(enum op op, struct type a, struct type b)
{
    return op == OP_MULTIPLY && !type_is_scalar(a) && !type_is_scalar(b) &&
           (type_is_matrix(a) || type_is_matrix(b));
}

static uint16_t lower_product(struct lower *lower, struct type a_type, uint16_t a,
                              struct type b_type, uint16_t b)
{
    bool row = type_is_vector(a_type); /* v * M: the vector is a row */
    int rows = row ? 1 : a_type.rows, inner = row ? a_type.rows : a_type.columns;
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
    int count = type_components(type);
    uint16_t out;
    switch (op) {
    case OP_LESS:
        return join(lower, STEP_LESS, 1, a, b, (struct step){0});
    case OP_GREATER:
        return join(lower, STEP_LESS, 1, b, a, (struct step){0});
    case OP_LESS_EQUAL:
        return join(lower, STEP_LESS_EQUAL, 1, a, b, (struct step){0});
    case OP_GREATER_EQUAL:
        return join(lower, STEP_LESS_EQUAL, 1, b, a, (struct step){0});
    default:
        out = join(lower, STEP_EQUAL, count, a, b, (struct step){0});
        return op == OP_EQUAL ? out : negated(lower, out);
    }
}

/* && and ||: the second is looked at only where it matters. */
static uint16_t lower_logic(struct lower *lower, const struct expr *expr)
{
    uint16_t out = lower_alloc(lower, 1);
    uint16_t a = lower_value(lower, expr->a);
    lower_move(lower, out, a, 1);
    uint16_t skip_unless = expr->op == OP_AND ? out : negated(lower, out);
    size_t jump = lower_jump(lower, STEP_UNLESS, skip_unless);
    uint16_t b = lower_value(lower, expr->b);
    lower_move(lower, out, b, 1);
    lower_land(lower, jump);
    return out;
}

static uint16_t lower_binary(struct lower *lower, const struct expr *expr)
{
    struct type a_type = expr->a->type, b_type = expr->b->type;
    bool follow = expr->b->effects;
    if (expr->op == OP_AND || expr->op == OP_OR) {
        return lower_logic(lower, expr);
    }
    if (is_product(expr->op, a_type, b_type)) {
        uint16_t a = lower_stable(lower, expr->a, follow);
        return lower_product(lower, a_type, a, b_type, lower_value(lower, expr->b));
    }
    bool compares = expr->op >= OP_LESS && expr->op <= OP_XOR;
    int count = type_components(compares ? a_type : expr->type);
    struct operand a, b;
    if (expr->op == OP_EQUAL || expr->op == OP_UNEQUAL) {
        a = (struct operand){lower_stable(lower, expr->a, follow), false};
        b = (struct operand){lower_value(lower, expr->b), false};
    } else {
        a = operand(lower, expr->a, count, follow);
        b = operand(lower, expr->b, count, false);
    }
    lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
    return compares ? compare(lower, expr->op, a_type, a, b)
                    : arithmetic(lower, expr->op, expr->type, a, b);
}

static uint16_t lower_unary(struct lower *lower, const struct expr *expr)
{
    static const double zero = 0, ones = -1;
    int count = type_components(expr->type);
    struct operand nothing = {MACHINE_NOWHERE, false};
    struct operand a = {lower_value(lower, expr->a), false};
    bool whole = type_is_integer(expr->type);
    lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
    if (expr->op == OP_PLUS) {
        return a.at;
    }
    if (expr->op == OP_NOT) {
        return negated(lower, a.at);
    }
    if (expr->op == OP_INVERT) {
        return arithmetic(lower, OP_BIT_XOR, expr->type, a,
                          (struct operand){lower_number(lower, &ones, 1), true});
    }
    if (whole) {
        return arithmetic(lower, OP_SUBTRACT, expr->type,
                          (struct operand){lower_number(lower, &zero, 1), true}, a);
    }
    return join(lower, STEP_NEGATE, count, a, nothing, (struct step){.parts = (uint8_t)count});
}

static uint16_t lower_choice(struct lower *lower, const struct expr *expr)
{
    int count = type_components(expr->type);
    uint16_t out = lower_alloc(lower, count);
    size_t no = lower_jump(lower, STEP_UNLESS, lower_value(lower, expr->a));
    lower_move(lower, out, lower_value(lower, expr->b), count);
    size_t end = lower_jump(lower, STEP_JUMP, 0);
    lower_land(lower, no);
    lower_move(lower, out, lower_value(lower, expr->c), count);
    lower_land(lower, end);
    return out;
}

/* --- places --- */

/* What is at `index` of it, one of `count` of this type. */
static void spot_index(struct lower *lower, struct spot *spot, const struct expr *index)
{
    int count = type_elements(spot->type);
    spot->type = type_element(spot->type);
    int stride = type_components(spot->type);
    if (index->value) {
        spot->at = (uint16_t)(spot->at + (int)index->value[0] * stride);
        return;
    }
    struct step step = {.kind = STEP_INDEX,
                        .n = (uint16_t)stride,
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

static struct spot lower_spot(struct lower *lower, const struct expr *expr);
static uint16_t spot_load(struct lower *lower, const struct spot *spot);

/* A swizzle that another part is taken of becomes a value first. */
static struct spot lower_spot_index(struct lower *lower, const struct expr *expr)
{
    struct spot spot = lower_spot(lower, expr->a);
    if (spot.count > 0) {
        struct type type = type_vector((enum base)spot.type.base, spot.count);
        spot = (struct spot){spot_load(lower, &spot), MACHINE_NOWHERE, type, 0, {0}};
    }
    if (expr->b->effects) { /* the index may change what it is an index of */
        int count = type_components(spot.type);
        uint16_t copy = lower_alloc(lower, count);
        lower_move(lower, copy, spot_load(lower, &spot), count);
        spot.at = copy;
        spot.offset = MACHINE_NOWHERE;
    }
    spot_index(lower, &spot, expr->b);
    return spot;
}

static struct spot lower_spot(struct lower *lower, const struct expr *expr)
{
    if (!expr->value && expr->kind == EXPR_INDEX) {
        return lower_spot_index(lower, expr);
    }
    if (!expr->value && expr->kind == EXPR_SWIZZLE) {
        struct spot spot = lower_spot(lower, expr->a);
        spot_swizzle(&spot, expr);
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

static uint16_t spot_load(struct lower *lower, const struct spot *spot)
{
    uint16_t at = spot->at;
    if (spot->offset != MACHINE_NOWHERE) {
        int count = type_components(spot->type);
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

static void spot_store(struct lower *lower, const struct spot *spot, uint16_t from)
{
    int count = spot->count > 0 ? spot->count : type_components(spot->type);
    if (spot->offset == MACHINE_NOWHERE && in_a_row(spot)) {
        uint16_t first = spot->count > 0 ? spot->swizzle[0] : 0;
        lower_move(lower, (uint16_t)(spot->at + first), from, count);
        return;
    }
    uint16_t whole = spot->at;
    if (spot->offset != MACHINE_NOWHERE && spot->count > 0) {
        const struct spot all = {spot->at, spot->offset, spot->type, 0, {0}};
        whole = spot_load(lower, &all);
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
static uint16_t lower_assign(struct lower *lower, const struct expr *expr, bool wanted)
{
    struct spot spot = lower_spot(lower, expr->a);
    if (expr->op == OP_NONE) {
        spot_store(lower, &spot, lower_value(lower, expr->b));
        return wanted ? spot_load(lower, &spot) : 0;
    }
    struct type type = expr->type;
    int count = type_components(type);
    struct operand left = {spot_load(lower, &spot), false};
    if (expr->b->effects) {
        uint16_t copy = lower_alloc(lower, count);
        lower_move(lower, copy, left.at, count);
        left.at = copy;
    }
    uint16_t out;
    if (is_product(expr->op, type, expr->b->type)) {
        uint16_t right = lower_value(lower, expr->b);
        lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
        out = lower_product(lower, type, left.at, expr->b->type, right);
    } else {
        struct operand right = operand(lower, expr->b, count, false);
        lower->origin = (struct origin){expr->at, tree_op_text(expr->op)};
        out = arithmetic(lower, expr->op, type, left, right);
    }
    spot_store(lower, &spot, out);
    return wanted ? spot_load(lower, &spot) : 0;
}

/* Gives the old or the new value, if it is wanted. */
static uint16_t lower_increment(struct lower *lower, const struct expr *expr, bool wanted)
{
    static const double one = 1;
    int count = type_components(expr->type);
    struct spot spot = lower_spot(lower, expr->a);
    uint16_t old = spot_load(lower, &spot);
    if (expr->postfix && wanted) {
        uint16_t copy = lower_alloc(lower, count);
        lower_move(lower, copy, old, count);
        old = copy;
    }
    lower->origin = (struct origin){expr->at, expr->op == OP_ADD ? "++" : "--"};
    uint16_t out = arithmetic(lower, expr->op, expr->type, (struct operand){old, false},
                              (struct operand){lower_number(lower, &one, 1), count > 1});
    spot_store(lower, &spot, out);
    return expr->postfix || !wanted ? old : spot_load(lower, &spot);
}

/* --- types and functions --- */

static uint16_t converted(struct lower *lower, const struct expr *arg, enum base to)
{
    static const double zero = 0;
    enum base from = (enum base)arg->type.base;
    int count = type_components(arg->type);
    struct operand a = {lower_value(lower, arg), false};
    bool fits = from == to || from == BASE_BOOL || to == BASE_FLOAT;
    if (fits) {
        return a.at;
    }
    if (from != BASE_FLOAT && to != BASE_BOOL) { /* int to uint, or back */
        return arithmetic(lower, OP_BIT_OR, type_vector(to, arg->type.rows), a,
                          (struct operand){lower_number(lower, &zero, 1), true});
    }
    return join(lower, STEP_CONVERT, count, a, (struct operand){MACHINE_NOWHERE, false},
                (struct step){.extra = (uint8_t)to});
}

/* A matrix of a number, or of another matrix: ones on the diagonal, and what there is. */
static uint16_t lower_matrix(struct lower *lower, const struct expr *expr)
{
    int size = expr->type.rows, own = expr->args->type.columns;
    uint16_t from = lower_value(lower, expr->args), out = lower_alloc(lower, size * size);
    double identity[16] = {0};
    for (int i = 0; i < size; i++) {
        identity[i * size + i] = own > 1;
    }
    lower_move(lower, out, lower_number(lower, identity, size * size), size * size);
    for (int i = 0; i < size; i++) {
        if (own == 1) {
            lower_move(lower, (uint16_t)(out + i * size + i), from, 1);
        } else if (i < own) {
            lower_move(lower, (uint16_t)(out + i * size), (uint16_t)(from + i * own),
                       size < own ? size : own);
        }
    }
    return out;
}

static uint16_t lower_spread(struct lower *lower, const struct expr *expr)
{
    int count = expr->type.rows;
    struct step step = {.kind = STEP_MOVE,
                        .n = (uint16_t)count,
                        .flags = SPREAD_A,
                        .a = converted(lower, expr->args, (enum base)expr->type.base),
                        .b = MACHINE_NOWHERE,
                        .c = MACHINE_NOWHERE};
    step.out = lower_alloc(lower, count);
    lower_step(lower, step);
    return step.out;
}

static uint16_t lower_construct(struct lower *lower, const struct expr *expr)
{
    struct type type = expr->type;
    int count = type_components(type), filled = 0;
    if (expr->arg_count == 1 && type.count == 0) {
        struct type own = expr->args->type;
        if (type_is_matrix(type) && (type_is_scalar(own) || type_is_matrix(own))) {
            return lower_matrix(lower, expr);
        }
        if (type_is_vector(type) && type_is_scalar(own)) {
            return lower_spread(lower, expr);
        }
        return converted(lower, expr->args, (enum base)type.base);
    }
    uint16_t out = lower_alloc(lower, count);
    for (const struct expr *arg = expr->args; arg && filled < count; arg = arg->next) {
        int have = type_components(arg->type);
        have = have < count - filled ? have : count - filled;
        uint16_t from = converted(lower, arg, (enum base)type.base);
        lower_move(lower, (uint16_t)(out + filled), from, have);
        filled += have;
    }
    return out;
}

static bool any_effects(const struct expr *list)
{
    for (; list; list = list->next) {
        if (list->effects) {
            return true;
        }
    }
    return false;
}

static uint16_t lower_builtin(struct lower *lower, const struct expr *expr)
{
    const struct builtin *row = expr->builtin;
    struct operand in[BUILTIN_ARGUMENTS];
    int count = type_components(expr->type), i = 0;
    bool together = row->whole != NULL;
    for (int k = 0; k < BUILTIN_ARGUMENTS; k++) {
        in[k] = (struct operand){MACHINE_NOWHERE, false};
    }
    for (const struct expr *arg = expr->args; arg; arg = arg->next, i++) {
        bool follow = any_effects(arg->next);
        in[i] = together ? (struct operand){lower_stable(lower, arg, follow), false}
                         : operand(lower, arg, count, follow);
    }
    struct step step = {.kind = (uint8_t)(together   ? STEP_TOGETHER
                                          : row->one ? STEP_ONE
                                          : row->two ? STEP_TWO
                                                     : STEP_THREE),
                        .extra = (uint8_t)(row - builtin_table),
                        .flags =
                            (uint8_t)(spread_flags(in[0], in[1]) | (in[2].spread ? SPREAD_C : 0)),
                        .parts = expr->type.base == BASE_FLOAT ? (uint8_t)count : 0,
                        .n = (uint16_t)(together ? expr->args->type.rows : count),
                        .a = in[0].at,
                        .b = in[1].at,
                        .c = in[2].at};
    step.out = lower_alloc(lower, count);
    lower->origin = (struct origin){expr->at, row->name};
    lower_step(lower, step);
    return step.out;
}

/* Arguments go to the function's parameters only when all have been computed, as one may call the
 * function, too. */
static uint16_t lower_call(struct lower *lower, const struct expr *expr)
{
    const struct function *function = expr->function;
    struct spot spots[TREE_PARAMETERS];
    uint16_t values[TREE_PARAMETERS];
    int i = 0, count = type_components(function->result);
    const struct variable *parameter = function->parameters;
    for (const struct expr *arg = expr->args; arg; arg = arg->next, parameter = parameter->next) {
        if (parameter->direction == DIRECTION_IN) {
            values[i++] =
                type_is_handle(arg->type) ? 0 : lower_stable(lower, arg, any_effects(arg->next));
        } else {
            spots[i] = lower_spot(lower, arg);
            values[i] = spot_load(lower, &spots[i]);
            i++;
        }
    }
    i = 0;
    for (parameter = function->parameters; parameter; parameter = parameter->next, i++) {
        int size = type_components(parameter->type);
        if (size > 0 && parameter->direction != DIRECTION_OUT) {
            lower_step(lower, (struct step){.kind = STEP_MOVE,
                                            .n = (uint16_t)size,
                                            .out = parameter->at_frame,
                                            .a = values[i]});
        }
    }
    lower_step(lower, (struct step){.kind = STEP_CALL, .out = function->entry});
    lower->label = lower->code->step_count;
    uint16_t out = lower_alloc(lower, count);
    lower_move(lower, out, function->result_at, count);
    i = 0;
    for (parameter = function->parameters; parameter; parameter = parameter->next, i++) {
        if (parameter->direction != DIRECTION_IN) {
            spot_store(lower, &spots[i], parameter->at_frame);
        }
    }
    return out;
}

static uint16_t lower_variable(struct lower *lower, const struct variable *variable)
{
    if (variable->storage == STORAGE_DECLARED) {
        return (uint16_t)(lower->code->numbers + variable->first);
    }
    return variable->at_frame;
}

static uint16_t lower_constant_value(struct lower *lower, const struct expr *expr)
{
    struct variable *variable = expr->kind == EXPR_VARIABLE ? expr->variable : NULL;
    int count = type_components(expr->type);
    if (variable && lower->keep && count > 1) {
        if (!variable->placed) {
            variable->at_frame = lower_number(lower, expr->value, count);
            variable->placed = true;
        }
        return variable->at_frame;
    }
    return lower_number(lower, expr->value, count);
}

/* In struct code_shading: three vectors of three, and one more, before the distance. */
static uint16_t lower_field(const struct lower *lower, const struct expr *expr)
{
    return (uint16_t)(lower->code->shading + 3 * expr->field);
}

uint16_t lower_value(struct lower *lower, const struct expr *expr)
{
    if (expr->value) {
        return lower_constant_value(lower, expr);
    }
    switch (expr->kind) {
    case EXPR_VARIABLE:
        return lower_variable(lower, expr->variable);
    case EXPR_UNARY:
        return lower_unary(lower, expr);
    case EXPR_STEP:
        return lower_increment(lower, expr, true);
    case EXPR_BINARY:
        return lower_binary(lower, expr);
    case EXPR_ASSIGN:
        return lower_assign(lower, expr, true);
    case EXPR_CHOICE:
        return lower_choice(lower, expr);
    case EXPR_COMMA:
        lower_effect(lower, expr->a);
        return lower_value(lower, expr->b);
    case EXPR_CALL:
        return lower_call(lower, expr);
    case EXPR_BUILTIN:
        return lower_builtin(lower, expr);
    case EXPR_CONSTRUCT:
        return lower_construct(lower, expr);
    case EXPR_INDEX:
    case EXPR_SWIZZLE: {
        struct spot spot = lower_spot(lower, expr);
        return spot_load(lower, &spot);
    }
    case EXPR_FIELD:
        return lower_field(lower, expr);
    case EXPR_DATA:
        return lower->code->numbers;
    default:
        assert(!"an expression that was checked");
        return 0;
    }
}

void lower_effect(struct lower *lower, const struct expr *expr)
{
    if (expr->kind == EXPR_STEP) {
        lower_increment(lower, expr, false);
    } else if (expr->kind == EXPR_ASSIGN) {
        lower_assign(lower, expr, false);
    } else {
        lower_value(lower, expr);
    }
}
