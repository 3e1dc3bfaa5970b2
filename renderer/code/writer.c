/* SPDX-License-Identifier: MIT */
/* All names begin with that of the whole, which nothing else does: NAME_f2 is function 2, NAME_v3
 * variable 3, NAME_n3 the counter of its loop, NAME_d4 declared parameter 4. */
#include "writer.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "builtins.h"

struct writer {
    FILE *out;
    const struct tree *tree;
    const char *name;
    int source;
    int line; /* of the author's text, that the driver takes the current one for; 0: unknown */
};

static void write_expr(struct writer *w, const struct expr *expr);
static void write_statement(struct writer *w, const struct stmt *stmt);

#define PUT(w, ...) fprintf((w)->out, __VA_ARGS__)

static void end_line(struct writer *w)
{
    PUT(w, "\n");
    w->line += w->line > 0;
}

static void begin_line(struct writer *w, struct at at)
{
    if (w->line != at.line && at.line > 0) {
        PUT(w, "#line %d %d\n", at.line, w->source);
        w->line = at.line;
    }
}

/* --- constants --- */

/* Nine digits are enough for every float. */
static void write_float(struct writer *w, double number)
{
    char text[40];
    snprintf(text, sizeof text, "%.9g", number);
    bool whole = strspn(text, "-0123456789") == strlen(text);
    PUT(w, number < 0 || signbit(number) ? "(%s%s)" : "%s%s", text, whole ? ".0" : "");
}

static void write_number(struct writer *w, enum base base, double number)
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

static void write_constant(struct writer *w, struct type type, const double *value)
{
    char name[TYPE_NAME_BYTES];
    int count = type_components(type);
    if (count == 1 && type.count == 0) {
        write_number(w, (enum base)type.base, *value);
        return;
    }
    PUT(w, "%s(", type_name(type, name));
    struct type element = type.count > 0 ? type_element(type) : type_vector(type.base, 1);
    int size = type_components(element);
    for (int i = 0; i < count; i += size) {
        PUT(w, i > 0 ? ", " : "");
        write_constant(w, element, value + i);
    }
    PUT(w, ")");
}

/* --- expressions --- */

static void write_variable(struct writer *w, const struct variable *variable)
{
    bool declared = variable->storage == STORAGE_DECLARED;
    PUT(w, "%s_%c%d", w->name, declared ? 'd' : 'v', variable->number);
}

static void write_value(struct writer *w, const struct expr *expr)
{
    bool named = expr->kind == EXPR_VARIABLE && type_components(expr->type) > 1;
    if (named) {
        write_variable(w, expr->variable);
    } else {
        write_constant(w, expr->type, expr->value);
    }
}

static void write_arguments(struct writer *w, const struct expr *args)
{
    const char *before = "(";
    for (; args; args = args->next) {
        if (!type_is_handle(args->type)) {
            PUT(w, "%s", before);
            write_expr(w, args);
            before = ", ";
        }
    }
    PUT(w, "%s)", *before == '(' ? "(" : "");
}

/* code_div(a, b), or (a << (b & 31)): what GLSL leaves open. */
static bool write_guarded(struct writer *w, const struct expr *expr)
{
    const char *mask = expr->b->type.base == BASE_UINT ? "31u" : "31";
    bool shifts = expr->op == OP_SHIFT_LEFT || expr->op == OP_SHIFT_RIGHT;
    bool divides = expr->op == OP_DIVIDE || expr->op == OP_REMAINDER;
    if (!type_is_integer(expr->type) || !(shifts || divides)) {
        return false;
    }
    PUT(w, shifts ? "(" : expr->op == OP_DIVIDE ? "code_div(" : "code_rem(");
    write_expr(w, expr->a);
    PUT(w, shifts ? " %s (" : ", ", tree_op_text(expr->op));
    write_expr(w, expr->b);
    if (shifts) {
        PUT(w, " & %s)", mask);
    }
    PUT(w, ")");
    return true;
}

static void write_joined(struct writer *w, const struct expr *expr, const char *op)
{
    PUT(w, "(");
    write_expr(w, expr->a);
    PUT(w, " %s ", op);
    write_expr(w, expr->b);
    PUT(w, ")");
}

static void write_assign(struct writer *w, const struct expr *expr)
{
    bool whole = type_is_integer(expr->type);
    bool guarded = whole && (expr->op == OP_DIVIDE || expr->op == OP_REMAINDER ||
                             expr->op == OP_SHIFT_LEFT || expr->op == OP_SHIFT_RIGHT);
    char op[4];
    if (guarded) { /* the place has no effects of its own, so it can stand twice */
        PUT(w, "(");
        write_expr(w, expr->a);
        PUT(w, " = ");
        write_guarded(w, expr);
        PUT(w, ")");
        return;
    }
    snprintf(op, sizeof op, "%s=", tree_op_text(expr->op));
    write_joined(w, expr, op);
}

/* Scalars have no members in all drivers. */
static void write_swizzle(struct writer *w, const struct expr *expr)
{
    char name[TYPE_NAME_BYTES];
    if (type_is_scalar(expr->a->type)) {
        bool spread = expr->swizzle_count > 1;
        PUT(w, "%s(", spread ? type_name(expr->type, name) : "");
        write_expr(w, expr->a);
        PUT(w, ")");
        return;
    }
    write_expr(w, expr->a);
    PUT(w, ".");
    for (int i = 0; i < expr->swizzle_count; i++) {
        PUT(w, "%c", "xyzw"[expr->swizzle[i]]);
    }
}

static void write_index(struct writer *w, const struct expr *expr)
{
    const char *suffix = expr->b->type.base == BASE_UINT ? "u" : "";
    write_expr(w, expr->a);
    if (expr->b->value) {
        PUT(w, "[%.0f]", *expr->b->value);
        return;
    }
    PUT(w, "[clamp(");
    write_expr(w, expr->b);
    PUT(w, ", 0%s, %d%s)]", suffix, type_elements(expr->a->type) - 1, suffix);
}

/* Floats become whole numbers in code_int(), which knows what these hold. */
static void write_construct(struct writer *w, const struct expr *expr)
{
    char name[TYPE_NAME_BYTES];
    bool whole = type_is_integer(expr->type);
    PUT(w, "%s(", type_name(expr->type, name));
    for (const struct expr *arg = expr->args; arg; arg = arg->next) {
        bool guarded = whole && arg->type.base == BASE_FLOAT;
        PUT(w, "%s", !guarded ? "" : expr->type.base == BASE_UINT ? "code_uint(" : "code_int(");
        write_expr(w, arg);
        PUT(w, "%s%s", guarded ? ")" : "", arg->next ? ", " : "");
    }
    PUT(w, ")");
}

static void write_builtin(struct writer *w, const struct expr *expr)
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
        write_expr(w, arg);
    }
}

static void write_field(struct writer *w, const struct expr *expr)
{
    PUT(w, "%s_s.%s", w->name, expr->name->text); /* one of five names, which are ours */
}

static void write_expr(struct writer *w, const struct expr *expr)
{
    if (expr->value) {
        write_value(w, expr);
        return;
    }
    switch (expr->kind) {
    case EXPR_VARIABLE:
        write_variable(w, expr->variable);
        break;
    case EXPR_UNARY:
        PUT(w, "(%s", tree_op_text(expr->op));
        write_expr(w, expr->a);
        PUT(w, ")");
        break;
    case EXPR_STEP: {
        const char *op = expr->op == OP_ADD ? "++" : "--";
        PUT(w, "(%s", expr->postfix ? "" : op);
        write_expr(w, expr->a);
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
        write_expr(w, expr->a);
        PUT(w, " ? ");
        write_expr(w, expr->b);
        PUT(w, " : ");
        write_expr(w, expr->c);
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
    case EXPR_INDEX:
        write_index(w, expr);
        break;
    case EXPR_SWIZZLE:
        write_swizzle(w, expr);
        break;
    case EXPR_FIELD:
        write_field(w, expr);
        break;
    case EXPR_DATA:
        PUT(w, "%s_data", w->name);
        break;
    default:
        assert(!"an expression that was checked");
    }
}

/* --- statements --- */

/* "vec3 NAME_v2", "float NAME_v3[4]" */
static void write_declared(struct writer *w, const struct variable *variable)
{
    char name[TYPE_NAME_BYTES];
    PUT(w, "%s ", type_name(variable->type, name));
    write_variable(w, variable);
}

static void write_nothing(struct writer *w, struct type type)
{
    static const double zeros[LIMIT_CODE_ARRAY * 16];
    PUT(w, " = ");
    write_constant(w, type, zeros);
    PUT(w, ";");
    end_line(w);
}

static void write_declaration(struct writer *w, const struct stmt *stmt)
{
    begin_line(w, stmt->at);
    write_declared(w, stmt->variable);
    if (!stmt->expr) {
        write_nothing(w, stmt->variable->type);
        return;
    }
    PUT(w, " = ");
    write_expr(w, stmt->expr);
    PUT(w, ";");
    end_line(w);
}

/* The body, in braces of its own, as it may be one declaration. */
static void write_body(struct writer *w, const struct stmt *stmt)
{
    PUT(w, "{");
    end_line(w);
    write_statement(w, stmt);
    PUT(w, "}");
    end_line(w);
}

static void write_if(struct writer *w, const struct stmt *stmt)
{
    begin_line(w, stmt->at);
    PUT(w, "if (");
    write_expr(w, stmt->expr);
    PUT(w, ") ");
    write_body(w, stmt->body);
    if (stmt->other) {
        PUT(w, "else ");
        write_body(w, stmt->other);
    }
}

static void write_for(struct writer *w, const struct stmt *stmt)
{
    const struct variable *variable = stmt->variable;
    char name[TYPE_NAME_BYTES];
    int n = variable->number;
    type_name(variable->type, name);
    begin_line(w, stmt->at);
    PUT(w, "for (int %s_n%d = 0; %s_n%d < %d; %s_n%d++) {", w->name, n, w->name, n, stmt->trips,
        w->name, n);
    end_line(w);
    begin_line(w, stmt->at);
    PUT(w, "%s %s_v%d = ", name, w->name, n);
    write_number(w, (enum base)variable->type.base, stmt->start);
    PUT(w, " + %s(%s_n%d) * ", name, w->name, n);
    write_number(w, (enum base)variable->type.base,
                 variable->type.base == BASE_UINT && stmt->step < 0 ? stmt->step + 4294967296.0
                                                                    : stmt->step);
    PUT(w, ";");
    end_line(w);
    write_statement(w, stmt->body);
    PUT(w, "}");
    end_line(w);
}

static void write_simple(struct writer *w, const char *word, const struct stmt *stmt)
{
    begin_line(w, stmt->at);
    PUT(w, "%s", word);
    if (stmt->expr) {
        PUT(w, "%s", *word ? " " : "");
        write_expr(w, stmt->expr);
    }
    PUT(w, ";");
    end_line(w);
}

static void write_list(struct writer *w, const struct stmt *list)
{
    for (; list; list = list->next) {
        write_statement(w, list);
    }
}

static void write_statement(struct writer *w, const struct stmt *stmt)
{
    switch (stmt->kind) {
    case STMT_BLOCK:
        PUT(w, "{");
        end_line(w);
        write_list(w, stmt->body);
        PUT(w, "}");
        end_line(w);
        break;
    case STMT_DECLARE:
        write_list(w, stmt->body);
        if (stmt->variable) {
            write_declaration(w, stmt);
        }
        break;
    case STMT_EXPR:
        write_simple(w, "", stmt);
        break;
    case STMT_IF:
        write_if(w, stmt);
        break;
    case STMT_FOR:
        write_for(w, stmt);
        break;
    case STMT_RETURN:
        write_simple(w, "return", stmt);
        break;
    case STMT_BREAK:
        write_simple(w, "break", stmt);
        break;
    case STMT_CONTINUE:
        write_simple(w, "continue", stmt);
        break;
    case STMT_EMPTY:
    case STMT_FUNCTION:
        break;
    }
}

/* --- functions and what they read --- */

static void write_parameters(struct writer *w, const struct function *function)
{
    static const char *const directions[] = {"", "out ", "inout "};
    const char *before = "(";
    for (const struct variable *p = function->parameters; p; p = p->next) {
        if (!type_is_handle(p->type)) {
            PUT(w, "%s%s", before, directions[p->direction]);
            write_declared(w, p);
            before = ", ";
        }
    }
    PUT(w, "%s)", *before == '(' ? "(" : "");
}

static void write_function(struct writer *w, const struct function *function)
{
    char name[TYPE_NAME_BYTES];
    begin_line(w, function->at);
    PUT(w, "%s %s_f%d", type_name(function->result, name), w->name, function->number);
    write_parameters(w, function);
    PUT(w, " {");
    end_line(w);
    for (const struct variable *p = function->parameters; p; p = p->next) {
        if (p->direction == DIRECTION_OUT) {
            begin_line(w, function->at);
            write_variable(w, p);
            write_nothing(w, p->type);
        }
    }
    write_statement(w, function->body);
    PUT(w, "}");
    end_line(w);
}

/* Constants that are not written where they are used, for being several numbers. */
static void write_globals(struct writer *w)
{
    for (const struct stmt *stmt = w->tree->top; stmt; stmt = stmt->next) {
        for (const struct stmt *one = stmt->body; one; one = one->next) {
            const struct variable *variable = one->variable;
            if (stmt->kind == STMT_DECLARE && variable->used && variable->value &&
                type_components(variable->type) > 1) {
                begin_line(w, one->at);
                PUT(w, "const ");
                write_declared(w, variable);
                PUT(w, " = ");
                write_constant(w, variable->type, variable->value);
                PUT(w, ";");
                end_line(w);
            }
        }
    }
}

/* What every function can read, set by the last one. */
static void write_inputs(struct writer *w)
{
    const struct tree *tree = w->tree;
    char name[TYPE_NAME_BYTES];
    for (const struct variable *v = tree->declared; v; v = v->next) {
        if (v->used) {
            PUT(w, "%s %s_d%d;\n", type_name(v->type, name), w->name, v->number);
        }
    }
    if (tree->data_used) {
        PUT(w, "float %s_data[%d];\n", w->name, tree->data_count);
    }
    if (tree->shading_used) {
        PUT(w, "Shading %s_s;\n", w->name);
    }
}

/* The argument as what the code takes it for. */
static void write_input(struct writer *w, const struct variable *v)
{
    int n = v->number;
    PUT(w, "%s_d%d = ", w->name, n);
    switch (v->type.base) {
    case BASE_INT:
        PUT(w, "int(floor(a%d + 0.5));\n", n);
        break;
    case BASE_BOOL:
        PUT(w, "a%d != 0.0;\n", n);
        break;
    default:
        PUT(w, "a%d;\n", n);
    }
}

static void write_data(struct writer *w)
{
    const struct tree *tree = w->tree;
    int next = 0;
    for (const struct variable *v = tree->declared; v; v = v->next) {
        for (int i = 0; i < v->type.rows; i++) {
            PUT(w, "%s_data[%d] = a%d", w->name, next++, v->number);
            PUT(w, v->type.rows > 1 ? ".%c;\n" : ";\n", "xyzw"[i]);
        }
    }
    while (next < tree->data_count) {
        PUT(w, "%s_data[%d] = 0.0;\n", w->name, next++);
    }
}

static void write_entry(struct writer *w, enum code_use use)
{
    const struct tree *tree = w->tree;
    bool shade = use == CODE_SHADE;
    PUT(w, "%s %s(%s", shade ? "vec4" : "float", w->name, shade ? "Shading s" : "vec3 p");
    for (const struct variable *v = tree->declared; v; v = v->next) {
        char name[TYPE_NAME_BYTES];
        PUT(w, ", %s a%d", type_name(type_vector(BASE_FLOAT, v->type.rows), name), v->number);
    }
    PUT(w, ")\n{\n");
    for (const struct variable *v = tree->declared; v; v = v->next) {
        if (v->used) {
            write_input(w, v);
        }
    }
    if (tree->data_used) {
        write_data(w);
    }
    if (tree->shading_used) {
        PUT(w, "%s_s = s;\n", w->name);
    }
    int entry = tree->entry->number;
    if (!shade) {
        PUT(w, "return code_distance(%s_f%d(p));\n}\n", w->name, entry);
    } else if (tree->entry->result.rows == 3) {
        PUT(w, "return code_color(vec4(%s_f%d(), 1.0));\n}\n", w->name, entry);
    } else {
        PUT(w, "return code_color(%s_f%d());\n}\n", w->name, entry);
    }
}

void writer_write(const struct tree *tree, enum code_use use, const char *name, int source_number,
                  FILE *out)
{
    struct writer w = {.out = out, .tree = tree, .name = name, .source = source_number};
    write_inputs(&w);
    write_globals(&w);
    for (const struct function *f = tree->called; f; f = f->next_called) {
        if (f->reachable) {
            write_function(&w, f);
        }
    }
    write_entry(&w, use);
}
