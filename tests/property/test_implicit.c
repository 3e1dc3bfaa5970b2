/* SPDX-License-Identifier: MIT */
/* The distances of implicit equations are lower bounds: within them the function does not change
 * its sign. Their signs are the function's, the engine agrees with the evaluator in C, and where
 * surfaces have a known distance the bound comes near it.
 *
 * EQUATION_CASES=50000: so many random equations, ten boxes each. */
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
#include "renderer/code/equation_value.h"
#include "tests/support/code_engine.h"
#include "tests/support/equation_rows.h"

enum { POINTS = 400, SAMPLES = 33 };

/* Points of the ball of this radius that are not of f's sign. */
static int count_other_side(struct random *random, const struct equation *equation,
                            const double p[3], double radius, double f)
{
    int count = 0;

    for (int i = 0; i < SAMPLES; i++) {
        double way[3], q[3];
        random_direction(random, way);
        for (int k = 0; k < 3; k++) {
            q[k] = p[k] + 0.9999 * radius * way[k];
        }
        const double there = equation_value(equation, q, equation_rows_values);
        count += (f < 0) != (there < 0) && fabs(there) > 1e-6;
    }
    return count;
}

static void the_sign_holds_within_the_distance(void **state)
{
    struct random random = {.state = 15};
    (void)state;

    for (size_t e = 0; e < equation_rows_count; e++) {
        struct field *field = equation_rows_field(equation_rows[e].text, ",'size':[6,6,6]");
        struct equation *equation = equation_rows_read(equation_rows[e].text);
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            /* Farther from the box than from the surface, mostly. */
            equation_rows_point(&random, 1.4, p);
            const double f = equation_value(equation, p, equation_rows_values);
            const double d = field_distance(field, p);
            if (fabs(f) < 1e-6) {
                continue;
            }
            if ((d < 0) != (f < 0) || count_other_side(&random, equation, p, fabs(d), f) > 0) {
                fail_msg("%s at (%.9g, %.9g, %.9g): distance %g, value %g", equation_rows[e].text,
                         p[0], p[1], p[2], d, f);
            }
        }
        free(equation);
        field_unref(field);
    }
}

/* --- where something draws at a distance of the surface --- */

#define ROUNDED 0.05

static struct field *rounded_field(const char *text, const char *more)
{
    static const char *const around[2] = {"{'type':'round','params':{'radius':0.05},'children':[",
                                          "]}"};

    return equation_rows_field_in(around, text, more);
}

static void distances_to_round_hold_the_sign(void **state)
{
    struct random random = {.state = 16};
    int known = 0;
    (void)state;

    for (size_t e = 0; e < equation_rows_count; e++) {
        struct field *field = rounded_field(equation_rows[e].text, ",'size':[6,6,6]");
        struct equation *equation = equation_rows_read(equation_rows[e].text);
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            equation_rows_point(&random, 1.4, p);
            const double f = equation_value(equation, p, equation_rows_values);
            const double d = field_distance(field, p) + ROUNDED;
            known += fabs(d) > 0.02;
            if (fabs(f) > 1e-6 && fabs(d) > 1e-6 &&
                ((d < 0) != (f < 0) || count_other_side(&random, equation, p, fabs(d), f) > 0)) {
                fail_msg("%s at (%.9g, %.9g, %.9g): distance %g, value %g", equation_rows[e].text,
                         p[0], p[1], p[2], d, f);
            }
        }
        free(equation);
        field_unref(field);
    }
    assert_true(known > (int)equation_rows_count * POINTS / 2);
}

/* In the clip, at its faces and around it: a ray that goes on by the distance meets the surface
 * that is drawn at 0.05, and nothing of a jump is seen in it. */
static void distances_to_round_change_by_no_more_than_the_way(void **state)
{
    struct random random = {.state = 17};
    (void)state;

    for (size_t e = 0; e < 2 * equation_rows_count; e++) {
        const bool sheet = e % 2 != 0;
        const char *text = equation_rows[e / 2].text;
        struct field *field = rounded_field(text, sheet ? ",'mode':'sheet','size':[2,2,2]"
                                                        : ",'clip':'ball','radius':1.2");
        for (int i = 0; i < POINTS; i++) {
            double p[3], way[3], q[3];
            const double length = pow(10, random_between(&random, -3, 0));
            equation_rows_point(&random, 2.5, p);
            random_direction(&random, way);
            for (int k = 0; k < 3; k++) {
                q[k] = p[k] + length * way[k];
            }
            const double change = fabs(field_distance(field, p) - field_distance(field, q));
            if (change > 1.002 * length + 1e-6) {
                fail_msg("%s at (%.9g, %.9g, %.9g): changes by %g on a way of %g", text, p[0], p[1],
                         p[2], change, length);
            }
        }
        field_unref(field);
    }
}

/* A distance around the clip: beyond its margin it is that to the clip, whatever the equation is,
 * and nowhere does it lead beyond a point of the solid. */
static double around_clip(bool ball, const double p[3])
{
    double square = 0;

    for (int i = 0; i < 3; i++) {
        const double beyond = ball ? fabs(p[i]) : fmax(fabs(p[i]) - 1, 0);
        square += beyond * beyond;
    }
    return ball ? sqrt(square) - 1 : sqrt(square);
}

enum { INSIDE = 2000 };

static size_t points_inside(struct random *random, bool ball, double out[INSIDE][3])
{
    struct equation *equation = equation_rows_read("x^3 + y*z < 0.1");
    size_t count = 0;

    while (count < INSIDE) {
        equation_rows_point(random, 1, out[count]);
        const double clip = around_clip(ball, out[count]);
        count += clip <= 0 && equation_value(equation, out[count], equation_rows_values) < 0;
    }
    free(equation);
    return count;
}

/* That of an equation which is code; a polynomial is asked everywhere. */
static void the_clip_is_the_distance_beyond_its_margin(void **state)
{
    static const char *const texts[] = {"x^3 + y*z < 0.1", "x^3 + y*z - 0.1 < 0*exp(x)"};
    static double inside[INSIDE][3];
    struct random random = {.state = 18};
    (void)state;

    for (int each = 0; each < 4; each++) {
        const bool ball = each & 1, code = each & 2;
        const double margin = EQUATION_MARGIN * (ball ? 1 : sqrt(3));
        struct field *field = equation_rows_field(texts[code], ball ? ",'clip':'ball','radius':1"
                                                                    : ",'size':[2,2,2]");
        const size_t count = points_inside(&random, ball, inside);
        int beyond = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3], nearest = INFINITY;
            equation_rows_point(&random, 2, p);
            const double d = field_surface(field, p, NULL).distance, clip = around_clip(ball, p);
            for (size_t k = 0; k < count; k++) {
                nearest = fmin(nearest, hypot(hypot(p[0] - inside[k][0], p[1] - inside[k][1]),
                                              p[2] - inside[k][2]));
            }
            assert_true(d <= nearest);
            assert_true(clip <= 0 || d >= clip - 1e-9);
            if (clip > margin) {
                assert_true(!code || d <= clip + 1e-9);
                beyond++;
            }
        }
        assert_in_range(beyond, POINTS / 4, POINTS);
        field_unref(field);
    }
}

/* --- random equations --- */

enum { RANDOM_EQUATIONS = 100, BOXES = 10, RANDOM_DEPTH = 4 };

/* Beyond a jump or a pole a distance may lead by a little. */
static bool has_jumps(enum equation_name name)
{
    return name == EQUATION_TAN || name == EQUATION_SIGN || name == EQUATION_FLOOR ||
           name == EQUATION_CEIL;
}

static const char *const leaves[] = {"x", "y", "z", "x", "y", "z", "a"};
static const char *const forms[] = {"(@ + @)",
                                    "(@ - @)",
                                    "(@)*(@)",
                                    "(@)/((@)^2 + 0.2)",
                                    "(@)^2",
                                    "(@)^3",
                                    "-(@)^4",
                                    "min(@, @)",
                                    "max(@, @)",
                                    "atan2(@, (@)^2 + 0.1)",
                                    "(@)^2^0.5",
                                    "(sin(2x - z)*(@) + cos(2x - z)*(@))",
                                    "(cos(y)*(@) - sin(y)*(@))"};
enum { LEAVES = sizeof leaves / sizeof leaves[0], FORMS = sizeof forms / sizeof forms[0] };

static void write_random(struct random *random, int depth, FILE *out)
{
    size_t pick = random_below(random, FORMS + EQUATION_MIN);

    while (pick >= FORMS && has_jumps((enum equation_name)(pick - FORMS))) {
        pick = random_below(random, FORMS + EQUATION_MIN);
    }
    if (depth == 0) {
        fputs(leaves[random_below(random, LEAVES)], out);
    } else if (pick >= FORMS) {
        /* Of a constant that log() does not know, no digit is known later either. */
        const bool is_log = pick - FORMS == EQUATION_LOG;
        fprintf(out, "%s(%s", equation_functions[pick - FORMS].name, is_log ? "0.1 + (" : "");
        write_random(random, depth - 1, out);
        fputs(is_log ? ")^2)" : ")", out);
    } else {
        for (const char *c = forms[pick]; *c; c++) {
            if (*c == '@') {
                write_random(random, (int)random_below(random, (size_t)depth), out);
            } else {
                fputc(*c, out);
            }
        }
    }
}

/* The caller frees it. */
static char *random_equation(struct random *random)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    fputs("x*y + z*", out);
    write_random(random, RANDOM_DEPTH, out);
    fputs(" - ", out);
    write_random(random, RANDOM_DEPTH, out);
    fclose(out);
    return text;
}

/* The boxes are those around the distances: no point in them is of another sign. */
static void random_equations_keep_their_sign(void **state)
{
    struct random random = {.state = 2026};
    int free_boxes = 0;
    const int count = equation_rows_cases(RANDOM_EQUATIONS);
    (void)state;

    for (int e = 0; e < count; e++) {
        char *text = random_equation(&random);
        struct field *field = equation_rows_field(text, ",'size':[6,6,6]");
        struct equation *equation = equation_rows_read(text);
        for (int i = 0; i < BOXES; i++) {
            double p[3];
            equation_rows_point(&random, 1.4, p);
            const double f = equation_value(equation, p, equation_rows_values);
            const double d = field_distance(field, p);
            if (!(fabs(f) >= 1e-6) || fabs(d) < 1e-9) {
                continue; /* as tan(exp(40)), of which no digit is known */
            }
            if ((d < 0) != (f < 0) || count_other_side(&random, equation, p, fabs(d), f) > 0) {
                fail_msg("%s at (%.9g, %.9g, %.9g): distance %g, value %g", text, p[0], p[1], p[2],
                         d, f);
            }
            free_boxes += fabs(d) > 0.003;
        }
        free(equation);
        field_unref(field);
        free(text);
    }
    assert_in_range(free_boxes, BOXES * count / 2, BOXES * count);
}

/* --- sheets --- */

#define OCTIC(x) "128*" x "^8 - 256*" x "^6 + 160*" x "^4 - 32*" x "^2 + 1"
static const char *const sheets[] = {OCTIC("x") " + " OCTIC("y") " + " OCTIC("z"),
                                     "cheb(8, x) + cheb(8, y) + cheb(8, z)", "x^2 = y^2*z",
                                     "sin(4x)*cos(4y) + sin(4y)*cos(4z) + sin(4z)*cos(4x)"};
#define SHEET 0.02

/* A zero on the way between two points of different signs. */
static bool find_zero(const struct equation *equation, double p[3], double q[3])
{
    const bool below = equation_value(equation, p, equation_rows_values) < 0;

    if (below == (equation_value(equation, q, equation_rows_values) < 0)) {
        return false;
    }
    for (int i = 0; i < 40; i++) {
        double middle[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = 0.5 * (p[k] + q[k]);
        }
        const bool on = below == (equation_value(equation, middle, equation_rows_values) < 0);
        memcpy(on ? p : q, middle, sizeof middle);
    }
    return true;
}

/* What is outside has no point of the sheet within its distance; all zeros are in the middle of the
 * sheet, and what is in it is a small part of space. */
static void sheets_are_thin_and_whole(void **state)
{
    struct random random = {.state = 20};
    (void)state;

    for (size_t e = 0; e < sizeof sheets / sizeof sheets[0]; e++) {
        struct field *field =
            equation_rows_field(sheets[e], ",'mode':'sheet','thickness':0.02,'size':[4,4,4]");
        struct equation *equation = equation_rows_read(sheets[e]);
        int within = 0, zeros = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3], q[3], way[3];
            equation_rows_point(&random, 1, p);
            const double d = field_distance(field, p);
            within += d < 0;
            for (int k = 0; d > 0 && k < SAMPLES; k++) {
                random_direction(&random, way);
                for (int c = 0; c < 3; c++) {
                    q[c] = p[c] + 0.999 * d * way[c];
                }
                assert_true(field_distance(field, q) > -0.05 * SHEET);
            }
            equation_rows_point(&random, 1, q);
            if (find_zero(equation, p, q)) {
                zeros++;
                assert_true(field_distance(field, p) < -0.49 * SHEET);
            }
        }
        if (within > POINTS / 5 || zeros < POINTS / 20) {
            fail_msg("%s: %d points in the sheet, %d zeros", sheets[e], within, zeros);
        }
        free(equation);
        field_unref(field);
    }
}

static void the_engine_agrees(void **state)
{
    struct random random = {.state = 16};
    (void)state;

    for (size_t e = 0; e < 2 * equation_rows_count; e++) {
        static const char *const modes[] = {"", ",'mode':'sheet','thickness':0.1",
                                            ",'clip':'ball','radius':1.2"};
        const char *text = equation_rows[e / 2].text, *mode = modes[e / 2 % 3];
        struct field *field =
            e % 2 != 0 ? rounded_field(text, mode) : equation_rows_field(text, mode);
        float points[POINTS][3], got[POINTS];
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            equation_rows_point(&random, 2, p);
            for (int k = 0; k < 3; k++) {
                points[i][k] = (float)p[k];
            }
        }
        engine_agree(field, (const float(*)[3])points, POINTS, got);
        int apart = 0;
        for (int i = 0; i < POINTS; i++) {
            const double p[3] = {points[i][0], points[i][1], points[i][2]};
            const double d = field_distance(field, p);
            apart += fabs(got[i] - d) > 1e-3 * fmax(fabs(d), 0.01);
        }
        /* How often a box shrinks may differ where a comparison is close. */
        if (apart > POINTS / 50) {
            fail_msg("%s: %d of %d points differ", text, apart, POINTS);
        }
        field_unref(field);
    }
}

static double to_ball(const double p[3])
{
    return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1;
}

static double to_plane(const double p[3])
{
    return (p[0] + 2 * p[1] - 2 * p[2]) / 3;
}

static double to_torus(const double p[3])
{
    return hypot(hypot(p[0], p[2]) - 1, p[1]) - 0.4;
}

static void the_bound_comes_near(void **state)
{
    static const struct {
        const char *text;
        double (*distance)(const double p[3]);
        double least; /* part of the distance that is kept on the average */
    } rows[] = {{"x^2 + y^2 + z^2 = 1", to_ball, 0.4},
                {"x + 2y - 2z = 0", to_plane, 0.99},
                {"(sqrt(x^2 + z^2) - 1)^2 + y^2 = 0.16", to_torus, 0.3}};
    struct random random = {.state = 17};
    (void)state;
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        struct field *field = equation_rows_field(rows[r].text, ",'size':[20,20,20]");
        double kept = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            equation_rows_point(&random, 2, p);
            const double d = field_distance(field, p), exact = rows[r].distance(p);
            assert_true(fabs(d) <= fabs(exact) * (1 + 1e-9));
            kept += fabs(exact) > 0 ? fabs(d / exact) / POINTS : 0;
        }
        if (kept < rows[r].least) {
            fail_msg("%s: %g of the distance is kept", rows[r].text, kept);
        }
        field_unref(field);
    }
}

/* --- where a domain ends --- */

/* In the plane z = 0: y = g(x), also beyond the end of the domain of g. */
static double to_graph(const struct equation *equation, const double p[3])
{
    enum { PIECES = 4000 };
    double nearest = INFINITY, from[2] = {0};

    for (int i = 0; i <= PIECES; i++) {
        const double x = 6.0 * i / PIECES - 3;
        const double to[2] = {
            x, -equation_value(equation, (const double[]){x, 0, 0}, equation_rows_values)};
        const double way[2] = {to[0] - from[0], to[1] - from[1]};
        const double square = way[0] * way[0] + way[1] * way[1];
        const double along = ((p[0] - from[0]) * way[0] + (p[1] - from[1]) * way[1]) / square;
        const double part = fmin(fmax(along, 0), 1);
        const double off[2] = {p[0] - from[0] - part * way[0], p[1] - from[1] - part * way[1]};
        nearest = i > 0 ? fmin(nearest, hypot(off[0], off[1])) : nearest;
        from[0] = to[0];
        from[1] = to[1];
    }
    return nearest;
}

/* Where a domain ends, the slope may be without bound, while there is no zero near. */
static const struct {
    const char *sheet, *solid;
    double end;
} graphs[] = {{"y = log(x)", "y < log(x)", 0},
              {"y = sqrt(x)", "y < sqrt(x)", 0},
              {"y = x^1.5", "y < x^1.5", 0},
              {"y = asin(x)", "y < asin(x)", 1},
              {"y = acos(x)", "y < acos(x)", -1}};
#define LONGEST 0.8 /* at most this much of a distance has to be known */
enum { GRAPHS = sizeof graphs / sizeof graphs[0] };

static void point_at_end(struct random *random, double end, double out[3])
{
    const double way = pow(10, random_between(random, -8, 0));

    equation_rows_point(random, 2, out);
    out[0] = end + (random_below(random, 2) ? way : -way);
}

static void sheets_have_no_wall_at_the_end_of_a_domain(void **state)
{
    struct random random = {.state = 21};
    (void)state;

    for (size_t e = 0; e < GRAPHS; e++) {
        struct field *field =
            equation_rows_field(graphs[e].sheet, ",'mode':'sheet','thickness':0.05,"
                                                 "'size':[6,6,6]");
        struct equation *equation = equation_rows_read(graphs[e].sheet);
        int beside = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            point_at_end(&random, graphs[e].end, p);
            const double d = field_distance(field, p), exact = to_graph(equation, p);
            beside += exact > 0.05;
            if (d > exact || (exact > 0.05 && d < 0.02 * (fmin(exact, LONGEST) - 0.025))) {
                fail_msg("%s at (%.9g, %.9g, %.9g): distance %g, %g to the middle of the sheet",
                         graphs[e].sheet, p[0], p[1], p[2], d, exact);
            }
        }
        assert_true(beside > POINTS / 2);
        free(equation);
        field_unref(field);
    }
}

static void bounds_come_near_at_the_end_of_a_domain(void **state)
{
    struct random random = {.state = 22};
    (void)state;

    for (size_t e = 0; e < GRAPHS; e++) {
        struct field *field = equation_rows_field(graphs[e].solid, ",'size':[6,6,6]");
        struct equation *equation = equation_rows_read(graphs[e].solid);
        double kept = 0, least = 1;
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            point_at_end(&random, graphs[e].end, p);
            const double exact = to_graph(equation, p);
            const double part = fabs(field_distance(field, p)) / fmin(exact, LONGEST);
            kept += part / POINTS;
            least = exact > 0.05 ? fmin(least, part) : least;
        }
        print_message("# %s: %.2f of the distance is kept, %.2f at least\n", graphs[e].solid, kept,
                      least);
        assert_true(least > 0.05);
        free(equation);
        field_unref(field);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sign_holds_within_the_distance),
        cmocka_unit_test(distances_to_round_hold_the_sign),
        cmocka_unit_test(distances_to_round_change_by_no_more_than_the_way),
        cmocka_unit_test(random_equations_keep_their_sign),
        cmocka_unit_test(the_clip_is_the_distance_beyond_its_margin),
        cmocka_unit_test(sheets_are_thin_and_whole),
        cmocka_unit_test(the_engine_agrees),
        cmocka_unit_test(the_bound_comes_near),
        cmocka_unit_test(sheets_have_no_wall_at_the_end_of_a_domain),
        cmocka_unit_test(bounds_come_near_at_the_end_of_a_domain),
    };

    return cmocka_run_group_tests_name("implicit equations", tests, NULL, NULL);
}
