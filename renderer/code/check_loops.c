/* SPDX-License-Identifier: MIT */
/* Loops whose iterations can be counted: for (int i = 0; i < 8; i++), where all three numbers are
 * constants. */
#include <math.h>

#include "check.h"

static bool refuse_loop(struct checker *checker, struct at at, const char *why)
{
    return CHECK_FAIL(checker, at, "%s; loops are for (int i = 0; i < 8; i++) with constants", why);
}

/* The one variable, with its start. */
static struct variable *check_start(struct checker *checker, struct stmt *stmt)
{
    struct stmt *one = stmt->other->kind == STMT_DECLARE ? stmt->other->body : NULL;

    if (!one || one->next || !one->expr) {
        refuse_loop(checker, stmt->other->at, "the loop does not begin with one variable");
        return NULL;
    }
    struct variable *variable = one->variable;
    if (!check_statement(checker, stmt->other)) {
        return NULL;
    }
    if (!type_is_number(variable->type) || !type_is_scalar(variable->type) || variable->read_only) {
        refuse_loop(checker, variable->at, "the variable of a loop is an int or a float");
        return NULL;
    }
    if (!one->expr->value) {
        refuse_loop(checker, one->expr->at, "the start of the loop is not constant");
        return NULL;
    }
    stmt->variable = variable;
    stmt->start = *one->expr->value;
    return variable;
}

static bool is_variable(const struct expr *expr, const struct variable *variable)
{
    return expr->kind == EXPR_VARIABLE && expr->variable == variable;
}

/* i < 8, or 8 > i. */
static bool check_bound(struct checker *checker, struct stmt *stmt, enum op *out_op,
                        double *out_bound)
{
    static const enum op mirrored[] = {[OP_LESS] = OP_GREATER,
                                       [OP_GREATER] = OP_LESS,
                                       [OP_LESS_EQUAL] = OP_GREATER_EQUAL,
                                       [OP_GREATER_EQUAL] = OP_LESS_EQUAL,
                                       [OP_UNEQUAL] = OP_UNEQUAL};
    struct expr *test = stmt->expr;

    if (!check_value(checker, test)) {
        return false;
    }
    const bool compares = test->kind == EXPR_BINARY && test->op >= OP_LESS &&
                          test->op <= OP_UNEQUAL && test->op != OP_EQUAL;
    if (compares && is_variable(test->a, stmt->variable) && test->b->value) {
        *out_op = test->op;
        *out_bound = *test->b->value;
        return true;
    }
    if (compares && is_variable(test->b, stmt->variable) && test->a->value) {
        *out_op = mirrored[test->op];
        *out_bound = *test->a->value;
        return true;
    }
    return refuse_loop(checker, test->at,
                       test->op == OP_AND || test->op == OP_OR
                           ? "the loop has more than one condition: write if (...) break;"
                           : "the bound of the loop is not constant");
}

/* i++, i += 2, i = i + 2, and with minus. */
static bool check_step(struct checker *checker, struct stmt *stmt)
{
    struct expr *step = stmt->advance;

    if (!check_value(checker, step)) {
        return false;
    }
    const struct expr *by = NULL;
    enum op op = step->op;
    if (step->kind == EXPR_ASSIGN && step->op != OP_NONE) {
        by = step->b;
    } else if (step->kind == EXPR_ASSIGN && step->b->kind == EXPR_BINARY &&
               is_variable(step->b->a, stmt->variable)) {
        op = step->b->op;
        by = step->b->b;
    }
    const bool ok = (step->kind == EXPR_STEP || (by && by->value)) &&
                    is_variable(step->a, stmt->variable) && (op == OP_ADD || op == OP_SUBTRACT);
    if (!ok) {
        return refuse_loop(checker, step->at, "the step of the loop is not constant");
    }
    stmt->step = (op == OP_ADD ? 1 : -1) * (by ? *by->value : 1);
    return true;
}

static bool goes_on(enum op op, double at, double bound)
{
    switch (op) {
    case OP_LESS:
        return at < bound;
    case OP_GREATER:
        return at > bound;
    case OP_LESS_EQUAL:
        return at <= bound;
    case OP_GREATER_EQUAL:
        return at >= bound;
    default:
        return at != bound;
    }
}

static bool fits(struct type type, double number)
{
    return type.base == BASE_FLOAT || (type.base == BASE_INT && fabs(number) <= 2147483647.0) ||
           (type.base == BASE_UINT && number >= 0 && number <= 4294967295.0);
}

/* Counted with the floats that a driver has. */
static bool count_trips(struct checker *checker, struct stmt *stmt, enum op op, double bound)
{
    const bool whole = stmt->variable->type.base != BASE_FLOAT;
    double at = stmt->start;

    while (stmt->trips <= LIMIT_CODE_TRIPS && goes_on(op, at, bound)) {
        const double next = whole ? at + stmt->step : (double)((float)at + (float)stmt->step);
        if (next == at || (!fits(stmt->variable->type, next) && goes_on(op, next, bound))) {
            return refuse_loop(checker, stmt->at, "the loop never ends");
        }
        at = next;
        stmt->trips++;
    }
    return stmt->trips <= LIMIT_CODE_TRIPS ||
           tree_fail_limit(checker->tree, stmt->at, "iterations of loops", LIMIT_CODE_TRIPS,
                           "code_trips");
}

bool check_for(struct checker *checker, struct stmt *stmt)
{
    enum op op = OP_NONE;
    double bound = 0;

    if (!stmt->expr || !stmt->advance) {
        return refuse_loop(checker, stmt->at,
                           stmt->expr ? "the loop has no step" : "the loop has no bound");
    }
    struct variable *variable = check_start(checker, stmt);
    if (!variable || !check_bound(checker, stmt, &op, &bound) || !check_step(checker, stmt) ||
        !count_trips(checker, stmt, op, bound)) {
        return false;
    }
    variable->counter = true;
    checker->loops++;
    const bool ok = check_statement(checker, stmt->body);
    checker->loops--;
    return ok;
}
