/* SPDX-License-Identifier: MIT */
/* The distances of implicit equations are lower bounds: within them the function does not change
 * its sign. Their signs are the function's, the engine agrees with the evaluator in C, and where
 * surfaces have a known distance the bound comes near it. Every function has a row here.
 *
 * EQUATION_CASES=50000: so many ranges of each function, and random equations, ten boxes each. */
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
#include "renderer/code/code.h"
#include "renderer/code/equation_code.h"
#include "renderer/code/equation_rules.h"
#include "renderer/code/equation_value.h"
#include "tests/support/code_engine.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

enum { POINTS = 400, SAMPLES = 33 };
static const char *const letters[] = {"a", "b", "c", "d", NULL};
static const double letter_values[] = {0.75, 1, 1, 1}; /* floats hold them */

/* `function`: the row of equation_functions that it is for; EQUATION_FUNCTIONS: none. */
static const struct {
    enum equation_name function;
    const char *text;
} equations[] = {
    {EQUATION_SIN, "sin(4x) + sin(5y) * sin(3z) = 0.2"},
    {EQUATION_COS, "cos(3x)*z + cos(4y + z) = a"},
    /* These share ranges, whichever comes first. */
    {EQUATION_FUNCTIONS, "sin(3x)*y + cos(3x)*z = 0.3*sin(4y)"},
    {EQUATION_FUNCTIONS, "cos(2x - y)*z + sin(2x - y)*cos(5z) = 0.2 + 0.1*sin(5z)"},
    {EQUATION_TAN, "tan(x)*y = z + tan(0.3z)"},
    {EQUATION_ASIN, "asin(x/2) + asin(y/3) = z"},
    {EQUATION_ACOS, "acos(x*y/3) = z + 1"},
    {EQUATION_ATAN, "atan(3x) + atan(2y*z) = 0.3"},
    {EQUATION_SINH, "sinh(x)*z = sinh(y) - 0.2"},
    {EQUATION_COSH, "cosh(x) + cosh(2y - z) = 3"},
    {EQUATION_TANH, "tanh(3x)*y + tanh(z) = 0.1"},
    {EQUATION_EXP, "exp(-4*(x^2 + y^2)) + exp(-4*((x - 1)^2 + z^2)) > 0.4"},
    {EQUATION_LOG, "log(x^2 + y^2 + 0.1) = z"},
    {EQUATION_SQRT, "(sqrt(x^2 + z^2) - 1)^2 + y^2 = 0.16"},
    {EQUATION_CBRT, "cbrt(x + 2) + cbrt(y*z) = 1.5"},
    {EQUATION_ABS, "|x|^3 + |y - z| = 0.8"},
    {EQUATION_SIGN, "sign(x - 0.3)*y + 2z = 0.1 + sign(y)"},
    {EQUATION_FLOOR, "floor(2x)*0.4 + y = z + fract(1.5y)"},
    {EQUATION_CEIL, "ceil(x + y)*z = mod(y, 0.7)"},
    {EQUATION_ATAN2, "atan2(y, x) + z = 0.4*atan2(z + 1, y - 2)"},
    {EQUATION_FUNCTIONS, "cheb(8, x) + cheb(6, y) + cheb(5, z) = 0"},
    {EQUATION_FUNCTIONS, "smoothstep(-1, 1, x) + step(0.2, y) = z"},
    {EQUATION_MIN, "min(x^2 + y^2, y^2 + z^2) = 0.2"},
    {EQUATION_MAX, "max(x^2 + y, z^2 - x*y) < 0.5"},
    {EQUATION_FUNCTIONS, "x^4 + y^4 + z^4 - x^2 - y^2 - z^2 + 0.4 = 0"},
    {EQUATION_FUNCTIONS, "(x^2 + 9/4*z^2 + y^2 - 1)^3 - x^2*y^3 - 9/80*z^2*y^3 = 0"},
    {EQUATION_FUNCTIONS, "x^2 = y^2*z"},
    {EQUATION_FUNCTIONS, "y/(x^2 + 1) = z^3 - a*x"},
    {EQUATION_FUNCTIONS, "(x^2 + 1)^-2 + y*z = (2 + x)^a"},
    {EQUATION_FUNCTIONS, "2^x - y^5*z + (y^2 + 1)^x = 1.5"},
    {EQUATION_FUNCTIONS, "1/(x^2 + 0.2) + 1/(y^2 + 0.3) > 3 - z/(2 + y)"},
    {EQUATION_FUNCTIONS, "x^18 + y^17*z - z^16 + x = 0.3"},
    /* Most of these points are outside of a domain. */
    {EQUATION_FUNCTIONS, "asin(2z) - log(x) = y"},
    {EQUATION_FUNCTIONS, "acos(3x) - sqrt(y) < z^a + 0.5"},
};
enum { EQUATIONS = sizeof equations / sizeof equations[0] };

/* `around`: what the node stands in, before and behind it. */
static struct field *field_in(const char *const around[2], const char *text, const char *more)
{
    struct error err = {0};
    char json[1024];

    snprintf(json, sizeof json,
             "{'format':'fieldcast/1','root':%s{'type':'implicit','params':{"
             "'equation':'%s','a':0.75%s}}%s}",
             around[0], text, more, around[1]);
    struct scene *scene = json_text_valid_scene(json);
    struct field *field = field_compile(scene, &err);
    if (!field) {
        fail_msg("%s: %d: %s", text, err.column, err.message);
    }
    scene_destroy(scene);
    return field;
}

static struct field *field_of(const char *text, const char *more)
{
    return field_in((const char *const[]){"", ""}, text, more);
}

static struct equation *read(const char *text)
{
    struct equation_errors errors;
    struct equation *equation = equation_read(text, letters, &errors);

    assert_non_null(equation);
    return equation;
}

static void random_point(struct random *random, double half, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (float)random_between(random, -half, half);
    }
}

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
        const double there = equation_value(equation, q, letter_values);
        count += (f < 0) != (there < 0) && fabs(there) > 1e-6;
    }
    return count;
}

static void the_sign_holds_within_the_distance(void **state)
{
    struct random random = {.state = 15};
    (void)state;

    for (size_t e = 0; e < EQUATIONS; e++) {
        struct field *field = field_of(equations[e].text, ",'size':[6,6,6]");
        struct equation *equation = read(equations[e].text);
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            random_point(&random, 1.4, p); /* farther from the box than from the surface, mostly */
            const double f = equation_value(equation, p, letter_values);
            const double d = field_distance(field, p);
            if (fabs(f) < 1e-6) {
                continue;
            }
            if ((d < 0) != (f < 0) || count_other_side(&random, equation, p, fabs(d), f) > 0) {
                fail_msg("%s at (%.9g, %.9g, %.9g): distance %g, value %g", equations[e].text, p[0],
                         p[1], p[2], d, f);
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

    return field_in(around, text, more);
}

static void distances_to_round_hold_the_sign(void **state)
{
    struct random random = {.state = 16};
    int known = 0;
    (void)state;

    for (size_t e = 0; e < EQUATIONS; e++) {
        struct field *field = rounded_field(equations[e].text, ",'size':[6,6,6]");
        struct equation *equation = read(equations[e].text);
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            random_point(&random, 1.4, p);
            const double f = equation_value(equation, p, letter_values);
            const double d = field_distance(field, p) + ROUNDED;
            known += fabs(d) > 0.02;
            if (fabs(f) > 1e-6 && fabs(d) > 1e-6 &&
                ((d < 0) != (f < 0) || count_other_side(&random, equation, p, fabs(d), f) > 0)) {
                fail_msg("%s at (%.9g, %.9g, %.9g): distance %g, value %g", equations[e].text, p[0],
                         p[1], p[2], d, f);
            }
        }
        free(equation);
        field_unref(field);
    }
    assert_true(known > (int)EQUATIONS * POINTS / 2);
}

/* In the clip, at its faces and around it: a ray that goes on by the distance meets the surface
 * that is drawn at 0.05, and nothing of a jump is seen in it. */
static void distances_to_round_change_by_no_more_than_the_way(void **state)
{
    struct random random = {.state = 17};
    (void)state;

    for (size_t e = 0; e < 2 * EQUATIONS; e++) {
        const bool sheet = e % 2 != 0;
        const char *text = equations[e / 2].text;
        struct field *field = rounded_field(text, sheet ? ",'mode':'sheet','size':[2,2,2]"
                                                        : ",'clip':'ball','radius':1.2");
        for (int i = 0; i < POINTS; i++) {
            double p[3], way[3], q[3];
            const double length = pow(10, random_between(&random, -3, 0));
            random_point(&random, 2.5, p);
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
    struct equation *equation = read("x^3 + y*z < 0.1");
    size_t count = 0;

    while (count < INSIDE) {
        random_point(random, 1, out[count]);
        const double clip = around_clip(ball, out[count]);
        count += clip <= 0 && equation_value(equation, out[count], letter_values) < 0;
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
        struct field *field =
            field_of(texts[code], ball ? ",'clip':'ball','radius':1" : ",'size':[2,2,2]");
        const size_t count = points_inside(&random, ball, inside);
        int beyond = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3], nearest = INFINITY;
            random_point(&random, 2, p);
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

static int cases(int usual)
{
    const char *asked = getenv("EQUATION_CASES");

    return asked ? atoi(asked) : usual;
}

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
    const int count = cases(RANDOM_EQUATIONS);
    (void)state;

    for (int e = 0; e < count; e++) {
        char *text = random_equation(&random);
        struct field *field = field_of(text, ",'size':[6,6,6]");
        struct equation *equation = read(text);
        for (int i = 0; i < BOXES; i++) {
            double p[3];
            random_point(&random, 1.4, p);
            const double f = equation_value(equation, p, letter_values);
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
    const bool below = equation_value(equation, p, letter_values) < 0;

    if (below == (equation_value(equation, q, letter_values) < 0)) {
        return false;
    }
    for (int i = 0; i < 40; i++) {
        double middle[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = 0.5 * (p[k] + q[k]);
        }
        const bool on = below == (equation_value(equation, middle, letter_values) < 0);
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
            field_of(sheets[e], ",'mode':'sheet','thickness':0.02,'size':[4,4,4]");
        struct equation *equation = read(sheets[e]);
        int within = 0, zeros = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3], q[3], way[3];
            random_point(&random, 1, p);
            const double d = field_distance(field, p);
            within += d < 0;
            for (int k = 0; d > 0 && k < SAMPLES; k++) {
                random_direction(&random, way);
                for (int c = 0; c < 3; c++) {
                    q[c] = p[c] + 0.999 * d * way[c];
                }
                assert_true(field_distance(field, q) > -0.05 * SHEET);
            }
            random_point(&random, 1, q);
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
    return equation_value(&equation, p, letter_values);
}

/* Values between and differences between, by the mean value theorem; a slope of 1e9 or more says
 * that there may be a jump. */
static bool range_holds(enum equation_name name, const struct code *code, struct random *random)
{
    double p[3], half[2] = {random_between(random, 0, 0.6), random_between(random, 0, 0.6)}, n[6];

    random_point(random, 2.5, p);
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
        for (int i = 0; i < cases(POINTS); i++) {
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
    struct equation *equation = read(text);
    char *whole = equation_function_code(
        equation, letters, "float sdf(vec3 p)\n{\nreturn function_at(p)[int(which)];\n}\n");
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
    return code_distance(code, p, (const double[]){letter_values[0], which}, NULL);
}

/* By central differences, good to `room`; false: at a corner or a jump, where both sides differ. */
static bool difference_at(const struct equation *equation, const double p[3], int axis, double *out,
                          double *room)
{
    const double h = 1e-5, f = equation_value(equation, p, letter_values);
    double values[4];

    for (int i = 0; i < 4; i++) {
        static const int steps[] = {-2, -1, 1, 2};
        double q[3] = {p[0], p[1], p[2]};
        q[axis] += steps[i] * h;
        values[i] = equation_value(equation, q, letter_values);
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

    for (size_t e = 0; e < EQUATIONS; e++) {
        struct code *code = gradient_code(equations[e].text);
        struct equation *equation = read(equations[e].text);
        int smooth = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3], expected, room;
            random_point(&random, 1.4, p);
            const double f = equation_value(equation, p, letter_values);
            assert_float_equal(gradient_at(code, p, 3), f, 1e-12 * fmax(1, fabs(f)));
            const int axis = i % 3;
            if (!difference_at(equation, p, axis, &expected, &room)) {
                continue;
            }
            const double got = gradient_at(code, p, axis);
            if (!(fabs(got - expected) <= room)) {
                fail_msg("%s at (%.9g, %.9g, %.9g), axis %d: %.9g, not %.9g", equations[e].text,
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
        for (size_t e = 0; e < EQUATIONS; e++) {
            found = found || ((int)equations[e].function == name &&
                              (strstr(equations[e].text, call) || name == EQUATION_ABS));
        }
        assert_true(found);
    }
}

static void the_engine_agrees(void **state)
{
    struct random random = {.state = 16};
    (void)state;

    for (size_t e = 0; e < 2 * EQUATIONS; e++) {
        static const char *const modes[] = {"", ",'mode':'sheet','thickness':0.1",
                                            ",'clip':'ball','radius':1.2"};
        const char *text = equations[e / 2].text, *mode = modes[e / 2 % 3];
        struct field *field = e % 2 != 0 ? rounded_field(text, mode) : field_of(text, mode);
        float points[POINTS][3], got[POINTS];
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            random_point(&random, 2, p);
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

/* A slider compiles nothing. */
static void letters_and_sizes_are_numbers(void **state)
{
    static const char text[] = "sin(a*x) + b*y = exp(z)*c";
    struct field *first = field_of(text, ""),
                 *other = field_of(text, ",'b':2.5,'c':-1,'size':[3,1,2],'thickness':0.3"),
                 *more = field_of("sin(a*x) + b*y = exp(z)*c*c", "");
    (void)state;

    assert_true(first->structure_hash == other->structure_hash);
    assert_true(first->structure_hash != more->structure_hash);
    field_unref(first);
    field_unref(other);
    field_unref(more);
}

/* In a node's equation, and in a material's function. */
static void every_letter_is_a_number(void **state)
{
    static const double p[3] = {0.3, 0.2, -0.1};
    (void)state;

    for (int i = 0; equation_letters[i]; i++) {
        const char *letter = equation_letters[i];
        char text[64], value[32], json[512];
        struct error err = {0};
        snprintf(text, sizeof text, "sin(%s*x) + y = exp(z)", letter);
        snprintf(value, sizeof value, ",'%s':0.5", letter);
        struct field *one = field_of(text, ""), *half = field_of(text, i > 0 ? value : "");
        assert_true(one->structure_hash == half->structure_hash);
        assert_true(i == 0 || fabs(field_distance(one, p) - field_distance(half, p)) > 1e-3);
        field_unref(one);
        field_unref(half);
        snprintf(json, sizeof json,
                 "{'format':'fieldcast/1','materials':{'m':{'shader':'map','properties':{"
                 "'function':'%s*x'%s}}},'root':{'type':'sphere','material':'m'}}",
                 letter, value);
        struct scene *scene = json_text_valid_scene(json);
        struct field *field = field_compile(scene, &err);
        if (!field) {
            fail_msg("%s: %s", letter, err.message);
        }
        field_unref(field);
        scene_destroy(scene);
    }
}

static void numbers_in_the_text_are_numbers(void **state)
{
    static const char text[] = "sin(2*x) + 0.5*y^2 = exp(z) + 1";
    static const double p[3] = {0.3, 0.2, -0.1};
    struct field *first = field_of(text, ""),
                 *other = field_of("sin(2.25*x) + 0.75*y^2 = exp(z) + 3", ""),
                 *more = field_of("sin(2*x) + 0.5*y^3 = exp(z) + 1", "");
    (void)state;

    assert_true(first->structure_hash == other->structure_hash);
    assert_true(first->structure_hash != more->structure_hash);
    assert_true(field_distance(first, p) < 0.9 * field_distance(other, p));
    field_unref(first);
    field_unref(other);
    field_unref(more);
}

#define WAVES(NUMBER, MORE)                                                                        \
    "{'type':'implicit','params':{'equation':'sin(" NUMBER "*x) = y + exp(z)'" MORE "}}"

static void equations_share_code_of_the_same_form(void **state)
{
    struct error err;
    struct scene *scene = json_text_valid_scene(
        "{'format':'fieldcast/1','root':{'type':'union','children':[" WAVES("2", "") "," WAVES(
            "3",
            "") "," WAVES("2",
                          ",'mode':'sheet'") ",{'type':'round','children':[" WAVES("2",
                                                                                   "") "]}]}}");
    struct field *field = field_compile(scene, &err);
    (void)state;

    assert_int_equal(field->code_count, 3);
    field_unref(field);
    scene_destroy(scene);
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
        struct field *field = field_of(rows[r].text, ",'size':[20,20,20]");
        double kept = 0;
        for (int i = 0; i < POINTS; i++) {
            double p[3];
            random_point(&random, 2, p);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_has_a_row),
        cmocka_unit_test(ranges_hold_values_and_slopes),
        cmocka_unit_test(nothing_changes_outside_of_a_domain),
        cmocka_unit_test(gradients_are_those_of_differences),
        cmocka_unit_test(the_sign_holds_within_the_distance),
        cmocka_unit_test(distances_to_round_hold_the_sign),
        cmocka_unit_test(distances_to_round_change_by_no_more_than_the_way),
        cmocka_unit_test(random_equations_keep_their_sign),
        cmocka_unit_test(the_clip_is_the_distance_beyond_its_margin),
        cmocka_unit_test(sheets_are_thin_and_whole),
        cmocka_unit_test(the_engine_agrees),
        cmocka_unit_test(letters_and_sizes_are_numbers),
        cmocka_unit_test(every_letter_is_a_number),
        cmocka_unit_test(numbers_in_the_text_are_numbers),
        cmocka_unit_test(equations_share_code_of_the_same_form),
        cmocka_unit_test(the_bound_comes_near),
    };

    return cmocka_run_group_tests_name("implicit equations", tests, NULL, NULL);
}
