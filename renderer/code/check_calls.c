/* SPDX-License-Identifier: MIT */
/* Calls of functions, the author's and ours, and constructors. */
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "protocol/suggest.h"

enum { LIST_BYTES = 120 };

/* "(vec3, float)" */
static const char *list_types(const struct expr *args, char out[LIST_BYTES])
{
    size_t used = (size_t)snprintf(out, LIST_BYTES, "(");

    for (; args && used < LIST_BYTES - 40; args = args->next) {
        char name[TYPE_NAME_BYTES];
        used += (size_t)snprintf(out + used, LIST_BYTES - used, "%s%s", type_name(args->type, name),
                                 args->next ? ", " : "");
    }
    snprintf(out + used, LIST_BYTES - used, "%s)", args ? "..." : "");
    return out;
}

static bool check_arguments(struct checker *checker, struct expr *expr)
{
    for (struct expr *arg = expr->args; arg; arg = arg->next) {
        char name[TYPE_NAME_BYTES];
        if (!check_value(checker, arg)) {
            return false;
        }
        if (arg->type.base == BASE_VOID) {
            return CHECK_FAIL(checker, arg->at, "an argument is %s", type_name(arg->type, name));
        }
        expr->effects |= arg->effects;
    }
    return true;
}

/* --- constructors --- */

bool check_length(struct checker *checker, struct expr *length, uint8_t *out)
{
    if (!length->value && !check_value(checker, length)) {
        return false;
    }
    if (!length->value || !type_is_integer(length->type) || !type_is_scalar(length->type)) {
        return CHECK_FAIL(checker, length->at, "the length of an array is a constant int");
    }
    if (*length->value > LIMIT_CODE_ARRAY) {
        return tree_fail_limit(checker->tree, length->at, "elements of an array", LIMIT_CODE_ARRAY,
                               "code_array");
    }
    if (*length->value < 1) {
        return CHECK_FAIL(checker, length->at, "an array has at least one element");
    }
    *out = (uint8_t)*length->value;
    return true;
}

static bool check_array(struct checker *checker, struct expr *expr)
{
    struct type element = type_element(expr->type);

    if (expr->arg_count != expr->type.count) {
        return CHECK_FAIL(checker, expr->at, "an array of %d elements gets %d values",
                          expr->type.count, expr->arg_count);
    }
    for (struct expr **arg = &expr->args; *arg; arg = &(*arg)->next) {
        if (!check_fit(checker, arg, element, "this element")) {
            return false;
        }
    }
    return check_fold(checker, expr);
}

/* Whether one matrix, or one scalar, fills the whole type. */
static bool fills(struct type type, struct type arg)
{
    if (type_is_matrix(arg)) {
        return type_is_matrix(type) || type.rows <= arg.rows * arg.columns;
    }
    return type_is_scalar(arg);
}

static bool check_components(struct checker *checker, struct expr *expr)
{
    char name[TYPE_NAME_BYTES], given[LIST_BYTES];
    struct type type = expr->type;
    int want = type_components(type), have = 0;
    bool ok = true;

    for (const struct expr *arg = expr->args; arg; arg = arg->next) {
        bool whole_matrix =
            type_is_matrix(arg->type) && (expr->arg_count > 1 || type.base != BASE_FLOAT);
        ok = ok && arg->type.count == 0 && type_components(arg->type) > 0 && !whole_matrix &&
             !type_is_surface(arg->type) && have < want; /* else it would not be used at all */
        have += type_components(arg->type);
    }
    if (expr->arg_count == 1) {
        ok = ok && (fills(type, expr->args->type) || have >= want) &&
             !(type_is_matrix(type) && type_is_vector(expr->args->type) && have < want);
    } else {
        ok = ok && have >= want;
    }
    if (!ok) {
        return CHECK_FAIL(checker, expr->at, "%s cannot be made of %s", type_name(type, name),
                          list_types(expr->args, given));
    }
    return check_fold(checker, expr);
}

/* Surface(), or Surface(color): all else is the default. */
static bool check_surface(struct checker *checker, struct expr *expr)
{
    if (!check_arguments(checker, expr)) {
        return false;
    }
    if (expr->arg_count > 1) {
        return CHECK_FAIL(checker, expr->at, "Surface takes a color or nothing, not %d arguments",
                          expr->arg_count);
    }
    if (!expr->args) {
        expr->value = surface_defaults;
        return true;
    }
    return check_fit(checker, &expr->args, type_vector(BASE_FLOAT, 3), "the color") &&
           check_fold(checker, expr);
}

bool check_list(struct checker *checker, struct expr *list, struct type *type, bool unsized)
{
    if (unsized) {
        if (list->arg_count > LIMIT_CODE_ARRAY) {
            return tree_fail_limit(checker->tree, list->at, "elements of an array",
                                   LIMIT_CODE_ARRAY, "code_array");
        }
        type->count = (uint8_t)list->arg_count;
    }
    if (type_is_surface(*type)) {
        return CHECK_FAIL(checker, list->at, "{ } is no value of Surface; set its members");
    }
    list->list = false;
    list->type = *type;
    for (struct expr *arg = list->args; arg && type->count > 0; arg = arg->next) {
        if (arg->list) { /* {{1, 2}, {3, 4}} */
            arg->list = false;
            arg->type = type_element(*type);
        }
    }
    if (!check_arguments(checker, list)) {
        return false;
    }
    return type->count > 0 ? check_array(checker, list) : check_components(checker, list);
}

bool check_construct(struct checker *checker, struct expr *expr)
{
    char name[TYPE_NAME_BYTES];

    if (expr->list) {
        return CHECK_FAIL(checker, expr->at, "{ } can only be the initial value of a variable");
    }
    if (expr->type.base == BASE_VOID || type_is_handle(expr->type)) {
        return CHECK_FAIL(checker, expr->at, "no value of %s can be made",
                          type_name(expr->type, name));
    }
    if (type_is_surface(expr->type)) {
        return expr->array ? CHECK_FAIL(checker, expr->at, "there are no arrays of Surface")
                           : check_surface(checker, expr);
    }
    if (expr->array) {
        const bool unsized = !expr->a;
        if (expr->a && !check_length(checker, expr->a, &expr->type.count)) {
            return false;
        }
        expr->a = NULL;
        if (unsized && expr->arg_count == 0) {
            return CHECK_FAIL(checker, expr->at, "an array has at least one element");
        }
        return check_list(checker, expr, &expr->type, unsized);
    }
    return check_arguments(checker, expr) && check_components(checker, expr);
}

/* --- functions of ours --- */

struct match {
    struct type wanted[BUILTIN_ARGUMENTS];
    struct type result;
};

/* The shape of all arguments: their vector's, or a scalar's. */
static bool common_rows(const struct expr *args, int *out)
{
    *out = 1;
    for (; args; args = args->next) {
        struct type type = args->type;
        if (type.count > 0 || type.columns > 1 || type_components(type) == 0 ||
            (type.rows > 1 && *out > 1 && type.rows != *out)) {
            return false;
        }
        *out = type.rows > *out ? type.rows : *out;
    }
    return true;
}

/* The base of all: float if there is one, else uint if there is one. BASE_VOID: there is none. */
static enum base common_base(const struct expr *args)
{
    enum base base = BASE_INT;

    for (; args; args = args->next) {
        if (!type_is_number(args->type)) {
            return BASE_VOID;
        }
        if (args->type.base == BASE_FLOAT || base == BASE_FLOAT) {
            base = BASE_FLOAT;
        } else if (args->type.base == BASE_UINT) {
            base = BASE_UINT;
        }
    }
    return base;
}

static void want_all(struct match *match, struct type type)
{
    for (int i = 0; i < BUILTIN_ARGUMENTS; i++) {
        match->wanted[i] = type;
    }
    match->result = type;
}

/* Those that take vectors of certain lengths alone. */
static bool match_lengths(const struct builtin *row, const struct expr *args, enum base base,
                          int rows, struct match *match)
{
    switch (row->family) {
    case FAMILY_CROSS:
        want_all(match, type_vector(BASE_FLOAT, 3));
        return base != BASE_VOID && rows == 3;
    case FAMILY_PLACE:
        want_all(match, type_vector(BASE_FLOAT, 3));
        match->result.rows = 1;
        return base != BASE_VOID && rows == 3;
    case FAMILY_OCTAVES:
        want_all(match, type_vector(BASE_FLOAT, 3));
        match->wanted[1] = type_vector(BASE_INT, 1);
        match->result.rows = 1;
        return args->type.rows == 3 && args->next->type.base == BASE_INT &&
               type_is_scalar(args->next->type);
    case FAMILY_COMPARE:
    case FAMILY_EQUAL:
        base = args->type.base == BASE_BOOL && row->family == FAMILY_EQUAL ? BASE_BOOL : base;
        want_all(match, type_vector(base, rows));
        match->result.base = BASE_BOOL;
        return base != BASE_VOID && rows > 1;
    case FAMILY_OUTER:
        want_all(match, type_vector(BASE_FLOAT, rows));
        match->result = type_matrix(rows);
        return base != BASE_VOID && rows > 1 && args->type.rows == args->next->type.rows;
    case FAMILY_LOGIC:
    case FAMILY_COUNT:
        want_all(match, type_vector(BASE_BOOL, rows));
        match->result.rows = row->family == FAMILY_COUNT ? 1 : (uint8_t)rows;
        return args->type.base == BASE_BOOL && rows > 1;
    default:
        return false;
    }
}

static bool match_vectors(const struct builtin *row, const struct expr *args, struct match *match)
{
    int rows;
    const bool shape = common_rows(args, &rows);
    enum base base = common_base(args);

    if (!shape) {
        return false;
    }
    switch (row->family) {
    case FAMILY_FLOAT:
    case FAMILY_SHAPE:
        want_all(match, type_vector(BASE_FLOAT, rows));
        return base != BASE_VOID;
    case FAMILY_SIGNED:
        want_all(match, type_vector(base, rows));
        return base == BASE_FLOAT || base == BASE_INT;
    case FAMILY_NUMBER:
        want_all(match, type_vector(base, rows));
        return base != BASE_VOID;
    case FAMILY_SELECT:
        want_all(match, type_vector(BASE_FLOAT, rows));
        match->wanted[2] = type_vector(BASE_BOOL, rows);
        return args->next->next->type.base == BASE_BOOL;
    case FAMILY_TEST:
        want_all(match, type_vector(BASE_FLOAT, rows));
        match->result.base = BASE_BOOL;
        return base != BASE_VOID;
    case FAMILY_SCALAR:
        want_all(match, type_vector(BASE_FLOAT, rows));
        match->result.rows = 1;
        return base != BASE_VOID;
    case FAMILY_REFRACT:
        want_all(match, type_vector(BASE_FLOAT, rows));
        match->wanted[2].rows = 1;
        return base != BASE_VOID && type_is_scalar(args->next->next->type);
    default:
        return match_lengths(row, args, base, rows, match);
    }
}

static bool match_sizes(const struct builtin *row, const struct expr *args, struct match *match)
{
    bool fits = true;

    match->result = builtin_jet_type(row->sizes[0]);
    for (int i = 0; args; args = args->next, i++) {
        match->wanted[i] = builtin_jet_type(row->sizes[1 + i]);
        fits = fits && type_equal(args->type, match->wanted[i]);
    }
    return fits;
}

static bool match_row(const struct builtin *row, const struct expr *args, struct match *match)
{
    if (row->family == FAMILY_JET) {
        return match_sizes(row, args, match);
    }
    if (row->family == FAMILY_MATRIX || row->family == FAMILY_DETERMINANT) {
        want_all(match, args->type);
        if (row->family == FAMILY_DETERMINANT) {
            match->result = type_vector(BASE_FLOAT, 1);
        }
        return type_is_matrix(args->type);
    }
    return match_vectors(row, args, match);
}

/* mul(a, b) of HLSL, whose matrices are taken by rows where GLSL's are by columns. */
static bool check_product(struct checker *checker, struct expr *expr)
{
    struct expr *a = expr->args, *b = a->next;

    if (type_is_vector(a->type) && type_is_vector(b->type)) {
        return CHECK_FAIL(checker, expr->at, "mul of two vectors: write dot()");
    }
    expr->kind = EXPR_BINARY;
    expr->op = OP_MULTIPLY;
    expr->a = b;
    expr->b = a;
    a->next = expr->args = NULL;
    return check_operator(checker, expr, false) && check_fold(checker, expr);
}

static bool apply(struct checker *checker, struct expr *expr, const struct builtin *row,
                  const struct match *match)
{
    int i = 0;

    for (struct expr **arg = &expr->args; *arg; arg = &(*arg)->next, i++) {
        if (!check_convert(checker, arg, match->wanted[i])) {
            return false;
        }
    }
    expr->kind = EXPR_BUILTIN;
    expr->builtin = row;
    expr->type = match->result;
    return true;
}

/* Whether the arguments fit without being changed. */
static bool converts(const struct expr *args, const struct match *match)
{
    for (int i = 0; args; args = args->next, i++) {
        struct type to = match->wanted[i], from = args->type;
        const bool number = type_is_number(from) && type_is_number(to) && from.base != BASE_BOOL;
        if (!type_equal(from, to) &&
            (from.columns != to.columns || (from.rows != to.rows && from.rows > 1) ||
             (from.base != to.base && !number))) {
            return false;
        }
    }
    return true;
}

static bool check_builtin(struct checker *checker, struct expr *expr)
{
    const char *name = expr->name->text;
    char given[LIST_BYTES];
    const struct builtin *first = builtin_find(name, checker->tree->ours), *row = first;
    bool counted = false;
    int least = first->arguments, most = least;

    for (; row->name && strcmp(row->name, name) == 0; row++) {
        struct match match;
        least = row->arguments < least ? row->arguments : least;
        most = row->arguments > most ? row->arguments : most;
        if (row->arguments != expr->arg_count) {
            continue;
        }
        counted = true;
        if (row->family == FAMILY_PRODUCT) {
            return check_product(checker, expr);
        }
        if (match_row(row, expr->args, &match) && converts(expr->args, &match)) {
            return apply(checker, expr, row, &match) && check_fold(checker, expr);
        }
    }
    if (!counted) {
        char or_more[16] = "";
        if (most > least) {
            snprintf(or_more, sizeof or_more, " or %d", most);
        }
        return CHECK_FAIL(checker, expr->at, "%s takes %d%s argument%s, not %d", name, least,
                          or_more, most == 1 ? "" : "s", expr->arg_count);
    }
    return CHECK_FAIL(checker, expr->at, "%s cannot take %s", name, list_types(expr->args, given));
}

/* --- functions of the author's --- */

/* How much has to be converted; -1: it cannot be. */
static int cost_of(const struct variable *parameter, const struct expr *arg)
{
    enum { OF_BASE = 1, TO_FLOAT = 2, TO_VECTOR = 8 };
    struct type from = arg->type, to = parameter->type;
    if (type_equal(from, to)) {
        return 0;
    }
    if (parameter->direction != DIRECTION_IN || !type_is_number(from) || !type_is_number(to) ||
        from.columns != to.columns || (from.rows != to.rows && from.rows > 1) ||
        (from.base != to.base && (from.base == BASE_FLOAT || to.base == BASE_INT))) {
        return -1;
    }
    return (from.base == to.base    ? 0
            : to.base == BASE_FLOAT ? TO_FLOAT
                                    : OF_BASE) +
           (from.rows == to.rows ? 0 : TO_VECTOR);
}

static int cost_of_all(const struct function *function, const struct expr *args, int count)
{
    int cost = 0;

    if (function->parameter_count != count) {
        return -1;
    }
    for (const struct variable *p = function->parameters; p; p = p->next, args = args->next) {
        const int one = cost_of(p, args);
        if (one < 0) {
            return -1;
        }
        cost += one;
    }
    return cost;
}

static bool refuse_call(struct checker *checker, const struct expr *expr)
{
    const struct function *only = expr->name->functions;
    char given[LIST_BYTES], wanted[TYPE_NAME_BYTES], type[TYPE_NAME_BYTES];
    int number = 1;

    if (only->overload) {
        return CHECK_FAIL(checker, expr->at, "no function %.40s takes %s", expr->name->text,
                          list_types(expr->args, given));
    }
    if (only->parameter_count != expr->arg_count) {
        return CHECK_FAIL(checker, expr->at, "%.40s takes %d argument%s, not %d", expr->name->text,
                          only->parameter_count, only->parameter_count == 1 ? "" : "s",
                          expr->arg_count);
    }
    const struct expr *arg = expr->args;
    const struct variable *p = only->parameters;
    for (; cost_of(p, arg) >= 0; p = p->next, arg = arg->next) {
        number++;
    }
    return CHECK_FAIL(checker, arg->at, "argument %d of %.40s is %s, not %s", number,
                      expr->name->text, type_name(arg->type, type), type_name(p->type, wanted));
}

static bool fit_arguments(struct checker *checker, struct expr *expr)
{
    const struct variable *p = expr->function->parameters;

    for (struct expr **arg = &expr->args; *arg; arg = &(*arg)->next, p = p->next) {
        if (p->direction != DIRECTION_IN) {
            expr->effects = true;
            if (!check_place(checker, *arg)) {
                return false;
            }
        } else if (!check_fit(checker, arg, p->type, "the argument")) {
            return false;
        }
    }
    return true;
}

static bool check_function(struct checker *checker, struct expr *expr)
{
    struct function *best = NULL;
    int best_cost = -1, same = 0;

    for (struct function *f = expr->name->functions; f; f = f->overload) {
        const int cost = cost_of_all(f, expr->args, expr->arg_count);
        if (cost >= 0 && (best_cost < 0 || cost < best_cost)) {
            best = f;
            best_cost = cost;
            same = 0;
        } else if (cost >= 0 && cost == best_cost) {
            same++;
        }
    }
    if (!best) {
        return builtin_find(expr->name->text, checker->tree->ours) ? check_builtin(checker, expr)
                                                                   : refuse_call(checker, expr);
    }
    if (same > 0) {
        char given[LIST_BYTES];
        return CHECK_FAIL(checker, expr->at, "several functions %.40s fit %s", expr->name->text,
                          list_types(expr->args, given));
    }
    if (!checker->function) {
        return CHECK_FAIL(checker, expr->at, "a constant cannot be made by a function of yours");
    }
    expr->function = best;
    expr->type = best->result;
    return fit_arguments(checker, expr);
}

/* A function of this name that is defined after its use; NULL: none. */
static const struct function *find_below(const struct tree *tree, const struct name *name)
{
    for (const struct stmt *stmt = tree->top; stmt; stmt = stmt->next) {
        if (stmt->kind == STMT_FUNCTION && stmt->function->name == name) {
            return stmt->function;
        }
    }
    return NULL;
}

static bool unknown_function(struct checker *checker, const struct expr *expr)
{
    const struct function *below = find_below(checker->tree, expr->name);
    char hint[80];
    const char *name = expr->name->text, *advice = builtin_advice(name);
    struct suggestion suggestion = {.text = name};

    if (advice) {
        return CHECK_FAIL(checker, expr->at, "%.40s is not known here: %s", name, advice);
    }
    if (below) {
        return CHECK_FAIL(checker, expr->at, "%.40s is defined below, in line %d; move it up", name,
                          below->at.line);
    }
    for (const struct function *f = checker->tree->functions; f; f = f->next) {
        suggest_consider(&suggestion, f->name->text);
    }
    for (const struct builtin *row = builtin_table; row->name; row++) {
        if (row->family != FAMILY_JET) {
            suggest_consider(&suggestion, row->name);
        }
    }
    for (size_t i = 0; type_name_at(i); i++) {
        suggest_consider(&suggestion, type_name_at(i));
    }
    return CHECK_FAIL(checker, expr->at, "there is no function %.40s%s", name,
                      suggest_hint(&suggestion, hint, sizeof hint));
}

bool check_call(struct checker *checker, struct expr *expr)
{
    if (!check_arguments(checker, expr)) {
        return false;
    }
    if (expr->name->functions) {
        return check_function(checker, expr);
    }
    if (builtin_find(expr->name->text, checker->tree->ours)) {
        return check_builtin(checker, expr);
    }
    return unknown_function(checker, expr);
}
