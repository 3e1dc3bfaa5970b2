/* SPDX-License-Identifier: MIT */
/* Constructors and functions as steps, and expressions of all kinds. */
#include <assert.h>
#include <string.h>

#include "lower.h"

/* --- constructors --- */

static uint16_t converted(struct lower *lower, const struct expr *arg, enum base to)
{
    static const double zero = 0;
    const enum base from = (enum base)arg->type.base;
    const int count = type_components(arg->type);
    struct operand a = {lower_value(lower, arg), false};

    if (from == to) {
        return a.at;
    }
    if (type_is_integer(arg->type) && (to == BASE_INT || to == BASE_UINT)) {
        return lower_arithmetic(lower, OP_BIT_OR, type_vector(to, arg->type.rows), a,
                                (struct operand){lower_number(lower, to, &zero, 1), true});
    }
    return lower_join(lower, STEP_CONVERT, count, a, (struct operand){MACHINE_NOWHERE, false},
                      (struct step){.extra = (uint8_t)to, .base = (uint8_t)from});
}

/* A matrix of a number, or of another matrix: ones on the diagonal, and what there is. */
static uint16_t lower_matrix(struct lower *lower, const struct expr *expr)
{
    const int size = expr->type.rows, own = expr->args->type.columns;
    const uint16_t from =
        own == 1 ? converted(lower, expr->args, BASE_FLOAT) : lower_value(lower, expr->args);
    const uint16_t out = lower_alloc(lower, size * size);
    double identity[16] = {0};

    for (int i = 0; i < size; i++) {
        identity[i * size + i] = own > 1;
    }
    lower_move(lower, out, lower_number(lower, BASE_FLOAT, identity, size * size), size * size);
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
    const int count = expr->type.rows;
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

/* Of a colour, which comes first; all else is the default. */
static uint16_t lower_surface(struct lower *lower, const struct expr *expr)
{
    uint16_t color = lower_value(lower, expr->args), out = lower_alloc(lower, SURFACE_NUMBERS);
    const uint16_t all = lower_number(lower, BASE_FLOAT, surface_defaults, SURFACE_NUMBERS);

    lower_move(lower, out, all, SURFACE_NUMBERS);
    lower_step(lower, (struct step){.kind = STEP_MOVE, .n = 3, .out = out, .a = color});
    return out;
}

/* Made of one value that is more than a part of it. */
static bool is_conversion(const struct expr *expr)
{
    const struct type type = expr->type;

    return type_is_surface(type) || (expr->arg_count == 1 && type.count == 0);
}

static uint16_t lower_conversion(struct lower *lower, const struct expr *expr)
{
    const struct type type = expr->type, own = expr->args->type;

    if (type_is_surface(type)) {
        return lower_surface(lower, expr);
    }
    if (type_is_matrix(type) && (type_is_scalar(own) || type_is_matrix(own))) {
        return lower_matrix(lower, expr);
    }
    if (type_is_vector(type) && type_is_scalar(own)) {
        return lower_spread(lower, expr);
    }
    return converted(lower, expr->args, (enum base)type.base);
}

/* Constants from `*arg` on, up to `room` numbers; how many there are. */
static int constants_in_a_row(const struct expr **arg, enum base base, int room, double *out)
{
    int count = 0;

    for (; *arg && (*arg)->value && (*arg)->type.base == base; *arg = (*arg)->next) {
        const int have = type_components((*arg)->type);
        if (count + have > room) {
            break;
        }
        memcpy(out + count, (*arg)->value, (size_t)have * sizeof *out);
        count += have;
    }
    return count;
}

void lower_parts(struct lower *lower, const struct expr *expr, uint16_t out)
{
    enum { ROW_MAX = 16 };
    const enum base base = (enum base)expr->type.base;
    const int count = type_components(expr->type);
    int filled = 0;

    for (const struct expr *arg = expr->args; arg && filled < count;) {
        double row[ROW_MAX];
        const uint16_t to = (uint16_t)(out + filled);
        const int room = count - filled, most = room < ROW_MAX ? room : ROW_MAX;
        int have = constants_in_a_row(&arg, base, most, row);
        if (have > 0) {
            lower_move(lower, to, lower_number(lower, base, row, have), have);
        } else {
            have = type_components(arg->type);
            have = have < room ? have : room;
            lower_move(lower, to, converted(lower, arg, base), have);
            arg = arg->next;
        }
        filled += have;
    }
}

bool lower_has_parts(const struct expr *expr)
{
    return !expr->value && expr->kind == EXPR_CONSTRUCT && !is_conversion(expr);
}

static uint16_t lower_construct(struct lower *lower, const struct expr *expr)
{
    if (is_conversion(expr)) {
        return lower_conversion(lower, expr);
    }
    const uint16_t out = lower_alloc(lower, type_components(expr->type));
    lower_parts(lower, expr, out);
    return out;
}

static uint16_t lower_builtin(struct lower *lower, const struct expr *expr)
{
    const struct builtin *row = expr->builtin;
    struct operand in[BUILTIN_ARGUMENTS];
    int count = type_components(expr->type), i = 0;
    const bool together = row->whole != NULL;

    for (int k = 0; k < BUILTIN_ARGUMENTS; k++) {
        in[k] = (struct operand){MACHINE_NOWHERE, false};
    }
    for (const struct expr *arg = expr->args; arg; arg = arg->next, i++) {
        in[i] = together ? (struct operand){lower_value(lower, arg), false}
                         : lower_operand(lower, arg, count);
    }
    struct step step = {
        .kind = (uint8_t)(together   ? STEP_TOGETHER
                          : row->one ? STEP_ONE
                          : row->two ? STEP_TWO
                                     : STEP_THREE),
        .extra = (uint8_t)(row - builtin_table),
        .flags = (uint8_t)(lower_spread_flags(in[0], in[1]) | (in[2].spread ? SPREAD_C : 0)),
        .parts = expr->type.base == BASE_FLOAT ? (uint8_t)count : 0,
        .base = expr->args->type.base,
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
            values[i++] = type_is_handle(arg->type) ? 0 : lower_value(lower, arg);
        } else {
            spots[i] = lower_spot(lower, arg);
            values[i] = lower_load(lower, &spots[i]);
            i++;
        }
    }
    i = 0;
    for (parameter = function->parameters; parameter; parameter = parameter->next, i++) {
        const int size = type_components(parameter->type);
        if (size > 0 && parameter->direction != DIRECTION_OUT) {
            lower_step(lower, (struct step){.kind = STEP_MOVE,
                                            .n = (uint16_t)size,
                                            .out = parameter->at_frame,
                                            .a = values[i]});
        }
    }
    lower_step(lower, (struct step){.kind = STEP_CALL, .out = function->entry});
    lower->label = lower->code->step_count;
    const uint16_t out = lower_alloc(lower, count);
    lower_move(lower, out, function->result_at, count);
    i = 0;
    for (parameter = function->parameters; parameter; parameter = parameter->next, i++) {
        if (parameter->direction != DIRECTION_IN) {
            lower_store(lower, &spots[i], parameter->at_frame);
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
    const enum base base = type_is_surface(expr->type) ? BASE_FLOAT : (enum base)expr->type.base;
    const int count = type_components(expr->type);

    if (variable && lower->keep && count > 1) {
        if (!variable->placed) {
            variable->at_frame = lower_number(lower, base, expr->value, count);
            variable->placed = true;
        }
        return variable->at_frame;
    }
    return lower_number(lower, base, expr->value, count);
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
    case EXPR_PART:
    case EXPR_SWIZZLE: {
        struct spot spot = lower_spot(lower, expr);
        return lower_load(lower, &spot);
    }
    case EXPR_FIELD:
        return lower_field(lower, expr);
    case EXPR_DATA:
        return lower->code->data;
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
