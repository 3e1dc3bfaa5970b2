/* SPDX-License-Identifier: MIT */
/* What the code of each function of equations says of it: its values and slopes in a box, its
 * gradient at a point. Every function has a row in tests/support/equation_rows.c.
 *
 * EQUATION_CASES=50000: so many ranges of each function. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/code/code.h"
#include "renderer/code/equation_code.h"
#include "renderer/code/equation_rules.h"
#include "renderer/code/equation_value.h"
#include "tests/support/equation_rows.h"

enum { POINTS = 400, SAMPLES = 33 };

/* --- ranges --- */

/* Of a function, by its row, while its arguments are within p.x +- q.x and p.y +- q.y: least and
 * greatest value, and least and greatest slope along the first argument and the second. */
static double range_of(const struct code *code, const double p[3], const double half[2], int which)
{
    const double numbers[] = {half[0], half[1], which};

    return code_distance(code, p, numbers, NULL);
}

static const struct param range_params[] = {{.name = "half_x", .type = PARAM_FLOAT},
                                            {.name = "half_y", .type = PARAM_FLOAT},
                                            {.name = "which", .type = PARAM_FLOAT},
                                            {.name = NULL}};

static struct code *range_code(enum equation_name name)
{
    struct error err = {0};
    char text[4000], call[64];
    const bool one = equation_functions[name].arguments == 1;

    snprintf(call, sizeof call, one ? "jet_of(x, range_%s(x[2].xy))" : "jet_%s(x, y)",
             equation_functions[name].name);
    const int length =
        snprintf(text, sizeof text,
                 "%s%s\nfloat sdf(vec3 p)\n{\n"
                 "mat3 x = mat3(vec3(1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), vec3(p.x - half_x, p.x + "
                 "half_x, 0.0));\n"
                 "mat3 y = mat3(vec3(0.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(p.y - half_y, p.y + "
                 "half_y, 0.0));\n"
                 "mat3 j = %s;\n"
                 "float n[6] = {j[2].x, j[2].y, j[0].x, j[1].x, j[0].y, j[1].y};\n"
                 "return clamp(n[int(which)], -9e8, 9e8);\n}\n",
                 equation_sizes, equation_rules[name].range,
                 name == EQUATION_SIN   ? "jet_of(x, jet_turn(x[2].xy))"
                 : name == EQUATION_COS ? "jet_cos(x, jet_turn(x[2].xy))"
                 : name == EQUATION_EXP ? "jet_exp(x)"
                                        : call);

    assert_in_range(length, 1, sizeof text - 1);
    struct code *code =
        code_compile(&(struct code_source){CODE_DISTANCE, text, range_params, true}, &err);
    if (!code) {
        fail_msg("%s: %s", equation_functions[name].name, err.message);
    }
    return code;
}

static double function_value(enum equation_name name, double x, double y)
{
    struct equation equation = {.count = 5, .left = 2, .right = 3};
    const double p[3] = {x, y, 0};

    equation.nodes[0] = (struct equation_node){.op = EQUATION_AXIS, .which = 0};
    equation.nodes[1] = (struct equation_node){.op = EQUATION_AXIS, .which = 1};
    equation.nodes[2] =
        (struct equation_node){.op = EQUATION_CALL, .which = (uint8_t)name, .args = {0, 1}};
    equation.nodes[3] = (struct equation_node){.op = EQUATION_NUMBER, .value = 0};
    equation.nodes[4] = equation.nodes[3];
    return equation_value(&equation, p, equation_rows_values);
}

/* Values between and differences between, by the mean value theorem; a slope of 1e9 or more says
 * that there may be a jump. */
static bool range_holds(enum equation_name name, const struct code *code, struct random *random)
{
    double p[3], half[2] = {random_between(random, 0, 0.6), random_between(random, 0, 0.6)}, n[6];

    equation_rows_point(random, 2.5, p);
    for (int i = 0; i < 6; i++) {
        n[i] = range_of(code, p, half, i);
    }
    for (int i = 0; i < SAMPLES; i++) {
        const double x = p[0] + random_between(random, -1, 1) * half[0];
        const double y = p[1] + random_between(random, -1, 1) * half[1];
        const double u = p[0] + random_between(random, -1, 1) * half[0];
        const double v = p[1] + random_between(random, -1, 1) * half[1];
        const double f = function_value(name, x, y), room = 1e-6 * (1 + fabs(f));
        const double along = function_value(name, u, y) - f, up = function_value(name, x, v) - f;
        const double a = n[2] * (u - x), b = n[3] * (u - x), c = n[4] * (v - y), d = n[5] * (v - y);
        const bool jumps = n[2] < -8e8 || n[3] > 8e8 || n[4] < -8e8 || n[5] > 8e8;
        if (jumps && f >= n[0] - room && f <= n[1] + room) {
            continue;
        }
        if (f < n[0] - room || f > n[1] + room || along < fmin(a, b) - room ||
            along > fmax(a, b) + room || up < fmin(c, d) - room || up > fmax(c, d) + room) {
            print_error("%s at (%g, %g) +- (%g, %g): %g in [%g, %g], slopes [%g, %g] [%g, %g]\n",
                        equation_functions[name].name, p[0], p[1], half[0], half[1], f, n[0], n[1],
                        n[2], n[3], n[4], n[5]);
            return false;
        }
    }
    return true;
}

static void ranges_hold_values_and_slopes(void **state)
{
    struct random random = {.state = 19};
    (void)state;

    for (int name = 0; name < EQUATION_FUNCTIONS; name++) {
        struct code *code = range_code((enum equation_name)name);
        for (int i = 0; i < equation_rows_cases(POINTS); i++) {
            assert_true(range_holds((enum equation_name)name, code, &random));
        }
        code_destroy(code);
    }
}

/* Boxes there are as large as the step that their slope allows. */
static void nothing_changes_outside_of_a_domain(void **state)
{
    static const struct {
        enum equation_name name;
        double outside;
    } rows[] = {{EQUATION_LOG, -0.5}, {EQUATION_SQRT, -0.5}, {EQUATION_ASIN, -1.5},
                {EQUATION_ASIN, 1.5}, {EQUATION_ACOS, -1.5}, {EQUATION_ACOS, 1.5}};
    (void)state;

    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        const double p[3] = {rows[r].outside, 0, 0}, half[2] = {0.4, 0};
        struct code *code = range_code(rows[r].name);
        for (int i = 2; i < 4; i++) {
            assert_float_equal(range_of(code, p, half, i), 0, 0);
        }
        code_destroy(code);
    }
}

/* --- gradients --- */

/* The function's gradient and value by itself, one of the four numbers at a time. */
static struct code *gradient_code(const char *text)
{
    static const struct param params[] = {
        {.name = "a", .type = PARAM_FLOAT}, {.name = "which", .type = PARAM_FLOAT}, {.name = NULL}};
    struct error err = {0};
    struct equation *equation = equation_rows_read(text);
    char *whole =
        equation_function_code(equation, equation_rows_letters,
                               "float sdf(vec3 p)\n{\nreturn function_at(p)[int(which)];\n}\n");
    struct code *code =
        code_compile(&(struct code_source){CODE_DISTANCE, whole, params, true}, &err);

    if (!code) {
        fail_msg("%s: %s", text, err.message);
    }
    free(equation);
    free(whole);
    return code;
}

static double gradient_at(const struct code *code, const double p[3], int which)
{
    return code_distance(code, p, (const double[]){equation_rows_values[0], which}, NULL);
}

/* By central differences, good to `room`; false: at a corner or a jump, where both sides differ. */
static bool difference_at(const struct equation *equation, const double p[3], int axis, double *out,
                          double *room)
{
    const double h = 1e-5, f = equation_value(equation, p, equation_rows_values);
    double values[4];

    for (int i = 0; i < 4; i++) {
        static const int steps[] = {-2, -1, 1, 2};
        double q[3] = {p[0], p[1], p[2]};
        q[axis] += steps[i] * h;
        values[i] = equation_value(equation, q, equation_rows_values);
    }
    const double left = (f - values[1]) / h, right = (values[2] - f) / h;
    *out = 0.5 * (left + right);
    *room = 1e-6 * fmax(1, fabs(*out)) + fabs((values[3] - values[0]) / (4 * h) - *out);
    return fabs(right - left) <= 1e-2 * fmax(1, fabs(*out));
}

static void gradients_are_those_of_differences(void **state)
{
    struct random random = {.state = 22};
    (void)state;

    for (size_t e = 0; e < equation_rows_count; e++) {
        struct code *code = gradient_code(equation_rows[e].text);
        struct equation *equation = equation_rows_read(equation_rows[e].text);
        int smooth = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3], expected, room;
            equation_rows_point(&random, 1.4, p);
            const double f = equation_value(equation, p, equation_rows_values);
            assert_float_equal(gradient_at(code, p, 3), f, 1e-12 * fmax(1, fabs(f)));
            const int axis = i % 3;
            if (!difference_at(equation, p, axis, &expected, &room)) {
                continue;
            }
            const double got = gradient_at(code, p, axis);
            if (!(fabs(got - expected) <= room)) {
                fail_msg("%s at (%.9g, %.9g, %.9g), axis %d: %.9g, not %.9g", equation_rows[e].text,
                         p[0], p[1], p[2], axis, got, expected);
            }
            smooth++;
        }
        assert_in_range(smooth, POINTS / 2, POINTS);
        free(equation);
        code_destroy(code);
    }
}

static void every_function_has_a_row(void **state)
{
    (void)state;
    for (int name = 0; name < EQUATION_FUNCTIONS; name++) {
        char call[24];
        bool found = false;
        snprintf(call, sizeof call, "%s(", equation_functions[name].name);
        for (size_t e = 0; e < equation_rows_count; e++) {
            found = found || ((int)equation_rows[e].function == name &&
                              (strstr(equation_rows[e].text, call) || name == EQUATION_ABS));
        }
        assert_true(found);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_has_a_row),
        cmocka_unit_test(ranges_hold_values_and_slopes),
        cmocka_unit_test(nothing_changes_outside_of_a_domain),
        cmocka_unit_test(gradients_are_those_of_differences),
    };

    return cmocka_run_group_tests_name("rules of equations", tests, NULL, NULL);
}
