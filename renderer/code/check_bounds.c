/* SPDX-License-Identifier: MIT */
/* How large code is when every call is written out, as drivers do: a few lines of functions that
 * call each other twice keep a compiler busy for minutes. */
#include "check.h"
#include "check_loads.h"

#include <stdio.h>
#include <string.h>

struct bounds_walk {
    struct tree *tree;
    struct function *function; /* the innermost that is open */
    int open;
};

struct cost {
    long size, work, trips, bytes;
};

static bool walk_function(struct bounds_walk *walk, struct function *function, struct at call);

static long most(long a, long b)
{
    return a > b ? a : b;
}

static bool spend_work(struct bounds_walk *walk, struct cost *cost, long work, struct at at)
{
    cost->work += work;
    return walk->tree->ours || cost->work <= LIMIT_CODE_WORK ||
           tree_fail_limit(walk->tree, at, "operations of one call, with its loops run through,",
                           LIMIT_CODE_WORK, "code_work");
}

/* Adds operations that are only compiled, and refuses when they become too many. */
static bool spend_size(struct bounds_walk *walk, struct cost *cost, long size, struct at at)
{
    cost->size += size;
    return walk->tree->ours || cost->size <= LIMIT_CODE_SIZE ||
           tree_fail_limit(walk->tree, at, "operations, with every call written out,",
                           LIMIT_CODE_SIZE, "code_size");
}

static bool spend(struct bounds_walk *walk, struct cost *cost, long size, struct at at)
{
    return spend_work(walk, cost, size, at) && spend_size(walk, cost, size, at);
}

static bool spend_bytes(struct bounds_walk *walk, struct cost *cost, long bytes, struct at at)
{
    cost->bytes += bytes;
    return cost->bytes <= LIMIT_CODE_ARRAY_BYTES ||
           tree_fail_limit(walk->tree, at, "bytes of arrays, with every call written out,",
                           LIMIT_CODE_ARRAY_BYTES, "code_array_bytes");
}

/* --- calls --- */

/* "a -> b -> a" */
static bool refuse_cycle(struct bounds_walk *walk, const struct function *again, struct at at)
{
    const struct function *cycle[LIMIT_CODE_DEPTH + 1];
    char path[200];
    int count = 0, used = 0;

    for (const struct function *f = walk->function; f != again; f = f->caller) {
        cycle[count++] = f;
    }
    used += snprintf(path, sizeof path, "%.40s", again->name->text);
    while (count > 0 && used < (int)sizeof path - 60) {
        used += snprintf(path + used, sizeof path - (size_t)used, " -> %.40s",
                         cycle[--count]->name->text);
    }
    return tree_fail(walk->tree, at, "a function calls itself: %s%s -> %.40s", path,
                     count > 0 ? " -> ..." : "", again->name->text);
}

static bool walk_call(struct bounds_walk *walk, struct cost *cost, const struct expr *expr)
{
    struct function *to = expr->function;
    long arguments = type_components(to->result);

    if (!walk_function(walk, to, expr->at)) {
        return false;
    }
    struct call *call = tree_alloc(walk->tree, sizeof *call);
    call->to = to;
    call->next = walk->function->calls;
    walk->function->calls = call;
    walk->function->height = (int)most(walk->function->height, to->height + 1);
    for (const struct variable *p = to->parameters; p; p = p->next) {
        arguments += type_components(p->type);
    }
    cost->trips += to->trips;
    return spend(walk, cost, 1 + arguments, expr->at) &&
           spend_size(walk, cost, to->size, expr->at) &&
           spend_work(walk, cost, to->work, expr->at) &&
           spend_bytes(walk, cost, to->bytes, expr->at);
}

/* --- expressions --- */

/* Of the expression itself, without what is in it. */
static long size_of(const struct expr *expr)
{
    enum { HEAVY = 8 };
    const long count = type_components(expr->type);
    bool divides =
        type_is_integer(expr->type) && (expr->op == OP_DIVIDE || expr->op == OP_REMAINDER);
    if (expr->value) {
        return count > 1 ? count : 0;
    }
    switch (expr->kind) {
    case EXPR_VARIABLE:
    case EXPR_SWIZZLE:
    case EXPR_FIELD:
    case EXPR_PART:
    case EXPR_DATA:
        return 0;
    case EXPR_INDEX:
        return expr->b->value ? 0 : count + HEAVY;
    case EXPR_BINARY:
        if (type_is_matrix(expr->a->type) && !type_is_scalar(expr->b->type)) {
            return count * expr->a->type.columns;
        }
        return divides ? HEAVY * count : most(count, type_components(expr->a->type));
    case EXPR_ASSIGN:
        return divides ? HEAVY * count : expr->op == OP_NONE ? count : 2 * count;
    case EXPR_BUILTIN:
        return check_work_of_builtin(expr);
    default:
        return count;
    }
}

static bool walk_expr(struct bounds_walk *walk, struct cost *cost, const struct expr *expr)
{
    if (!expr) {
        return true;
    }
    if (!spend_size(walk, cost, check_load(expr), expr->at)) {
        return false;
    }
    if (!expr->value) {
        if (!walk_expr(walk, cost, expr->a) || !walk_expr(walk, cost, expr->b) ||
            !walk_expr(walk, cost, expr->c)) {
            return false;
        }
        for (const struct expr *arg = expr->args; arg; arg = arg->next) {
            if (!walk_expr(walk, cost, arg)) {
                return false;
            }
        }
        if (expr->kind == EXPR_CALL) {
            return walk_call(walk, cost, expr);
        }
        if (expr->kind == EXPR_BUILTIN && expr->builtin->trips > 0) {
            cost->trips += expr->builtin->trips;
            if (!spend_work(walk, cost, size_of(expr) * (expr->builtin->trips - 1), expr->at)) {
                return false;
            }
        }
    }
    return spend(walk, cost, size_of(expr), expr->at);
}

/* --- statements --- */

static bool walk_statement(struct bounds_walk *walk, struct cost *cost, const struct stmt *stmt);

static bool walk_list(struct bounds_walk *walk, struct cost *cost, const struct stmt *list)
{
    for (; list; list = list->next) {
        if (!walk_statement(walk, cost, list)) {
            return false;
        }
    }
    return true;
}

static bool walk_for(struct bounds_walk *walk, struct cost *cost, const struct stmt *stmt)
{
    struct cost body = {.size = cost->size, .bytes = cost->bytes};

    if (!walk_statement(walk, &body, stmt->body)) {
        return false;
    }
    cost->trips += stmt->trips * (1 + body.trips);
    cost->size = body.size;
    cost->bytes = body.bytes;
    if (!spend_work(walk, cost, stmt->trips * (1 + body.work), stmt->at)) {
        return false;
    }
    return cost->trips <= LIMIT_CODE_TRIPS ||
           tree_fail_limit(walk->tree, stmt->at, "iterations of loops", LIMIT_CODE_TRIPS,
                           "code_trips");
}

static bool walk_variable(struct bounds_walk *walk, struct cost *cost,
                          const struct variable *variable, struct at at)
{
    enum { COMPONENT_BYTES = 4 };
    const long count = type_components(variable->type);
    return spend(walk, cost, count, at) && (variable->type.count == 0 || variable->value ||
                                            spend_bytes(walk, cost, COMPONENT_BYTES * count, at));
}

static const struct stmt *last_of(const struct stmt *list)
{
    while (list && list->next) {
        list = list->next;
    }
    return list;
}

/* A return at the end leaves nothing out. */
static bool is_last(const struct function *function, const struct stmt *stmt)
{
    return stmt->kind == STMT_RETURN && stmt == last_of(function->body->body);
}

static bool walk_statement(struct bounds_walk *walk, struct cost *cost, const struct stmt *stmt)
{
    const struct variable *variable = stmt->variable;

    if (!is_last(walk->function, stmt) &&
        !spend_size(walk, cost, check_load_of_statement(stmt), stmt->at)) {
        return false;
    }
    switch (stmt->kind) {
    case STMT_EMPTY:
        return true;
    case STMT_FOR:
        return spend(walk, cost, 1, stmt->at) && walk_for(walk, cost, stmt);
    case STMT_IF:
        return spend(walk, cost, 1, stmt->at) && walk_expr(walk, cost, stmt->expr) &&
               walk_statement(walk, cost, stmt->body) &&
               (!stmt->other || walk_statement(walk, cost, stmt->other));
    case STMT_DECLARE:
        return walk_list(walk, cost, stmt->body) && walk_expr(walk, cost, stmt->expr) &&
               (!variable || walk_variable(walk, cost, variable, stmt->at));
    case STMT_BLOCK:
        return walk_list(walk, cost, stmt->body);
    default:
        return spend(walk, cost, 1, stmt->at) && walk_expr(walk, cost, stmt->expr);
    }
}

/* --- functions --- */

static bool open_function(struct bounds_walk *walk, struct function *function, struct at call)
{
    if (function->state == FUNCTION_OPEN) {
        return refuse_cycle(walk, function, call);
    }
    if (!function->body) {
        return tree_fail(walk->tree, call, "%.40s is declared, but nowhere defined",
                         function->name->text);
    }
    if (walk->open == LIMIT_CODE_DEPTH) {
        return tree_fail_limit(walk->tree, call, "calls inside calls", LIMIT_CODE_DEPTH,
                               "code_depth");
    }
    function->state = FUNCTION_OPEN;
    function->caller = walk->function;
    walk->function = function;
    walk->open++;
    return true;
}

static bool walk_function(struct bounds_walk *walk, struct function *function, struct at call)
{
    struct cost cost = {0};

    if (function->state == FUNCTION_DONE) {
        return true;
    }
    if (!open_function(walk, function, call) || !walk_statement(walk, &cost, function->body)) {
        return false;
    }
    function->size = cost.size;
    function->work = cost.work;
    function->trips = cost.trips;
    function->bytes = cost.bytes;
    if (function->trips > LIMIT_CODE_TRIPS) {
        return tree_fail_limit(walk->tree, function->at, "iterations of loops", LIMIT_CODE_TRIPS,
                               "code_trips");
    }
    if (function->height >= LIMIT_CODE_DEPTH) {
        return tree_fail_limit(walk->tree, function->at, "calls inside calls", LIMIT_CODE_DEPTH,
                               "code_depth");
    }
    function->state = FUNCTION_DONE;
    *walk->tree->last_called = function;
    walk->tree->last_called = &function->next_called;
    walk->function = function->caller;
    walk->open--;
    return true;
}

bool check_bounds(struct tree *tree)
{
    struct bounds_walk walk = {.tree = tree};

    for (struct function *f = tree->functions; f; f = f->next) {
        if (f->body && !walk_function(&walk, f, f->at)) {
            return false;
        }
    }
    return true;
}

void check_reach(struct function *entry)
{
    entry->reachable = true;
    for (const struct call *call = entry->calls; call; call = call->next) {
        if (!call->to->reachable) {
            check_reach(call->to);
        }
    }
}
