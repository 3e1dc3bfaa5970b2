/* SPDX-License-Identifier: MIT */
/* The language of equations: what is read and printed, every error with its place, every limit from
 * both sides, and texts by chance. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/equation.h"
#include "renderer/code/equation_pole.h"
#include "renderer/code/equation_value.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

static const char *const letters[] = {"a", "b", "c", "d", NULL};

static struct equation *read(const char *text)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, letters, &errors);

    if (!equation) {
        fail_msg("%s\n%d:%d: %s", text, errors.list[0].line, errors.list[0].column,
                 errors.list[0].message);
    }
    return equation;
}

/* --- what is read --- */

#define X 0.3
#define Y -1.7
#define Z 2.2
#define A 0.5
static const double point[3] = {X, Y, Z}, values[4] = {A, 2, 3, 4};

/* `value`: of left - right at that point. */
static const struct {
    const char *text, *printed;
    double value;
} good[] = {
    {"x", "x = 0", X},
    {"x = y", "x = y", X - Y},
    {"x < y", "x < y", X - Y},
    {"x <= y", "x <= y", X - Y},
    {"x > y", "x > y", Y - X},
    {"x >= y", "x >= y", Y - X},
    {"x \u2264 y", "x <= y", X - Y},
    {"x \u2265 y", "x >= y", Y - X},
    {"x + y - z", "x + y - z = 0", X + Y - Z},
    {"x - (y - z)", "x - (y - z) = 0", X - (Y - Z)},
    {"x - y + z", "x - y + z = 0", X - Y + Z},
    {"x*y/z", "x*y/z = 0", X *Y / Z},
    {"x/(y*z)", "x/(y*z) = 0", X / (Y * Z)},
    {"x/y*z", "x/y*z = 0", X / Y *Z},
    {"2x", "2*x = 0", 2 * X},
    {"3(x + 1)", "3*(x + 1) = 0", 3 * (X + 1)},
    {"(x + 1)(y - 2)", "(x + 1)*(y - 2) = 0", (X + 1) * (Y - 2)},
    {"(x + 1)y", "(x + 1)*y = 0", (X + 1) * Y},
    {"x(y + 1)", "x*(y + 1) = 0", X *(Y + 1)},
    {"a(x + 1)", "a*(x + 1) = 0", A *(X + 1)},
    {"pi(x + 1)", "pi*(x + 1) = 0", M_PI *(X + 1)},
    {"2x^2y - 1", "2*x^2*y - 1 = 0", 2 * X *X *Y - 1},
    {"-x^2", "-x^2 = 0", -X *X},
    {"(-x)^2", "(-x)^2 = 0", X *X},
    {"2^3^x", "2^3^x = 0", 0},
    {"(2^x)^3", "(2^x)^3 = 0", 0},
    {"x^-2", "x^-2 = 0", 1 / (X * X)},
    {"x ** 3", "x^3 = 0", X *X *X},
    {"x\u00b2 + y\u00b3", "x^2 + y^3 = 0", X *X + Y *Y *Y},
    {"x\u00b7y \u00d7 z \u2212 1", "x*y*z - 1 = 0", X *Y *Z - 1},
    {"\u03c0x", "pi*x = 0", 0},
    {"\u03c0*x", "pi*x = 0", M_PI *X},
    {"x\u00b2y", "x^2*y = 0", X *X *Y},
    {"2\u03c0*x", "2*pi*x = 0", 2 * M_PI *X},
    {"\u221a(z) + x", "sqrt(z) + x = 0", 0},
    {"2\u221a(z)", "2*sqrt(z) = 0", 0},
    {"|x - y|", "abs(x - y) = 0", X - Y},
    {"|x| + |y|", "abs(x) + abs(y) = 0", X - Y},
    {"|(x - |y|)|", "abs(x - abs(y)) = 0", -Y - X},
    {"r := x^2 + y^2; r^2 = r*z", "(x^2 + y^2)^2 = (x^2 + y^2)*z", 0},
    {"k := 2; m := k + 1; m*x", "(2 + 1)*x = 0", 3 * X},
    {"x^(1 + 1)", "x^2 = 0", X *X},
    {"x^(2^2)", "x^4 = 0", X *X *X *X},
    {"x^4^0.5", "x^2 = 0", X *X},
    {"x^(1/2)", "x^(1/2) = 0", 0},
    {"z^a", "z^a = 0", 0},
    {"1e-3x + .5y + 2.", "0.001*x + 0.5*y + 2 = 0", 1e-3 * X + .5 * Y + 2},
    {"0.1 = x", "0.1 = x", 0.1 - X},
    {"hypot(x, y) = 1", "sqrt(x^2 + y^2) = 1", 0},
    {"clamp(x, 1, 2)", "min(max(x, 1), 2) = 0", 1},
    {"mix(x, y, a)", "x + (y - x)*a = 0", (X + Y) / 2},
    {"log2(z)", "log(z)/log(2) = 0", 0},
    {"pow(x, 3) + pow(z, a)", "x^3 + z^a = 0", 0},
    {"min(x, y) + max(x, y)", "min(x, y) + max(x, y) = 0", X + Y},
    {"54 x y z", "54*x*y*z = 0", 54 * X *Y *Z},
    {"x y^2 sin(z)", "x*y^2*sin(z) = 0", 0},
    {"pi x - a y", "pi*x - a*y = 0", M_PI *X - A *Y},
    {"sign(y) + floor(x) + ceil(z)", "sign(y) + floor(x) + ceil(z) = 0", -1 + 0 + 3},
    {"fract(z)", "z - floor(z) = 0", Z - 2},
    {"mod(y, 2)", "y - 2*floor(y/2) = 0", Y + 2},
    {"step(x, y) + 2 step(y, x)", "0.5*(1 + sign(y - x)) + 2*(0.5*(1 + sign(x - y))) = 0", 2},
    {"smoothstep(0, 1, x)",
     "min(max((x - 0)/(1 - 0), 0), 1)^2*(3 - 2*min(max((x - 0)/(1 - 0), 0), 1)) = 0",
     X *X *(3 - 2 * X)},
    {"atan2(y, x)", "atan2(y, x) = 0", 0},
    {"x + cheb(0, y)", "x + 1 = 0", X + 1},
    {"cheb(1, y)", "y = 0", Y},
    {"cheb(3, x)", "2*(x*(2*x^2 - 1)) - x = 0", 4 * X *X *X - 3 * X},
    {"cheb(8, x)", "2*(2*(2*x^2 - 1)^2 - 1)^2 - 1 = 0", -0.76222592},
    {"+x", "x = 0", X},
    {"- -x", "--x = 0", X},
    {"x\n  + y\n\t= 1", "x + y = 1", X + Y - 1},
    {"e*x + tau*y + phi*z", "e*x + tau*y + phi*z = 0", 0},
};

static void texts_are_read_and_printed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        struct equation *equation = read(good[i].text);
        char *printed = equation_print(equation, letters);
        struct equation *again = read(printed);
        char *twice = equation_print(again, letters);
        const double value = equation_value(equation, point, values);
        assert_string_equal(printed, good[i].printed);
        assert_string_equal(twice, printed);
        if (good[i].value != 0) {
            assert_float_equal(value, good[i].value, 1e-12);
        }
        assert_float_equal(value, equation_value(again, point, values), 1e-12);
        free(printed);
        free(twice);
        free(equation);
        free(again);
    }
}

/* In another expression the same: what is printed is read as the same, and the value is known. */
static void texts_are_read_within_others(void **state)
{
    static const struct {
        const char *before, *after;
        double factor, more;
    } around[] = {
        {"y - (", ")", -1, Y}, {"2(", ")\u00b7z", 2 * Z, 0}, {"k9 := ", "; k9 + 1", 1, 1}};
    int count = 0;
    (void)state;

    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        if (strpbrk(good[i].text, "<=>") || strstr(good[i].text, "\u2264") ||
            strstr(good[i].text, "\u2265")) {
            continue;
        }
        struct equation *alone = read(good[i].text);
        for (size_t k = 0; k < sizeof around / sizeof around[0]; k++, count++) {
            char text[200];
            snprintf(text, sizeof text, "%s%s%s", around[k].before, good[i].text, around[k].after);
            struct equation *equation = read(text);
            char *printed = equation_print(equation, letters);
            struct equation *again = read(printed);
            char *twice = equation_print(again, letters);
            const double value = equation_value(again, point, values);
            const double expected =
                around[k].more + around[k].factor * equation_value(alone, point, values);
            assert_string_equal(twice, printed);
            assert_true(fabs(value - expected) <= 1e-12 * fmax(fabs(expected), 1));
            free(printed);
            free(twice);
            free(equation);
            free(again);
        }
        free(alone);
    }
    assert_in_range(count, 150, 1000);
}

/* --- what is refused --- */

static const struct {
    const char *text;
    int line, column;
    const char *words;
} bad[] = {
    {"", 1, 1, "expected a number, a name or \"(\", found the end"},
    {"x +", 1, 4, "found the end"},
    {"x + * y", 1, 5, "found \"*\""},
    {"x = y = z", 1, 7, "a second relation"},
    {"x = y < z", 1, 7, "a second relation"},
    {"(x + y", 1, 7, "expected \")\" for the \"(\" in line 1, column 1"},
    {"x + (y*(z + 1)", 1, 15, "for the \"(\" in line 1, column 5"},
    {"x + y)", 1, 6, "nothing is open"},
    {"|x + y", 1, 7, "expected \"|\""},
    {"sin(x", 1, 6, "expected \")\" for the \"(\" in line 1, column 4"},
    {"\u03c0*x +\n\u03c0*(y", 2, 5, "for the \"(\" in line 2, column 3"},
    {"xy = 1", 1, 1, "write x*y"},
    {"z + xyz", 1, 5, "write x*y*z"},
    {"ax + 1", 1, 1, "write a*x"},
    {"sine(x)", 1, 1, "did you mean \"sin\""},
    {"coz(x)", 1, 1, "did you mean \"cos\""},
    {"q + x", 1, 1, "\"q\" is no name; the letters are a, b, c, d; or define it before: q := 1"},
    {"radius*x", 1, 1, "or define it before: radius := 1"},
    {"x = PI", 1, 5, "\"PI\" is no name; did you mean \"pi\"?"},
    {"y + X", 1, 5, "did you mean \"x\"?"},
    {"ln(x)", 1, 1, "\"ln\" is no function; did you mean \"log\"?"},
    {"Sin(x)", 1, 1, "did you mean \"sin\"?"},
    {"arctan(x)", 1, 1, "did you mean \"atan\"?"},
    {"frob(x)", 1, 1, "\"frob\" is no function"},
    {"sin + x", 1, 1, "write sin(...)"},
    {"x + max", 1, 5, "write max(..., ...)"},
    {"sin(x, y)", 1, 1, "sin() takes 1 argument, not 2"},
    {"max(x)", 1, 1, "max() takes 2 arguments, not 1"},
    {"clamp(x, 1)", 1, 1, "clamp() takes 3 arguments, not 2"},
    {"1 + 2 = 3", 1, 1, "no x, y or z"},
    {"a = b", 1, 1, "no x, y or z"},
    {"x + 1e99", 1, 5, "above the maximum"},
    {"x + 0x10", 1, 6, "\"x10\" is no name"},
    {"x^9^9", 1, 3, "exponent 387420489; the limit is 64 (equation_exponent)"},
    {"x + 1/0", 1, 1, "a division by 0"},
    {"x + 1000000^64", 1, 1, "more than a number may be"},
    {"x + 10000000", 1, 5, "above the maximum"},
    {"x^65", 1, 3, "the limit is 64"},
    {"x^-65", 1, 3, "the limit is 64"},
    {"x # y", 1, 3, "unexpected \"#\""},
    {"cheb(65, x)", 1, 1, "whole number n from 0 to 64"},
    {"cheb(1/2, x)", 1, 1, "whole number n"},
    {"cheb(a, x)", 1, 1, "whole number n"},
    {"x xy", 1, 3, "write x*y"},
    {"x, y", 1, 2, "unexpected \",\""},
    {"r := x + y", 1, 11, "expected \";\""},
    {"x := 2; x", 1, 1, "has a meaning already"},
    {"sin := 2; x", 1, 1, "has a meaning already"},
    {"r := 2; r := 3; x", 1, 9, "defined twice"},
    {"r := ; x", 1, 6, "found \";\""},
    {"x\n+ y\n+ q", 3, 3, "\"q\" is no name"},
    {"\u03c0*x + q", 1, 7, "\"q\" is no name"},
    {"x\u00b2 + q", 1, 6, "\"q\" is no name"},
    {"x + \u00fc", 1, 5, "found \"\u00fc\""},
    {"x = ", 1, 5, "found the end"},
    {"x + abcdefghijklmnopqrstuvwxyzabcdefghij", 1, 5, "at most 31 letters"},
    {"()", 1, 2, "found \")\""},
    {"sin()", 1, 5, "found \")\""},
    {"x^", 1, 3, "found the end"},
    {"x ** ** y", 1, 6, "found \"*\""},
};

static void errors_have_their_place(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct equation_errors errors;
        struct equation *equation = equation_read(bad[i].text, letters, &errors);
        const struct equation_error *first = &errors.list[0];
        if (equation || first->line != bad[i].line || first->column != bad[i].column ||
            !strstr(first->message, bad[i].words)) {
            fail_msg("%s\n%d:%d: %s", bad[i].text, first->line, first->column,
                     equation ? "is read" : first->message);
        }
    }
}

/* Errors of the whole text stand at its begin, and definitions have to be there. */
static bool moves(const char *text, const char *words)
{
    static const char *const whole[] = {"no x, y or z", "a division by 0", "more than a number"};

    for (size_t i = 0; i < sizeof whole / sizeof whole[0]; i++) {
        if (strstr(words, whole[i])) {
            return false;
        }
    }
    return !strstr(text, ":=");
}

static void places_follow_the_text(void **state)
{
    static const struct {
        const char *text;
        int lines, columns; /* what follows begins so many later */
    } before[] = {
        {"z + ", 0, 4},        {"\u03c0\u00d7z +", 0, 5},   {"|y|\u00b2\n +", 1, 2},
        {"w := x;\n\n", 2, 0}, {"(x\n-\ty)\u00b7\n", 2, 0},
    };
    int count = 0;
    (void)state;

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        for (size_t k = 0; k < sizeof before / sizeof before[0]; k++) {
            struct equation_errors errors;
            char text[200];
            if (!moves(bad[i].text, bad[i].words)) {
                continue;
            }
            snprintf(text, sizeof text, "%s%s", before[k].text, bad[i].text);
            const struct equation *equation = equation_read(text, letters, &errors);
            const struct equation_error *first = &errors.list[0];
            const int line = bad[i].line + before[k].lines;
            const int column = bad[i].column + (bad[i].line == 1 ? before[k].columns : 0);
            if (equation || first->line != line || first->column != column ||
                (!strstr(bad[i].words, "in line") && !strstr(first->message, bad[i].words))) {
                fail_msg("%s\n%d:%d, not %d:%d: %s", text, first->line, first->column, line, column,
                         equation ? "is read" : first->message);
            }
            count++;
        }
    }
    assert_in_range(count, 150, 1000);
}

static void several_errors_are_told(void **state)
{
    struct equation_errors errors;
    (void)state;

    assert_null(equation_read("q + sine(x)\n + max(y) + (z", letters, &errors));
    assert_int_equal(errors.count, 4);
    assert_int_equal(errors.list[1].column, 5);
    assert_int_equal(errors.list[2].line, 2);
    assert_int_equal(errors.list[3].column, 15);
    assert_null(equation_read("q+q+q+q+q+q+q+q+q+q", letters, &errors));
    assert_int_equal(errors.count, EQUATION_ERRORS);
}

static void all_errors_are_told_as_one(void **state)
{
    static const struct {
        const char *text, *message;
    } rows[] = {
        {"x + y)", "nothing is open that \")\" could close"},
        {"sine(x) + max(y)", "\"sine\" is no function; did you mean \"sin\"? (also 1:11: max() "
                             "takes 2 arguments, not 1)"},
        {"sine(x)\n+ max(y) + (z",
         "\"sine\" is no function; did you mean \"sin\"? (also 2:3: max() takes 2 arguments, not "
         "1; "
         "2:14: expected \")\" for the \"(\" in line 2, column 12, found the end)"},
        {"sine(x) + sine(y) + coz(z)", "\"sine\" is no function; did you mean \"sin\"? (also 1:21: "
                                       "\"coz\" is no function; did you "
                                       "mean \"cos\"?)"},
        {"q + r + w + k",
         "\"q\" is no name; the letters are a, b, c, d; or define it before: q := 1 (also 1:5: "
         "\"r\" "
         "is no name; the letters are a, b, c, d; or define it before: r := 1; 1:9: \"w\" is no "
         "name; the letters are a, b, c, d; or define it before: w := 1; and 1 more)"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct equation_errors errors;
        struct error err = {0};
        assert_null(equation_read(rows[i].text, letters, &errors));
        assert_false(equation_errors_tell(&errors, ERROR_COMPILE, "/here", &err));
        assert_string_equal(err.message, rows[i].message);
        assert_string_equal(err.place, "/here");
        assert_int_equal(err.line, errors.list[0].line);
        assert_int_equal(err.column, errors.list[0].column);
    }
}

/* --- limits --- */

static bool is_read(const char *text)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, letters, &errors);

    free(equation);
    return equation != NULL;
}

/* `part` again and again: # is the number of the time, from 1, @ the one before. */
static char *repeated(const char *head, const char *part, int times, const char *tail)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fputs(head, out);
    for (int i = 0; i < times; i++) {
        for (const char *c = part; *c; c++) {
            if (*c == '#' || *c == '@') {
                fprintf(out, "%d", i + (*c == '#'));
            } else {
                fputc(*c, out);
            }
        }
    }
    fputs(tail, out);
    fclose(out);
    return text;
}

static void limits_hold_on_both_sides(void **state)
{
    static const struct {
        const char *head, *part, *tail;
        int most;
    } rows[] = {
        {"", "(", "x", LIMIT_EQUATION_DEPTH - 1}, /* closed below */
        {"", "2(", "x", LIMIT_EQUATION_DEPTH - 1},
        {"", "x sin(", "x", LIMIT_EQUATION_DEPTH - 1},
        {"", "(x)(", "x", LIMIT_EQUATION_DEPTH - 1},
        {"", "-", "x", LIMIT_EQUATION_DEPTH - 1},
        {"", "\u221a", "x", LIMIT_EQUATION_DEPTH - 1},
        {"", "k# := x + #;", "x", LIMIT_EQUATION_DEFINITIONS},
        {"x", "+ #.25", "", (LIMIT_EQUATION_NODES - 2) / 2}, /* besides x and 0 */
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        for (int over = 0; over < 2; over++) {
            const bool opens = rows[i].part[strlen(rows[i].part) - 1] == '(';
            char *text = repeated(rows[i].head, rows[i].part, rows[i].most + over, rows[i].tail);
            char *closed = repeated(text, ")", opens ? rows[i].most + over : 0, "");
            if (is_read(closed) != !over) {
                fail_msg("row %zu: %d", i, rows[i].most + over);
            }
            free(text);
            free(closed);
        }
    }
    assert_true(is_read("x^64 + y^-64"));
    assert_true(is_read("cheb(64, x)"));
    assert_true(is_read("x + 1000000"));
    assert_false(is_read("x + 1000001"));
    assert_false(is_read("x - 1000001"));
    assert_true(is_read("k0 := x + y; k1 := k0*k0; k2 := k1*k1; k3 := k2*k2; k4 := k3*k3; k4"));
}

/* k13 has 16,383 operations with all definitions written out. */
static void weights_are_bounded(void **state)
{
    static const struct {
        const char *tail;
        bool is_read;
    } rows[] = {{"k13", true}, {"-k13", true}, {"--k13", false}, {"k13 + k13", false}};
    (void)state;

    assert_int_equal(LIMIT_EQUATION_WEIGHT, 1 << 14);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char *text = repeated("k0 := x;", "k# := k@ + k@;", 13, rows[i].tail);
        assert_int_equal(is_read(text), rows[i].is_read);
        free(text);
    }
}

static void names_are_bounded(void **state)
{
    (void)state;
    for (int over = 0; over < 2; over++) {
        struct equation_errors errors;
        char *text = repeated("", "q", 31 + over, "*x");
        assert_null(equation_read(text, letters, &errors));
        assert_non_null(strstr(errors.list[0].message, over ? "at most 31 letters" : "is no name"));
        free(text);
    }
}

static void texts_are_bounded(void **state)
{
    (void)state;
    for (int over = 0; over < 2; over++) {
        struct error err = {0};
        char *text = repeated("{'format':'fieldcast/1','root':{'type':'implicit','params':"
                              "{'equation':'x",
                              " ", LIMIT_EQUATION_BYTES - 1 + over, "'}}}");
        struct scene *scene = json_text_scene(text, &err);
        assert_int_equal(scene == NULL, over);
        scene_destroy(scene);
        free(text);
    }
}

/* --- by chance --- */

/* Whatever the text is, it is read or refused at a place in it; what is read is printed as it will
 * be read. EQUATION_TEXTS=10000000 tries that many. */
static void random_texts_do_no_harm(void **state)
{
    static const char *const parts[] = {
        "x", "y", "z", "a",  "2",      "0.5",  "(", ")",  "+",  "-",
        "*", "/", "^", "^2", "sin(",   "max(", ",", "=",  "<",  " ",
        "|", ";", "r", ":=", "\u00b2", "pi",   ".", "1e", "\n", "hypot("};

    enum { ROUNDS = 20000, PARTS = sizeof parts / sizeof parts[0] };
    const char *asked = getenv("EQUATION_TEXTS");
    const int rounds = asked ? atoi(asked) : ROUNDS;
    struct random random = {.state = 99 + (uint64_t)rounds};
    int valid = 0;
    (void)state;
    for (int round = 0; round < rounds; round++) {
        char text[256] = "";
        struct equation_errors errors;
        const size_t length = 1 + random_below(&random, 14);
        for (size_t i = 0; i < length; i++) {
            strcat(text, parts[random_below(&random, PARTS)]);
        }
        struct equation *equation = equation_read(text, letters, &errors);
        if (!equation) {
            assert_true(errors.count > 0 && errors.list[0].column > 0 &&
                        errors.list[0].column <= (int)strlen(text) + 1);
            continue;
        }
        char *printed = equation_print(equation, letters);
        struct equation *again = read(printed);
        char *twice = equation_print(again, letters);
        assert_string_equal(printed, twice);
        free(printed);
        free(twice);
        free(equation);
        free(again);
        valid++;
    }
    assert_true(valid > rounds / 200);
}

/* --- poles --- */

static const struct {
    enum equation_break what;
    const char *texts[8];
} breaks[] = {
    {EQUATION_POLE, {"y = 1/(x - a)", "y = tan(x)", "y = x/(x^2 - y^2)", "y < 1/x^3"}},
    {EQUATION_JUMP, {"y = floor(x)", "z = sign(x - y)", "atan2(y, x) = 0.1"}},
    {EQUATION_UNBROKEN,
     {"y = x^3", "x*y*z = 1", "y = 1/(x^2 + 1)", "y = 1/x^2", "|x| = y", "y = cbrt(x)",
      "y = log(x)"}},
    {EQUATION_UNBROKEN,
     {"y = sqrt(x)", "y = 1e6*x", "y = x*floor(2)", "max(x, y) = z", "y = exp(9*x)"}},
};

static void poles_are_told_from_zeros(void **state)
{
    static const struct equation_clip clip = {.half = {2, 2, 2}};
    (void)state;

    for (size_t i = 0; i < sizeof breaks / sizeof *breaks; i++) {
        for (const char *const *text = breaks[i].texts; *text; text++) {
            struct equation *equation = read(*text);
            double at[3];
            const enum equation_break found = equation_pole(equation, values, &clip, at);
            if (found != breaks[i].what) {
                fail_msg("%s: %d, not %d", *text, found, breaks[i].what);
            }
            free(equation);
        }
    }
}

static void a_pole_has_its_place(void **state)
{
    static const struct equation_clip clip = {.half = {2, 2, 2}}, small = {.half = {0.4, 2, 2}};
    double at[3];
    (void)state;
    struct equation *equation = read("y = 1/(x - a)");

    assert_int_equal(equation_pole(equation, values, &clip, at), EQUATION_POLE);
    assert_true(fabs(at[0] - A) < 1e-6 && fabs(at[1]) <= 2 && fabs(at[2]) <= 2);
    assert_int_equal(equation_pole(equation, values, &small, at), EQUATION_UNBROKEN);
    free(equation);
}

static void a_ball_has_no_corners(void **state)
{
    static const struct equation_clip box = {.half = {1, 1, 1}},
                                      ball = {.half = {1, 1, 1}, .ball = true};
    double at[3];
    (void)state;
    struct equation *equation = read("1/(x + y - 1.6) = z");

    assert_int_equal(equation_pole(equation, values, &box, at), EQUATION_POLE);
    assert_int_equal(equation_pole(equation, values, &ball, at), EQUATION_UNBROKEN);
    free(equation);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_are_read_and_printed),
        cmocka_unit_test(errors_have_their_place),
        cmocka_unit_test(texts_are_read_within_others),
        cmocka_unit_test(places_follow_the_text),
        cmocka_unit_test(several_errors_are_told),
        cmocka_unit_test(all_errors_are_told_as_one),
        cmocka_unit_test(limits_hold_on_both_sides),
        cmocka_unit_test(weights_are_bounded),
        cmocka_unit_test(names_are_bounded),
        cmocka_unit_test(texts_are_bounded),
        cmocka_unit_test(random_texts_do_no_harm),
        cmocka_unit_test(poles_are_told_from_zeros),
        cmocka_unit_test(a_pole_has_its_place),
        cmocka_unit_test(a_ball_has_no_corners),
    };

    return cmocka_run_group_tests_name("equations", tests, NULL, NULL);
}
