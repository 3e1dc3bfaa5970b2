/* SPDX-License-Identifier: MIT */
/* Expressions as GLSL. */
#include <assert.h>
#include <math.h>
#include <string.h>

#include "builtins.h"
#include "writer.h"

/* --- constants --- */

/* Nine digits are enough for every float. */
static void write_float(struct code_writer *w, double number)
{
    char text[40];

    snprintf(text, sizeof text, "%.9g", number);
    const bool whole = strspn(text, "-0123456789") == strlen(text);
    PUT(w, number < 0 || signbit(number) ? "(%s%s)" : "%s%s", text, whole ? ".0" : "");
}

void writer_number(struct code_writer *w, enum base base, double number)
{
    switch (base) {
    case BASE_FLOAT:
        write_float(w, number);
        break;
    case BASE_UINT:
        PUT(w, "%.0fu", number);
        break;
    case BASE_BOOL:
        PUT(w, number != 0 ? "true" : "false");
        break;
    default:
        if (number == -2147483648.0) {
            PUT(w, "(-2147483647 - 1)");
        } else {
            PUT(w, number < 0 ? "(%.0f)" : "%.0f", number);
        }
    }
}

const char *writer_type(struct type type, char out[TYPE_NAME_BYTES])
{
    return type_is_surface(type) ? "CodeSurface" : type_name(type, out);
}

/* Members from `first` on. */
static void write_members(struct code_writer *w, int first, const double *value)
{
    for (int i = first; i < SURFACE_MEMBERS; i++) {
        const struct surface_member *member = &surface_members[i];
        PUT(w, i > 0 ? ", " : "");
        writer_constant(w, type_vector(BASE_FLOAT, member->rows), value + member->at);
    }
}

void writer_constant(struct code_writer *w, struct type type, const double *value)
{
    char name[TYPE_NAME_BYTES];
    const int count = type_components(type);

    if (type_is_surface(type)) {
        PUT(w, "CodeSurface(");
        write_members(w, 0, value);
        PUT(w, ")");
        return;
    }
    if (count == 1 && type.count == 0) {
        writer_number(w, (enum base)type.base, *value);
        return;
    }
    PUT(w, "%s(", type_name(type, name));
    struct type element = type.count > 0 ? type_element(type) : type_vector(type.base, 1);
    const int size = type_components(element);
    for (int i = 0; i < count; i += size) {
        PUT(w, i > 0 ? ", " : "");
        writer_constant(w, element, value + i);
    }
    PUT(w, ")");
}

/* --- expressions --- */

void writer_variable(struct code_writer *w, const struct variable *variable)
{
    const bool declared = variable->storage == STORAGE_DECLARED;

    PUT(w, "%s_%c%d", w->name, declared ? 'd' : 'v', variable->number);
}

static void write_value(struct code_writer *w, const struct expr *expr)
{
    const bool named = expr->kind == EXPR_VARIABLE && type_components(expr->type) > 1;

    if (named) {
        writer_variable(w, expr->variable);
    } else {
        writer_constant(w, expr->type, expr->value);
    }
}

static void write_arguments(struct code_writer *w, const struct expr *args)
{
    const char *before = "(";

    for (; args; args = args->next) {
        if (!type_is_handle(args->type)) {
            PUT(w, "%s", before);
            writer_expr(w, args);
            before = ", ";
        }
    }
    PUT(w, "%s)", *before == '(' ? "(" : "");
}

/* code_div(a, b), or (a << (b & 31)): what GLSL leaves open. */
static bool write_guarded(struct code_writer *w, const struct expr *expr)
{
    const char *mask = expr->b->type.base == BASE_UINT ? "31u" : "31";
    const bool shifts = expr->op == OP_SHIFT_LEFT || expr->op == OP_SHIFT_RIGHT;
    const bool divides = expr->op == OP_DIVIDE || expr->op == OP_REMAINDER;

    if (!type_is_integer(expr->type) || !(shifts || divides)) {
        return false;
    }
    PUT(w, shifts ? "(" : expr->op == OP_DIVIDE ? "code_div(" : "code_rem(");
    writer_expr(w, expr->a);
    PUT(w, shifts ? " %s (" : ", ", tree_op_text(expr->op));
    writer_expr(w, expr->b);
    if (shifts) {
        PUT(w, " & %s)", mask);
    }
    PUT(w, ")");
    return true;
}

static void write_joined(struct code_writer *w, const struct expr *expr, const char *op)
{
    const bool guarded = expr->op == OP_DIVIDE && !expr->b->value; /* constants are not 0 */

    PUT(w, "(");
    writer_expr(w, expr->a);
    PUT(w, " %s ", op);
    PUT(w, guarded ? "code_nonzero(" : "");
    writer_expr(w, expr->b);
    PUT(w, guarded ? "))" : ")");
}

static void write_assign(struct code_writer *w, const struct expr *expr)
{
    const bool whole = type_is_integer(expr->type);
    const bool guarded = whole && (expr->op == OP_DIVIDE || expr->op == OP_REMAINDER ||
                                   expr->op == OP_SHIFT_LEFT || expr->op == OP_SHIFT_RIGHT);
    char op[4];

    if (guarded) { /* the place has no effects of its own, so it can stand twice */
        PUT(w, "(");
        writer_expr(w, expr->a);
        PUT(w, " = ");
        write_guarded(w, expr);
        PUT(w, ")");
        return;
    }
    snprintf(op, sizeof op, "%s=", tree_op_text(expr->op));
    write_joined(w, expr, op);
}

/* Scalars have no members in all drivers. */
static void write_swizzle(struct code_writer *w, const struct expr *expr)
{
    char name[TYPE_NAME_BYTES];

    if (type_is_scalar(expr->a->type)) {
        const bool spread = expr->swizzle_count > 1;
        PUT(w, "%s(", spread ? type_name(expr->type, name) : "");
        writer_expr(w, expr->a);
        PUT(w, ")");
        return;
    }
    writer_expr(w, expr->a);
    PUT(w, ".");
    for (int i = 0; i < expr->swizzle_count; i++) {
        PUT(w, "%c", "xyzw"[expr->swizzle[i]]);
    }
}

static void write_index(struct code_writer *w, const struct expr *expr)
{
    const char *suffix = expr->b->type.base == BASE_UINT ? "u" : "";

    writer_expr(w, expr->a);
    if (expr->b->value) {
        PUT(w, "[%.0f]", *expr->b->value);
        return;
    }
    PUT(w, "[clamp(");
    writer_expr(w, expr->b);
    PUT(w, ", 0%s, %d%s)]", suffix, type_elements(expr->a->type) - 1, suffix);
}

/* Floats become whole numbers in code_int(), which knows what these hold. */
static void write_construct(struct code_writer *w, const struct expr *expr)
{
    char name[TYPE_NAME_BYTES];
    const bool whole = type_is_integer(expr->type);

    PUT(w, "%s(", writer_type(expr->type, name));
    for (const struct expr *arg = expr->args; arg; arg = arg->next) {
        const bool guarded = whole && arg->type.base == BASE_FLOAT;
        PUT(w, "%s", !guarded ? "" : expr->type.base == BASE_UINT ? "code_uint(" : "code_int(");
        writer_expr(w, arg);
        PUT(w, "%s%s", guarded ? ")" : "", arg->next ? ", " : "");
    }
    if (type_is_surface(expr->type)) {
        write_members(w, 1, surface_defaults);
    }
    PUT(w, ")");
}

static void write_builtin(struct code_writer *w, const struct expr *expr)
{
    const char *text = expr->builtin->glsl ? expr->builtin->glsl : expr->builtin->name;

    if (!strchr(text, '$')) {
        PUT(w, "%s", text);
        write_arguments(w, expr->args);
        return;
    }
    for (; *text; text++) {
        if (*text != '$') {
            PUT(w, "%c", *text);
            continue;
        }
        const struct expr *arg = expr->args;
        for (int i = *++text - '0'; i > 0; i--) {
            arg = arg->next;
        }
        writer_expr(w, arg);
    }
}

static void write_field(struct code_writer *w, const struct expr *expr)
{
    PUT(w, "%s_s.%s", w->name, expr->name->text); /* one of five names, which are ours */
}

/* What names a place or a part of one. */
static void write_place(struct code_writer *w, const struct expr *expr)
{
    switch (expr->kind) {
    case EXPR_VARIABLE:
        writer_variable(w, expr->variable);
        break;
    case EXPR_INDEX:
        write_index(w, expr);
        break;
    case EXPR_SWIZZLE:
        write_swizzle(w, expr);
        break;
    case EXPR_FIELD:
        write_field(w, expr);
        break;
    case EXPR_PART:
        writer_expr(w, expr->a);
        PUT(w, ".%s", surface_members[expr->field].name);
        break;
    case EXPR_DATA:
        PUT(w, "%s_data", w->name);
        break;
    default:
        assert(!"an expression that was checked");
    }
}

void writer_expr(struct code_writer *w, const struct expr *expr)
{
    if (expr->value) {
        write_value(w, expr);
        return;
    }
    switch (expr->kind) {
    case EXPR_UNARY:
        PUT(w, "(%s", tree_op_text(expr->op));
        writer_expr(w, expr->a);
        PUT(w, ")");
        break;
    case EXPR_STEP: {
        const char *op = expr->op == OP_ADD ? "++" : "--";
        PUT(w, "(%s", expr->postfix ? "" : op);
        writer_expr(w, expr->a);
        PUT(w, "%s)", expr->postfix ? op : "");
        break;
    }
    case EXPR_BINARY:
        if (!write_guarded(w, expr)) {
            write_joined(w, expr, tree_op_text(expr->op));
        }
        break;
    case EXPR_ASSIGN:
        write_assign(w, expr);
        break;
    case EXPR_CHOICE:
        PUT(w, "(");
        writer_expr(w, expr->a);
        PUT(w, " ? ");
        writer_expr(w, expr->b);
        PUT(w, " : ");
        writer_expr(w, expr->c);
        PUT(w, ")");
        break;
    case EXPR_COMMA:
        write_joined(w, expr, ",");
        break;
    case EXPR_CALL:
        PUT(w, "%s_f%d", w->name, expr->function->number);
        write_arguments(w, expr->args);
        break;
    case EXPR_BUILTIN:
        write_builtin(w, expr);
        break;
    case EXPR_CONSTRUCT:
        write_construct(w, expr);
        break;
    default:
        write_place(w, expr);
    }
}
