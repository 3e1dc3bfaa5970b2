/* SPDX-License-Identifier: MIT */
/* What goes without saying between types, and what operators join. */
#include "check.h"

/* --- conversions --- */

/* Whether values of one base are those of another, too: int, uint, float, in this order. */
static bool base_fits(enum base from, enum base to)
{
    return from == to || (from == BASE_INT && (to == BASE_UINT || to == BASE_FLOAT)) ||
           (from == BASE_UINT && to == BASE_FLOAT);
}

bool check_convert(struct checker *checker, struct expr **expr, struct type to)
{
    struct expr *from = *expr;
    struct type type = from->type;

    if (type_equal(type, to)) {
        return true;
    }
    const bool shape = type.count == 0 && to.count == 0 && type.columns == to.columns &&
                       (type.rows == to.rows || type_is_scalar(type));
    if (!shape || type_components(type) == 0 || type_is_handle(to) ||
        !base_fits((enum base)type.base, (enum base)to.base)) {
        return false;
    }
    struct expr *made = tree_expr(checker->tree, EXPR_CONSTRUCT, from->at);
    made->type = to;
    made->args = from;
    made->arg_count = 1;
    made->effects = from->effects;
    made->next = from->next;
    from->next = NULL;
    *expr = made;
    return check_fold(checker, made);
}

bool check_fit(struct checker *checker, struct expr **expr, struct type to, const char *what)
{
    char wanted[TYPE_NAME_BYTES], given[TYPE_NAME_BYTES];

    if (check_convert(checker, expr, to)) {
        return true;
    }
    type_name(to, wanted);
    type_name((*expr)->type, given);
    const bool narrows = type_is_number(to) && type_is_number((*expr)->type) &&
                         to.rows == (*expr)->type.rows && to.columns == 1;
    return CHECK_FAIL(checker, (*expr)->at, "%s is %s, not %s%s%s%s", what, given, wanted,
                      narrows ? "; write " : "", narrows ? wanted : "", narrows ? "(...)" : "");
}

/* --- operators --- */

static bool refuse(struct checker *checker, const struct expr *expr)
{
    char a[TYPE_NAME_BYTES], b[TYPE_NAME_BYTES];

    return CHECK_FAIL(checker, expr->at, "%s%s cannot join %s and %s", tree_op_text(expr->op),
                      expr->kind == EXPR_ASSIGN ? "=" : "", type_name(expr->a->type, a),
                      type_name(expr->b->type, b));
}

/* Gives both the base that holds both. `shape`: and the greater of their shapes. */
static bool join_bases(struct checker *checker, struct expr *expr, bool keep, bool shape)
{
    struct type a = expr->a->type, b = expr->b->type;
    const bool to_b = !keep && base_fits((enum base)a.base, (enum base)b.base);

    if (!to_b && !base_fits((enum base)b.base, (enum base)a.base)) {
        return false;
    }
    a.base = b.base = to_b ? b.base : a.base;
    if (shape && type_is_scalar(a) && !keep) {
        a.rows = b.rows;
    } else if (shape && type_is_scalar(b)) {
        b.rows = a.rows;
    }
    return (keep || check_convert(checker, &expr->a, a)) && check_convert(checker, &expr->b, b);
}

/* The shape of a op b, component by component or, for *, as matrices. */
static bool join_shapes(enum op op, struct type a, struct type b, struct type *out)
{
    *out = a;
    if (type_equal(a, b)) {
        return true;
    }
    if (type_is_scalar(a)) {
        *out = b;
        return true;
    }
    if (type_is_scalar(b)) {
        return true;
    }
    const bool matrix_vector = type_is_matrix(a) && type_is_vector(b);
    const bool vector_matrix = type_is_vector(a) && type_is_matrix(b);
    if (op != OP_MULTIPLY || a.rows != b.rows || !(matrix_vector || vector_matrix)) {
        return false;
    }
    *out = matrix_vector ? b : a;
    return true;
}

static bool check_zero(struct checker *checker, const struct expr *expr)
{
    const double *value = expr->b->value;

    for (int i = 0; value && i < type_components(expr->b->type); i++) {
        if (value[i] == 0) {
            return CHECK_FAIL(checker, expr->at, "a division by 0");
        }
    }
    return true;
}

static bool check_arithmetic(struct checker *checker, struct expr *expr, bool keep)
{
    const bool divides = expr->op == OP_DIVIDE || expr->op == OP_REMAINDER;

    if (!type_is_number(expr->a->type) || !type_is_number(expr->b->type)) {
        return refuse(checker, expr);
    }
    if (expr->op == OP_REMAINDER &&
        (expr->a->type.base == BASE_FLOAT || expr->b->type.base == BASE_FLOAT)) {
        return CHECK_FAIL(checker, expr->at, "%% is for int; write mod(), or fmod()");
    }
    /* Helpers divide whole numbers, and want one shape. */
    const bool whole = type_is_integer(expr->a->type) && type_is_integer(expr->b->type);
    struct type kept = expr->a->type;
    if (!join_bases(checker, expr, keep, divides && whole) ||
        !join_shapes(expr->op, expr->a->type, expr->b->type, &expr->type) ||
        (keep && !type_equal(expr->type, kept))) {
        return refuse(checker, expr);
    }
    return !divides || check_zero(checker, expr);
}

static bool check_bits(struct checker *checker, struct expr *expr, bool keep)
{
    const bool shifts = expr->op == OP_SHIFT_LEFT || expr->op == OP_SHIFT_RIGHT;
    struct type a = expr->a->type, b = expr->b->type;

    if (!type_is_integer(a) || !type_is_integer(b)) {
        return refuse(checker, expr);
    }
    if (shifts) {
        expr->type = a;
        return a.rows == b.rows || b.rows == 1 || refuse(checker, expr);
    }
    if (!join_bases(checker, expr, keep, false) ||
        !join_shapes(expr->op, expr->a->type, expr->b->type, &expr->type) ||
        (keep && !type_equal(expr->type, a))) {
        return refuse(checker, expr);
    }
    return true;
}

static bool check_comparison(struct checker *checker, struct expr *expr)
{
    struct type a = expr->a->type, b = expr->b->type;
    const bool order = expr->op != OP_EQUAL && expr->op != OP_UNEQUAL;

    expr->type = type_vector(BASE_BOOL, 1);
    if (order && (type_is_vector(a) || type_is_vector(b))) {
        return CHECK_FAIL(checker, expr->at,
                          "%s compares numbers; for vectors write lessThan(), greaterThan(), ...",
                          tree_op_text(expr->op));
    }
    const bool ok = order ? type_is_number(a) && type_is_number(b) &&
                                join_bases(checker, expr, false, false) && type_is_scalar(a) &&
                                type_is_scalar(b)
                          : type_components(a) > 0 && !type_is_surface(a) && a.count == 0 &&
                                b.count == 0 && a.rows == b.rows && a.columns == b.columns &&
                                join_bases(checker, expr, false, false);
    return ok || refuse(checker, expr);
}

bool check_operator(struct checker *checker, struct expr *expr, bool keep)
{
    switch (expr->op) {
    case OP_ADD:
    case OP_SUBTRACT:
    case OP_MULTIPLY:
    case OP_DIVIDE:
    case OP_REMAINDER:
        return check_arithmetic(checker, expr, keep);
    case OP_SHIFT_LEFT:
    case OP_SHIFT_RIGHT:
    case OP_BIT_AND:
    case OP_BIT_OR:
    case OP_BIT_XOR:
        return check_bits(checker, expr, keep);
    case OP_AND:
    case OP_OR:
    case OP_XOR:
        expr->type = type_vector(BASE_BOOL, 1);
        return (type_is(expr->a->type, BASE_BOOL) && type_is(expr->b->type, BASE_BOOL)) ||
               refuse(checker, expr);
    default:
        return check_comparison(checker, expr);
    }
}
