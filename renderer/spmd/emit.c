/* SPDX-License-Identifier: MIT */
/* Functions and statements. */
#include "emit.h"

#include <string.h>

/* --- functions --- */

const char *emit_function_name(struct emit *e, const struct function *function)
{
    int before = 0;

    for (const struct function *f = function->overload; f; f = f->overload) {
        before++;
    }
    return before ? emit_text(e, "lanes_%s_%d", function->name->text, before + 1)
                  : emit_text(e, "lanes_%s", function->name->text);
}

static void head_parameter(struct emit *e, const struct variable *p)
{
    struct variable named = *p;
    struct name unnamed = {.text = "unnamed"};

    named.name = p->name ? p->name : &unnamed;
    struct value value = emit_variable(e, &named);
    for (int i = 0; i < value.count; i++) {
        const struct component x = value.at[i];
        if (p->direction == DIRECTION_IN) {
            fprintf(e->out, ", %s%s%s%s", p->type.count > 0 ? "const " : "",
                    emit_type(x.base, x.varying), p->type.count > 0 ? " *" : " ", x.text);
        } else {
            fprintf(e->out, ", %s *to_%s", emit_type(x.base, true), x.text);
        }
    }
}

void emit_head(struct emit *e, const struct function *function, const char *end)
{
    const struct type result = function->result;
    const int count = spmd_components(e->tree, result);

    fprintf(e->out, "static inline %s %s(struct lanes *c, vb m",
            count == 1 ? emit_type(spmd_base(e->tree, result, 0), function->varying) : "void",
            emit_function_name(e, function));
    for (const struct variable *p = function->parameters; p; p = p->next) {
        head_parameter(e, p);
    }
    for (int i = 0; count > 1 && i < count; i++) {
        fprintf(e->out, ", %s *result_%d",
                emit_type(spmd_base(e->tree, result, i), function->varying), i);
    }
    fprintf(e->out, ")%s\n", end);
}

/* Parameters that go out are variables until the end. */
static void copy_parameters(struct emit *e, const struct function *function, bool out)
{
    for (const struct variable *p = function->parameters; p; p = p->next) {
        if (p->direction == DIRECTION_IN) {
            continue;
        }
        struct value value = emit_variable(e, p);
        for (int i = 0; i < value.count; i++) {
            const struct component x = value.at[i];
            if (out) {
                emit_line(e, "*to_%s = %s;", x.text, x.text);
            } else {
                emit_line(e, "%s %s = *to_%s;", emit_type(x.base, true), x.text, x.text);
            }
        }
    }
}

static void emit_function(struct emit *e, struct function *function)
{
    const int count = spmd_components(e->tree, function->result);

    e->function = function;
    e->scope = function->scope;
    e->temps = 0;
    emit_head(e, function, "");
    emit_line(e, "{\n(void)c, (void)m;");
    copy_parameters(e, function, false);
    for (int i = 0; i < count; i++) {
        const enum base base = spmd_base(e->tree, function->result, i);
        emit_line(e, "%s r_%d = %s;", emit_type(base, function->varying), i,
                  function->varying ? emit_text(e, "v%c_zero", emit_letter(base)) : "0");
    }
    emit_statement(e, function->body);
    emit_line(e, "out: __attribute__((unused));");
    copy_parameters(e, function, true);
    if (count == 1) {
        emit_line(e, "return r_0;");
    }
    for (int i = 0; count > 1 && i < count; i++) {
        emit_line(e, "*result_%d = r_%d;", i, i);
    }
    emit_line(e, "}\n");
}

/* --- statements --- */

static void emit_list(struct emit *e, struct stmt *stmt)
{
    for (; stmt; stmt = stmt->next) {
        emit_statement(e, stmt);
    }
}

static void emit_declaration(struct emit *e, struct stmt *stmt)
{
    struct variable *variable = stmt->variable;

    if (!variable) {
        emit_list(e, stmt->body);
        return;
    }
    struct value value = stmt->expr ? emit_value(e, stmt->expr) : (struct value){0};
    struct value names = emit_variable(e, variable);
    for (int i = 0; i < names.count; i++) {
        const struct component x = names.at[i];
        if (variable->type.count > 0) {
            emit_line(e, "%s %s[%d];", emit_type(x.base, x.varying), x.text, variable->type.count);
        } else if (stmt->expr) {
            struct component from = emit_convert(e, emit_value_at(&value, i), x.base);
            from = x.varying ? emit_spread(e, from) : from;
            emit_line(e, "%s %s = %s;", emit_type(x.base, x.varying), x.text, from.text);
        } else {
            emit_line(e, "%s %s = %s;", emit_type(x.base, x.varying), x.text,
                      x.varying ? emit_text(e, "v%c_zero", emit_letter(x.base)) : "0");
        }
    }
}

/* One side of a branch that lanes take differently; `mask` holds those that are left after it. */
static void emit_side(struct emit *e, struct stmt *stmt, const char *mask, int scope)
{
    const int before = e->scope;

    e->scope = scope;
    emit_line(e, "if (lanes_any(%s)) {\nvb m = %s;", mask, mask);
    emit_statement(e, stmt);
    emit_line(e, "%s = m;\n}", mask);
    e->scope = before;
}

static void emit_if(struct emit *e, struct stmt *stmt)
{
    const struct component condition = emit_value(e, stmt->expr).at[0];

    if (!stmt->varying) {
        emit_line(e, "if (%s) {", condition.text);
        emit_statement(e, stmt->body);
        if (stmt->other) {
            emit_line(e, "} else {");
            emit_statement(e, stmt->other);
        }
        emit_line(e, "}");
        return;
    }
    const int label = e->labels++;
    const char *mask = emit_spread(e, condition).text;
    emit_line(e, "vb yes_%d = m & %s, no_%d = m & ~%s;", label, mask, label, mask);
    emit_side(e, stmt->body, emit_text(e, "yes_%d", label), stmt->scope);
    if (stmt->other) {
        emit_side(e, stmt->other, emit_text(e, "no_%d", label), stmt->other_scope);
    }
    emit_line(e, "m = yes_%d | no_%d;", label, label);
}

/* `gone` are lanes that left the loop and go on behind it, `again` those that wait for the next
 * round. */
static void emit_for(struct emit *e, struct stmt *stmt)
{
    const struct emit outer = *e;
    const int label = e->labels++;

    e->loop = label;
    e->loop_varying = stmt->varying;
    if (stmt->varying) {
        e->scope = stmt->scope;
        emit_line(e, "vb gone_%d = vb_zero;\n{\nvb m_%d = m;", label, label);
        emit_line(e, "{\nvb m = m_%d;", label);
    } else {
        emit_line(e, "{");
    }
    emit_statement(e, stmt->other);
    emit_line(e, "for (;;) {");
    if (stmt->expr) {
        const struct component condition = emit_value(e, stmt->expr).at[0];
        if (condition.varying) {
            emit_line(e, "gone_%d |= m & ~%s;\nm &= %s;\nif (!lanes_any(m)) { break; }", label,
                      condition.text, condition.text);
        } else if (stmt->varying) {
            emit_line(e, "if (!%s) { gone_%d |= m; break; }", condition.text, label);
        } else {
            emit_line(e, "if (!%s) { break; }", condition.text);
        }
    }
    if (stmt->varying) {
        emit_line(e, "vb again_%d = vb_zero;", label);
    }
    emit_line(e, "{");
    emit_statement(e, stmt->body);
    emit_line(e, "}\nnext_%d: __attribute__((unused));", label);
    if (stmt->varying) {
        emit_line(e, "m |= again_%d;\nif (!lanes_any(m)) { break; }", label);
    }
    if (stmt->advance) {
        emit_value(e, stmt->advance);
    }
    if (stmt->varying) {
        emit_line(e, "}\n}\n}\nm = gone_%d;", label);
    } else {
        emit_line(e, "}\n}");
    }
    e->loop = outer.loop;
    e->loop_varying = outer.loop_varying;
    e->scope = outer.scope;
}

/* All lanes here leave the loop, or its round. */
static void emit_leave(struct emit *e, const struct stmt *stmt)
{
    const bool ends = stmt->kind == STMT_BREAK;
    const char *kept = ends ? "gone" : "again";

    if (e->loop_varying) {
        emit_line(e, "%s_%d |= m;\nm = vb_zero;", kept, e->loop);
    }
    if (!stmt->varying && ends) {
        emit_line(e, "break;");
    } else if (!stmt->varying) {
        emit_line(e, "goto next_%d;", e->loop);
    }
}

static void emit_return(struct emit *e, struct stmt *stmt)
{
    const struct function *f = e->function;
    struct value value = stmt->expr ? emit_value(e, stmt->expr) : (struct value){0};

    for (int i = 0; i < spmd_components(e->tree, f->result) && stmt->expr; i++) {
        const enum base base = spmd_base(e->tree, f->result, i);
        struct component x = emit_convert(e, emit_value_at(&value, i), base);
        x = f->varying ? emit_spread(e, x) : x;
        if (f->leaves) {
            emit_line(e, "r_%d = v%c_select(m, %s, r_%d);", i, emit_letter(base), x.text, i);
        } else {
            emit_line(e, "r_%d = %s;", i, x.text);
        }
    }
    emit_line(e, stmt->varying ? "m = vb_zero;" : "goto out;");
}

void emit_statement(struct emit *e, struct stmt *stmt)
{
    switch (stmt->kind) {
    case STMT_BLOCK:
        emit_line(e, "{");
        emit_list(e, stmt->body);
        emit_line(e, "}");
        break;
    case STMT_DECLARE:
        emit_declaration(e, stmt);
        break;
    case STMT_EXPR:
        emit_value(e, stmt->expr);
        break;
    case STMT_IF:
        emit_if(e, stmt);
        break;
    case STMT_FOR:
        emit_for(e, stmt);
        break;
    case STMT_RETURN:
        emit_return(e, stmt);
        break;
    case STMT_BREAK:
    case STMT_CONTINUE:
        emit_leave(e, stmt);
        break;
    default:
        break;
    }
}

/* What functions are handed: what the caller adds, and variables outside of functions. */
static void emit_globals(struct emit *e)
{
    emit_line(e, "struct lanes {\nLANES_CONTEXT");
    for (const struct stmt *stmt = e->tree->top; stmt; stmt = stmt->next) {
        for (const struct stmt *one = stmt->kind == STMT_DECLARE ? stmt->body : NULL; one;
             one = one->next) {
            const struct variable *v = one->variable;
            const int count = v->read_only ? 0 : spmd_components(e->tree, v->type);
            for (int i = 0; i < count; i++) {
                const char *type = emit_type(spmd_base(e->tree, v->type, i), true);
                const char *length = v->type.count ? emit_text(e, "[%d]", v->type.count) : "";
                emit_line(e, "%s %s_%d%s;", type, v->name->text, i, length);
            }
        }
    }
    emit_line(e, "};\n");
}

static struct emit begin(struct tree *tree, const char *const *entries, size_t count, FILE *out)
{
    return (struct emit){
        .tree = tree, .out = out, .entries = entries, .entry_count = count, .ok = true};
}

bool spmd_emit(struct tree *tree, const char *const *entries, size_t count, FILE *out)
{
    struct emit e = begin(tree, entries, count, out);

    for (struct function *f = tree->called; f && e.ok; f = f->next_called) {
        if (f->body) {
            emit_function(&e, f);
        }
        emit_door(&e, f);
    }
    return e.ok;
}

/* How many components each struct has, in the order of its members. */
static void emit_sizes(struct emit *e)
{
    for (int i = 0; i < e->tree->struct_count; i++) {
        const struct type type = {.base = BASE_STRUCT, .rows = (uint8_t)i};
        emit_line(e, "enum { SPMD_%s = %d };", e->tree->structs[i].name->text,
                  spmd_components(e->tree, type));
    }
}

bool spmd_emit_header(struct tree *tree, const char *const *entries, size_t count, FILE *out)
{
    struct emit e = begin(tree, entries, count, out);

    emit_sizes(&e);
    emit_globals(&e);
    for (struct function *f = tree->called; f && e.ok; f = f->next_called) {
        emit_door_head(&e, f);
    }
    return e.ok;
}
