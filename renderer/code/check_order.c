/* SPDX-License-Identifier: MIT */
/* Expressions that come out one way or another, as their parts are looked at in this order or that:
 * GLSL names no order, and drivers have several. */
#include "check.h"

#include <string.h>

/* What is assigned to, in the end. */
static const struct variable *root_of(const struct expr *place)
{
    while (place->kind != EXPR_VARIABLE) {
        place = place->a;
    }
    return place->variable;
}

static bool uses(const struct expr *expr, const struct variable *variable)
{
    if (!expr || expr->value) {
        return false;
    }
    for (const struct expr *arg = expr->args; arg; arg = arg->next) {
        if (uses(arg, variable)) {
            return true;
        }
    }
    return (expr->kind == EXPR_VARIABLE && expr->variable == variable) || uses(expr->a, variable) ||
           uses(expr->b, variable) || uses(expr->c, variable);
}

/* A variable that one part assigns to and another one uses; NULL: none. */
static const struct variable *find_clash(const struct expr *part, const struct expr *other)
{
    const struct variable *clash = NULL;

    if (!part || !part->effects) {
        return NULL;
    }
    if (part->kind == EXPR_ASSIGN || part->kind == EXPR_STEP) {
        const struct variable *root = root_of(part->a);
        clash = uses(other, root) ? root : NULL;
    }
    const struct variable *p = part->kind == EXPR_CALL ? part->function->parameters : NULL;
    for (const struct expr *arg = part->args; arg && !clash; arg = arg->next) {
        if (p && p->direction != DIRECTION_IN && uses(other, root_of(arg))) {
            clash = root_of(arg);
        }
        clash = clash ? clash : find_clash(arg, other);
        p = p ? p->next : NULL;
    }
    const struct expr *below[] = {part->a, part->b, part->c};
    for (size_t i = 0; i < 3 && !clash; i++) {
        clash = find_clash(below[i], other);
    }
    return clash;
}

static bool clash(struct checker *checker, struct at at, const struct expr *one,
                  const struct expr *two)
{
    const struct variable *variable = find_clash(one, two);

    variable = variable ? variable : find_clash(two, one);
    return variable &&
           !CHECK_FAIL(checker, at,
                       "%.40s is used and changed in one expression; make two statements of it",
                       variable->name->text);
}

/* The part of its variable that a place begins with; the variable itself where it is all of it. */
static const struct expr *first_part(const struct expr *place)
{
    while (place->kind != EXPR_VARIABLE && place->a->kind != EXPR_VARIABLE) {
        place = place->a;
    }
    return place;
}

static bool share_components(const struct expr *one, const struct expr *two)
{
    for (int i = 0; i < one->swizzle_count; i++) {
        if (memchr(two->swizzle, one->swizzle[i], two->swizzle_count)) {
            return true;
        }
    }
    return false;
}

/* Whether two places surely are the same in part: of indices only constants are known. */
static bool overlap(const struct expr *one, const struct expr *two)
{
    if (root_of(one) != root_of(two)) {
        return false;
    }
    one = first_part(one);
    two = first_part(two);
    if (one->kind != two->kind || one->kind == EXPR_VARIABLE) {
        return true;
    }
    switch (one->kind) {
    case EXPR_SWIZZLE:
        return share_components(one, two);
    case EXPR_INDEX:
        return one->b->value && two->b->value && *one->b->value == *two->b->value;
    default:
        return one->field == two->field;
    }
}

/* A call writes its results back in an order that GLSL does not say. */
static bool check_results(struct checker *checker, const struct expr *call)
{
    const struct variable *p = call->function->parameters, *q;

    for (const struct expr *one = call->args; one; one = one->next, p = p->next) {
        q = p->next;
        for (const struct expr *two = one->next; two; two = two->next, q = q->next) {
            if (p->direction != DIRECTION_IN && q->direction != DIRECTION_IN && overlap(one, two)) {
                return CHECK_FAIL(checker, two->at,
                                  "%.40s gets two results of one call; give it two variables",
                                  root_of(two)->name->text);
            }
        }
    }
    return true;
}

bool check_order(struct checker *checker, const struct expr *expr)
{
    const bool ordered = expr->kind == EXPR_COMMA || expr->kind == EXPR_CHOICE ||
                         (expr->kind == EXPR_BINARY && (expr->op == OP_AND || expr->op == OP_OR));

    if (!expr->effects || ordered) {
        return true;
    }
    if (expr->kind == EXPR_CALL && !check_results(checker, expr)) {
        return false;
    }
    for (const struct expr *one = expr->args; one; one = one->next) {
        for (const struct expr *two = one->next; two; two = two->next) {
            if ((one->effects || two->effects) && clash(checker, expr->at, one, two)) {
                return false;
            }
        }
    }
    return !expr->a || !expr->b || !clash(checker, expr->at, expr->a, expr->b);
}
