/* SPDX-License-Identifier: MIT */
/* How well equations are drawn: analytic cases of each quality, with their places. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/code/equation_code.h"
#include "renderer/field/field_quality.h"
#include "tests/support/json_text.h"

enum { MOST = 8 };

struct told {
    struct equation_quality list[MOST];
    int count;
};

static void keep(void *data, const struct equation_quality *quality)
{
    struct told *told = data;

    assert_true(told->count < MOST);
    told->list[told->count++] = *quality;
}

static struct told judge_document(const char *text, const char *node)
{
    struct told told = {.count = 0};
    struct scene *scene = json_text_valid_scene(text);

    field_qualities(scene, node, keep, &told);
    scene_destroy(scene);
    return told;
}

static struct equation_quality judge(const char *params)
{
    char text[600];

    snprintf(text, sizeof text,
             "{'format': 'fieldcast/1', 'root': {'id': 'it', 'type': 'implicit', 'params': {%s}}}",
             params);
    const struct told told = judge_document(text, NULL);
    assert_int_equal(told.count, 1);
    return told.list[0];
}

static double share(const struct equation_quality *quality)
{
    return (double)quality->unresolved / quality->rays;
}

/* --- kinds --- */

/* `least`, `most`: of the share of unresolved rays. */
static const struct {
    const char *params;
    enum equation_quality_kind kind;
    int degree;
    double least, most;
} cases[] = {
    {"'equation': 'x^2+y^2+z^2 = 1'", QUALITY_POLYNOMIAL, 2, 0, 0},
    {"'equation': 'x^2+y^2+z^2 = a^2', 'clip': 'ball', 'radius': 3", QUALITY_POLYNOMIAL, 2, 0, 0},
    {"'equation': 'x*(y + z)^3/7 < 0.1', 'mode': 'sheet'", QUALITY_POLYNOMIAL, 4, 0, 0},
    {"'equation': 'sin(3*x)*cos(2*y) = z'", QUALITY_SAFE, -1, 0, 0},
    {"'equation': 'exp(-x^2-y^2) = z'", QUALITY_SAFE, -1, 0, 0},
    {"'equation': 'sqrt(x^2+y^2) = 0.7'", QUALITY_SAFE, -1, 0, 0},
    {"'equation': '|x|+|y|+|z| = 0.8'", QUALITY_SAFE, -1, 0, 0},
    {"'equation': '1/(x^2+y^2+0.5) = 1'", QUALITY_SAFE, -1, 0, 0},
    {"'equation': '1/x = y'", QUALITY_POLE, -1, 0, 0.1},
    {"'equation': 'tan(2*x) = y'", QUALITY_POLE, -1, 0, 0.1},
    {"'equation': 'floor(2*x) = y'", QUALITY_JUMP, -1, 0, 0.1},
    /* Of two signs nowhere: each ray that meets the surface. */
    {"'equation': '(x^2+y^2+z^2-1)^2 = 0'", QUALITY_POLYNOMIAL, 4, 0.4, 0.8},
    {"'equation': '(sin(3*x) - y)^2 = 0'", QUALITY_SAFE, -1, 0.6, 1},
    {"'equation': '|z| = 0'", QUALITY_SAFE, -1, 0.6, 1},
    /* Beyond the end of a domain the value stays, so there is no wall. */
    {"'equation': 'sqrt(x) = y'", QUALITY_SAFE, -1, 0, 0.01},
};

static void each_kind_is_told(void **state)
{
    (void)state;

    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct equation_quality quality = judge(cases[i].params);
        const double found = quality.rays ? share(&quality) : -1;
        if (quality.kind != cases[i].kind || quality.degree != cases[i].degree ||
            found < cases[i].least || found > cases[i].most) {
            fail_msg("%s: kind %d, degree %d, %d of %d rays", cases[i].params, quality.kind,
                     quality.degree, quality.unresolved, quality.rays);
        }
        assert_string_equal(quality.node, "it");
        assert_string_equal(quality.place, "/nodes/it/params/equation");
    }
}

static void a_pole_has_its_place(void **state)
{
    (void)state;
    const struct equation_quality pole = judge("'equation': 'y = 1/(x - a)', 'a': 0.5");
    const struct equation_quality outside = judge("'equation': 'y = 1/(x - a)', 'a': 1.6");

    assert_int_equal(pole.kind, QUALITY_POLE);
    assert_true(fabs(pole.at[0] - 0.5) < 1e-6);
    assert_int_equal(outside.kind, QUALITY_SAFE);
}

/* Whether the code of this equation reads the value of each of its letters. */
static void assert_letters_are_read(const char *text, int letters)
{
    const double form[EQUATION_FORM_NUMBERS] = {0};
    double values[EQUATION_LETTERS], out[4 * EQUATION_VECTORS];
    struct equation_errors errors;
    struct equation *equation = equation_read(text, equation_letters, &errors);

    assert_non_null(equation);
    for (int i = 0; i < EQUATION_LETTERS; i++) {
        values[i] = 1000 + i;
    }
    assert_int_equal(equation_code_numbers(equation, form, values, out), EQUATION_VECTORS);
    char *code = equation_code(equation, (struct equation_form){.ball = true});
    for (int i = 0; i < 4 * EQUATION_VECTORS; i++) {
        char place[32];
        snprintf(place, sizeof place, " = v%d.%c;", i / 4, "xyzw"[i % 4]);
        letters -= out[i] >= 1000 && strstr(code, place);
    }
    assert_int_equal(letters, 0);
    free(code);
    free(equation);
}

/* The code reads 59 letters and numbers; further numbers are written into it. */
static void letters_are_read_behind_many_numbers(void **state)
{
    (void)state;
    static const char begins[] = "'equation': '";
    char text[600] = "'equation': 'sin(3*x)";

    for (int i = 1; i <= 60; i++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), "+.%02d", i);
    }
    const size_t sum = strlen(text);
    snprintf(text + sum, sizeof text - sum, "= a");
    assert_letters_are_read(text + sizeof begins - 1, 1);
    snprintf(text + sum, sizeof text - sum, "= a+b+c+d+f+g+h+k+m+n+p+q+r+w");
    assert_letters_are_read(text + sizeof begins - 1, EQUATION_LETTERS);
    snprintf(text + sum, sizeof text - sum, "= a', 'a': 18.3");
    const struct equation_quality quality = judge(text);
    assert_int_equal(quality.kind, QUALITY_SAFE);
    assert_true(quality.rays > 0 && share(&quality) < 0.02);
}

/* --- documents --- */

static void every_node_of_a_document_is_judged(void **state)
{
    static const char text[] =
        "{'format': 'fieldcast/1', 'root': {'id': 'all', 'type': 'union', 'children': ["
        "{'id': 'a', 'type': 'implicit', 'params': {'equation': 'x = 0'}},"
        "{'id': 'b', 'type': 'sphere'},"
        "{'id': 'c', 'type': 'implicit', 'visible': false, 'transform': {'translation': [1, 2, "
        "3]}, "
        "'params': {'equation': '1/x = 0'}},"
        "{'id': 'd', 'type': 'implicit', 'params': {'equation': 'x +'}}]}}";
    (void)state;
    const struct told told = judge_document(text, NULL), one = judge_document(text, "c");

    assert_int_equal(told.count, 3);
    assert_int_equal(told.list[0].kind, QUALITY_POLYNOMIAL);
    assert_int_equal(told.list[1].kind, QUALITY_POLE);
    assert_string_equal(told.list[1].place, "/nodes/c/params/equation");
    assert_true(told.list[1].at[0] == 0);
    assert_int_equal(told.list[2].kind, QUALITY_UNKNOWN);
    assert_int_equal(one.count, 1);
    assert_string_equal(one.list[0].node, "c");
    assert_int_equal(judge_document(text, "b").count, 0);
}

/* --- words --- */

static void check_text(struct equation_quality quality, const char *expected)
{
    char text[QUALITY_TEXT_BYTES];

    assert_string_equal(equation_quality_text(&quality, text), expected);
}

static void words_say_what_was_found(void **state)
{
    (void)state;
    struct equation_quality quality = {.kind = QUALITY_POLYNOMIAL, .degree = 6, .rays = 400};

    check_text(quality, "exact polynomial of degree 6");
    quality.unresolved = 1;
    check_text(quality, "exact polynomial of degree 6, below 1 % unresolved");
    quality.kind = QUALITY_SAFE;
    quality.unresolved = 51;
    check_text(quality, "safe, 13 % unresolved");
    quality = (struct equation_quality){.kind = QUALITY_JUMP, .at = {1, -0.25, 0}};
    check_text(quality, "unsafe: jump at (1, -0.25, 0)");
    quality = (struct equation_quality){.kind = QUALITY_POLE, .at = {0, 0.12345, -2}};
    check_text(quality, "unsafe: pole at (0, 0.123, -2)");
}

/* --- parametric surfaces --- */

static const struct {
    const char *params, *text; /* without the error */
    double least, most;        /* of it */
    int left_out;
    bool thin;
} surfaces[] = {
    /* Bicubic: exact but for the last digit of floats. */
    {"'x': 's^3*t', 'y': 't^3', 'z': 's*t - s', 's': [0, 1], 't': [0, 1]", "1024 patches, off by ",
     0, 1e-6, 0, false},
    /* A part of the circle of an angle h: h^4 / 4! * 1.2 / 3^4, within a factor of 2. */
    {"'x': 'cos(s)', 'y': 't', 'z': 'sin(s)', 's': [0, 6.2832], 't': [0, 1]",
     "1024 patches, off by ", 4e-7, 1.2e-6, 0, false},
    {"'x': 'sin(90s)', 'y': 't', 'z': 's', 's': [0, 1], 't': [0, 1]",
     ", more than half of the thickness", 0.025, 0.4, 0, true},
    {"'x': 's + 0/s', 'y': 't', 'z': '0*s', 's': [0, 1], 't': [0, 1]", ", 32 of them not finite", 0,
     1e-6, 32, false},
};

static void surfaces_tell_their_error(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof surfaces / sizeof surfaces[0]; i++) {
        char text[600], told[QUALITY_TEXT_BYTES];
        snprintf(text, sizeof text,
                 "{'format': 'fieldcast/1', 'root': {'id': 'it', 'type': 'parametric', 'params': "
                 "{'surface': {%s}, 'thickness': 0.05}}}",
                 surfaces[i].params);
        const struct told all = judge_document(text, "it");
        assert_int_equal(all.count, 1);
        const struct equation_quality *quality = &all.list[0];
        assert_int_equal(quality->kind, QUALITY_SAMPLED);
        assert_string_equal(quality->place, "/nodes/it/params/surface");
        assert_int_equal(quality->patches, 1024);
        if (!(quality->error >= surfaces[i].least && quality->error <= surfaces[i].most)) {
            fail_msg("%s: %g", surfaces[i].params, quality->error);
        }
        assert_int_equal(quality->left_out, surfaces[i].left_out);
        assert_int_equal(quality->thin, surfaces[i].thin);
        assert_true(quality->box.low[1] < quality->box.high[1] && quality->box.high[1] < 1.1);
        assert_non_null(strstr(equation_quality_text(quality, told), surfaces[i].text));
    }
    const struct told none = judge_document(
        "{'format': 'fieldcast/1', 'root': {'id': 'it', 'type': 'parametric'}}", NULL);
    assert_int_equal(none.count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_is_told),
        cmocka_unit_test(a_pole_has_its_place),
        cmocka_unit_test(letters_are_read_behind_many_numbers),
        cmocka_unit_test(every_node_of_a_document_is_judged),
        cmocka_unit_test(words_say_what_was_found),
        cmocka_unit_test(surfaces_tell_their_error),
    };

    return cmocka_run_group_tests_name("quality of equations", tests, NULL, NULL);
}
