/* SPDX-License-Identifier: MIT */
/* Between our C and the C written here. spmd_NAME is what either calls of the other: one component
 * is passed as it is, several as an array of vf, whatever they are, and what comes back of several
 * goes into an array as well. Results are vectors, also where all lanes have the same. */
#include "emit.h"

/* vf[] from or to a component of another base: the same bits. */
static const char *cast(struct emit *e, const char *text, enum base base)
{
    return base == BASE_FLOAT ? text : emit_text(e, "(%s)%s", emit_type(base, true), text);
}

static const char *name_of(struct emit *e, const struct function *f)
{
    return emit_text(e, "spmd_%s", emit_function_name(e, f) + sizeof "lanes_" - 1);
}

/* The list of parameters by arrays. */
static void door_head(struct emit *e, const struct function *f, const char *end)
{
    const int count = spmd_components(e->tree, f->result);
    int i = 0;

    fprintf(e->out, "static %s %s(struct lanes *c, vb m",
            count == 1 ? emit_type(spmd_base(e->tree, f->result, 0), true) : "void", name_of(e, f));
    for (const struct variable *p = f->parameters; p; p = p->next, i++) {
        if (p->direction != DIRECTION_IN) {
            fprintf(e->out, ", vf *a%d", i);
        } else if (spmd_components(e->tree, p->type) == 1) {
            fprintf(e->out, ", %s a%d", emit_type(spmd_base(e->tree, p->type, 0), p->varying), i);
        } else {
            fprintf(e->out, ", const vf *a%d", i);
        }
    }
    fprintf(e->out, count > 1 ? ", vf *result)%s\n" : ")%s\n", end);
}

/* Of a call of a function with one component. */
static struct component result_of(const struct emit *e, const struct function *f, const char *call)
{
    return (struct component){
        .text = call, .base = spmd_base(e->tree, f->result, 0), .varying = f->varying};
}

/* For our C to call an entry. */
static void emit_way_in(struct emit *e, const struct function *f)
{
    const int count = spmd_components(e->tree, f->result);
    const char *list = "c, m";
    int at = 0;

    door_head(e, f, "\n{");
    for (const struct variable *p = f->parameters; p; p = p->next, at++) {
        const int parts = spmd_components(e->tree, p->type);
        for (int i = 0; i < parts; i++) {
            const enum base base = spmd_base(e->tree, p->type, i);
            const char *part = emit_text(e, "a%d[%d]", at, i);
            if (p->direction != DIRECTION_IN) {
                emit_line(e, "%s o%d_%d = %s;", emit_type(base, true), at, i, cast(e, part, base));
                part = emit_text(e, "&o%d_%d", at, i);
            } else {
                part = parts == 1 ? emit_text(e, "a%d", at) : cast(e, part, base);
            }
            list = emit_text(e, "%s, %s", list, part);
        }
    }
    for (int i = 0; count > 1 && i < count; i++) {
        emit_line(e, "%s r_%d;", emit_type(spmd_base(e->tree, f->result, i), true), i);
        list = emit_text(e, "%s, &r_%d", list, i);
    }
    const char *call = emit_text(e, "%s(%s)", emit_function_name(e, f), list);
    if (count == 1) {
        emit_line(e, "const %s r = %s;", emit_type(spmd_base(e->tree, f->result, 0), true),
                  emit_spread(e, result_of(e, f, call)).text);
    } else {
        emit_line(e, "%s;", call);
    }
    for (int i = 0; count > 1 && i < count; i++) {
        emit_line(e, "result[%d] = (vf)r_%d;", i, i);
    }
    at = 0;
    for (const struct variable *p = f->parameters; p; p = p->next, at++) {
        for (int i = 0; p->direction != DIRECTION_IN && i < spmd_components(e->tree, p->type);
             i++) {
            emit_line(e, "a%d[%d] = (vf)o%d_%d;", at, i, at, i);
        }
    }
    if (count == 1) {
        emit_line(e, "return r;");
    }
    emit_line(e, "}\n");
}

/* For what is written here to call a function of ours. */
static void emit_way_out(struct emit *e, const struct function *f)
{
    const int count = spmd_components(e->tree, f->result);
    const char *list = "c, m";
    int at = 0;

    emit_head(e, f, "\n{");
    for (const struct variable *p = f->parameters; p; p = p->next, at++) {
        const struct value value = emit_variable(e, p);
        const bool in = p->direction == DIRECTION_IN;
        if (in && value.count == 1) {
            list = emit_text(e, "%s, %s", list, value.at[0].text);
            continue;
        }
        emit_line(e, "vf b%d[%d];", at, value.count);
        for (int i = 0; i < value.count; i++) {
            emit_line(e, "b%d[%d] = (vf)%s%s;", at, i, in ? "" : "*to_",
                      in ? emit_spread(e, value.at[i]).text : value.at[i].text);
        }
        list = emit_text(e, "%s, b%d", list, at);
    }
    if (count > 1) {
        emit_line(e, "vf r[%d];", count);
        list = emit_text(e, "%s, r", list);
    }
    if (count == 1) {
        emit_line(e, "const %s r = %s(%s);", emit_type(spmd_base(e->tree, f->result, 0), true),
                  name_of(e, f), list);
    } else {
        emit_line(e, "%s(%s);", name_of(e, f), list);
    }
    for (int i = 0; count > 1 && i < count; i++) {
        emit_line(e, "*result_%d = %s;", i,
                  cast(e, emit_text(e, "r[%d]", i), spmd_base(e->tree, f->result, i)));
    }
    at = 0;
    for (const struct variable *p = f->parameters; p; p = p->next, at++) {
        const struct value value = emit_variable(e, p);
        for (int i = 0; p->direction != DIRECTION_IN && i < value.count; i++) {
            emit_line(e, "*to_%s = %s;", value.at[i].text,
                      cast(e, emit_text(e, "b%d[%d]", at, i), value.at[i].base));
        }
    }
    if (count == 1) {
        emit_line(e, "return r;");
    }
    emit_line(e, "}\n");
}

void emit_door_head(struct emit *e, const struct function *f)
{
    if (!f->body || spmd_is_entry(f, e->entries, e->entry_count)) {
        door_head(e, f, ";");
    }
}

void emit_door(struct emit *e, const struct function *f)
{
    if (!f->body) {
        emit_way_out(e, f);
    } else if (spmd_is_entry(f, e->entries, e->entry_count)) {
        emit_way_in(e, f);
    }
}
