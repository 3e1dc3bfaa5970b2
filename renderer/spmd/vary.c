/* SPDX-License-Identifier: MIT */
/* Which values may differ from lane to lane. Everything is taken to be the same at first; what is
 * found to vary makes more vary, until nothing changes.
 *
 * A scope is a piece of program that the same lanes run: what is declared in it and assigned in it
 * may stay a scalar. */
#include <string.h>

#include "spmd.h"

struct vary {
    struct function *function;
    int scope, scopes; /* the current one; made so far */
    bool apart;        /* not all lanes that entered the function are here */
    bool loop_apart;   /* not all lanes that began this round of the loop are here */
    bool loop_leaves;  /* out: some lanes of the loop leave it, or its round, before others */
    bool changed;
};

static void vary_statement(struct vary *v, struct stmt *stmt);

static void mark(struct vary *v, bool *varying, bool is)
{
    if (is && !*varying) {
        *varying = true;
        v->changed = true;
    }
}

/* The variable that a place is part of. */
static struct variable *root_of(const struct expr *place)
{
    while (place->kind != EXPR_VARIABLE) {
        place = place->a;
    }
    return place->variable;
}

static void vary_value(struct vary *v, struct expr *expr);

static void assign_to(struct vary *v, const struct expr *place, bool varying)
{
    struct variable *variable = root_of(place);
    bool index = false;

    for (const struct expr *e = place; e->kind != EXPR_VARIABLE; e = e->a) {
        index |= e->kind == EXPR_INDEX && e->b->varying;
    }
    mark(v, &variable->varying, varying || index || variable->scope != v->scope);
}

static void vary_call(struct vary *v, struct expr *expr)
{
    struct function *f = expr->function;
    struct expr *arg = expr->args;

    for (struct variable *p = f->parameters; p; p = p->next, arg = arg->next) {
        if (p->direction == DIRECTION_IN) {
            mark(v, &p->varying, arg->varying);
        } else {
            mark(v, &p->varying, true);
            assign_to(v, arg, true);
        }
    }
    mark(v, &expr->varying, f->varying);
}

static void vary_value(struct vary *v, struct expr *expr)
{
    struct expr *parts[] = {expr->a, expr->b, expr->c};
    bool any = false;

    for (int i = 0; i < 3; i++) {
        if (parts[i]) {
            vary_value(v, parts[i]);
            any |= parts[i]->varying;
        }
    }
    for (struct expr *arg = expr->args; arg; arg = arg->next) {
        vary_value(v, arg);
        any |= arg->varying;
    }
    if (expr->kind == EXPR_CALL) {
        vary_call(v, expr);
        return;
    }
    if (expr->kind == EXPR_BUILTIN && spmd_builtin_joins(expr->name->text)) {
        return;
    }
    if (expr->kind == EXPR_VARIABLE) {
        any = expr->variable->varying;
    }
    if (expr->kind == EXPR_ASSIGN || expr->kind == EXPR_STEP) {
        assign_to(v, expr->a, any);
        any |= root_of(expr->a)->varying;
    }
    mark(v, &expr->varying, any);
}

static void vary_list(struct vary *v, struct stmt *stmt)
{
    for (; stmt; stmt = stmt->next) {
        vary_statement(v, stmt);
    }
}

static int scope_of(struct vary *v, int *scope)
{
    if (*scope == 0) {
        *scope = ++v->scopes;
    }
    return *scope;
}

static void vary_if(struct vary *v, struct stmt *stmt)
{
    const struct vary before = *v;

    vary_value(v, stmt->expr);
    mark(v, &stmt->varying, stmt->expr->varying);
    if (stmt->varying) {
        v->apart = v->loop_apart = true;
        v->scope = scope_of(v, &stmt->scope);
    }
    vary_statement(v, stmt->body);
    if (stmt->other) {
        v->scope = stmt->varying ? scope_of(v, &stmt->other_scope) : before.scope;
        vary_statement(v, stmt->other);
    }
    v->scope = before.scope;
    v->apart = before.apart;
    v->loop_apart = before.loop_apart;
}

static void vary_for(struct vary *v, struct stmt *stmt)
{
    const struct vary before = *v;

    if (stmt->varying) {
        v->apart = true;
        v->scope = scope_of(v, &stmt->scope);
    }
    v->loop_apart = v->loop_leaves = false;
    vary_statement(v, stmt->other);
    if (stmt->expr) {
        vary_value(v, stmt->expr);
    }
    vary_statement(v, stmt->body);
    if (stmt->advance) {
        vary_value(v, stmt->advance);
    }
    mark(v, &stmt->varying, (stmt->expr && stmt->expr->varying) || v->loop_leaves);
    v->scope = before.scope;
    v->apart = before.apart;
    v->loop_apart = before.loop_apart;
    v->loop_leaves = before.loop_leaves;
}

static void vary_return(struct vary *v, struct stmt *stmt)
{
    mark(v, &stmt->varying, v->apart);
    mark(v, &v->function->varying, stmt->varying || (stmt->expr && stmt->expr->varying));
    mark(v, &v->function->leaves, stmt->varying);
    v->loop_leaves |= v->loop_apart;
}

static void vary_statement(struct vary *v, struct stmt *stmt)
{
    if (stmt->kind == STMT_IF) {
        vary_if(v, stmt);
        return;
    }
    if (stmt->kind == STMT_FOR) {
        vary_for(v, stmt);
        return;
    }
    if (stmt->expr) {
        vary_value(v, stmt->expr);
    }
    if (stmt->kind == STMT_RETURN) {
        vary_return(v, stmt);
    }
    if (stmt->kind == STMT_BREAK || stmt->kind == STMT_CONTINUE) {
        mark(v, &stmt->varying, v->loop_apart);
        v->loop_leaves |= v->loop_apart;
    }
    if (stmt->kind == STMT_DECLARE && stmt->variable) {
        stmt->variable->scope = v->scope;
        mark(v, &stmt->variable->varying, stmt->expr && stmt->expr->varying);
    }
    vary_list(v, stmt->body);
}

static void vary_function(struct vary *all, struct function *function)
{
    struct vary v = {.function = function, .scopes = all->scopes};

    v.scope = scope_of(&v, &function->scope);
    for (struct variable *p = function->parameters; p; p = p->next) {
        /* What lanes that returned have given must stay. */
        p->scope = p->direction == DIRECTION_IN || !function->leaves ? v.scope : -1;
    }
    if (function->body) {
        vary_statement(&v, function->body);
    }
    all->scopes = v.scopes;
    all->changed |= v.changed;
}

void spmd_vary(struct tree *tree, const char *const *entries, size_t count)
{
    struct vary v = {.changed = true};

    for (struct stmt *stmt = tree->top; stmt; stmt = stmt->next) {
        for (struct stmt *one = stmt->variable ? stmt : stmt->body;
             one && stmt->kind == STMT_DECLARE; one = stmt->variable ? NULL : one->next) {
            one->variable->varying =
                one->variable->storage == STORAGE_GLOBAL && !one->variable->read_only;
            one->variable->scope = -1;
        }
    }
    for (struct function *f = tree->called; f; f = f->next_called) {
        const bool outside = !f->body;
        f->varying = outside;
        for (struct variable *p = f->parameters; p; p = p->next) {
            const bool single = type_is(p->type, BASE_INT) || type_is(p->type, BASE_BOOL) ||
                                p->type.base == BASE_SAMPLER;
            p->varying = p->direction != DIRECTION_IN ||
                         ((outside || spmd_is_entry(f, entries, count)) && !single);
        }
    }
    while (v.changed) {
        v.changed = false;
        for (struct function *f = tree->called; f; f = f->next_called) {
            vary_function(&v, f);
        }
    }
}
