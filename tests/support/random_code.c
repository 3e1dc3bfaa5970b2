/* SPDX-License-Identifier: MIT */
/* Making texts, and changing them. */
#include "random_code.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

struct maker {
    struct random *random;
    FILE *out;
    int depth;
};

static const char *pick(struct maker *maker, const char *const *from, size_t count)
{
    return from[random_below(maker->random, count)];
}
#define PICK(maker, from) pick(maker, from, sizeof(from) / sizeof(from)[0])

static void make_value(struct maker *maker, int rows);

/* What is left over when it may go no deeper. */
static void make_leaf(struct maker *maker, int rows)
{
    static const char *const ones[] = {"p.x", "p.y", "a", "b.x", "c[1]", "0.5", "float(n)", "e[n]"};
    static const char *const twos[] = {"p.xy", "p.zx", "b", "c.yz", "vec2(0.5, a)", "m[0].xy"};
    static const char *const threes[] = {"p",          "c",    "p.zxy", "vec3(a)",
                                         "vec3(b, 1)", "m[1]", "m[n]"};

    fputs(rows == 1   ? PICK(maker, ones)
          : rows == 2 ? PICK(maker, twos)
                      : PICK(maker, threes),
          maker->out);
}

static void make_call(struct maker *maker, int rows)
{
    static const struct {
        const char *before;
        int arguments;
    } calls[] = {{"normalize(", 1}, {"sin(", 1},       {"cos(", 1},        {"abs(", 1},
                 {"atan(", 1},      {"sqrt(", 1},      {"min(", 2},        {"max(", 2},
                 {"mix(", 3},       {"clamp(", 3},     {"smoothstep(", 3}, {"tanh(", 1},
                 {"fract(", 1},     {"exp2(-abs(", 1}, {"step(", 2},       {"saturate(", 1}};
    enum { CALLS = sizeof calls / sizeof calls[0] };
    const bool jumps = rows == 1; /* normalize() of a number is its sign */
    const size_t which = jumps + random_below(maker->random, CALLS - jumps);
    fputs(calls[which].before, maker->out);
    for (int i = 0; i < calls[which].arguments; i++) {
        fputs(i > 0 ? ", " : "", maker->out);
        make_value(maker, rows);
    }
    fputs(strstr(calls[which].before, "(-abs") ? "))" : ")", maker->out);
}

static void make_condition(struct maker *maker)
{
    static const char *const ops[] = {" < ", " > ", " <= ", " >= "};
    static const char *const joins[] = {" && ", " || ", " ^^ "};

    fputc('(', maker->out);
    make_value(maker, 1);
    fputs(PICK(maker, ops), maker->out);
    make_value(maker, 1);
    if (random_below(maker->random, 4) == 0) {
        fputs(PICK(maker, joins), maker->out);
        make_condition(maker);
    }
    fputc(')', maker->out);
}

static void make_joined(struct maker *maker, int rows)
{
    static const char *const ops[] = {" + ", " - ", " * "};

    fputc('(', maker->out);
    make_value(maker, rows);
    fputs(PICK(maker, ops), maker->out);
    make_value(maker, random_below(maker->random, 3) == 0 ? 1 : rows);
    fputc(')', maker->out);
}

static void make_part(struct maker *maker, int rows)
{
    static const char *const parts[][3] = {
        {".z", ".x", ".y"}, {".xy", ".zy", ".xx"}, {".yzx", ".xxz", ".zyx"}};

    fputc('(', maker->out);
    make_value(maker, 3);
    fprintf(maker->out, ")%s", PICK(maker, parts[rows - 1]));
}

static void make_value(struct maker *maker, int rows)
{
    if (maker->depth <= 0 || random_below(maker->random, 5) == 0) {
        make_leaf(maker, rows);
        return;
    }
    maker->depth--;
    switch (random_below(maker->random, 6)) {
    case 0:
    case 1:
        make_call(maker, rows);
        break;
    case 2:
        fputc('(', maker->out);
        make_condition(maker);
        fputs(" ? ", maker->out);
        make_value(maker, rows);
        fputs(" : ", maker->out);
        make_value(maker, rows);
        fputc(')', maker->out);
        break;
    case 3:
        make_part(maker, rows);
        break;
    default:
        make_joined(maker, rows);
    }
    maker->depth++;
}

static void make_statement(struct maker *maker)
{
    static const struct {
        const char *place;
        int rows;
    } places[] = {{"a = ", 1},        {"b = ", 2},       {"c = ", 3},    {"a += 0.5 * ", 1},
                  {"b.yx = ", 2},     {"c.zx -= ", 2},   {"c[n] = ", 1}, {"m[n] = ", 3},
                  {"e[1 + n] = ", 1}, {"m[2].zy = ", 2}, {"p *= ", 1}};
    switch (random_below(maker->random, 6)) {
    case 0:
        fputs("if ", maker->out);
        make_condition(maker);
        fputs(" { ", maker->out);
        break;
    case 1:
        fprintf(maker->out, "for (int i = 0; i < %zu; i++) { if ",
                1 + random_below(maker->random, 4));
        make_condition(maker);
        fprintf(maker->out, " %s;\n", random_below(maker->random, 2) == 0 ? "break" : "continue");
        break;
    case 2:
        fputs("{ n = (n + int(a * 8.0)) % 3; n = abs(n); ", maker->out);
        break;
    case 3:
        fputs("{ change(b.x, c); ", maker->out);
        break;
    default:
        fputs("{ ", maker->out);
    }
    const size_t which = random_below(maker->random, sizeof places / sizeof places[0]);
    fputs(places[which].place, maker->out);
    make_value(maker, places[which].rows);
    fputs("; a = clamp(a, -4.0, 4.0); b = clamp(b, -4.0, 4.0); c = clamp(c, -4.0, 4.0);\n"
          "p = clamp(p, -4.0, 4.0); }\n",
          maker->out);
}

char *random_code_make(struct random *random)
{
    char *text = NULL;
    size_t length;
    struct maker maker = {random, open_memstream(&text, &length), 3};

    fputs("void change(inout float x, out vec3 y) { y += vec3(x); x = fract(x * 0.5); }\n"
          "float sdf(vec3 p) {\nfloat a = p.y; vec2 b = p.xz; vec3 c = p * 0.5;\n"
          "mat3 m = mat3(p, c, p.yzx); float e[4] = float[4](0.5, p.x, 1.0, p.z); int n = 1;\n",
          maker.out);
    for (size_t i = 2 + random_below(random, 5); i > 0; i--) {
        make_statement(&maker);
    }
    fputs("return a + dot(b, vec2(0.5)) + dot(c, p) * 0.25 + e[n] + m[1][n]; }\n", maker.out);
    fclose(maker.out);
    return text;
}

/* --- changing --- */

/* One change: a token taken out, doubled, or taken from elsewhere; or a byte. */
void random_code_damage(struct random *random, char *text, size_t size)
{
    static const char bytes[] = "(){}[];,.+-*/%&|^~!?:=<>#\\\"'09aex_ \n\x80\xff";
    const size_t length = strlen(text);
    const size_t from = random_below(random, length), to = random_below(random, length);
    size_t count = 1 + random_below(random, 12);
    char part[16];

    count = count < length - from ? count : length - from;
    memcpy(part, text + from, count);
    switch (random_below(random, 4)) {
    case 0:
        memmove(text + from, text + from + count, length - from - count + 1);
        break;
    case 1:
        if (length + count < size) {
            memmove(text + to + count, text + to, length - to + 1);
            memcpy(text + to, part, count);
        }
        break;
    case 2:
        text[to] = bytes[random_below(random, sizeof bytes - 1)];
        break;
    default:
        count = count < length - to ? count : length - to;
        memmove(text + to, part, count);
    }
    if (*text == '\0') {
        strcpy(text, "x");
    }
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_' || c == '.';
}

/* Letters and digits, or one mark or two, from anywhere in the text; blanks: 0. */
static size_t token_at(const char *text, size_t at)
{
    size_t length = 0;

    while (is_word(text[at + length])) {
        length++;
    }
    if (length > 0 || !strchr("+-*/%<>=!&|^?,", text[at])) {
        return length;
    }
    return text[at + 1] != '\0' && strchr("=&|<>+-^", text[at + 1]) ? 2 : 1;
}

void random_code_swap(struct random *random, char *text, size_t size)
{
    static const char *const marks[] = {
        "+", "-", "*", "/",  "%",  "<", ">",  "<=", ">=", "==", "!=", "&&",  "||", "^^",
        "&", "|", "^", "<<", ">>", "=", "+=", "-=", "*=", "/=", "%=", "<<=", ","};
    static const char *const words[] = {"float", "int",   "uint",    "bool",        "vec2",  "vec3",
                                        "vec4",  "ivec2", "uvec3",   "bvec3",       "mat2",  "mat3",
                                        "p",     "p.xy",  "p.x",     "int(p.x)",    "p.zyx", "0",
                                        "1",     "2.5",   "7u",      "true",        "1e38",  "-1",
                                        "s",     "a[i]",  "vec2(1)", "mat3(p,p,p)", "{1,2}"};
    size_t length = strlen(text), at = random_below(random, length);

    while (at > 0 && is_word(text[at]) && is_word(text[at - 1])) {
        at--;
    }
    const size_t old = token_at(text, at);
    if (old == 0) {
        return;
    }
    const char *now = is_word(text[at]) ? words[random_below(random, sizeof words / sizeof *words)]
                                        : marks[random_below(random, sizeof marks / sizeof *marks)];
    const size_t count = strlen(now);
    if (length - old + count < size) {
        memmove(text + at + count, text + at + old, length - at - old + 1);
        memcpy(text + at, now, count);
    }
}
