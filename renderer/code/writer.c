/* SPDX-License-Identifier: MIT */
/* Statements and functions as GLSL. */
#include "writer.h"

static void write_statement(struct code_writer *w, const struct stmt *stmt);

static void end_line(struct code_writer *w)
{
    PUT(w, "\n");
    w->line += w->line > 0;
}

static void begin_line(struct code_writer *w, struct at at)
{
    if (w->line != at.line && at.line > 0) {
        PUT(w, "#line %d %d\n", at.line, w->source);
        w->line = at.line;
    }
}

/* --- statements --- */

/* "vec3 NAME_v2", "float NAME_v3[4]" */
static void write_declared(struct code_writer *w, const struct variable *variable)
{
    char name[TYPE_NAME_BYTES];

    PUT(w, "%s ", writer_type(variable->type, name));
    writer_variable(w, variable);
}

static void write_nothing(struct code_writer *w, struct type type)
{
    static const double zeros[LIMIT_CODE_ARRAY * 16];

    PUT(w, " = ");
    writer_constant(w, type, type_is_surface(type) ? surface_defaults : zeros);
    PUT(w, ";");
    end_line(w);
}

static void write_declaration(struct code_writer *w, const struct stmt *stmt)
{
    begin_line(w, stmt->at);
    write_declared(w, stmt->variable);
    if (!stmt->expr) {
        write_nothing(w, stmt->variable->type);
        return;
    }
    PUT(w, " = ");
    writer_expr(w, stmt->expr);
    PUT(w, ";");
    end_line(w);
}

/* The body, in braces of its own, as it may be one declaration. */
static void write_body(struct code_writer *w, const struct stmt *stmt)
{
    PUT(w, "{");
    end_line(w);
    write_statement(w, stmt);
    PUT(w, "}");
    end_line(w);
}

static void write_if(struct code_writer *w, const struct stmt *stmt)
{
    begin_line(w, stmt->at);
    PUT(w, "if (");
    writer_expr(w, stmt->expr);
    PUT(w, ") ");
    write_body(w, stmt->body);
    if (stmt->other) {
        PUT(w, "else ");
        write_body(w, stmt->other);
    }
}

static void write_for(struct code_writer *w, const struct stmt *stmt)
{
    const struct variable *variable = stmt->variable;
    char name[TYPE_NAME_BYTES];
    const int n = variable->number;

    type_name(variable->type, name);
    begin_line(w, stmt->at);
    /* zero of glsl/frame.glsl: drivers write out loops from a constant on, and take long for it. */
    PUT(w, "for (int %s_n%d = zero; %s_n%d < %d; %s_n%d++) {", w->name, n, w->name, n, stmt->trips,
        w->name, n);
    end_line(w);
    begin_line(w, stmt->at);
    PUT(w, "%s %s_v%d = ", name, w->name, n);
    writer_number(w, (enum base)variable->type.base, stmt->start);
    PUT(w, " + %s(%s_n%d) * ", name, w->name, n);
    writer_number(w, (enum base)variable->type.base,
                  variable->type.base == BASE_UINT && stmt->step < 0 ? stmt->step + 4294967296.0
                                                                     : stmt->step);
    PUT(w, ";");
    end_line(w);
    write_statement(w, stmt->body);
    PUT(w, "}");
    end_line(w);
}

static void write_simple(struct code_writer *w, const char *word, const struct stmt *stmt)
{
    begin_line(w, stmt->at);
    PUT(w, "%s", word);
    if (stmt->expr) {
        PUT(w, "%s", *word ? " " : "");
        writer_expr(w, stmt->expr);
    }
    PUT(w, ";");
    end_line(w);
}

static void write_list(struct code_writer *w, const struct stmt *list)
{
    for (; list; list = list->next) {
        write_statement(w, list);
    }
}

static void write_statement(struct code_writer *w, const struct stmt *stmt)
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

static void write_parameters(struct code_writer *w, const struct function *function)
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

static void write_function(struct code_writer *w, const struct function *function)
{
    char name[TYPE_NAME_BYTES];

    begin_line(w, function->at);
    PUT(w, "%s %s_f%d", writer_type(function->result, name), w->name, function->number);
    write_parameters(w, function);
    PUT(w, " {");
    end_line(w);
    for (const struct variable *p = function->parameters; p; p = p->next) {
        if (p->direction == DIRECTION_OUT) {
            begin_line(w, function->at);
            writer_variable(w, p);
            write_nothing(w, p->type);
        }
    }
    write_statement(w, function->body);
    PUT(w, "}");
    end_line(w);
}

/* Constants that are not written where they are used, for being several numbers. */
static void write_globals(struct code_writer *w)
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
                writer_constant(w, variable->type, variable->value);
                PUT(w, ";");
                end_line(w);
            }
        }
    }
}

/* What every function can read, set by the last one. */
static void write_inputs(struct code_writer *w)
{
    const struct tree *tree = w->tree;
    char name[TYPE_NAME_BYTES];

    for (const struct variable *v = tree->declared; v; v = v->next) {
        if (v->used) {
            /* A value, though it gets another: else drivers warn of each use. */
            type_name(v->type, name);
            PUT(w, "%s %s_d%d = %s(0);\n", name, w->name, v->number, name);
        }
    }
    if (tree->data_used) {
        PUT(w, "float %s_data[%d];\n", w->name, tree->data_count);
    }
    if (tree->shading_used) {
        PUT(w, "Shading %s_s = Shading(vec3(0), vec3(0), vec3(0), vec3(0), 0.0);\n", w->name);
    }
}

/* The argument as what the code takes it for. */
static void write_input(struct code_writer *w, const struct variable *v)
{
    const int n = v->number;
    char name[TYPE_NAME_BYTES];

    PUT(w, "%s_d%d = ", w->name, n);
    switch (v->type.base) {
    case BASE_INT:
        PUT(w, "%s(floor(a%d + 0.5));\n", type_name(v->type, name), n);
        break;
    case BASE_BOOL:
        PUT(w, "a%d != 0.0;\n", n);
        break;
    default:
        PUT(w, "a%d;\n", n);
    }
}

static void write_data(struct code_writer *w)
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

static void write_entry(struct code_writer *w, enum code_use use)
{
    const struct tree *tree = w->tree;
    const bool shade = use == CODE_SHADE, surface = shade && type_is_surface(tree->entry->result);

    PUT(w, "%s %s(%s",
        surface ? "CodeSurface"
        : shade ? "vec4"
                : "float",
        w->name, shade ? "Shading s" : "vec3 p");
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
    const int entry = tree->entry->number;
    if (surface) {
        PUT(w, "return code_surface(%s_f%d());\n}\n", w->name, entry);
    } else if (!shade) {
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
    struct code_writer w = {.out = out, .tree = tree, .name = name, .source = source_number};

    write_inputs(&w);
    write_globals(&w);
    for (const struct function *f = tree->called; f; f = f->next_called) {
        if (f->reachable) {
            write_function(&w, f);
        }
    }
    write_entry(&w, use);
}
