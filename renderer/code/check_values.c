/* SPDX-License-Identifier: MIT */
/* Expressions: types, constants, what can be assigned to. */
#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "lower.h"
#include "protocol/suggest.h"

/* --- constants --- */

static bool all_constant(const struct expr *expr)
{
    const struct expr *parts[] = {expr->a, expr->b, expr->c};

    for (size_t i = 0; i < 3; i++) {
        if (parts[i] && !parts[i]->value) {
            return false;
        }
    }
    for (const struct expr *arg = expr->args; arg; arg = arg->next) {
        if (!arg->value) {
            return false;
        }
    }
    return expr->a || expr->args;
}

/* What a message calls the expression. */
static const char *describe(const struct expr *expr)
{
    switch (expr->kind) {
    case EXPR_BUILTIN:
        return expr->builtin->name;
    case EXPR_UNARY:
    case EXPR_BINARY:
        return tree_op_text(expr->op);
    default:
        return "this";
    }
}

static bool check_finite(struct checker *checker, const struct expr *expr, const double *value)
{
    for (int i = 0; i < type_components(expr->type); i++) {
        if (isnan(value[i]) || fabs(value[i]) > (double)FLT_MAX) {
            return CHECK_FAIL(checker, expr->at, "the constant that %s gives is %s", describe(expr),
                              isnan(value[i]) ? "not a number" : "infinite");
        }
    }
    return true;
}

bool check_fold(struct checker *checker, struct expr *expr)
{
    if (expr->effects || !all_constant(expr)) {
        return true;
    }
    const int count = type_components(expr->type);
    double *value = tree_alloc(checker->tree, (size_t)count * sizeof *value);
    if (!lower_constant(expr, &checker->scratch, value)) {
        return tree_fail_limit(checker->tree, expr->at, "numbers in a constant", MACHINE_VALUES,
                               "code_size");
    }
    if (!check_finite(checker, expr, value)) {
        return false;
    }
    expr->value = value;
    return true;
}

/* --- names --- */

static bool unknown_variable(struct checker *checker, const struct expr *expr)
{
    char hint[80];
    struct suggestion suggestion = {.text = expr->name->text};

    for (int i = 0; i <= checker->scope; i++) {
        for (struct variable *v = checker->scopes[i]; v; v = v->next_in_scope) {
            suggest_consider(&suggestion, v->name->text);
        }
    }
    if (expr->name->functions || builtin_find(expr->name->text, checker->tree->ours)) {
        return CHECK_FAIL(checker, expr->at, "%.40s is a function; call it with ( )",
                          expr->name->text);
    }
    return CHECK_FAIL(checker, expr->at, "there is no variable %.40s%s", expr->name->text,
                      suggest_hint(&suggestion, hint, sizeof hint));
}

static bool check_variable(struct checker *checker, struct expr *expr)
{
    struct variable *variable = expr->name->variable;

    if (!variable) {
        return unknown_variable(checker, expr);
    }
    variable->used = true;
    expr->variable = variable;
    expr->type = variable->type;
    expr->value = variable->value;
    return true;
}

/* --- operators --- */

static bool check_unary(struct checker *checker, struct expr *expr)
{
    char name[TYPE_NAME_BYTES];
    struct type type = expr->a->type;
    const bool ok = expr->op == OP_NOT      ? type_is(type, BASE_BOOL)
                    : expr->op == OP_INVERT ? type_is_integer(type)
                                            : type_is_number(type);

    if (!ok) {
        return CHECK_FAIL(checker, expr->at, "%s cannot be used on %s%s", tree_op_text(expr->op),
                          type_name(type, name),
                          expr->op == OP_NOT && type.base == BASE_BOOL ? "; write not()" : "");
    }
    expr->type = type;
    expr->effects = expr->a->effects;
    return check_fold(checker, expr);
}

static bool check_increment(struct checker *checker, struct expr *expr)
{
    char name[TYPE_NAME_BYTES];

    if (!check_place(checker, expr->a)) {
        return false;
    }
    if (!type_is_number(expr->a->type)) {
        return CHECK_FAIL(checker, expr->at, "%s cannot be used on %s",
                          expr->op == OP_ADD ? "++" : "--", type_name(expr->a->type, name));
    }
    expr->type = expr->a->type;
    expr->effects = true;
    return true;
}

static bool check_choice(struct checker *checker, struct expr *expr)
{
    char b[TYPE_NAME_BYTES], c[TYPE_NAME_BYTES];

    if (!type_is(expr->a->type, BASE_BOOL)) {
        return CHECK_FAIL(checker, expr->at, "the condition of ? is %s, not bool",
                          type_name(expr->a->type, b));
    }
    const bool ok = check_convert(checker, &expr->b, expr->c->type) ||
                    check_convert(checker, &expr->c, expr->b->type);
    if (!ok || expr->b->type.count > 0 || type_components(expr->b->type) == 0) {
        return CHECK_FAIL(checker, expr->at, "? cannot choose between %s and %s",
                          type_name(expr->b->type, b), type_name(expr->c->type, c));
    }
    expr->type = expr->b->type;
    expr->effects = expr->a->effects || expr->b->effects || expr->c->effects;
    return check_fold(checker, expr);
}

static bool check_binary(struct checker *checker, struct expr *expr)
{
    expr->effects = expr->a->effects || expr->b->effects;
    return check_operator(checker, expr, false) && check_fold(checker, expr);
}

static bool check_assign(struct checker *checker, struct expr *expr)
{
    if (!check_place(checker, expr->a)) {
        return false;
    }
    expr->effects = true;
    if (expr->op != OP_NONE) {
        return check_operator(checker, expr, true);
    }
    expr->type = expr->a->type;
    return check_fit(checker, &expr->b, expr->type, "the value");
}

static bool refuse_place(struct checker *checker, const struct expr *expr)
{
    const struct variable *v = expr->variable;

    if (v->counter) {
        return CHECK_FAIL(checker, expr->at, "%.40s counts a loop; it changes in its head alone",
                          v->name->text);
    }
    if (v->storage == STORAGE_DECLARED) {
        return CHECK_FAIL(checker, expr->at,
                          "%.40s is declared outside of the code, which can only read it",
                          v->name->text);
    }
    return CHECK_FAIL(checker, expr->at, "%.40s is constant and cannot be changed", v->name->text);
}

bool check_place(struct checker *checker, const struct expr *expr)
{
    bool indexed = false;

    for (const struct expr *e = expr;; e = e->a) {
        switch (e->kind) {
        case EXPR_VARIABLE:
            if (e->variable->read_only || e->variable->counter ||
                e->variable->storage == STORAGE_DECLARED || type_is_handle(e->type)) {
                return refuse_place(checker, e);
            }
            return true;
        case EXPR_INDEX:
            indexed = true;
            if (e->b->effects) {
                return CHECK_FAIL(checker, e->b->at,
                                  "the index of what is assigned to cannot itself assign");
            }
            break;
        case EXPR_SWIZZLE:
            for (int i = 0; i < e->swizzle_count; i++) {
                if (memchr(e->swizzle, e->swizzle[i], (size_t)i)) {
                    return CHECK_FAIL(checker, e->at,
                                      "a component stands here twice, so that it "
                                      "cannot be assigned to");
                }
            }
            if (indexed) {
                return CHECK_FAIL(checker, e->at, "an index of .%.40s cannot be assigned to",
                                  e->name->text);
            }
            break;
        case EXPR_PART:
            break;
        case EXPR_FIELD:
        case EXPR_DATA:
            return CHECK_FAIL(checker, e->at, "%.40s can only be read", e->name->text);
        default:
            return CHECK_FAIL(checker, e->at, "this is a value, not a variable to assign to");
        }
    }
}

/* --- parts --- */

static bool check_index(struct checker *checker, struct expr *expr)
{
    char name[TYPE_NAME_BYTES];
    struct type type = expr->a->type;

    if ((type_components(type) < 2 && type.count == 0) || type_is_surface(type)) {
        return CHECK_FAIL(checker, expr->at, "%s has no index", type_name(type, name));
    }
    if (!type_is(expr->b->type, BASE_INT) && !type_is(expr->b->type, BASE_UINT)) {
        return CHECK_FAIL(checker, expr->b->at, "an index is int, not %s",
                          type_name(expr->b->type, name));
    }
    if (expr->b->value && (*expr->b->value < 0 || *expr->b->value >= type_elements(type))) {
        return CHECK_FAIL(checker, expr->b->at, "the index %.0f is outside of %s", *expr->b->value,
                          type_name(type, name));
    }
    expr->type = type_element(type);
    expr->effects = expr->a->effects || expr->b->effects;
    return check_fold(checker, expr);
}

static bool check_swizzle(struct checker *checker, struct expr *expr)
{
    static const char *const sets[] = {"xyzw", "rgba", "stpq"};
    const char *text = expr->name->text;
    char name[TYPE_NAME_BYTES];
    struct type type = expr->a->type;
    const size_t count = strlen(text);
    const char *set = NULL;

    for (size_t i = 0; i < 3 && !set; i++) {
        set = strchr(sets[i], text[0]) ? sets[i] : NULL;
    }
    if (!set || count > 4 || strspn(text, set) != count) {
        return CHECK_FAIL(checker, expr->at, "%s has no member %.40s; there are x, y, z, w",
                          type_name(type, name), text);
    }
    for (size_t i = 0; i < count; i++) {
        expr->swizzle[i] = (uint8_t)(strchr(set, text[i]) - set);
        if (expr->swizzle[i] >= type.rows) {
            return CHECK_FAIL(checker, expr->at, "%s has no component %c", type_name(type, name),
                              text[i]);
        }
    }
    expr->kind = EXPR_SWIZZLE;
    expr->swizzle_count = (uint8_t)count;
    expr->type = type_vector((enum base)type.base, (int)count);
    expr->effects = expr->a->effects;
    return check_fold(checker, expr);
}

static bool check_fragment_member(struct checker *checker, struct expr *expr)
{
    static const char *const fields[] = {"world_position", "object_position", "world_normal",
                                         "ray_direction", "ray_distance"};

    enum { FIELDS = sizeof fields / sizeof fields[0] };
    char hint[80];
    struct suggestion suggestion = {.text = expr->name->text};
    for (int i = 0; i < FIELDS; i++) {
        if (strcmp(fields[i], expr->name->text) == 0) {
            expr->kind = EXPR_FIELD;
            expr->field = (uint8_t)i;
            expr->type = type_vector(BASE_FLOAT, i == FIELDS - 1 ? 1 : 3);
            expr->a = NULL;
            checker->tree->shading_used = true;
            return true;
        }
        suggest_consider(&suggestion, fields[i]);
    }
    return CHECK_FAIL(checker, expr->at, "FragmentProperties has no member %.40s%s",
                      expr->name->text, suggest_hint(&suggestion, hint, sizeof hint));
}

static bool check_surface_member(struct checker *checker, struct expr *expr)
{
    char hint[80];
    struct suggestion suggestion = {.text = expr->name->text};

    for (int i = 0; i < SURFACE_MEMBERS; i++) {
        if (strcmp(surface_members[i].name, expr->name->text) == 0) {
            expr->kind = EXPR_PART;
            expr->field = (uint8_t)i;
            expr->type = type_vector(BASE_FLOAT, surface_members[i].rows);
            expr->effects = expr->a->effects;
            checker->tree->transmissive |= strcmp(expr->name->text, "transmission") == 0;
            return check_fold(checker, expr);
        }
        suggest_consider(&suggestion, surface_members[i].name);
    }
    return CHECK_FAIL(checker, expr->at, "Surface has no member %.40s%s", expr->name->text,
                      suggest_hint(&suggestion, hint, sizeof hint));
}

static bool check_primitive_member(struct checker *checker, struct expr *expr)
{
    static const double no_id = 0;

    if (strcmp(expr->name->text, "data") == 0) {
        expr->kind = EXPR_DATA;
        expr->type = type_vector(BASE_FLOAT, 1);
        expr->type.count = (uint8_t)checker->tree->data_count;
        expr->a = NULL;
        checker->tree->data_used = true;
        return true;
    }
    if (strcmp(expr->name->text, "id") == 0) {
        expr->kind = EXPR_LITERAL;
        expr->type = type_vector(BASE_INT, 1);
        expr->value = &no_id;
        expr->a = NULL;
        return true;
    }
    return CHECK_FAIL(checker, expr->at, "Primitive3D has no member %.40s; there are data, id",
                      expr->name->text);
}

static bool check_member(struct checker *checker, struct expr *expr)
{
    char name[TYPE_NAME_BYTES];
    struct type type = expr->a->type;

    if (type.base == BASE_FRAGMENT) {
        return check_fragment_member(checker, expr);
    }
    if (type.base == BASE_PRIMITIVE) {
        return check_primitive_member(checker, expr);
    }
    if (type_is_surface(type)) {
        return check_surface_member(checker, expr);
    }
    if (!type_is_vector(type) && !type_is_scalar(type)) {
        return CHECK_FAIL(checker, expr->at, "%s has no members", type_name(type, name));
    }
    return check_swizzle(checker, expr);
}

/* --- all of them --- */

static bool check_parts(struct checker *checker, struct expr *expr)
{
    struct expr *parts[] = {expr->a, expr->b, expr->c};

    for (size_t i = 0; i < 3; i++) {
        if (parts[i] && !check_value(checker, parts[i])) {
            return false;
        }
        if (parts[i] && type_is_handle(parts[i]->type) && expr->kind != EXPR_MEMBER) {
            return CHECK_FAIL(checker, parts[i]->at, "only its members can be used here");
        }
    }
    return true;
}

static bool check_kind(struct checker *checker, struct expr *expr)
{
    if (expr->kind == EXPR_CALL) {
        return check_call(checker, expr);
    }
    if (expr->kind == EXPR_CONSTRUCT) {
        return check_construct(checker, expr);
    }
    if (!check_parts(checker, expr)) {
        return false;
    }
    switch (expr->kind) {
    case EXPR_LITERAL:
        return true;
    case EXPR_VARIABLE:
        return check_variable(checker, expr);
    case EXPR_UNARY:
        return check_unary(checker, expr);
    case EXPR_STEP:
        return check_increment(checker, expr);
    case EXPR_BINARY:
        return check_binary(checker, expr);
    case EXPR_ASSIGN:
        return check_assign(checker, expr);
    case EXPR_CHOICE:
        return check_choice(checker, expr);
    case EXPR_COMMA:
        expr->type = expr->b->type;
        expr->effects = true; /* so that it is nowhere taken for a value without a past */
        return true;
    case EXPR_INDEX:
        return check_index(checker, expr);
    case EXPR_MEMBER:
        return check_member(checker, expr);
    default:
        assert(!"an expression of the parser");
        return false;
    }
}

bool check_value(struct checker *checker, struct expr *expr)
{
    return check_kind(checker, expr) && check_order(checker, expr);
}
