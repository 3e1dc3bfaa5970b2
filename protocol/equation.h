/* SPDX-License-Identifier: MIT */
/* The language of implicit equations in x, y and z:
 *
 *     text       := { name ":=" expression ";" } expression [ relation expression ]
 *     relation   := "=" | "<" | "<=" | ">" | ">="
 *     expression := term { ("+" | "-") term }
 *     term       := unary { ("*" | "/" | nothing) unary }      nothing: 2x, 3(x + 1), (x)y, x y
 *     unary      := { "-" | "+" } power
 *     power      := atom [ ("^" | "**") unary ]                -x^2 is -(x^2), x^y^z is x^(y^z)
 *     atom       := number | name | name "(" expression { "," expression } ")"
 *                 | "(" expression ")" | "|" expression "|"
 *
 * The characters of typeset mathematics are read too: minus, times and middle dot, superscripts 2
 * and 3, pi, the root sign, less-or-equal, greater-or-equal. A text without a relation equals 0.
 * Constants: pi, tau, e, phi. Pure; an equation is immutable once it is read. */
#ifndef PROTOCOL_EQUATION_H
#define PROTOCOL_EQUATION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "error.h"
#include "limits.h"

enum equation_op {
    EQUATION_NUMBER,   /* value */
    EQUATION_CONSTANT, /* equation_constants[which] */
    EQUATION_AXIS,     /* x, y or z: which */
    EQUATION_LETTER,   /* letters[which] of equation_read */
    EQUATION_ADD,      /* args[0] and args[1] from here on */
    EQUATION_SUBTRACT,
    EQUATION_MULTIPLY,
    EQUATION_DIVIDE,
    EQUATION_POWER,  /* any exponent */
    EQUATION_NEGATE, /* args[0] from here on */
    EQUATION_WHOLE,  /* to the power of the whole number `value` */
    EQUATION_CALL,   /* equation_functions[which] */
};

/* Functions, in the order of their rows. */
enum equation_name {
    EQUATION_SIN,
    EQUATION_COS,
    EQUATION_TAN,
    EQUATION_ASIN,
    EQUATION_ACOS,
    EQUATION_ATAN,
    EQUATION_SINH,
    EQUATION_COSH,
    EQUATION_TANH,
    EQUATION_EXP,
    EQUATION_LOG,
    EQUATION_SQRT,
    EQUATION_CBRT,
    EQUATION_ABS,
    EQUATION_SIGN,
    EQUATION_FLOOR,
    EQUATION_CEIL,
    EQUATION_MIN,
    EQUATION_MAX,
    EQUATION_ATAN2,
    EQUATION_FUNCTIONS,
};

/* How a call is typeset (equation_mathml.h). */
enum equation_notation {
    EQUATION_CALLED, /* sin x, max(x, y) by `sign`, or by the name where that is NULL */
    EQUATION_ROOT,   /* the root sign, with `sign` on it */
    EQUATION_RAISED, /* to the power of the argument: `sign` */
    EQUATION_FENCED, /* between `sign` and `close` */
};

struct equation_function {
    const char *name;
    int arguments;
    enum equation_notation notation;
    const char *sign, *close; /* NULL: none */
};
extern const struct equation_function equation_functions[EQUATION_FUNCTIONS];

struct equation_constant {
    const char *name;
    double value;
    const char *sign; /* as it is typeset */
};
extern const struct equation_constant equation_constants[]; /* ends with a name of NULL */

/* Equal nodes are one node. Arguments have lower indices. */
struct equation_node {
    uint8_t op, which;
    uint16_t args[2];
    double value;
    /* What follows from these: */
    bool varies;     /* x, y or z is in it */
    bool known;      /* neither axes nor letters nor functions are in it; it is `constant` then */
    uint32_t weight; /* nodes of it with all that are shared written out */
    double constant;
};

enum equation_relation {
    EQUATION_EQUALS, /* left = right, or left alone; right is then the number 0 */
    EQUATION_LESS,
    EQUATION_LESS_EQUAL,
    EQUATION_GREATER,
    EQUATION_GREATER_EQUAL,
};

/* As a text has them, and as they are typeset. */
struct equation_sign {
    const char *text, *typeset;
};
extern const struct equation_sign equation_relations[];

struct equation {
    struct equation_node nodes[LIMIT_EQUATION_NODES + 1]; /* room for left - right */
    size_t count;
    uint16_t left, right;
    enum equation_relation relation;
};

/* What a text defines: name := node. */
enum { EQUATION_NAME_BYTES = 32 };
struct equation_definition {
    char name[EQUATION_NAME_BYTES];
    uint16_t node;
};
struct equation_definitions {
    struct equation_definition list[LIMIT_EQUATION_DEFINITIONS];
    int count;
};

enum { EQUATION_ERRORS = 8, EQUATION_MESSAGE_BYTES = 160 };

/* A place in the text, in code points from 1. */
struct equation_error {
    int line, column;
    char message[EQUATION_MESSAGE_BYTES];
};
struct equation_errors {
    struct equation_error list[EQUATION_ERRORS];
    int count; /* of those in the list */
};

/* The first of them at its place in the text. Behind it stand as many others as fit, if they say
 * something else: "... (also 2:3: ...; and 2 more)". Returns false. */
bool equation_errors_tell(const struct equation_errors *errors, enum error_kind kind,
                          const char *place, struct error *err);

/* THE LIST of letters that are numbers of whatever has an equation: EACH(letter, ...). Not among
 * them are the axes, e, the parameters of surfaces, and what looks like a digit or another unit. */
#define EQUATION_LETTERS_EACH(EACH, ...)                                                           \
    EACH("a", __VA_ARGS__)                                                                         \
    EACH("b", __VA_ARGS__)                                                                         \
    EACH("c", __VA_ARGS__)                                                                         \
    EACH("d", __VA_ARGS__)                                                                         \
    EACH("f", __VA_ARGS__)                                                                         \
    EACH("g", __VA_ARGS__)                                                                         \
    EACH("h", __VA_ARGS__)                                                                         \
    EACH("k", __VA_ARGS__)                                                                         \
    EACH("m", __VA_ARGS__)                                                                         \
    EACH("n", __VA_ARGS__)                                                                         \
    EACH("p", __VA_ARGS__)                                                                         \
    EACH("q", __VA_ARGS__)                                                                         \
    EACH("r", __VA_ARGS__)                                                                         \
    EACH("w", __VA_ARGS__)
#define EQUATION_COUNT_LETTER(LETTER, ...) +1
enum { EQUATION_LETTERS = EQUATION_LETTERS_EACH(EQUATION_COUNT_LETTER, ) };
extern const char *const equation_letters[EQUATION_LETTERS + 1]; /* NULL at the end */

/* `letters` are further names that may be used, NULL at the end. The caller frees the result. NULL:
 * at least one error, in the order in which they were found. */
struct equation *equation_read(const char *text, const char *const *letters,
                               struct equation_errors *out_errors);
/* One expression in letters alone, without x, y, z and without a relation: it is `left`. */
struct equation *equation_read_expression(const char *text, const char *const *letters,
                                          struct equation_errors *out_errors);
/* The same, with a relation or without one. */
struct equation *equation_read_relation(const char *text, const char *const *letters,
                                        struct equation_errors *out_errors);
/* As equation_read, `plain`: as equation_read_expression. Names that the text defines stay names:
 * they are letters that count on from `letters`, and are written out nowhere. NULL: it cannot be
 * read so, as where a name stands for a number that is needed; equation_read may read it yet. */
struct equation *equation_read_written(const char *text, const char *const *letters, bool plain,
                                       struct equation_definitions *out);
/* The number that a text begins with, and where it ends; false: it begins with none. */
bool equation_number(const char *text, double *out_value, const char **out_end);
/* Canonical text; reading it gives the same text again. The caller frees it. */
char *equation_print(const struct equation *equation, const char *const *letters);
/* How many arguments a node has. */
int equation_arguments(const struct equation_node *node);

#endif
