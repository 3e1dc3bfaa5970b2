/* SPDX-License-Identifier: MIT */
/* Between the files that write C. */
#ifndef RENDERER_SPMD_EMIT_H
#define RENDERER_SPMD_EMIT_H

#include "spmd.h"

/* A component of a value: an expression of C without effects. */
struct component {
    const char *text;
    enum base base;
    bool varying;
};

struct value {
    struct component *at;
    int count;
};

/* Where components are stored, or where lanes find them in arrays. */
struct place {
    struct variable *variable;
    struct value value;
    const char *index; /* NULL, or the lanes' own indices into each component, an array */
};

struct emit {
    struct tree *tree;
    FILE *out;
    const char *const *entries;
    size_t entry_count;
    struct function *function;
    int temps, labels, scope;
    int loop;          /* number of the label of the loop around */
    bool loop_varying; /* that loop has lanes that left */
    bool ok;
};

const char *emit_text(struct emit *e, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void emit_fail(struct emit *e, struct at at, const char *what);
/* Writes a line of C. */
void emit_line(struct emit *e, const char *format, ...) __attribute__((format(printf, 2, 3)));
struct value emit_values(struct emit *e, int count);
/* A new variable of C that holds this. */
struct component emit_temp(struct emit *e, enum base base, bool varying, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
const char *emit_type(enum base base, bool varying); /* of C */
char emit_letter(enum base base);                    /* f, i, u or b */
/* The same as a vector; of another base. */
struct component emit_spread(struct emit *e, struct component x);
struct component emit_convert(struct emit *e, struct component x, enum base base);
struct component emit_value_at(const struct value *value, int i); /* one component stands for all */
/* One of two. */
struct component emit_select(struct emit *e, struct component mask, struct component yes,
                             struct component no);
struct component emit_operator(struct emit *e, enum op op, struct component a, struct component b);
/* A function of lanes.h, component by component. */
struct component emit_each(struct emit *e, const char *name, const struct component *args,
                           int count);

struct value emit_value(struct emit *e, struct expr *expr);
struct place emit_place(struct emit *e, struct expr *expr);
void emit_store(struct emit *e, const struct place *place, struct value value);
struct value emit_builtin(struct emit *e, struct expr *expr);
struct value emit_call(struct emit *e, struct expr *expr);
/* The components of a variable or parameter as C names them. */
struct value emit_variable(struct emit *e, const struct variable *variable);
const char *emit_function_name(struct emit *e, const struct function *function);
/* The list of parameters in C; of a declaration too. */
void emit_head(struct emit *e, const struct function *function, const char *end);
void emit_statement(struct emit *e, struct stmt *stmt);
/* Of an entry, or of a function without a body. */
void emit_door(struct emit *e, const struct function *function);
void emit_door_head(struct emit *e, const struct function *function);

#endif
