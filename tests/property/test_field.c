/* SPDX-License-Identifier: MIT */
/* The field program: transforms, operations with nothing in them, repetition, twist, guards, ids,
 * materials, marching. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/field/field.h"
#include "tests/support/pair.h"
#include "tests/support/random_scene.h"

static double distance_of(const char *root, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    struct pair pair = pair_of(root, "");
    const double d = field_distance(pair.field, p);

    pair_finish(&pair);
    return d;
}

static void assert_near(double got, double want)
{
    if (!(fabs(got - want) <= 1e-6 * fmax(1, fabs(want)))) {
        fail_msg("%.9g instead of %.9g", got, want);
    }
}

#define AT(x, y, z) ",'transform':{'translation':[" #x "," #y "," #z "]}"
#define MATERIALS                                                                                  \
    "'materials':{'m0':{'shader':'phong'},'m1':{'shader':'phong'},"                                \
    "'m2':{'shader':'phong'}},"

static void transforms_apply_scale_rotation_translation(void **state)
{
    (void)state;
    /* (1, 0, 0), scaled by 2, a quarter turn about Z to (0, 2, 0), then moved. */
    const char *moved = "{'type':'group','transform':{'translation':[5,0,0],"
                        "'rotation':[0,0,1.5707963267948966],'scale':[2,2,2]},"
                        "'children':[{'type':'sphere','params':{'radius':0.25},"
                        "'transform':{'translation':[1,0,0]}}]}";
    assert_near(distance_of(moved, 5, 2, 0), -0.5);
    assert_near(distance_of(moved, 5, 5, 0), 2.5);
    /* Rx, then Ry, then Rz: +Z goes by Rx to -Y; Ry leaves it; Rz takes it to +X. */
    const char *turned = "{'type':'plane','params':{'normal':[0,0,1]},'transform':{"
                         "'rotation':[1.5707963267948966,1.5707963267948966,"
                         "1.5707963267948966]}}";
    assert_near(distance_of(turned, 3, 7, 9), 3);
    const char *flat = "{'type':'sphere','params':{'radius':1},'transform':{"
                       "'scale':[4,0.5,-2]}}";
    assert_near(distance_of(flat, 8, 0, 0), 0.5); /* (8/4 - 1) * least scale */
    assert_near(distance_of(flat, 0, 0.5, 0), 0);
    assert_near(distance_of(flat, 0, 0, 2), 0);
}

static void lengths_of_operations_are_scaled(void **state)
{
    (void)state;
    const char *scaled = "{'type':'round','params':{'radius':0.5},'transform':{"
                         "'scale':[3,3,3]},'children':[" BALL("") "]}";

    assert_near(distance_of(scaled, 10, 0, 0), 10 - 3 - 1.5);
    const char *shell = "{'type':'shell','params':{'thickness':0.25},'transform':{"
                        "'scale':[2,2,2]},'children':[" BALL("") "]}";
    assert_near(distance_of(shell, 0, 0, 0), 1.5);
    assert_near(distance_of(shell, 2, 0, 0), -0.5);
    /* Equal distances are lowered by k/4. */
    const char *blend =
        "{'type':'smooth_union','params':{'k':0.4},'transform':{"
        "'scale':[2,2,2]},'children':[" BALL(AT(-2, 0, 0)) "," BALL(AT(2, 0, 0)) "]}";
    assert_near(distance_of(blend, 0, 0, 0), 2 - 0.2);
}

static void operations_mean_what_they_say(void **state)
{
    (void)state;
#define TWO "'children':[" BALL(AT(-0.5, 0, 0)) "," BALL(AT(0.5, 0, 0)) "]}"
    assert_near(distance_of("{'type':'union'," TWO, -2, 0, 0), 0.5);
    assert_near(distance_of("{'type':'intersection'," TWO, -2, 0, 0), 1.5);
    assert_near(distance_of("{'type':'difference'," TWO, -1, 0, 0), -0.5);
    assert_near(distance_of("{'type':'difference'," TWO, 0, 0, 0), 0.5);
    assert_near(distance_of("{'type':'smooth_intersection','params':{'k':1}," TWO, 0, 0, 0),
                -0.5 + 0.25);
    /* a = -0.5, -b = 0.5: they differ by k, so nothing is blended. */
    assert_near(distance_of("{'type':'smooth_difference','params':{'k':1}," TWO, 0, 0, 0), 0.5);
    /* a = -b = -0.5. */
    assert_near(distance_of("{'type':'smooth_difference','params':{'k':1}," TWO, -1, 0, 0),
                -0.5 + 0.25);
    /* A primitive with children is their union. */
    assert_near(
        distance_of("{'type':'sphere','params':{'radius':1},'children':[" BALL(AT(5, 0, 0)) "]}", 5,
                    0, 0),
        -1);
#undef TWO
}

#define FAR_AWAY 1e9

static void nothing_is_empty_space(void **state)
{
    (void)state;
    static const struct {
        const char *root;
        double at_origin;
    } cases[] = {
        {NOTHING, FAR_AWAY},
        {HIDDEN, FAR_AWAY},
        {"{'type':'union','children':[" HIDDEN "," BALL("") "]}", -1},
        {"{'type':'union','children':[" NOTHING "," BALL("") "]}", -1},
        {"{'type':'intersection','children':[" HIDDEN "," BALL("") "]}", -1},
        {"{'type':'intersection','children':[" NOTHING "," BALL("") "]}", FAR_AWAY},
        {"{'type':'intersection','children':[" BALL("") "," NOTHING "]}", FAR_AWAY},
        {"{'type':'difference','children':[" HIDDEN "," BALL("") "]}", FAR_AWAY},
        {"{'type':'difference','children':[" NOTHING "," BALL("") "]}", FAR_AWAY},
        {"{'type':'difference','children':[" BALL("") "," NOTHING "," HIDDEN "]}", -1},
        {"{'type':'round','children':[" NOTHING "]}", FAR_AWAY},
        {"{'type':'repeat','children':[" NOTHING "]}", FAR_AWAY},
        {"{'type':'twist','children':[" HIDDEN "]}", FAR_AWAY},
        {"{'type':'smooth_union','children':[{'type':'mirror','children':[" NOTHING
         "]}," BALL("") "]}",
         -1},
        {"{'type':'group','visible':false,'children':[" BALL("") "]}", FAR_AWAY},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double got = distance_of(cases[i].root, 0, 0, 0);
        if (got != cases[i].at_origin) {
            fail_msg("%s: %g", cases[i].root, got);
        }
    }
}

/* --- repetition --- */

/* The same children as `count` copies, each moved on its own. */
static struct pair explicit_copies(const char *child, const double spacing[3], const int count[3],
                                   const int window[3])
{
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    const char *comma = "";

    assert_non_null(out);
    fprintf(out, "{'type':'union','children':[");
    int n[3];
    for (int i = 0; i < 3; i++) {
        n[i] = count[i] < 0 ? window[i] : count[i] == 0 ? 1 : count[i];
    }
    for (int i = 0; i < n[0] * n[1] * n[2]; i++) {
        const int at[3] = {i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
        fprintf(out, "%s{'type':'group','transform':{'translation':[", comma);
        for (int j = 0; j < 3; j++) {
            fprintf(out, "%s%.17g", j ? "," : "", spacing[j] * (at[j] - (n[j] - 1) / 2.0));
        }
        fprintf(out, "]},'children':[%s]}", child);
        comma = ",";
    }
    fprintf(out, "]}");
    fclose(out);
    struct pair pair = pair_of(text, MATERIALS);
    free(text);
    return pair;
}

static void repetition_is_copies(void **state)
{
    (void)state;
    struct random random = {21};
    int checked = 0;

    for (int round = 0; round < 150; round++) {
        const struct random_limits limits = {.bounded = true, .exact = true};
        double spacing[3];
        int count[3], window[3] = {9, 9, 9};
        for (int i = 0; i < 3; i++) {
            count[i] = (int)random_below(&random, 6) - 1;
            spacing[i] = random_between(&random, count[i] < 0 ? 1.5 : 0.9, 3);
        }
        char *child, *repeat;
        size_t length;
        FILE *out = open_memstream(&child, &length);
        random_node(&random, out, random_type(&random, KIND_SHAPE, &limits), &limits);
        fclose(out);
        if (asprintf(&repeat,
                     "{'type':'repeat','params':{'spacing':[%.17g,%.17g,%.17g],"
                     "'count':[%d,%d,%d]},'children':[%s]}",
                     spacing[0], spacing[1], spacing[2], count[0], count[1], count[2], child) < 0) {
            abort();
        }
        struct pair a = pair_of(repeat, MATERIALS);
        struct pair b = explicit_copies(child, spacing, count, window);
        /* Were all cells looked at that the child reaches into? */
        const bool all = a.field->loop_trips < SDF_REPEAT_CELLS_MAX - 25;
        checked += all;
        for (int k = 0; k < 200 && all; k++) {
            double p[3], limit = 1.5; /* well inside the window of endless axes */
            for (int i = 0; i < 3; i++) {
                p[i] = random_between(&random, -limit, limit);
            }
            const double want = field_distance(b.field, p), got = field_distance(a.field, p);
            if (fabs(want - got) > 1e-5) {
                fail_msg("%g instead of %g at %g %g %g\n%s", got, want, p[0], p[1], p[2], repeat);
            }
        }
        pair_finish(&a);
        pair_finish(&b);
        free(child);
        free(repeat);
    }
    assert_true(checked > 100);
}

static void repetition_counts_its_loops(void **state)
{
    (void)state;
    static const struct {
        const char *root;
        uint32_t trips;
    } cases[] = {
        {BALL(""), 0},
        {"{'type':'repeat','params':{'count':[0,0,0]},'children':[" BALL("") "]}", 1},
        {"{'type':'repeat','params':{'count':[-1,0,1],'spacing':[4,4,4]},"
         "'children':[" BALL("") "]}",
         2},
        {"{'type':'repeat','params':{'count':[-1,-1,9],'spacing':[4,4,4]},"
         "'children':[" BALL("") "]}",
         8},
        {"{'type':'repeat','params':{'count':[2,0,0],'spacing':[4,4,4]},'children':["
         "{'type':'repeat','params':{'count':[3,0,0],'spacing':[2,2,2]},'children':"
         "[" BALL("") "]}," BALL("") "]}",
         2 * (1 + 2)},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pair pair = pair_of(cases[i].root, "");
        assert_int_equal(pair.field->loop_trips, cases[i].trips);
        pair_finish(&pair);
    }
    struct pair dense = pair_of("{'type':'repeat','params':{'count':[-1,-1,-1],"
                                "'spacing':[0.01,0.02,0.01]},'children':[" BALL("") "]}",
                                "");
    assert_true(dense.field->loop_trips <= SDF_REPEAT_CELLS_MAX);
    pair_finish(&dense);
}

/* --- twist --- */

/* Against points of the twisted surface itself: those of the box, turned forward. */
static void twist_is_a_bound(void **state)
{
    (void)state;
    struct random random = {22};

    for (int round = 0; round < 40; round++) {
        const double rate = random_between(&random, -3, 3),
                     height = random_between(&random, 0.5, 3);
        const double width = random_between(&random, 0.3, 2);
        char *root;
        if (asprintf(&root,
                     "{'type':'twist','params':{'rate':%.17g},'children':[{'type':"
                     "'box','params':{'size':[%.17g,%.17g,0.4]}}]}",
                     rate, width, height) < 0) {
            abort();
        }
        struct pair pair = pair_of(root, "");
        static double surface[20000][3];
        for (size_t i = 0; i < 20000; i++) {
            double q[3] = {random_between(&random, -0.5, 0.5), random_between(&random, -0.5, 0.5),
                           random_between(&random, -0.5, 0.5)};
            q[i % 3] = i % 2 ? 0.5 : -0.5;
            q[0] *= width, q[1] *= height, q[2] *= 0.4;
            const double c = cos(rate * q[1]), s = sin(rate * q[1]); /* right-handed about +Y */
            surface[i][0] = c * q[0] + s * q[2];
            surface[i][1] = q[1];
            surface[i][2] = -s * q[0] + c * q[2];
            assert_true(fabs(field_distance(pair.field, surface[i])) < 1e-5);
        }
        for (int k = 0; k < 40; k++) {
            double p[3], nearest = INFINITY;
            for (int j = 0; j < 3; j++) {
                p[j] = random_between(&random, -4, 4);
            }
            for (size_t i = 0; i < 20000; i++) {
                nearest = fmin(nearest, hypot(hypot(surface[i][0] - p[0], surface[i][1] - p[1]),
                                              surface[i][2] - p[2]));
            }
            if (fabs(field_distance(pair.field, p)) > nearest + 1e-6) {
                fail_msg("%g is above %g\n%s", field_distance(pair.field, p), nearest, root);
            }
        }
        /* Far from the axis the bound stays close to the distance. */
        const double far[3] = {50, 0, 0};
        assert_true(field_distance(pair.field, far) > 48);
        pair_finish(&pair);
        free(root);
    }
}

static void twisted_planes_end_somewhere(void **state)
{
    (void)state;
    const char *root = "{'type':'twist','children':[{'type':'plane'}]}";

    assert_true(distance_of(root, 0, -1, 0) < 0);
    assert_true(distance_of(root, SDF_TURN_RADIUS_MAX + 1, -1, 0) > 0);
}

/* --- guards --- */

/* Columns far apart, each with a loop in it: what is skipped changes nothing near a surface, and
 * nowhere is the field above the true distance. */
static void guards_change_no_surface(void **state)
{
    (void)state;
    char text[4096] = "{'type':'union','children':[" BALL("");

    for (int i = 1; i < 6; i++) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used,
                 ",{'type':'repeat','params':{'spacing':[1,0.8,1],'count':[0,3,0]},"
                 "'transform':{'translation':[%d,0,%d],'rotation':[0,0,0.3]},"
                 "'children':[{'type':'sphere','params':{'radius':0.4}}]}",
                 2 * i, i % 2);
    }
    strcat(text, "]}");
    struct pair pair = pair_of(text, "");
    size_t guards = 0;
    for (size_t i = 0; i < pair.field->instruction_count; i++) {
        guards += pair.field->instructions[i].op == FIELD_GUARD;
    }
    assert_int_equal(guards, 5);
    struct random random = {31};
    for (int k = 0; k < 20000; k++) {
        double p[3] = {random_between(&random, -2, 12), random_between(&random, -2, 2),
                       random_between(&random, -2, 3)};
        double want = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1;
        for (int i = 1; i < 6; i++) {
            for (int copy = -1; copy <= 1; copy++) {
                const double x = p[0] - 2 * i + 0.8 * copy * sin(0.3),
                             y = p[1] - 0.8 * copy * cos(0.3);
                const double z = p[2] - i % 2;
                want = fmin(want, sqrt(x * x + y * y + z * z) - 0.4);
            }
        }
        assert_true(fabs(field_distance(pair.field, p) - want) < 1e-6);
    }
    pair_finish(&pair);
}

/* --- surfaces --- */

static void leaves_are_numbered_in_pre_order(void **state)
{
    (void)state;
    struct pair pair =
        pair_of("{'id':'root','type':'union','children':["
                "{'type':'group','visible':false,'children':[" BALL("") "," BALL(
                    "") "]},"
                        "{'type':'group','children':[{'id':'left','type':'sphere',"
                        "'transform':{"
                        "'translation':[-3,0,0]}},{'id':'right','type':'sphere','transform':{"
                        "'translation':[3,0,0]}}]}]}",
                "");
    const double p[2][3] = {{-3, 0, 0}, {3, 0, 0}};

    assert_int_equal(field_surface(pair.field, p[0], NULL).number,
                     6); /* root 1, hidden 2 to 4, group 5 */
    assert_int_equal(field_surface(pair.field, p[1], NULL).number, 7);
    assert_string_equal(field_leaf_id(pair.field, 6), "left");
    assert_string_equal(field_leaf_id(pair.field, 7), "right");
    assert_null(field_leaf_id(pair.field, 5));
    assert_null(field_leaf_id(pair.field, 0));
    pair_finish(&pair);
}

/* The weight of an operand is the derivative of the blend by it. */
static void materials_mix_by_the_derivative(void **state)
{
    (void)state;
    struct random random = {24};
    static const char *const types[] = {"smooth_union", "smooth_intersection", "smooth_difference"};

    for (int i = 0; i < 3; i++) {
        const struct sdf *sdf = sdf_find(node_type_find(types[i]));
        for (int k = 0; k < 10000; k++) {
            const double a = random_between(&random, -1, 1), b = random_between(&random, -1, 1);
            double n[2] = {random_between(&random, 0.1, 1)}, share, ignored, h = 1e-6;
            sdf->combine(a, b, n, &share);
            double by_b =
                (sdf->combine(a, b + h, n, &ignored) - sdf->combine(a, b - h, n, &ignored)) /
                (2 * h);
            assert_true(fabs(fabs(by_b) - share) < 1e-4);
        }
    }
    struct pair pair =
        pair_of("{'type':'smooth_union','params':{'k':2},'children':["
                "{'type':'sphere','material':'a','transform':{'translation':[-1,0,0]}},"
                "{'type':'sphere','material':'b','transform':{'translation':[1,0,0]}}]}",
                "'materials':{'a':{'shader':'phong','properties':{'diffuse':[0,0,0]}},"
                "'b':{'shader':'phong','properties':{'diffuse':[1,1,1]}}},");
    const double middle[3] = {0, 0, 0}, right[3] = {0.5, 0, 0};
    assert_near(field_surface(pair.field, middle, NULL).material[0], 0.5);
    /* Distances 1 and 0: h = 1/2, so three quarters of b. */
    assert_near(field_surface(pair.field, right, NULL).material[0], 0.75);
    assert_int_equal(field_surface(pair.field, right, NULL).number, 3);
    pair_finish(&pair);
}

static void materials_are_inherited(void **state)
{
    (void)state;
    struct pair pair =
        pair_of("{'type':'group','material':'a','children':[" BALL(
                    "") ","
                        "{'type':'group','children':[" BALL(AT(9, 0, 0) ",'material':'b'") "]}]}",
                "'materials':{'a':{'shader':'phong','properties':{'diffuse':[0.25,0,0]}},"
                "'b':{'shader':'phong','properties':{'diffuse':[0.5,0,0]}}},");
    const double p[2][3] = {{0, 0, 0}, {9, 0, 0}};

    assert_near(field_surface(pair.field, p[0], NULL).material[0], 0.25);
    assert_near(field_surface(pair.field, p[1], NULL).material[0], 0.5);
    pair_finish(&pair);
}

/* --- marching --- */

static void rays_stop_at_surfaces(void **state)
{
    (void)state;
    struct pair pair =
        pair_of("{'type':'difference','children':[" BOX "," BALL(AT(0, 0, 1)) "]}", "");
    const double origin[3] = {0.25, 0.125, 9}, forward[3] = {0, 0, -1}, away[3] = {0, 0, 1};
    const double t = field_march(pair.field, origin, forward, 100, 1e-9);
    const double dent = 1 - sqrt(1 - 0.25 * 0.25 - 0.125 * 0.125);

    assert_near(t, 9 - dent);
    assert_near(field_march(pair.field, origin, forward, 8, 1e-9), -1);
    assert_near(field_march(pair.field, origin, away, 100, 1e-9), -1);
    const double hit[3] = {0.25, 0.125, dent};
    double normal[3];
    field_normal(pair.field, hit, 1e-5, normal);
    const double to_middle[3] = {-0.25, -0.125, 1 - dent};
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(normal[i] - to_middle[i]) < 1e-4);
    }
    assert_string_equal(field_leaf_id(pair.field, field_surface(pair.field, hit, NULL).number),
                        "sphere-1");
    pair_finish(&pair);
}

static void deep_and_wide_scenes_fit(void **state)
{
    (void)state;
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    for (int i = 0; i < LIMIT_NODE_DEPTH - 1; i++) {
        fprintf(out, "{'type':'%s','children':[" BALL("") ",", i % 2 ? "repeat" : "mirror");
    }
    fprintf(out, BALL(""));
    for (int i = 0; i < LIMIT_NODE_DEPTH - 1; i++) {
        fprintf(out, "]}");
    }
    fclose(out);
    struct pair deep = pair_of(text, "");
    const double p[3] = {4, 0, 0};
    assert_near(field_distance(deep.field, p), 3);
    assert_int_equal(field_surface(deep.field, p, NULL).distance, 3);
    free(text);
    pair_finish(&deep);
    out = open_memstream(&text, &length);
    assert_non_null(out);
    fprintf(out, "{'type':'smooth_union','children':[");
    for (int i = 0; i < LIMIT_CHILDREN; i++) {
        fprintf(out, "%s{'type':'sphere','transform':{'translation':[%d,0,0]}}", i ? "," : "",
                2 * i);
    }
    fprintf(out, "]}");
    fclose(out);
    struct pair wide = pair_of(text, "");
    const double end[3] = {2.0 * (LIMIT_CHILDREN - 1), 3, 0};
    assert_near(field_distance(wide.field, end), 2.5);
    assert_string_equal(field_leaf_id(wide.field, field_surface(wide.field, end, NULL).number),
                        "sphere-10000");
    assert_int_equal(wide.field->distance_slots, 2);
    free(text);
    pair_finish(&wide);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(transforms_apply_scale_rotation_translation),
        cmocka_unit_test(lengths_of_operations_are_scaled),
        cmocka_unit_test(operations_mean_what_they_say),
        cmocka_unit_test(nothing_is_empty_space),
        cmocka_unit_test(repetition_is_copies),
        cmocka_unit_test(repetition_counts_its_loops),
        cmocka_unit_test(twist_is_a_bound),
        cmocka_unit_test(twisted_planes_end_somewhere),
        cmocka_unit_test(guards_change_no_surface),
        cmocka_unit_test(leaves_are_numbered_in_pre_order),
        cmocka_unit_test(materials_mix_by_the_derivative),
        cmocka_unit_test(materials_are_inherited),
        cmocka_unit_test(rays_stop_at_surfaces),
        cmocka_unit_test(deep_and_wide_scenes_fit),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
