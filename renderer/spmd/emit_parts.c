/* SPDX-License-Identifier: MIT */
/* Components: their names, types and conversions, and what is done with one or two of them. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "emit.h"

const char *emit_text(struct emit *e, const char *format, ...)
{
    char *text = NULL;
    va_list args;

    va_start(args, format);
    const int length = vasprintf(&text, format, args);
    va_end(args);
    if (length < 0) {
        abort();
    }
    char *kept = tree_alloc(e->tree, (size_t)length + 1);
    memcpy(kept, text, (size_t)length + 1);
    free(text);
    return kept;
}

void emit_line(struct emit *e, const char *format, ...)
{
    va_list args;

    va_start(args, format);
    vfprintf(e->out, format, args);
    va_end(args);
    fputc('\n', e->out);
}

void emit_fail(struct emit *e, struct at at, const char *what)
{
    if (e->ok) {
        tree_fail(e->tree, at, "%s", what);
    }
    e->ok = false;
}

struct value emit_values(struct emit *e, int count)
{
    return (struct value){
        tree_alloc(e->tree, (size_t)(count > 0 ? count : 1) * sizeof(struct component)), count};
}

char emit_letter(enum base base)
{
    return base == BASE_FLOAT                         ? 'f'
           : base == BASE_INT || base == BASE_SAMPLER ? 'i'
           : base == BASE_UINT                        ? 'u'
                                                      : 'b';
}

const char *emit_type(enum base base, bool varying)
{
    switch (emit_letter(base)) {
    case 'f':
        return varying ? "vf" : "float";
    case 'i':
        return varying ? "vi" : "int";
    case 'u':
        return varying ? "vu" : "unsigned";
    default:
        return varying ? "vb" : "bool";
    }
}

struct component emit_temp(struct emit *e, enum base base, bool varying, const char *format, ...)
{
    va_list args;
    const char *name = emit_text(e, "t%d", e->temps++);

    fprintf(e->out, "%s %s = ", emit_type(base, varying), name);
    va_start(args, format);
    vfprintf(e->out, format, args);
    va_end(args);
    fputs(";\n", e->out);
    return (struct component){name, base, varying};
}

struct component emit_value_at(const struct value *value, int i)
{
    return value->at[value->count == 1 ? 0 : i];
}

struct component emit_spread(struct emit *e, struct component x)
{
    if (!x.varying) {
        x.text = emit_text(e, "v%c_all(%s)", emit_letter(x.base), x.text);
        x.varying = true;
    }
    return x;
}

struct component emit_convert(struct emit *e, struct component x, enum base base)
{
    if (emit_letter(x.base) == emit_letter(base)) {
        return x;
    }
    x.text = emit_text(e, "%s%c_of_%c(%s)", x.varying ? "v" : "", emit_letter(base),
                       emit_letter(x.base), x.text);
    x.base = base;
    return x;
}

struct component emit_select(struct emit *e, struct component mask, struct component yes,
                             struct component no)
{
    yes = emit_spread(e, yes);
    no = emit_spread(e, no);
    return emit_temp(e, yes.base, true, "v%c_select(%s, %s, %s)", emit_letter(yes.base), mask.text,
                     yes.text, no.text);
}

static bool is_logic(enum op op)
{
    return op == OP_AND || op == OP_OR || op == OP_XOR;
}

/* C's operator: masks have bits for what single values have truth. */
static const char *operator_of(enum op op, bool varying)
{
    if (is_logic(op)) {
        return op == OP_XOR ? (varying ? "^" : "!=") : op == OP_AND ? "&" : "|";
    }
    return tree_op_text(op);
}

struct component emit_operator(struct emit *e, enum op op, struct component a, struct component b)
{
    const bool varying = a.varying || b.varying;
    const bool compares = op >= OP_LESS && op <= OP_UNEQUAL;
    const enum base base = a.base == BASE_FLOAT || b.base == BASE_FLOAT ? BASE_FLOAT
                           : a.base == BASE_UINT || b.base == BASE_UINT ? BASE_UINT
                                                                        : a.base;

    if (op != OP_SHIFT_LEFT && op != OP_SHIFT_RIGHT) {
        a = emit_convert(e, a, base);
        b = emit_convert(e, b, base);
    }
    if (varying) {
        a = emit_spread(e, a);
        b = emit_spread(e, b);
    }
    if (op == OP_SHIFT_LEFT || op == OP_SHIFT_RIGHT) {
        b = emit_convert(e, b, a.base);
    }
    return emit_temp(e, compares ? BASE_BOOL : base, varying, "%s %s %s", a.text,
                     operator_of(op, varying), b.text);
}

struct component emit_each(struct emit *e, const char *name, const struct component *args,
                           int count)
{
    struct component of[4];
    bool varying = false;
    enum base base = args[0].base;

    for (int i = 0; i < count; i++) {
        varying |= args[i].varying;
        base = args[i].base == BASE_FLOAT ? BASE_FLOAT : base;
    }
    const char *list = "";
    for (int i = 0; i < count; i++) {
        of[i] = emit_convert(e, args[i], base);
        of[i] = varying ? emit_spread(e, of[i]) : of[i];
        list = emit_text(e, "%s%s%s", list, i ? ", " : "", of[i].text);
    }
    return emit_temp(e, base, varying, "%s%c_%s(%s)", varying ? "v" : "", emit_letter(base), name,
                     list);
}
