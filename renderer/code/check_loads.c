/* SPDX-License-Identifier: MIT */
/* Loads as those of builtins.c, measured on llvmpipe with chains of each kind of statement
 * (tests/property/test_code_bound.c). */
#include "check_loads.h"

#include "check.h"

static long most(long a, long b)
{
    return a > b ? a : b;
}

/* --- functions of the table --- */

long check_work_of_builtin(const struct expr *expr)
{
    const long count = most(type_components(expr->type), type_components(expr->args->type));

    return expr->builtin->weight > 0 ? count * expr->builtin->weight : count;
}

/* min, max and clamp compare, which takes longer for whole numbers. */
static long load_of_builtin(const struct expr *expr)
{
    enum { WHOLE = 24 };
    const struct builtin *builtin = expr->builtin;
    const long work = check_work_of_builtin(expr), count = work / most(builtin->weight, 1);
    if (builtin->family == FAMILY_NUMBER && type_is_integer(expr->type)) {
        return count * WHOLE;
    }
    return builtin->load > 0 ? count * builtin->load - work : 0;
}

/* --- operators --- */

/* Division of whole numbers is done number by number, with care for 0; by a constant it is turned
 * into a product. */
static long load_of_division(const struct expr *expr)
{
    enum { FLOAT = 9, WHOLE = 440, WHOLE_BY_CONSTANT = 40 };
    if (!type_is_integer(expr->type)) {
        return FLOAT;
    }
    return expr->b->value ? WHOLE_BY_CONSTANT : WHOLE;
}

static long load_of_product(const struct expr *expr, long count)
{
    enum { WHOLE = 6 };
    const struct type a = expr->a->type, b = expr->b->type;
    if (type_is_matrix(a) || type_is_matrix(b)) {
        return most(count, type_components(b)) * most(a.columns, b.columns);
    }
    return type_is_integer(expr->type) ? count * WHOLE : 0;
}

static long load_of_operator(const struct expr *expr)
{
    enum { SHIFT = 10, COMPARE = 6, BITS = 3 };
    const long count = most(type_components(expr->type), type_components(expr->a->type));
    switch (expr->op) {
    case OP_DIVIDE:
    case OP_REMAINDER:
        return count * load_of_division(expr);
    case OP_MULTIPLY:
        return load_of_product(expr, count);
    case OP_SHIFT_LEFT:
    case OP_SHIFT_RIGHT:
        return count * SHIFT;
    case OP_BIT_AND:
    case OP_BIT_OR:
    case OP_BIT_XOR:
        return count * BITS;
    case OP_LESS:
    case OP_LESS_EQUAL:
    case OP_GREATER:
    case OP_GREATER_EQUAL:
    case OP_EQUAL:
    case OP_UNEQUAL:
    case OP_AND:
    case OP_OR:
    case OP_XOR:
        return count * COMPARE;
    default:
        return 0;
    }
}

/* Drivers spread an index that is not constant over all that it may mean: each component of a
 * number, and of vectors and matrices each with each. */
static long load_of_index(const struct expr *expr, bool written)
{
    enum { EACH = 8, PAIRS = 6 };
    long whole = type_components(expr->a->type), pairs = 0;
    if (expr->b->value) {
        return 0;
    }
    if (type_components(expr->type) > 1) {
        pairs = EACH * whole * whole / PAIRS;
    }
    return most(EACH * whole, pairs) * (written ? 2 : 1);
}

/* --- all --- */

long check_load(const struct expr *expr)
{
    enum { CHOICE = 6, STEP = 2, CONVERTED = 5 };
    if (expr->value) {
        return 0;
    }
    switch (expr->kind) {
    case EXPR_BUILTIN:
        return load_of_builtin(expr);
    case EXPR_INDEX:
        return load_of_index(expr, false);
    case EXPR_BINARY:
        return load_of_operator(expr);
    case EXPR_ASSIGN:
        return load_of_operator(expr) + check_load_written(expr->a);
    case EXPR_STEP:
        return STEP + check_load_written(expr->a);
    case EXPR_CONSTRUCT:
        return expr->args && expr->args->type.base != expr->type.base
                   ? CONVERTED * type_components(expr->type)
                   : 0;
    case EXPR_CHOICE:
        return CHOICE * type_components(expr->type);
    default:
        return 0;
    }
}

long check_load_written(const struct expr *place)
{
    long load = 0;

    for (; place && !place->value; place = place->a) {
        if (place->kind == EXPR_INDEX) {
            load += load_of_index(place, true) - load_of_index(place, false);
        }
    }
    return load;
}

/* What may leave a function or a loop in the middle keeps a mask of who is still in it, which all
 * that follows has to heed. */
long check_load_of_statement(const struct stmt *stmt)
{
    enum { BRANCH = 6, LOOP = 50, LEAVE = 24, RETURN = 50 };
    switch (stmt->kind) {
    case STMT_IF:
        return BRANCH;
    case STMT_FOR:
        return LOOP;
    case STMT_BREAK:
    case STMT_CONTINUE:
        return LEAVE;
    case STMT_RETURN:
        return RETURN;
    default:
        return 0;
    }
}
