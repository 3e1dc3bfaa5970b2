/* SPDX-License-Identifier: MIT */
/* Values and what is assigned to. */
#include <stdio.h>
#include <string.h>

#include "emit.h"

/* --- places --- */

struct value emit_variable(struct emit *e, const struct variable *variable)
{
    struct value out = emit_values(e, spmd_components(e->tree, variable->type));

    for (int i = 0; i < out.count; i++) {
        const enum base base = spmd_base(e->tree, variable->type, i);
        out.at[i] =
            (struct component){emit_text(e, "%s_%d_%d", variable->name->text, variable->number, i),
                               base, variable->varying};
    }
    return out;
}

/* Components of a member of a struct of C, as renderer/glsl/interface.h lays it out. */
static int block_components(struct emit *e, const char *path, struct type type,
                            struct component *out)
{
    int count = 0;

    if (type.base == BASE_STRUCT) {
        for (const struct variable *v = e->tree->structs[type.rows].members; v; v = v->next) {
            count += block_components(e, emit_text(e, "%s.%s", path, v->name->text), v->type,
                                      out + count);
        }
        return count;
    }
    for (; count < type.rows; count++) {
        out[count] = (struct component){type.rows == 1 ? path : emit_text(e, "%s[%d]", path, count),
                                        (enum base)type.base, false};
    }
    return count;
}

/* The path to a part of a block in C; NULL: it is none. */
static const char *block_path(struct emit *e, struct expr *expr)
{
    if (expr->kind == EXPR_VARIABLE && expr->variable->storage == STORAGE_UNIFORM &&
        expr->type.base == BASE_STRUCT) {
        return emit_text(e, "(*c->%s)", expr->variable->name->text);
    }
    if (expr->kind == EXPR_MEMBER) {
        const char *path = block_path(e, expr->a);
        return path ? emit_text(e, "%s.%s", path, expr->name->text) : NULL;
    }
    if (expr->kind == EXPR_INDEX) {
        const char *path = block_path(e, expr->a);
        if (path && expr->b->varying) {
            emit_fail(e, expr->at, "an index into a block that varies");
        }
        return path ? emit_text(e, "%s[%s]", path, emit_value(e, expr->b).at[0].text) : NULL;
    }
    return NULL;
}

static struct place block_place(struct emit *e, const struct expr *expr, const char *path)
{
    struct value value = emit_values(e, spmd_components(e->tree, expr->type));

    block_components(e, path, expr->type, value.at);
    return (struct place){.value = value};
}

static struct place variable_place(struct emit *e, const struct expr *expr)
{
    struct variable *variable = expr->variable;
    struct place out = {.variable = variable};

    if (variable->storage == STORAGE_GLOBAL) {
        out.value = emit_variable(e, variable);
        for (int i = 0; i < out.value.count; i++) {
            out.value.at[i].text = emit_text(e, "c->%s_%d", variable->name->text, i);
        }
        return out;
    }
    if (variable->storage == STORAGE_UNIFORM) {
        out.value = emit_values(e, 1);
        out.value.at[0] =
            (struct component){emit_text(e, "%d", variable->number), BASE_SAMPLER, false};
        return out;
    }
    out.value = emit_variable(e, variable);
    return out;
}

static struct place part_of(struct emit *e, struct place of, int first, int count)
{
    struct value part = emit_values(e, count);
    (void)e;

    memcpy(part.at, of.value.at + first, (size_t)count * sizeof *part.at);
    of.value = part;
    return of;
}

static struct place index_place(struct emit *e, struct expr *expr)
{
    struct place of = emit_place(e, expr->a);
    const int count = spmd_components(e->tree, expr->type);
    int at;

    if (expr->a->type.count == 0) {
        if (!spmd_constant(e->tree, expr->b, &at)) {
            e->ok = false;
            at = 0;
        }
        return part_of(e, of, at * count, count);
    }
    struct component index = emit_value(e, expr->b).at[0];
    if (index.varying) {
        of.index = index.text;
        return of;
    }
    struct value element = emit_values(e, count);
    for (int i = 0; i < count; i++) {
        element.at[i] = of.value.at[i];
        element.at[i].text = emit_text(e, "%s[%s]", of.value.at[i].text, index.text);
    }
    of.value = element;
    return of;
}

struct place emit_place(struct emit *e, struct expr *expr)
{
    const char *path = block_path(e, expr);
    int first;

    if (path) {
        return block_place(e, expr, path);
    }
    if (expr->kind == EXPR_VARIABLE) {
        return variable_place(e, expr);
    }
    if (expr->kind == EXPR_INDEX && (expr->a->kind == EXPR_VARIABLE ||
                                     expr->a->kind == EXPR_INDEX || expr->a->kind == EXPR_MEMBER)) {
        return index_place(e, expr);
    }
    if (expr->kind == EXPR_MEMBER) {
        struct place of = emit_place(e, expr->a);
        spmd_member(e->tree, expr->a->type, expr->name, &first);
        return part_of(e, of, first, spmd_components(e->tree, expr->type));
    }
    if (expr->kind == EXPR_SWIZZLE) {
        struct place of = emit_place(e, expr->a);
        struct value picked = emit_values(e, expr->swizzle_count);
        for (int i = 0; i < picked.count; i++) {
            picked.at[i] = of.value.at[expr->swizzle[i]];
        }
        of.value = picked;
        return of;
    }
    return (struct place){.value = emit_value(e, expr)};
}

static struct value load(struct emit *e, const struct place *place)
{
    if (!place->index) {
        return place->value;
    }
    struct value out = emit_values(e, place->value.count);
    for (int i = 0; i < out.count; i++) {
        const struct component x = place->value.at[i];
        out.at[i] = emit_temp(e, x.base, true, "lanes_pick(%s, %s, m)", x.text, place->index);
    }
    return out;
}

static void store_one(struct emit *e, const struct place *place, struct component to,
                      struct component x)
{
    x = emit_convert(e, x, to.base);
    if (!to.varying) {
        emit_line(e, "%s = %s;", to.text, x.text);
        return;
    }
    x = emit_spread(e, x);
    if (place->index) {
        emit_line(e, "lanes_put(%s, %s, %s, m);", to.text, place->index, x.text);
    } else if (place->variable->scope == e->scope) {
        emit_line(e, "%s = %s;", to.text, x.text);
    } else {
        emit_line(e, "%s = v%c_select(m, %s, %s);", to.text, emit_letter(to.base), x.text, to.text);
    }
}

void emit_store(struct emit *e, const struct place *place, struct value value)
{
    /* What is stored may be made of what is stored to. */
    struct value kept = emit_values(e, place->value.count);
    for (int i = 0; i < kept.count; i++) {
        const struct component x = emit_value_at(&value, i);
        kept.at[i] = kept.count > 1 ? emit_temp(e, x.base, x.varying, "%s", x.text) : x;
    }
    for (int i = 0; i < kept.count; i++) {
        store_one(e, place, place->value.at[i], kept.at[i]);
    }
}

/* --- operators --- */

static struct value multiply_matrix(struct emit *e, const struct value *m, const struct value *v)
{
    const int rows = m->count / v->count;
    struct value out = emit_values(e, rows);

    for (int r = 0; r < rows; r++) {
        out.at[r] = emit_operator(e, OP_MULTIPLY, m->at[r], v->at[0]);
        for (int i = 1; i < v->count; i++) {
            out.at[r] = emit_operator(e, OP_ADD, out.at[r],
                                      emit_operator(e, OP_MULTIPLY, m->at[i * rows + r], v->at[i]));
        }
    }
    return out;
}

static struct value multiply_by_matrix(struct emit *e, const struct value *v, const struct value *m)
{
    const int columns = m->count / v->count;
    struct value out = emit_values(e, columns);

    for (int i = 0; i < columns; i++) {
        const struct component *column = m->at + i * v->count;
        out.at[i] = emit_operator(e, OP_MULTIPLY, v->at[0], column[0]);
        for (int r = 1; r < v->count; r++) {
            out.at[i] = emit_operator(e, OP_ADD, out.at[i],
                                      emit_operator(e, OP_MULTIPLY, v->at[r], column[r]));
        }
    }
    return out;
}

static struct value operate(struct emit *e, enum op op, const struct value *a,
                            const struct value *b)
{
    struct value out = emit_values(e, a->count > b->count ? a->count : b->count);

    for (int i = 0; i < out.count; i++) {
        out.at[i] = emit_operator(e, op, emit_value_at(a, i), emit_value_at(b, i));
    }
    return out;
}

/* The second operand only where the first leaves it open; both are single. */
static struct value emit_short(struct emit *e, struct expr *expr)
{
    struct value out = emit_values(e, 1);
    const struct component a = emit_value(e, expr->a).at[0];

    out.at[0] = emit_temp(e, BASE_BOOL, false, "%s", a.text);
    emit_line(e, "if (%s%s) {", expr->op == OP_OR ? "!" : "", out.at[0].text);
    const struct component b = emit_value(e, expr->b).at[0];
    emit_line(e, "%s = %s;\n}", out.at[0].text, b.text);
    return out;
}

static struct value emit_binary(struct emit *e, struct expr *expr)
{
    if ((expr->op == OP_AND || expr->op == OP_OR) && !expr->varying) {
        return emit_short(e, expr);
    }
    struct value a = emit_value(e, expr->a), b = emit_value(e, expr->b);
    if (expr->op == OP_MULTIPLY && type_is_matrix(expr->a->type) && type_is_vector(expr->b->type)) {
        return multiply_matrix(e, &a, &b);
    }
    if (expr->op == OP_MULTIPLY && type_is_vector(expr->a->type) && type_is_matrix(expr->b->type)) {
        return multiply_by_matrix(e, &a, &b);
    }
    struct value out = operate(e, expr->op, &a, &b);
    for (int i = 1; out.at[0].base == BASE_BOOL && i < out.count; i++) { /* a == b of vectors */
        out.at[0] = emit_operator(e, expr->op == OP_UNEQUAL ? OP_OR : OP_AND, out.at[0], out.at[i]);
    }
    out.count = out.at[0].base == BASE_BOOL ? 1 : out.count;
    return out;
}

static struct value emit_unary(struct emit *e, struct expr *expr)
{
    struct value a = emit_value(e, expr->a), out = emit_values(e, a.count);

    for (int i = 0; i < out.count; i++) {
        const struct component x = a.at[i];
        const char *op = expr->op == OP_NOT && x.varying ? "~" : tree_op_text(expr->op);
        out.at[i] = emit_temp(e, x.base, x.varying, "%s%s", op, x.text);
    }
    return out;
}

static struct value emit_assign(struct emit *e, struct expr *expr)
{
    struct value value = emit_value(e, expr->b);
    struct place place = emit_place(e, expr->a);

    if (expr->op != OP_NONE) {
        struct value before = load(e, &place);
        value = operate(e, expr->op, &before, &value);
    }
    emit_store(e, &place, value);
    return load(e, &place);
}

static struct value emit_step(struct emit *e, struct expr *expr)
{
    struct place place = emit_place(e, expr->a);
    struct value before = load(e, &place), one = emit_values(e, 1), kept = emit_values(e, 1);
    const struct component x = before.at[0];

    kept.at[0] = emit_temp(e, x.base, x.varying, "%s", x.text);
    one.at[0] = (struct component){"1", BASE_INT, false};
    emit_store(e, &place, operate(e, expr->op, &kept, &one));
    return expr->postfix ? kept : load(e, &place);
}

/* One of two that all lanes take: the other is not computed. */
static struct value choose_one(struct emit *e, struct expr *expr, struct component condition)
{
    struct value out = emit_values(e, spmd_components(e->tree, expr->type));
    struct expr *const sides[] = {expr->b, expr->c};

    for (int i = 0; i < out.count; i++) {
        out.at[i] = (struct component){emit_text(e, "t%d", e->temps++),
                                       spmd_base(e->tree, expr->type, i), expr->varying};
        emit_line(e, "%s %s;", emit_type(out.at[i].base, expr->varying), out.at[i].text);
    }
    for (int side = 0; side < 2; side++) {
        if (side == 0) {
            emit_line(e, "if (%s) {", condition.text);
        } else {
            emit_line(e, "} else {");
        }
        struct value value = emit_value(e, sides[side]);
        for (int i = 0; i < out.count; i++) {
            struct component x = emit_convert(e, emit_value_at(&value, i), out.at[i].base);
            x = expr->varying ? emit_spread(e, x) : x;
            emit_line(e, "%s = %s;", out.at[i].text, x.text);
        }
    }
    emit_line(e, "}");
    return out;
}

static struct value emit_choice(struct emit *e, struct expr *expr)
{
    struct component condition = emit_value(e, expr->a).at[0];

    if (!condition.varying) {
        return choose_one(e, expr, condition);
    }
    struct value b = emit_value(e, expr->b), c = emit_value(e, expr->c);
    struct value out = emit_values(e, spmd_components(e->tree, expr->type));
    for (int i = 0; i < out.count; i++) {
        const enum base base = spmd_base(e->tree, expr->type, i);
        out.at[i] = emit_select(e, condition, emit_convert(e, emit_value_at(&b, i), base),
                                emit_convert(e, emit_value_at(&c, i), base));
    }
    return out;
}

/* --- made of others --- */

static struct value emit_literal(struct emit *e, const struct expr *expr)
{
    struct value out = emit_values(e, 1);
    const double number = expr->value[0];
    const enum base base = (enum base)expr->type.base;
    char digits[40];

    snprintf(digits, sizeof digits, "%.9g", number);
    const char *dot = strpbrk(digits, ".e") ? "" : ".0";
    const char *text = base == BASE_FLOAT  ? emit_text(e, "%s%sf", digits, dot)
                       : base == BASE_UINT ? emit_text(e, "%.0fu", number)
                       : base == BASE_INT  ? emit_text(e, "%.0f", number)
                       : number != 0       ? "true"
                                           : "false";
    out.at[0] = (struct component){text, base, false};
    return out;
}

static struct value emit_construct(struct emit *e, struct expr *expr)
{
    struct value out = emit_values(e, spmd_components(e->tree, expr->type)), arg = {0};
    int count = 0;

    if (expr->type.count > 0) {
        emit_fail(e, expr->at, "an array made here");
        return out;
    }
    for (struct expr *a = expr->args; a; a = a->next) {
        arg = emit_value(e, a);
        for (int i = 0; i < arg.count && count < out.count; i++, count++) {
            out.at[count] = emit_convert(e, arg.at[i], spmd_base(e->tree, expr->type, count));
        }
    }
    const struct component zero = {"0.0f", BASE_FLOAT, false};
    for (; count > 0 && count < out.count; count++) { /* of one number */
        const bool diagonal = expr->type.columns == 1 || count % (expr->type.rows + 1) == 0;
        out.at[count] = diagonal ? out.at[0] : zero;
    }
    return out;
}

struct value emit_call(struct emit *e, struct expr *expr)
{
    const struct function *f = expr->function;
    struct place outs[TREE_PARAMETERS * 4];
    struct value temps[TREE_PARAMETERS * 4];
    int out_count = 0;
    const char *list = "c, m";
    struct expr *arg = expr->args;

    for (const struct variable *p = f->parameters; p; p = p->next, arg = arg->next) {
        struct value value = p->direction == DIRECTION_OUT ? (struct value){0} : emit_value(e, arg);
        const int count = spmd_components(e->tree, p->type);
        struct value passed = emit_values(e, count);
        for (int i = 0; i < count; i++) {
            const enum base base = spmd_base(e->tree, p->type, i);
            if (p->direction == DIRECTION_IN) {
                struct component x = emit_value_at(&value, i);
                x = p->type.count > 0 ? x : emit_convert(e, x, base);
                x = p->varying && p->type.count == 0 ? emit_spread(e, x) : x;
                list = emit_text(e, "%s, %s", list, x.text);
                continue;
            }
            const struct component zero = {emit_text(e, "v%c_zero", emit_letter(base)), base, true};
            struct component x = p->direction == DIRECTION_OUT ? zero : emit_value_at(&value, i);
            x = emit_spread(e, emit_convert(e, x, base));
            passed.at[i] = emit_temp(e, base, true, "%s", x.text);
            list = emit_text(e, "%s, &%s", list, passed.at[i].text);
        }
        if (p->direction != DIRECTION_IN) {
            outs[out_count] = emit_place(e, arg);
            temps[out_count++] = passed;
        }
    }
    struct value result = emit_values(e, spmd_components(e->tree, f->result));
    const char *name = emit_function_name(e, f);
    if (result.count == 1) {
        result.at[0] =
            emit_temp(e, spmd_base(e->tree, f->result, 0), f->varying, "%s(%s)", name, list);
    } else {
        for (int i = 0; i < result.count; i++) {
            const enum base base = spmd_base(e->tree, f->result, i);
            result.at[i] = (struct component){emit_text(e, "t%d", e->temps++), base, f->varying};
            emit_line(e, "%s %s;", emit_type(base, f->varying), result.at[i].text);
            list = emit_text(e, "%s, &%s", list, result.at[i].text);
        }
        emit_line(e, "%s(%s);", name, list);
    }
    for (int i = 0; i < out_count; i++) {
        emit_store(e, &outs[i], temps[i]);
    }
    return result;
}

static struct value emit_name(struct emit *e, struct expr *expr)
{
    const struct variable *v = expr->variable;

    if (v->storage == STORAGE_GLOBAL && v->read_only) {
        for (struct stmt *stmt = e->tree->top; stmt; stmt = stmt->next) {
            for (struct stmt *one = stmt->kind == STMT_DECLARE ? stmt->body : NULL; one;
                 one = one->next) {
                if (one->variable == v) {
                    return emit_value(e, one->expr);
                }
            }
        }
    }
    struct place place = emit_place(e, expr);
    return load(e, &place);
}

struct value emit_value(struct emit *e, struct expr *expr)
{
    struct place place;

    switch (expr->kind) {
    case EXPR_LITERAL:
        return emit_literal(e, expr);
    case EXPR_VARIABLE:
        return emit_name(e, expr);
    case EXPR_UNARY:
        return emit_unary(e, expr);
    case EXPR_STEP:
        return emit_step(e, expr);
    case EXPR_BINARY:
        return emit_binary(e, expr);
    case EXPR_ASSIGN:
        return emit_assign(e, expr);
    case EXPR_CHOICE:
        return emit_choice(e, expr);
    case EXPR_COMMA:
        emit_value(e, expr->a);
        return emit_value(e, expr->b);
    case EXPR_CALL:
        return emit_call(e, expr);
    case EXPR_BUILTIN:
        return emit_builtin(e, expr);
    case EXPR_CONSTRUCT:
        return emit_construct(e, expr);
    default:
        place = emit_place(e, expr);
        return load(e, &place);
    }
}
