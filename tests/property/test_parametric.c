/* SPDX-License-Identifier: MIT */
/* Parametric surfaces are sheets around what their expressions say: no distance is above the true
 * one, near the surface it is the true one, and the engine agrees. The oracles are closed forms and
 * a search over all parameters. What changes numbers alone compiles nothing; what cannot be read
 * says where. */
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
#include "renderer/field/field.h"
#include "renderer/sdf/patches.h"
#include "tests/support/code_engine.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

enum { POINTS = 2000, SEARCHED = 60, TEXT = 4096 };
#define THICKNESS 0.04 /* as scene_of() has it */

static struct scene *scene_of(const char *surface, const char *more)
{
    static char json[TEXT];

    snprintf(json, sizeof json,
             "{'format':'fieldcast/1','root':{'id':'it','type':'parametric','params':{"
             "%s'surface':{%s}%s}}}",
             strstr(more, "thickness") ? "" : "'thickness':0.04,", surface, more);
    return json_text_valid_scene(json);
}

static struct field *field_of(const char *surface, const char *more)
{
    struct error err = {0};
    struct scene *scene = scene_of(surface, more);
    struct field *field = field_compile(scene, &err);

    scene_destroy(scene);
    if (!field) {
        fail_msg("%s: %s: %d: %s", surface, err.place, err.column, err.message);
    }
    return field;
}

static void random_point(struct random *random, double half, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (float)random_between(random, -half, half);
    }
}

/* --- closed forms --- */

#define SPHERE                                                                                     \
    "'x':'cos(s)*cos(t)','y':'sin(s)','z':'cos(s)*sin(t)',"                                        \
    "'s':[-1.570796327,1.570796327],'t':[0,6.283185307]"
#define TORUS                                                                                      \
    "'x':'(1+a*cos(t))*cos(s)','y':'a*sin(t)','z':'(1+a*cos(t))*sin(s)',"                          \
    "'s':[0,6.283185307],'t':[0,6.283185307]"
#define SQUARE "'x':'u+v/2','y':'a-a','z':'v','u':[-1,1],'v':[-1,1]"

static double to_sphere(const double p[3])
{
    return fabs(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1);
}

static double to_torus(const double p[3])
{
    return fabs(hypot(hypot(p[0], p[2]) - 1, p[1]) - 0.4);
}

static double to_thin_torus(const double p[3])
{
    return fabs(hypot(hypot(p[0], p[2]) - 1, p[1]) - 0.05);
}

/* A sheared square: the parallelogram's sides have the direction x, and (1/2, 1). */
static double to_square(const double p[3])
{
    double best = 1e9;

    for (int i = -1; i <= 1; i += 2) {
        const double along = fmin(fmax(p[0] - 0.5 * i, -1), 1) + 0.5 * i;
        best = fmin(best, hypot(p[0] - along, p[2] - i));
        const double x = p[0] - i, share = fmin(fmax((0.5 * x + p[2]) / 1.25, -1), 1);
        best = fmin(best, hypot(x - 0.5 * share, p[2] - share));
    }
    const bool inside = fabs(p[2]) <= 1 && fabs(p[0] - p[2] / 2) <= 1;
    return hypot(inside ? 0 : best, p[1]);
}

static const struct closed {
    const char *surface, *more;
    double (*distance)(const double p[3]);
    double tolerance; /* of the patches */
} closed_forms[] = {
    {SPHERE, "", to_sphere, 3e-6},
    {SPHERE, ",'detail':'coarse'", to_sphere, 5e-5},
    {TORUS, ",'a':0.4", to_torus, 5e-6},
    {TORUS, ",'a':0.4,'detail':'finest'", to_torus, 1e-6},
    {TORUS, ",'a':0.05", to_thin_torus, 5e-6},
    {SQUARE, "", to_square, 1e-6},
};

static void distances_are_those_of_closed_forms(void **state)
{
    struct random random = {.state = 5};
    (void)state;

    for (size_t i = 0; i < sizeof closed_forms / sizeof closed_forms[0]; i++) {
        const struct closed *row = &closed_forms[i];
        struct field *field = field_of(row->surface, row->more);
        int near = 0;
        for (int n = 0; n < POINTS; n++) {
            double p[3];
            random_point(&random, n % 2 ? 1.2 : 2.5, p);
            const double want = row->distance(p) - THICKNESS / 2, got = field_distance(field, p);
            const bool close = want < 0.04;
            near += close;
            if (got > want + row->tolerance || (close && got < want - row->tolerance) ||
                got < fmin(0.6 * want, want) - row->tolerance) {
                fail_msg("%s%s: at (%g, %g, %g): %g instead of %g", row->surface, row->more, p[0],
                         p[1], p[2], got, want);
            }
        }
        assert_true(near > POINTS / 120);
        field_unref(field);
    }
}

/* --- a search --- */

static void helicoid(double s, double t, double out[3])
{
    const double r = 2 * s - 1, turn = 12 * t;

    out[0] = r * cos(turn);
    out[1] = 0.15 * (turn - 6);
    out[2] = r * sin(turn);
}

static void klein(double s, double t, double out[3])
{
    const double u = 2 * M_PI * s, v = 2 * M_PI * t;
    const double r = 1 + (cos(u / 2) * sin(v) - sin(u / 2) * sin(2 * v)) / 2;

    out[0] = r * cos(u);
    out[1] = (sin(u / 2) * sin(v) + cos(u / 2) * sin(2 * v)) / 2;
    out[2] = r * sin(u);
}

/* A patch of degree 3 and 3: the patches are it. */
static void bicubic(double s, double t, double out[3])
{
    out[0] = 2 * s - 1 + t * t * (1 - t) * s;
    out[1] = s * (1 - s) * (2 * s - 1) * 3 + t * t * t / 2;
    out[2] = 2 * t - 1 + s * s * t / 3;
}

static double way_to(void (*surface)(double s, double t, double out[3]), double s, double t,
                     const double p[3])
{
    double at[3];

    surface(s, t, at);
    return hypot(hypot(at[0] - p[0], at[1] - p[1]), at[2] - p[2]);
}

static double search(void (*surface)(double s, double t, double out[3]), const double p[3])
{
    enum { ACROSS = 150, ROUNDS = 16 };
    double best = INFINITY, at[2] = {0};

    for (int i = 0; i <= ACROSS * ACROSS + 2 * ACROSS; i++) {
        const double s = (double)(i % (ACROSS + 1)) / ACROSS, t = i / (ACROSS + 1.0) / ACROSS;
        const double here = way_to(surface, s, floor(t * ACROSS) / ACROSS, p);
        if (here < best) {
            best = here;
            at[0] = s;
            at[1] = floor(t * ACROSS) / ACROSS;
        }
    }
    for (double step = 1.0 / ACROSS, round = 0; round < ROUNDS; round++, step /= 2) {
        const double from[2] = {at[0], at[1]};
        for (int k = 0; k < 49; k++) {
            const double s = fmin(fmax(from[0] + (k % 7 - 3) * step / 3, 0), 1);
            const double t = fmin(fmax(from[1] + (k / 7 - 3) * step / 3, 0), 1);
            const double here = way_to(surface, s, t, p);
            if (here < best) {
                best = here;
                at[0] = s;
                at[1] = t;
            }
        }
    }
    return best;
}

#define HELICOID "'x':'s*cos(t)','y':'b*0.15*(t-6)','z':'s*sin(t)','s':[-1,1],'t':[0,12]"
#define KLEIN                                                                                      \
    "'x':'(1+(cos(u/2)*sin(v)-sin(u/2)*sin(2v))/2)*cos(u)',"                                       \
    "'y':'(sin(u/2)*sin(v)+cos(u/2)*sin(2v))/2',"                                                  \
    "'z':'(1+(cos(u/2)*sin(v)-sin(u/2)*sin(2v))/2)*sin(u)',"                                       \
    "'u':[0,6.283185307],'v':[0,6.283185307]"
#define BICUBIC                                                                                    \
    "'x':'2s-1+t^2*(1-t)*s','y':'3s*(1-s)*(2s-1)+t^3/2','z':'2t-1+s^2*t/3','s':[0,1],'t':[0,1]"

static void distances_are_those_of_a_search(void **state)
{
    static const struct {
        const char *surface;
        void (*point)(double s, double t, double out[3]);
        double tolerance;
    } rows[] = {{HELICOID, helicoid, 2e-5}, {KLEIN, klein, 1e-5}, {BICUBIC, bicubic, 1e-6}};
    struct random random = {.state = 8};
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct field *field = field_of(rows[i].surface, "");
        for (int n = 0; n < SEARCHED; n++) {
            double p[3], q[3];
            if (n % 3 == 0) {
                random_point(&random, 1.6, p);
            } else {
                random_point(&random, 0.08, q);
                rows[i].point(random_between(&random, 0, 1), random_between(&random, 0, 1), p);
                for (int k = 0; k < 3; k++) {
                    p[k] = (float)(p[k] + q[k]);
                }
            }
            const double want = search(rows[i].point, p) - THICKNESS / 2;
            const double got = field_distance(field, p);
            if (got > want + rows[i].tolerance || (n % 3 && got < want - rows[i].tolerance)) {
                fail_msg("%s: at (%g, %g, %g): %g instead of %g", rows[i].surface, p[0], p[1], p[2],
                         got, want);
            }
        }
        field_unref(field);
    }
}

/* --- the engine --- */

static void the_engine_agrees(void **state)
{
    static const char *const surfaces[] = {SPHERE, TORUS, SQUARE, HELICOID, KLEIN, BICUBIC};
    struct random random = {.state = 21};
    (void)state;

    for (size_t i = 0; i < sizeof surfaces / sizeof surfaces[0]; i++) {
        static float points[POINTS][3], got[POINTS];
        struct field *field = field_of(surfaces[i], i % 2 ? ",'detail':'coarse'" : "");
        for (int n = 0; n < POINTS; n++) {
            double p[3];
            random_point(&random, n % 2 ? 1.2 : 3, p);
            for (int k = 0; k < 3; k++) {
                points[n][k] = (float)p[k];
            }
        }
        engine_agree(field, (const float(*)[3])points, POINTS, got);
        for (int n = 0; n < POINTS; n++) {
            const double p[3] = {points[n][0], points[n][1], points[n][2]};
            const double want = field_distance(field, p);
            if (!(fabs(got[n] - want) <= 2e-5)) {
                fail_msg("%s: at (%g, %g, %g): %g instead of %g", surfaces[i], p[0], p[1], p[2],
                         (double)got[n], want);
            }
        }
        field_unref(field);
    }
}

/* --- numbers and shape --- */

static void the_program_depends_on_the_detail(void **state)
{
    static const struct {
        const char *surface, *more;
        bool same;
    } rows[] = {{TORUS, ",'a':0.3", true},
                {TORUS, ",'thickness':1", true},
                {HELICOID, "", true},
                {"'x':'0/0','y':'s','z':'t','s':[0,1],'t':[0,1]", "", true},
                {TORUS, ",'detail':'coarse'", false}};
    struct field *first = field_of(TORUS, ",'a':0.4");
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct field *field = field_of(rows[i].surface, rows[i].more);
        assert_int_equal(field->structure_hash == first->structure_hash, rows[i].same);
        assert_int_equal(field->code_count, 0);
        field_unref(field);
    }
    field_unref(first);
}

/* As long as others are made in between, so that it is not remembered. */
static void the_numbers_are_the_same_again(void **state)
{
    struct field *first = field_of(KLEIN, "");
    (void)state;

    for (int i = 0; i < 9; i++) {
        char more[64];
        snprintf(more, sizeof more, ",'detail':'coarse','a':0.%d", i + 1);
        field_unref(field_of(TORUS, more));
    }
    struct field *again = field_of(KLEIN, "");
    assert_ptr_not_equal(first->params, again->params);
    assert_int_equal(first->vec4_count, again->vec4_count);
    assert_memory_equal(first->params, again->params, first->vec4_count * 4 * sizeof(float));
    field_unref(first);
    field_unref(again);
}

/* 1/s: the patches about s = 0 are left out, whatever is behind the pole. */
/* Of each letter, another number is another surface. */
static void every_letter_moves_the_surface(void **state)
{
    static const double p[3] = {0, 1, 0};
    char surface[256], more[64];

    (void)state;
    for (int i = 0; i < EQUATION_LETTERS; i++) {
        snprintf(surface, sizeof surface, "'x':'u','y':'%s','z':'v','u':[-1,1],'v':[-1,1]",
                 equation_letters[i]);
        for (int k = 0; k < 2; k++) {
            snprintf(more, sizeof more, ",'%s':%d", equation_letters[i], k);
            struct field *field = field_of(surface, more);
            assert_true(k ? field_distance(field, p) < 0 : field_distance(field, p) > 0.5);
            field_unref(field);
        }
    }
}

/* A ball that is rounded as far again is seen as far again. */
static void bounds_hold_what_is_rounded(void **state)
{
    struct scene *scene = json_text_valid_scene(
        "{'format':'fieldcast/1','root':{'type':'round','params':{'radius':1},'children':["
        "{'id':'it','type':'parametric','params':{'thickness':0.04,'surface':{" SPHERE "}}}]}}");
    struct field *field = field_compile(scene, NULL);

    (void)state;
    assert_non_null(field);
    for (int i = 0; i < 3; i++) {
        const double end[3] = {i == 0 ? 2 : 0, i == 1 ? 2 : 0, i == 2 ? 2 : 0};
        assert_true(field_distance(field, end) <= 0);
        assert_true(field->bounds.low[i] <= -2 && field->bounds.low[i] > -3);
        assert_true(field->bounds.high[i] >= 2 && field->bounds.high[i] < 3);
    }
    field_unref(field);
    scene_destroy(scene);
}

static void what_is_not_finite_is_a_hole(void **state)
{
    static const char text[] = "'x':'s+0*(1/(s-0.5))','y':'0*t','z':'t','s':[0,1],'t':[0,1]";
    struct field *field = field_of(text, ""), *none = field_of("", "");
    struct field *nothing = field_of("'x':'0/0','y':'s','z':'t','s':[0,1],'t':[0,1]", "");
    (void)state;

    assert_true(field_distance(field, (const double[]){0.3, 0, 0.5}) < 0);
    assert_true(field_distance(field, (const double[]){0.5, 0, 0.5}) > 0);
    assert_true(field_distance(none, (const double[]){0.5, 0, 0.5}) >= FIELD_FAR);
    assert_true(field_distance(nothing, (const double[]){0.5, 0, 0.5}) > FIELD_FAR / 2);
    field_unref(field);
    field_unref(none);
    field_unref(nothing);
}

static void errors_say_where(void **state)
{
    static const struct {
        const char *surface, *place, *message;
        int line, column;
    } rows[] = {
        {"'x':'s*ç','y':'t','z':'0','s':[0,1],'t':[0,1]", "/nodes/it/params/surface/x", "", 1, 3},
        {"'x':'π*s + j','y':'t','z':'0','s':[0,1],'t':[0,1]", "/nodes/it/params/surface/x", "j", 1,
         7},
        {"'x':'s','y':'u','z':'0','s':[0,1],'t':[0,1]", "/nodes/it/params/surface/y", "u", 1, 1},
        {"'x':'s','y':'t','z':'j+sn(s)','s':[0,1],'t':[0,1]", "/nodes/it/params/surface/z",
         "(also 1:3: \"sn\"", 1, 1},
        {"'x':'s','y':'t','z':'(s','s':[0,1],'t':[0,1]", "/nodes/it/params/surface/z", ")", 1, 3},
    };
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct error err = {0};
        struct scene *scene = scene_of(rows[i].surface, "");
        struct field *field = field_compile(scene, &err);
        assert_null(field);
        assert_string_equal(err.place, rows[i].place);
        assert_non_null(strstr(err.message, rows[i].message));
        assert_int_equal(err.line, rows[i].line);
        assert_int_equal(err.column, rows[i].column);
        scene_destroy(scene);
    }
}

/* Of all of a scene, and of the expressions of one. */
static void there_are_limits(void **state)
{
    const size_t most = LIMIT_SURFACE_ROWS / patches_rows(PATCHES_LEVELS_MAX);
    char *text;
    size_t length;
    (void)state;

    for (size_t over = 0; over < 2; over++) {
        struct error err = {0};
        FILE *out = open_memstream(&text, &length);
        fprintf(out, "{'format':'fieldcast/1','root':{'type':'union','children':[");
        for (size_t i = 0; i < most + over; i++) {
            fprintf(out,
                    "%s{'type':'parametric','params':{'detail':'finest','surface':{" SQUARE "}}}",
                    i ? "," : "");
        }
        fprintf(out, "]}}");
        fclose(out);
        struct scene *scene = json_text_valid_scene(text);
        struct field *field = field_compile(scene, &err);
        assert_int_equal(field == NULL, over);
        assert_true(!over || strstr(err.message, "(surface_rows)"));
        field_unref(field);
        scene_destroy(scene);
        free(text);
    }
    struct error err = {0};
    FILE *out = open_memstream(&text, &length);
    fprintf(out, "'x':'s','y':'t','z':'s");
    for (int i = 1; i < LIMIT_EQUATION_OPERATIONS / 2 + 1; i++) {
        fprintf(out, "+%d.5", i);
    }
    fprintf(out, "','s':[0,1],'t':[0,1]");
    fclose(out);
    struct scene *scene = scene_of(text, "");
    assert_null(field_compile(scene, &err));
    assert_non_null(strstr(err.message, "(equation_operations)"));
    scene_destroy(scene);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_closed_forms),
        cmocka_unit_test(distances_are_those_of_a_search),
        cmocka_unit_test(the_engine_agrees),
        cmocka_unit_test(the_program_depends_on_the_detail),
        cmocka_unit_test(the_numbers_are_the_same_again),
        cmocka_unit_test(every_letter_moves_the_surface),
        cmocka_unit_test(bounds_hold_what_is_rounded),
        cmocka_unit_test(what_is_not_finite_is_a_hole),
        cmocka_unit_test(errors_say_where),
        cmocka_unit_test(there_are_limits),
    };

    return cmocka_run_group_tests_name("parametric surfaces", tests, NULL, NULL);
}
