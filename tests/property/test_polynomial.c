/* SPDX-License-Identifier: MIT */
/* Equations that are polynomials are drawn by their coefficients: which those are, that the
 * coefficients make the equation, and that distances are lower bounds and change no faster than the
 * way, also for hundreds of terms, where the values are sums of large numbers that cancel. The
 * oracle evaluates the text of the equation. */
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
#include "renderer/code/equation_expand.h"
#include "renderer/code/equation_value.h"
#include "renderer/sdf/polynomial.h"
#include "tests/support/code_engine.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

enum { POINTS = 300, SAMPLES = 33, TEXT = LIMIT_EQUATION_BYTES + 1 };
static const double letter_values[] = {0.7, 1, 1, 1};

static struct field *field_of(const char *text, const char *more)
{
    static char json[TEXT + 1024];
    struct error err = {0};

    snprintf(json, sizeof json,
             "{'format':'fieldcast/1','root':{'type':'implicit','params':{"
             "'equation':'%s'%s}}}",
             text, more);
    struct scene *scene = json_text_valid_scene(json);
    struct field *field = field_compile(scene, &err);
    if (!field) {
        fail_msg("%.80s: %d: %s", text, err.column, err.message);
    }
    scene_destroy(scene);
    return field;
}

static struct equation *read(const char *text)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, equation_letters, &errors);

    assert_non_null(equation);
    return equation;
}

/* One with as many terms as a degree has, or the limits allow: the product of planes and of itself
 * would be short. About 0 it is flat, and its terms cancel. */
static void write_dense(struct random *random, int degree, int every, char text[TEXT])
{
    size_t used = 0;
    int term = 0;

    for (int i = 0; i <= degree; i++) {
        for (int j = 0; j <= degree - i; j++) {
            for (int k = 0; k <= degree - i - j; k++) {
                if (term++ % every == 0) {
                    used += (size_t)snprintf(text + used, TEXT - used, "%+.2f*x^%d*y^%d*z^%d",
                                             random_between(random, -9, 9), i, j, k);
                }
            }
        }
    }
    assert_in_range(used, 1, TEXT - 1);
}

static void random_point(struct random *random, double half, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (float)random_between(random, -half, half);
    }
}

static void the_degree_is_known(void **state)
{
    static const struct {
        const char *text;
        int degree;
    } rows[] = {
        {"x", 1},
        {"x^2 + y*z = a", 2},
        {"k := x + y; (k^3 - z)^6 < sin(a)", 18},
        {"(k - z)^9 * x^9 > 0", 18},
        {"x^19 = y", -1},
        {"(x + y)^9 * z^10", -1},
        {"x/a + y/sqrt(5) = cheb(5, z)", 5},
        {"x^0 + y = 0", 1},
        {"x/y = z", -1},
        {"x^-1 = y", -1},
        {"x^a = y", -1},
        {"|x| = y", -1},
        {"k := sin(x); x = y", 1},
        {"sin(x) = y", -1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "%s%s", strstr(rows[i].text, "(k - z)") ? "k := b; " : "",
                 rows[i].text);
        struct equation *equation = read(text);
        if (equation_degree(equation) != rows[i].degree) {
            fail_msg("%s: degree %d", rows[i].text, equation_degree(equation));
        }
        free(equation);
    }
}

static double value_of(int degree, const double *c, const double p[3])
{
    double sum = 0;

    for (int i = 0; i <= degree; i++) {
        for (int j = 0; j <= degree - i; j++) {
            for (int k = 0; k <= degree - i - j; k++) {
                sum += *c++ * pow(p[0], i) * pow(p[1], j) * pow(p[2], k);
            }
        }
    }
    return sum;
}

static void coefficients_make_the_equation(void **state)
{
    static const char *const texts[] = {
        "(x^2 + 9/4*z^2 + y^2 - 1)^3 = x^2*y^3 + 9/80*z^2*y^3",
        "cheb(8, x) + cheb(6, y*a) > cheb(5, z) - phi",
        "r := x^2 + y^2; (r - z)^4 / (a - 3) - -x*y*sqrt(2 + b) >= r^2*tau",
        "(2x - y + a*z + 0.4)^9 < exp(c)*atan2(d, a)*z",
    };
    struct random random = {.state = 3};
    (void)state;

    for (size_t t = 0; t < sizeof texts / sizeof texts[0]; t++) {
        struct equation *equation = read(texts[t]);
        const double letters[] = {0.7, 1.2, -0.4, 2}, extent = 1.7;
        const int degree = equation_degree(equation);
        double c[POLYNOMIAL_COEFFICIENTS_MAX], factor = 0, most = 0;
        equation_expand(equation, letters, extent, degree, c);
        for (size_t i = 0; i <= polynomial_at(degree, degree, 0); i++) {
            most = fmax(most, fabs(c[i]));
        }
        assert_float_equal(most, 1, 1e-15);
        for (int i = 0; i < POINTS; i++) {
            double p[3], q[3];
            random_point(&random, 1, p);
            for (int k = 0; k < 3; k++) {
                q[k] = extent * p[k];
            }
            const double f = equation_value(equation, q, letters), g = value_of(degree, c, p);
            factor = i == 0 ? f / g : factor;
            assert_true(factor > 0);
            assert_float_equal(f / factor, g, 1e-11);
        }
        free(equation);
    }
}

static bool holds(struct random *random, const struct equation *equation, const struct field *field,
                  const double p[3])
{
    const double f = equation_value(equation, p, letter_values), d = field_distance(field, p);
    bool same = fabs(f) < 1e-4 || (d < 0) == (f < 0);

    for (int i = 0; i < SAMPLES; i++) {
        double along[3], q[3];
        random_direction(random, along);
        for (int k = 0; k < 3; k++) {
            q[k] = p[k] + 0.999 * fabs(d) * along[k];
        }
        const double there = equation_value(equation, q, letter_values);
        same = same && (fabs(there) < 1e-4 || (f < 0) == (there < 0));
        const double way = 0.1 * random_between(random, 0, 1);
        for (int k = 0; k < 3; k++) {
            q[k] = p[k] + way * along[k];
        }
        const bool slow = fabs(field_distance(field, q) - d) <= 1.05 * way + 1e-6;
        same = same && slow;
    }
    return same;
}

/* In the middle of the clip, where it is not asked for. */
static void many_terms_keep_the_bound(void **state)
{
    static const struct {
        int degree, every;
    } rows[] = {{3, 1}, {4, 1}, {6, 1}, {9, 1}, {12, 2}, {18, 6}};
    static char text[TEXT];
    struct random random = {.state = 9};
    (void)state;
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        write_dense(&random, rows[r].degree, rows[r].every, text);
        struct field *field = field_of(text, ",'size':[3,3,3]");
        struct equation *equation = read(text);
        assert_int_equal(field->code_count, 0);
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            random_point(&random, 0.7, p);
            if (!holds(&random, equation, field, p)) {
                fail_msg("degree %d, at (%g, %g, %g): distance %g, value %g", rows[r].degree, p[0],
                         p[1], p[2], field_distance(field, p),
                         equation_value(equation, p, letter_values));
            }
        }
        free(equation);
        field_unref(field);
    }
}

static void the_engine_agrees(void **state)
{
    static const char *const forms[] = {",'size':[2,2,2]",
                                        ",'mode':'sheet','thickness':0.1,'size':[2,2,2]",
                                        ",'clip':'ball','radius':1.2"};
    static char text[TEXT];
    struct random random = {.state = 21};
    (void)state;

    for (int f = 0; f < 3; f++) {
        float points[POINTS][3], got[POINTS];
        int apart = 0;
        write_dense(&random, 12 - 4 * f, 2, text);
        struct field *field = field_of(text, forms[f]);
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            random_point(&random, 1.3, p);
            for (int k = 0; k < 3; k++) {
                points[i][k] = (float)p[k];
            }
        }
        engine_agree(field, (const float(*)[3])points, POINTS, got);
        for (int i = 0; i < POINTS; i++) {
            const double p[3] = {points[i][0], points[i][1], points[i][2]};
            const double d = field_distance(field, p);
            apart += fabs(got[i] - d) > 2e-3 * fmax(fabs(d), 0.01);
        }
        if (apart > POINTS / 100) {
            fail_msg("degree %d: %d of %d points differ", 12 - 4 * f, apart, POINTS);
        }
        field_unref(field);
    }
}

/* All else is numbers, so nothing is compiled. */
static void the_program_depends_on_the_degree(void **state)
{
    static const struct {
        const char *text, *more;
        bool same;
    } rows[] = {{"x^3 + y*z = a", ",'a':0.3", true},
                {"x^3 + y*z = a", ",'a':0", true},
                {"z*y^2 + 4x - 1 < b", ",'mode':'sheet'", true},
                {"x^4 + y*z = a", "", false},
                {"sin(x) = y", "", false}};
    struct field *first = field_of("x^3 + y*z = a", ",'a':0.7");
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct field *field = field_of(rows[i].text, rows[i].more);
        assert_int_equal(field->structure_hash == first->structure_hash, rows[i].same);
        field_unref(field);
    }
    field_unref(first);
}

static void operations_are_bounded_without_coefficients(void **state)
{
    for (int over = 0; over < 2; over++) {
        static char text[TEXT], json[TEXT + 200];
        struct error err = {0};
        /* x, sin(x) and 0 besides two for each */
        size_t used = (size_t)snprintf(text, sizeof text, "sin(x)");
        for (int i = 1; i <= (LIMIT_EQUATION_OPERATIONS - 3) / 2 + over; i++) {
            used += (size_t)snprintf(text + used, sizeof text - used, " + %d.5", i);
        }
        snprintf(json, sizeof json,
                 "{'format':'fieldcast/1','root':{'type':'implicit','params':{'equation':'%s'}}}",
                 text);
        struct scene *scene = json_text_valid_scene(json);
        struct field *field = field_compile(scene, &err);
        assert_int_equal(field == NULL, over);
        assert_true(!over || strstr(err.message, "above the maximum 256 (equation_operations)"));
        field_unref(field);
        scene_destroy(scene);
    }
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_degree_is_known),
        cmocka_unit_test(coefficients_make_the_equation),
        cmocka_unit_test(many_terms_keep_the_bound),
        cmocka_unit_test(the_engine_agrees),
        cmocka_unit_test(the_program_depends_on_the_degree),
        cmocka_unit_test(operations_are_bounded_without_coefficients),
    };

    return cmocka_run_group_tests_name("polynomials", tests, NULL, NULL);
}
