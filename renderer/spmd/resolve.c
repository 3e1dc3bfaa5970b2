/* SPDX-License-Identifier: MIT */
/* Names and types. */
#include <string.h>

#include "spmd.h"

enum { VARIABLES_MAX = 1024 };

struct resolver {
    struct tree *tree;
    struct variable *known[VARIABLES_MAX]; /* that names mean now, in their order */
    int count;
    struct function *function;
};

static bool resolve_value(struct resolver *r, struct expr *expr);
static bool resolve_statement(struct resolver *r, struct stmt *stmt);
static bool resolve_function(struct resolver *r, struct function *function);

/* --- types --- */

int spmd_components(const struct tree *tree, struct type type)
{
    int count = 0;

    if (type.base == BASE_VOID) {
        return 0;
    }
    if (type.base != BASE_STRUCT) {
        return type.rows * type.columns;
    }
    for (const struct variable *v = tree->structs[type.rows].members; v; v = v->next) {
        count += spmd_components(tree, v->type);
    }
    return count;
}

enum base spmd_base(const struct tree *tree, struct type type, int i)
{
    if (type.base != BASE_STRUCT) {
        return (enum base)type.base;
    }
    for (const struct variable *v = tree->structs[type.rows].members; v; v = v->next) {
        const int count = spmd_components(tree, v->type);
        if (i < count) {
            return spmd_base(tree, v->type, i);
        }
        i -= count;
    }
    return BASE_VOID;
}

const struct variable *spmd_member(const struct tree *tree, struct type type,
                                   const struct name *name, int *out_first)
{
    *out_first = 0;
    for (const struct variable *v = tree->structs[type.rows].members; v; v = v->next) {
        if (v->name == name) {
            return v;
        }
        *out_first += spmd_components(tree, v->type);
    }
    return NULL;
}

static bool is_plain(struct type type)
{
    return type.base >= BASE_FLOAT && type.base <= BASE_BOOL && type.count == 0;
}

static struct type shaped(enum base base, struct type like)
{
    like.base = (uint8_t)base;
    return like;
}

static bool same(struct type a, struct type b)
{
    return a.base == b.base && a.rows == b.rows && a.columns == b.columns;
}

bool spmd_constant(struct tree *tree, const struct expr *expr, int *out)
{
    int a, b;

    if (expr->kind == EXPR_LITERAL) {
        *out = (int)expr->value[0];
        return true;
    }
    if (expr->kind == EXPR_BINARY && spmd_constant(tree, expr->a, &a) &&
        spmd_constant(tree, expr->b, &b)) {
        *out = expr->op == OP_ADD ? a + b : expr->op == OP_SUBTRACT ? a - b : a * b;
        return expr->op == OP_ADD || expr->op == OP_SUBTRACT || expr->op == OP_MULTIPLY;
    }
    return tree_fail(tree, expr->at, "not a constant whole number");
}

/* --- names --- */

static bool declare(struct resolver *r, struct variable *variable)
{
    int length = 0;

    if (!variable->name) {
        return true;
    }
    if (variable->length) {
        if (!spmd_constant(r->tree, variable->length, &length)) {
            return false;
        }
        variable->type.count = (uint8_t)length;
        variable->length = NULL;
    }
    if (r->count == VARIABLES_MAX) {
        return tree_fail(r->tree, variable->at, "too many variables");
    }
    variable->hidden = variable->name->variable;
    variable->name->variable = variable;
    r->known[r->count++] = variable;
    return true;
}

static void close_scope(struct resolver *r, int count)
{
    while (r->count > count) {
        struct variable *variable = r->known[--r->count];
        variable->name->variable = variable->hidden;
    }
}

/* --- calls --- */

/* How far arguments are from parameters: -1 where they do not fit, else conversions. */
static int fits(const struct function *function, const struct expr *call)
{
    int conversions = 0;
    const struct expr *arg = call->args;

    if (function->parameter_count != call->arg_count) {
        return -1;
    }
    for (const struct variable *p = function->parameters; p; p = p->next, arg = arg->next) {
        if (same(p->type, arg->type)) {
            continue;
        }
        if (p->type.base == BASE_STRUCT || arg->type.base == BASE_STRUCT ||
            p->type.rows != arg->type.rows || p->type.columns != arg->type.columns ||
            p->type.base != BASE_FLOAT) {
            return -1;
        }
        conversions++;
    }
    return conversions;
}

static bool resolve_call_of(struct resolver *r, struct expr *expr)
{
    struct function *best = NULL;
    int least = 0;

    for (struct function *f = expr->name->functions; f; f = f->overload) {
        const int conversions = fits(f, expr);
        if (conversions >= 0 && (!best || conversions < least)) {
            best = f;
            least = conversions;
        }
    }
    if (!best) {
        return tree_fail(r->tree, expr->at, "no function %s fits", expr->name->text);
    }
    expr->function = best;
    expr->type = best->result;
    return resolve_function(r, best);
}

static struct type builtin_type(const struct spmd_builtin *builtin, const struct expr *call)
{
    struct type most = call->args ? call->args->type : type_vector(BASE_FLOAT, 1);
    const struct type first = most;

    for (const struct expr *arg = call->args; arg; arg = arg->next) {
        most = arg->type.rows > most.rows ? arg->type : most;
        most =
            most.base == BASE_INT && arg->type.base == BASE_FLOAT ? shaped(BASE_FLOAT, most) : most;
    }
    switch (builtin->gives) {
    case GIVES_SAME:
        return most;
    case GIVES_FLOAT:
        return type_vector(BASE_FLOAT, 1);
    case GIVES_BOOL:
        return type_vector(BASE_BOOL, 1);
    case GIVES_BOOLS:
        return shaped(BASE_BOOL, first);
    case GIVES_FLOATS:
        return shaped(BASE_FLOAT, first);
    case GIVES_INTS:
        return shaped(BASE_INT, first);
    case GIVES_UINTS:
        return shaped(BASE_UINT, first);
    case GIVES_VEC3:
        return type_vector(BASE_FLOAT, 3);
    case GIVES_VEC4:
        return type_vector(BASE_FLOAT, 4);
    default:
        return type_vector(BASE_INT, 2);
    }
}

static bool resolve_call(struct resolver *r, struct expr *expr)
{
    for (struct expr *arg = expr->args; arg; arg = arg->next) {
        if (!resolve_value(r, arg)) {
            return false;
        }
    }
    const struct spmd_builtin *builtin = spmd_builtin_find(expr->name->text);
    if (!builtin) {
        return resolve_call_of(r, expr);
    }
    expr->kind = EXPR_BUILTIN;
    expr->type = builtin_type(builtin, expr);
    return true;
}

/* --- values --- */

static bool resolve_name(struct resolver *r, struct expr *expr)
{
    expr->variable = expr->name->variable;
    if (!expr->variable) {
        return tree_fail(r->tree, expr->at, "%s is not known", expr->name->text);
    }
    expr->type = expr->variable->type;
    return true;
}

static bool resolve_binary(struct resolver *r, struct expr *expr)
{
    struct type a = expr->a->type, b = expr->b->type;
    struct type wide = b.rows * b.columns > a.rows * a.columns ? b : a;

    if (expr->op >= OP_LESS && expr->op <= OP_XOR) {
        expr->type = type_vector(BASE_BOOL, 1);
        return true;
    }
    if (!is_plain(a) || !is_plain(b)) {
        return tree_fail(r->tree, expr->at, "no operator %s for these", tree_op_text(expr->op));
    }
    if (expr->op == OP_MULTIPLY && type_is_matrix(a) != type_is_matrix(b) &&
        type_is_vector(a) != type_is_vector(b)) {
        expr->type = type_is_matrix(a) ? b : a;
        if (!type_is_scalar(a) && !type_is_scalar(b)) {
            return true;
        }
    }
    wide.base = a.base == BASE_FLOAT || b.base == BASE_FLOAT ? BASE_FLOAT : a.base;
    wide.base = a.base == BASE_INT && b.base == BASE_UINT ? BASE_UINT : wide.base;
    expr->type = wide;
    return true;
}

static int letter_of(char c)
{
    static const char *const sets[] = {"xyzw", "rgba", "stpq"};

    for (int i = 0; i < 3; i++) {
        const char *at = strchr(sets[i], c);
        if (at) {
            return (int)(at - sets[i]);
        }
    }
    return -1;
}

static bool resolve_member(struct resolver *r, struct expr *expr)
{
    struct type of = expr->a->type;
    const char *letters = expr->name->text;
    int first;

    if (of.base == BASE_STRUCT) {
        const struct variable *member = spmd_member(r->tree, of, expr->name, &first);
        if (!member) {
            return tree_fail(r->tree, expr->at, "there is no member %s", letters);
        }
        expr->kind = EXPR_MEMBER;
        expr->type = member->type;
        int length;
        if (member->length && spmd_constant(r->tree, member->length, &length)) {
            expr->type.count = (uint8_t)length;
        }
        return true;
    }
    expr->kind = EXPR_SWIZZLE;
    expr->swizzle_count = (uint8_t)strlen(letters);
    for (int i = 0; i < expr->swizzle_count; i++) {
        const int at = i < 4 ? letter_of(letters[i]) : -1;
        if (at < 0 || at >= of.rows) {
            return tree_fail(r->tree, expr->at, "there is no component %s", letters);
        }
        expr->swizzle[i] = (uint8_t)at;
    }
    expr->type = type_vector((enum base)of.base, expr->swizzle_count);
    return true;
}

static bool resolve_parts(struct resolver *r, struct expr *expr)
{
    struct expr *parts[] = {expr->a, expr->b, expr->c};

    for (int i = 0; i < 3; i++) {
        if (parts[i] && !resolve_value(r, parts[i])) {
            return false;
        }
    }
    return true;
}

static bool resolve_construct(struct resolver *r, struct expr *expr)
{
    for (struct expr *arg = expr->args; arg; arg = arg->next) {
        if (!resolve_value(r, arg)) {
            return false;
        }
    }
    expr->type.count = expr->array ? (uint8_t)expr->arg_count : 0;
    return true;
}

static bool resolve_value(struct resolver *r, struct expr *expr)
{
    if (expr->kind == EXPR_CONSTRUCT) {
        return resolve_construct(r, expr);
    }
    if (expr->kind == EXPR_CALL || expr->kind == EXPR_BUILTIN) {
        return resolve_call(r, expr);
    }
    if (!resolve_parts(r, expr)) {
        return false;
    }
    switch (expr->kind) {
    case EXPR_VARIABLE:
        return resolve_name(r, expr);
    case EXPR_BINARY:
        return resolve_binary(r, expr);
    case EXPR_MEMBER:
    case EXPR_SWIZZLE:
        return resolve_member(r, expr);
    case EXPR_INDEX:
        expr->type = type_element(expr->a->type);
        return true;
    case EXPR_CHOICE:
        expr->type = expr->b->type.base == BASE_INT ? expr->c->type : expr->b->type;
        return true;
    case EXPR_COMMA:
        expr->type = expr->b->type;
        return true;
    case EXPR_UNARY:
    case EXPR_STEP:
    case EXPR_ASSIGN:
        expr->type = expr->a->type;
        return true;
    default:
        return true;
    }
}

/* --- statements --- */

static bool resolve_list(struct resolver *r, struct stmt *stmt)
{
    for (; stmt; stmt = stmt->next) {
        if (!resolve_statement(r, stmt)) {
            return false;
        }
    }
    return true;
}

static bool resolve_declaration(struct resolver *r, struct stmt *stmt)
{
    if (!stmt->variable) {
        return resolve_list(r, stmt->body);
    }
    return (!stmt->expr || resolve_value(r, stmt->expr)) && declare(r, stmt->variable);
}

static bool resolve_statement(struct resolver *r, struct stmt *stmt)
{
    const int known = r->count;
    bool ok = true;

    if (stmt->kind == STMT_DECLARE) {
        return resolve_declaration(r, stmt);
    }
    if (stmt->kind == STMT_FOR) {
        ok = resolve_statement(r, stmt->other) && (!stmt->expr || resolve_value(r, stmt->expr)) &&
             resolve_statement(r, stmt->body) &&
             (!stmt->advance || resolve_value(r, stmt->advance));
        close_scope(r, known);
        return ok;
    }
    ok = (!stmt->expr || resolve_value(r, stmt->expr)) && resolve_list(r, stmt->body);
    close_scope(r, known);
    if (ok && stmt->other) {
        ok = resolve_statement(r, stmt->other);
        close_scope(r, known);
    }
    return ok;
}

static bool resolve_function(struct resolver *r, struct function *function)
{
    if (function->state == FUNCTION_DONE) {
        return true;
    }
    if (function->state == FUNCTION_OPEN) {
        return tree_fail(r->tree, function->at, "%s calls itself", function->name->text);
    }
    /* Names in the body mean what is outside of functions. */
    struct resolver inner = {.tree = r->tree, .function = function};
    struct variable *hidden[VARIABLES_MAX];
    int hidden_count = 0;
    for (int i = r->count; i-- > 0;) {
        if (r->known[i]->storage != STORAGE_GLOBAL && r->known[i]->storage != STORAGE_UNIFORM) {
            hidden[hidden_count++] = r->known[i];
            r->known[i]->name->variable = r->known[i]->hidden;
        }
    }
    bool ok = true;
    function->state = FUNCTION_OPEN;
    for (struct variable *p = function->parameters; p && ok; p = p->next) {
        ok = declare(&inner, p);
    }
    ok = ok && (!function->body || resolve_statement(&inner, function->body));
    close_scope(&inner, 0);
    while (hidden_count > 0) {
        struct variable *variable = hidden[--hidden_count];
        variable->name->variable = variable;
    }
    function->state = FUNCTION_DONE;
    *r->tree->last_called = function;
    r->tree->last_called = &function->next_called;
    return ok;
}

/* --- the whole --- */

static bool same_parameters(const struct function *a, const struct function *b)
{
    const struct variable *q = b->parameters;

    for (const struct variable *p = a->parameters; p && q; p = p->next, q = q->next) {
        if (!same(p->type, q->type)) {
            return false;
        }
    }
    return a->parameter_count == b->parameter_count;
}

/* A function, or the body of one that was declared. */
static void add_function(struct tree *tree, struct function *function)
{
    for (struct function *f = function->name->functions; f; f = f->overload) {
        if (same_parameters(f, function)) {
            f->body = function->body ? function->body : f->body;
            f->parameters = function->body ? function->parameters : f->parameters;
            return;
        }
    }
    function->number = tree->function_count++;
    function->overload = function->name->functions;
    function->name->functions = function;
}

static bool resolve_top(struct resolver *r)
{
    for (struct stmt *stmt = r->tree->top; stmt; stmt = stmt->next) {
        if (stmt->kind == STMT_FUNCTION) {
            add_function(r->tree, stmt->function);
            continue;
        }
        for (struct stmt *one = stmt->variable ? stmt : stmt->body; one;
             one = stmt->variable ? NULL : one->next) {
            if (one->variable->storage != STORAGE_UNIFORM) {
                one->variable->storage = STORAGE_GLOBAL;
            }
            if ((one->expr && !resolve_value(r, one->expr)) || !declare(r, one->variable)) {
                return false;
            }
        }
    }
    return true;
}

bool spmd_is_entry(const struct function *function, const char *const *entries, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const size_t length = strcspn(entries[i], "*");
        if (strncmp(function->name->text, entries[i], length) == 0 &&
            (entries[i][length] == '*' || function->name->text[length] == '\0')) {
            return true;
        }
    }
    return false;
}

bool spmd_resolve(struct tree *tree, const char *const *entries, size_t count)
{
    struct resolver r = {.tree = tree};

    if (!resolve_top(&r)) {
        return false;
    }
    for (struct stmt *stmt = tree->top; stmt; stmt = stmt->next) {
        if (stmt->kind != STMT_FUNCTION || !spmd_is_entry(stmt->function, entries, count)) {
            continue;
        }
        for (struct function *f = stmt->function->name->functions; f; f = f->overload) {
            if (!resolve_function(&r, f)) {
                return false;
            }
        }
    }
    return tree->called != NULL;
}
