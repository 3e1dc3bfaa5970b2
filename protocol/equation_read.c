/* SPDX-License-Identifier: MIT */
/* Equations, read by recursive descent. What is only meant wrongly (an unknown name, arguments that
 * are too few) is noted, and reading goes on; at what cannot be read it ends. */
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "equation_internal.h"
#include "memory.h"
#include "utf8.h"

struct reader {
    const char *text, *at;
    const char *const *letters;
    struct equation *equation;
    struct equation_errors *errors;
    struct equation_definitions definitions;
    struct equation_definitions *written; /* not NULL: names stay names, and stand for these */
    int depth;
    bool ended;   /* what follows cannot be read */
    bool in_bars; /* between | and | */
    bool plain;   /* letters alone: x, y and z are no names */
    bool relates; /* a relation may stand in it */
};

/* --- errors --- */

/* In code points, from 1. */
static void find_place(const char *text, const char *at, int *out_line, int *out_column)
{
    *out_line = *out_column = 1;
    for (const char *c = text; c < at; c++) {
        const bool begins = ((unsigned char)*c & 0xc0) != 0x80;
        *out_line += *c == '\n';
        *out_column = *c == '\n' ? 1 : *out_column + begins;
    }
}

static void note(struct reader *r, const char *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void note(struct reader *r, const char *at, const char *format, ...)
{
    struct equation_errors *errors = r->errors;

    if (errors->count == EQUATION_ERRORS) {
        return;
    }
    struct equation_error *error = &errors->list[errors->count++];
    va_list arguments;
    find_place(r->text, at, &error->line, &error->column);
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
}

/* --- characters --- */

/* What stands for the symbols of the grammar as well. */
static const struct {
    const char *symbol, *other;
} spellings[] = {
    {"-", "\u2212"},  {"*", "\u00b7"},  {"*", "\u00d7"},    {"<=", "\u2264"},
    {">=", "\u2265"}, {"pi", "\u03c0"}, {"sqrt", "\u221a"}, {"^", "**"},
};

static bool begins_with(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

static void skip_space(struct reader *r)
{
    while (*r->at == ' ' || *r->at == '\t' || *r->at == '\n') {
        r->at++;
    }
}

/* The length of this symbol, in any spelling, if it is next. */
static size_t next_is(struct reader *r, const char *symbol)
{
    skip_space(r);
    for (size_t i = 0; i < sizeof spellings / sizeof spellings[0]; i++) {
        if (strcmp(spellings[i].symbol, symbol) == 0 && begins_with(r->at, spellings[i].other)) {
            return strlen(spellings[i].other);
        }
    }
    const bool is_power = strcmp(symbol, "*") == 0 && begins_with(r->at, "**");
    return !is_power && begins_with(r->at, symbol) ? strlen(symbol) : 0;
}

static bool take(struct reader *r, const char *symbol)
{
    const size_t length = next_is(r, symbol);

    r->at += length;
    return length > 0;
}

/* What is next, for messages; returns `out`. */
static const char *next_character(struct reader *r, char out[8])
{
    skip_space(r);
    const size_t left = strlen(r->at);
    const size_t length = left > 0 ? utf8_sequence(r->at, left) : 0;
    memcpy(out, r->at, length);
    out[length] = '\0';
    return length > 0 ? out : "the end";
}

/* --- nodes --- */

static void note_full(struct reader *r)
{
    r->ended = true;
    note(r, r->at,
         "more than %d different operations (equation_nodes), or %d with all "
         "definitions written out (equation_weight)",
         LIMIT_EQUATION_NODES, LIMIT_EQUATION_WEIGHT);
}

static uint16_t add(struct reader *r, struct equation_node node)
{
    uint16_t index = 0;

    if (!r->ended && !equation_add(r->equation, node, &index)) {
        note_full(r);
    }
    return index;
}

static uint16_t add_number(struct reader *r, double value)
{
    return add(r, (struct equation_node){.op = EQUATION_NUMBER, .value = value});
}

static uint16_t add_two(struct reader *r, enum equation_op op, uint16_t a, uint16_t b)
{
    return add(r, (struct equation_node){.op = (uint8_t)op, .args = {a, b}});
}

static uint16_t add_call(struct reader *r, enum equation_name name, uint16_t a, uint16_t b)
{
    return add(r,
               (struct equation_node){.op = EQUATION_CALL, .which = (uint8_t)name, .args = {a, b}});
}

static uint16_t add_whole(struct reader *r, uint16_t base, double exponent)
{
    return add(r,
               (struct equation_node){.op = EQUATION_WHOLE, .args = {base, 0}, .value = exponent});
}

static uint16_t add_power(struct reader *r, uint16_t base, uint16_t exponent, const char *at)
{
    const struct equation_node *node = &r->equation->nodes[exponent];
    const double value = node->constant;

    if (!node->known || value != floor(value)) {
        return add_two(r, EQUATION_POWER, base, exponent);
    }
    if (fabs(value) > LIMIT_EQUATION_EXPONENT) {
        note(r, at, "exponent %.17g; the limit is %d (equation_exponent)", value,
             LIMIT_EQUATION_EXPONENT);
    }
    return add_whole(r, base, value);
}

/* --- names --- */

static uint16_t compose(struct reader *r, enum equation_composite which, const uint16_t *in,
                        const char *at)
{
    const struct equation_node *degree = &r->equation->nodes[in[0]];
    uint16_t out = 0;

    if (which == EQUATION_POW) {
        return add_power(r, in[0], in[1], at);
    }
    if (which == EQUATION_CHEB &&
        !(degree->known && degree->constant == floor(degree->constant) && degree->constant >= 0 &&
          degree->constant <= LIMIT_EQUATION_EXPONENT)) {
        note(r, at, "cheb(n, x) takes a whole number n from 0 to %d (equation_exponent)",
             LIMIT_EQUATION_EXPONENT);
        return 0;
    }
    if (!r->ended && !equation_compose(r->equation, which, in, &out)) {
        note_full(r);
    }
    return out;
}

/* Reads a name; its length. Digits belong to it, so x2 is no product. */
static size_t read_name(struct reader *r, char out[EQUATION_NAME_BYTES])
{
    size_t length = 0;

    skip_space(r);
    while (isalpha((unsigned char)r->at[length]) || r->at[length] == '_' ||
           (length > 0 && isdigit((unsigned char)r->at[length]))) {
        length++;
    }
    snprintf(out, EQUATION_NAME_BYTES, "%.*s", (int)length, r->at);
    r->at += length;
    return length;
}

static void note_unknown(struct reader *r, const char *name, bool called, const char *at)
{
    char message[EQUATION_MESSAGE_BYTES];

    equation_unknown(r->letters, r->plain, name, called, message);
    note(r, at, "%s", message);
}

static uint16_t value_of(struct reader *r, const char *name, const char *at)
{
    int arguments;

    for (int i = 0; i < r->definitions.count; i++) {
        if (strcmp(r->definitions.list[i].name, name) == 0) {
            return r->definitions.list[i].node;
        }
    }
    const int axis = r->plain ? -1 : equation_name_in(equation_axes, name),
              letter = equation_name_in(r->letters, name);
    if (axis >= 0 || letter >= 0) {
        return add(r, (struct equation_node){.op = axis >= 0 ? EQUATION_AXIS : EQUATION_LETTER,
                                             .which = (uint8_t)(axis >= 0 ? axis : letter)});
    }
    for (int i = 0; equation_constants[i].name; i++) {
        if (strcmp(equation_constants[i].name, name) == 0) {
            return add(r, (struct equation_node){.op = EQUATION_CONSTANT, .which = (uint8_t)i});
        }
    }
    if (equation_function_of(name, &arguments) >= 0) {
        note(r, at, "\"%s\" is a function; write %s(%s)", name, name,
             arguments == 1   ? "..."
             : arguments == 2 ? "..., ..."
                              : "..., ..., ...");
    } else {
        note_unknown(r, name, false, at);
    }
    return add_number(r, 0);
}

/* --- the grammar --- */

static uint16_t read_expression(struct reader *r);
static uint16_t read_unary(struct reader *r);

static void expect(struct reader *r, const char *symbol, const char *opener)
{
    char next[8];
    int line, column;

    if (r->ended || take(r, symbol)) {
        return;
    }
    r->ended = true;
    next_character(r, next);
    find_place(r->text, opener, &line, &column);
    note(r, r->at, "expected \"%s\" for the \"%c\" in line %d, column %d, found %s%s%s", symbol,
         *opener, line, column, *next ? "\"" : "", *next ? next : "the end", *next ? "\"" : "");
}

static uint16_t read_call(struct reader *r, const char *name, const char *at)
{
    uint16_t in[3] = {0};
    int wanted = 0, given = 0;
    const int function = equation_function_of(name, &wanted);
    const char *opener = r->at - 1;
    const bool in_bars = r->in_bars;

    r->in_bars = false;
    if (function < 0) {
        note_unknown(r, name, true, at);
    }
    do {
        const uint16_t one = read_expression(r);
        if (given < 3) {
            in[given] = one;
        }
        given++;
    } while (!r->ended && take(r, ","));
    r->in_bars = in_bars;
    expect(r, ")", opener);
    if (function < 0) {
        return in[0];
    }
    if (given != wanted) {
        note(r, at, "%s() takes %d argument%s, not %d", name, wanted, wanted == 1 ? "" : "s",
             given);
        return in[0];
    }
    return function < EQUATION_FUNCTIONS
               ? add_call(r, (enum equation_name)function, in[0], wanted > 1 ? in[1] : 0)
               : compose(r, (enum equation_composite)(function - EQUATION_FUNCTIONS), in, at);
}

bool equation_number(const char *text, double *out_value, const char **out_end)
{
    /* strtod knows hexadecimal digits, too. */
    const bool zero = text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
    char *end = (char *)text + 1;

    if (!isdigit((unsigned char)text[text[0] == '.'])) {
        return false;
    }
    *out_value = zero ? 0 : strtod(text, &end);
    *out_end = end;
    return true;
}

static uint16_t take_number(struct reader *r, double value, const char *end)
{
    if (!isfinite(value) || fabs(value) > LIMIT_COORDINATE) {
        note(r, r->at, "%.*s is above the maximum %g", (int)(end - r->at < 24 ? end - r->at : 24),
             r->at, (double)LIMIT_COORDINATE);
    }
    r->at = end;
    return add_number(r, value);
}

static uint16_t read_named(struct reader *r)
{
    char name[EQUATION_NAME_BYTES];
    const char *at = r->at;

    if (read_name(r, name) >= EQUATION_NAME_BYTES) {
        note(r, at, "names are at most %d letters long", EQUATION_NAME_BYTES - 1);
        return 0;
    }
    int arguments;
    const bool calls =
        *r->at == '(' || (equation_function_of(name, &arguments) >= 0 && next_is(r, "("));
    const bool is_value =
        equation_name_in(equation_axes, name) >= 0 || equation_name_in(r->letters, name) >= 0;
    if (calls && !is_value) {
        for (int i = 0; i < r->definitions.count; i++) {
            if (strcmp(r->definitions.list[i].name, name) == 0) {
                return r->definitions.list[i].node;
            }
        }
        for (int i = 0; equation_constants[i].name; i++) {
            if (strcmp(equation_constants[i].name, name) == 0) {
                return value_of(r, name, at);
            }
        }
        take(r, "(");
        return read_call(r, name, at);
    }
    return value_of(r, name, at);
}

static uint16_t read_group(struct reader *r)
{
    const char *opener = r->at;
    const bool bars = *opener == '|', outer = r->in_bars;

    if (!bars) {
        r->at++;
        r->in_bars = false;
        const uint16_t inner = read_expression(r);
        r->in_bars = outer;
        expect(r, ")", opener);
        return inner;
    }
    r->at++;
    r->in_bars = true;
    const uint16_t inner = read_expression(r);
    r->in_bars = outer;
    expect(r, "|", opener);
    return add_call(r, EQUATION_ABS, inner, 0);
}

static uint16_t read_atom(struct reader *r)
{
    char next[8];
    double number;
    const char *end;

    skip_space(r);
    const char c = *r->at;
    if (equation_number(r->at, &number, &end)) {
        return take_number(r, number, end);
    }
    if (isalpha((unsigned char)c) || c == '_') {
        return read_named(r);
    }
    if (c == '(' || (c == '|' && !r->in_bars)) {
        return read_group(r);
    }
    const char *at = r->at;
    if (take(r, "pi")) {
        return value_of(r, "pi", at);
    }
    if (take(r, "sqrt")) { /* the sign: the name was read above */
        return add_call(r, EQUATION_SQRT, read_unary(r), 0);
    }
    if (!r->ended) {
        r->ended = true;
        const char *found = next_character(r, next);
        const bool is_end = strcmp(found, "the end") == 0;
        note(r, r->at, "expected a number, a name or \"(\", found %s%s%s", is_end ? "" : "\"",
             found, is_end ? "" : "\"");
    }
    return 0;
}

static uint16_t read_power(struct reader *r)
{
    uint16_t base = read_atom(r);
    const char *at = r->at;

    if (!r->ended && begins_with(r->at, "\u00b2")) {
        r->at += strlen("\u00b2");
        base = add_whole(r, base, 2);
    } else if (!r->ended && begins_with(r->at, "\u00b3")) {
        r->at += strlen("\u00b3");
        base = add_whole(r, base, 3);
    }
    if (!r->ended && take(r, "^")) {
        skip_space(r);
        at = r->at;
        const uint16_t exponent = read_unary(r);
        return r->ended ? 0 : add_power(r, base, exponent, at);
    }
    return base;
}

/* One level further in, which its caller leaves by r->depth--; false: reading has ended. */
static bool enter(struct reader *r)
{
    if (++r->depth > LIMIT_EQUATION_DEPTH && !r->ended) {
        r->ended = true;
        note(r, r->at, "nested deeper than %d levels (equation_depth)", LIMIT_EQUATION_DEPTH);
    }
    return !r->ended;
}

static uint16_t read_unary(struct reader *r)
{
    uint16_t value = 0;

    if (!enter(r)) {
        value = 0;
    } else if (take(r, "-")) {
        value = add(r, (struct equation_node){.op = EQUATION_NEGATE, .args = {read_unary(r), 0}});
    } else if (take(r, "+")) {
        value = read_unary(r);
    } else {
        value = read_power(r);
    }
    r->depth--;
    return value;
}

/* A factor without a sign before it. */
static uint16_t read_factor(struct reader *r)
{
    const uint16_t value = enter(r) ? read_power(r) : 0;

    r->depth--;
    return value;
}

static bool ends_with(const char *begin, const char *end, const char *with)
{
    const size_t length = strlen(with);

    return (size_t)(end - begin) >= length && memcmp(end - length, with, length) == 0;
}

/* Whether a factor follows without a sign: after a number, a name or ")" a name or "(". Between two
 * names is a blank; xy is one name. */
static bool is_beside(struct reader *r, const char *begin)
{
    const char *last = r->at;

    while (last > begin && (last[-1] == ' ' || last[-1] == '\t' || last[-1] == '\n')) {
        last--;
    }
    skip_space(r);
    const bool opens = *r->at == '(';
    const bool named =
        isalpha((unsigned char)*r->at) || *r->at == '_' || next_is(r, "pi") || next_is(r, "sqrt");
    const bool closed = last > begin && last[-1] == ')';
    const bool digit =
        last > begin &&
        (isdigit((unsigned char)last[-1]) || last[-1] == '.' || ends_with(begin, last, "\u03c0") ||
         ends_with(begin, last, "\u00b2") || ends_with(begin, last, "\u00b3"));
    const bool letter = last > begin && isalpha((unsigned char)last[-1]);
    return (closed || digit || letter) && (named || opens);
}

static uint16_t read_term(struct reader *r)
{
    const char *begin = r->at;
    uint16_t value = read_unary(r);

    while (!r->ended) {
        if (take(r, "*")) {
            value = add_two(r, EQUATION_MULTIPLY, value, read_unary(r));
        } else if (take(r, "/")) {
            value = add_two(r, EQUATION_DIVIDE, value, read_unary(r));
        } else if (is_beside(r, begin)) {
            value = add_two(r, EQUATION_MULTIPLY, value, read_factor(r));
        } else {
            break;
        }
    }
    return value;
}

static uint16_t read_expression(struct reader *r)
{
    uint16_t value = read_term(r);

    while (!r->ended) {
        if (take(r, "+")) {
            value = add_two(r, EQUATION_ADD, value, read_term(r));
        } else if (take(r, "-")) {
            value = add_two(r, EQUATION_SUBTRACT, value, read_term(r));
        } else {
            break;
        }
    }
    return value;
}

static void define(struct reader *r, struct equation_definition next)
{
    int letters = 0;

    if (r->written) {
        while (r->letters[letters]) {
            letters++;
        }
        r->written->list[r->written->count] = next;
        next.node = add(r, (struct equation_node){.op = EQUATION_LETTER,
                                                  .which = (uint8_t)(letters + r->written->count)});
        r->written->count++;
    }
    r->definitions.list[r->definitions.count++] = next;
}

/* Reads "name := expression;" if that is next. */
static bool read_definition(struct reader *r)
{
    struct equation_definition next;
    const char *begin = r->at, *at;
    int arguments;

    skip_space(r);
    at = r->at;
    if (!(isalpha((unsigned char)*at) || *at == '_') ||
        read_name(r, next.name) >= EQUATION_NAME_BYTES || !take(r, ":=")) {
        r->at = begin;
        return false;
    }
    if (equation_name_in(equation_axes, next.name) >= 0 ||
        equation_function_of(next.name, &arguments) >= 0) {
        note(r, at, "\"%s\" has a meaning already; choose another name", next.name);
    }
    for (int i = 0; i < r->definitions.count; i++) {
        if (strcmp(r->definitions.list[i].name, next.name) == 0) {
            note(r, at, "\"%s\" is defined twice", next.name);
        }
    }
    next.node = read_expression(r);
    if (r->definitions.count == LIMIT_EQUATION_DEFINITIONS && !r->ended) {
        r->ended = true;
        note(r, at, "more than %d definitions (equation_definitions)", LIMIT_EQUATION_DEFINITIONS);
    }
    if (!r->ended) {
        define(r, next);
        if (!take(r, ";")) {
            r->ended = true;
            note(r, r->at, "expected \";\" after the definition of \"%s\"", next.name);
        }
    }
    return true;
}

static void read_relation(struct reader *r)
{
    static const struct {
        const char *symbol;
        enum equation_relation relation;
    } rows[] = {{"<=", EQUATION_LESS_EQUAL},
                {">=", EQUATION_GREATER_EQUAL},
                {"<", EQUATION_LESS},
                {">", EQUATION_GREATER},
                {"=", EQUATION_EQUALS}};
    r->equation->relation = EQUATION_EQUALS;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (take(r, rows[i].symbol)) {
            r->equation->relation = rows[i].relation;
            r->equation->right = read_expression(r);
            return;
        }
    }
    r->equation->right = add_number(r, 0);
}

static void check_end(struct reader *r)
{
    char next[8];

    skip_space(r);
    if (r->ended || !*r->at) {
        return;
    }
    if (strchr("<>=", *r->at)) {
        note(r, r->at,
             r->relates ? "a second relation; an equation has one"
                        : "a relation; an expression has none");
    } else if (*r->at == ')') {
        note(r, r->at, "nothing is open that \")\" could close");
    } else {
        note(r, r->at, "unexpected \"%s\"", next_character(r, next));
    }
}

static void check_varies(struct reader *r)
{
    const struct equation *equation = r->equation;

    if (r->errors->count == 0 && !equation->nodes[equation->left].varies &&
        !equation->nodes[equation->right].varies) {
        note(r, r->text, "no x, y or z: it holds everywhere or nowhere");
    }
}

/* Numbers alone that make none; parts of surfaces are computed exactly elsewhere. */
static void check_finite(struct reader *r)
{
    for (size_t i = 0; r->errors->count == 0 && i < r->equation->count; i++) {
        const struct equation_node *node = &r->equation->nodes[i];
        if (node->known && !isfinite(node->constant)) {
            note(r, r->text, "a division by 0, or numbers that make more than a number may be");
        }
    }
}

/* What is told of a text that was read to its end. */
static void check_values(struct reader *r)
{
    if (!r->plain && !r->written) {
        check_varies(r);
        check_finite(r);
    }
}

static struct equation *read_text(struct reader r)
{
    r.at = r.text;
    r.equation = memory_alloc(1, sizeof *r.equation);
    r.errors->count = 0;
    while (!r.ended && read_definition(&r)) {
    }
    if (!r.ended) {
        r.equation->left = read_expression(&r);
    }
    if (!r.ended && r.relates) {
        read_relation(&r);
    }
    check_end(&r);
    check_values(&r);
    if (r.errors->count > 0) {
        free(r.equation);
        return NULL;
    }
    return r.equation;
}

struct equation *equation_read(const char *text, const char *const *letters,
                               struct equation_errors *out_errors)
{
    return read_text(
        (struct reader){.text = text, .letters = letters, .errors = out_errors, .relates = true});
}

struct equation *equation_read_expression(const char *text, const char *const *letters,
                                          struct equation_errors *out_errors)
{
    return read_text(
        (struct reader){.text = text, .letters = letters, .errors = out_errors, .plain = true});
}

struct equation *equation_read_relation(const char *text, const char *const *letters,
                                        struct equation_errors *out_errors)
{
    return read_text((struct reader){
        .text = text, .letters = letters, .errors = out_errors, .plain = true, .relates = true});
}

struct equation *equation_read_written(const char *text, const char *const *letters, bool plain,
                                       struct equation_definitions *out)
{
    struct equation_errors errors;

    out->count = 0;
    return read_text((struct reader){.text = text,
                                     .letters = letters,
                                     .errors = &errors,
                                     .written = out,
                                     .plain = plain,
                                     .relates = !plain});
}
