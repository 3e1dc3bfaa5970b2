/* SPDX-License-Identifier: MIT */
/* Distances in C: every registry row has its functions, no field changes faster than the distance,
 * and boxes hold. Whether shapes are exact is seen to by test_exact.c and test_flat.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/field/field.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

#define PI 3.141592653589793
#define SIZE 3.0 /* points lie in a cube of this half side */

static void random_point(struct random *random, double size, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = random_between(random, -size, size);
    }
}

static void along(const double p[3], const double direction[3], double t, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] + t * direction[i];
    }
}

static void both_tables_have_the_same_rows(void **state)
{
    (void)state;
    size_t with = 0; /* without instances, code and equations: no functions of ours */

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        const struct sdf *sdf = sdf_find(type);
        if (type->kind == KIND_MODEL || type->kind == KIND_CODE || type->kind == KIND_EQUATION ||
            type->kind == KIND_SURFACE) {
            assert_null(sdf);
            continue;
        }
        with++;
        if (!sdf) {
            fail_msg("%s has no row in sdf.c", type->record.name);
        }
        const bool shape = type->kind == KIND_SHAPE || type->kind == KIND_FLAT;
        assert_true(shape == (sdf->shape && sdf->box));
        assert_true(!shape || (type->lipschitz > 0) == !sdf->lipschitz);
        assert_true((type->kind == KIND_COMBINE || type->kind == KIND_GROUP) ==
                    (sdf->combine != NULL));
        assert_true((type->kind == KIND_DISTANCE) == (sdf->change != NULL));
        assert_true((type->kind == KIND_DOMAIN) == (sdf->domain != NULL));
    }
    size_t count = 0;
    for (size_t i = 0; sdf_at(i); i++, count++) {
        if (!node_type_find(sdf_at(i)->type)) {
            fail_msg("%s is not in the registry", sdf_at(i)->type);
        }
    }
    assert_int_equal(count, with);
}

/* --- known values --- */

static const struct {
    const char *type;
    double n[13];
    double p[3];
    double distance;
} known[] = {
    {"sphere", {0.5}, {3, 4, 0}, 4.5},
    {"sphere", {0.5}, {0, 0, 0}, -0.5},
    {"ellipsoid", {1, 2, 4}, {0, 4, 0}, 1.9375}, /* less than 2: the box around it, nearly */
    {"ellipsoid", {1, 2, 4}, {1, 0, 0}, 0},
    {"box", {2, 4, 6}, {4, 6, 3}, 5},
    {"box", {2, 4, 6}, {0.5, 0, 0}, -0.5},
    {"round_box", {2, 2, 2, 0.25}, {1.5, 0, 0}, 0.5},
    {"round_box",
     {2, 2, 2, 5},
     {1, 1, 0},
     0.41421356237309515}, /* a ball: the rounding is limited */
    {"torus", {2, 0.5}, {2, 0, 0}, -0.5},
    {"torus", {2, 0.5}, {0, 0, 0}, 1.5},
    {"torus", {2, 0.5}, {5, 4, 0}, 4.5},
    {"cylinder", {1, 2}, {4, 5, 0}, 5},
    {"cylinder", {1, 2}, {0, 0.75, 0}, -0.25},
    {"capsule", {0, 0, 0, 2, 0, 0, 0.5}, {1, 2, 0}, 1.5},
    {"capsule", {0, 0, 0, 2, 0, 0, 0.5}, {5, 4, 0}, 4.5},
    {"capsule", {1, 1, 1, 1, 1, 1, 0.5}, {1, 1, 3}, 1.5},
    {"cone", {3, 4}, {0, 5, 0}, 3},  /* above the tip */
    {"cone", {3, 4}, {6, -2, 0}, 3}, /* beside the rim of the base */
    {"cone", {3, 4}, {0, -3, 0}, 1}, /* under the base */
    {"cone", {3, 4}, {0, -1.9, 0}, -0.1},
    {"cone", {3, 4}, {0, 1, 0}, -0.6}, /* the axis, 1 below the tip: 1 * 3/5 from the slope */
    {"cone", {3, 4}, {5.5, 3, 0}, 5},  /* the slope's middle (1.5, 0) and 5 along its normal */
    {"plane", {0, 2, 0, 1}, {7, 3, 7}, 2},
    {"plane", {0, 0, -3, 1}, {7, 3, -4}, 3},
    {"torus", {1, 2}, {0, 0, 0}, -1.7320508075688772}, /* so wide that it has no hole */
    {"torus", {1, 2}, {0, 1.5, 0}, -0.23205080756887719},
    {"box_frame", {2, 2, 2, 0.25}, {0, 0, 0}, 1.0606601717798212},
    {"box_frame", {2, 2, 2, 0.25}, {0.875, 0.875, 0}, -0.125},
    {"box_frame", {2, 4, 4, 1.5}, {0, 0, 0}, 0.5},  /* a square pipe along X */
    {"box_frame", {2, 2, 2, 1}, {0, 0, 0}, -1},     /* a cube */
    {"capped_torus", {2, 0.5, 0}, {0, -2, 0}, 3.5}, /* a ball */
    {"capped_torus", {2, 0.5, PI}, {0, -2, 0}, -0.5},
    {"capped_torus", {2, 0.5, PI / 2}, {2, -3, 0}, 2.5},
    {"capped_torus", {1, 2, PI}, {0, 0, 0}, -1.7320508075688772},
    {"capped_torus", {3, 5, PI / 2}, {0, -3, 0}, -1}, /* the ends meet at (0, -4, 0) */
    {"capped_torus", {3, 5, PI / 2}, {0, 0, 0}, -4},
    {"capped_torus", {3, 5, PI / 2}, {0, 7, 0}, -1},
    {"link", {0, 2, 0.5}, {0, 5, 0}, 2.5},
    {"link", {2, 1, 0.25}, {0, 0, 0}, 0.75},
    {"link", {2, 1, 0.25}, {1, 0.5, 0}, -0.25},
    {"link", {2, 1, 2}, {0, 0.5, 0}, -1.7320508075688772},
    {"round_cylinder", {1, 2, 9}, {0, 3, 0}, 2}, /* a ball: the rounding is limited */
    {"round_cylinder", {1, 2, 0.5}, {3, 0, 4}, 4},
    {"round_cylinder", {1, 2, 0}, {0, 0.75, 0}, -0.25},
    {"capped_cone", {1, 1, 2}, {4, 5, 0}, 5},
    {"capped_cone", {3, 0, 4}, {5.5, 3, 0}, 5},
    {"capped_cone", {0, 3, 4}, {0, -5, 0}, 3},
    {"capped_cone", {0, 0, 2}, {3, 5, 0}, 5}, /* a segment */
    {"round_cone", {4, 1, 5}, {3.6, 5.2, 0}, 2},
    {"round_cone", {1, 1, 2}, {3, 1, 0}, 2},
    {"round_cone", {2, 1, 0.5}, {0, 4, 0}, 2}, /* one ball in the other */
    {"round_cone", {2, 1, 0.5}, {0, -4, 0}, 2},
    {"round_cone", {1, 2, 0.5}, {0, 4.5, 0}, 2},
    {"round_cone", {1, 2, 0.5}, {0, -3.5, 0}, 2},
    {"solid_angle", {1, PI}, {0, -0.5, 0}, -0.5}, /* a ball */
    {"solid_angle", {1, 0}, {0, -3, 0}, 3},       /* a segment */
    {"solid_angle", {1, 0}, {3, 0.5, 0}, 3},
    {"solid_angle", {1, PI / 2}, {0, 0.25, 0}, -0.25},
    {"solid_angle", {2, 3 * PI / 4}, {0, -1, 0}, 0.70710678118654757},
    {"cut_sphere", {5, 3}, {0, 4.5, 0}, -0.5},
    {"cut_sphere", {5, 3}, {4, 0, 0}, 3},
    {"cut_sphere", {5, 3}, {7, -1, 0}, 5},
    {"cut_sphere", {5, 9}, {3, 9, 0}, 5},   /* a point */
    {"cut_sphere", {5, -9}, {0, -7, 0}, 2}, /* a ball */
    {"cut_hollow_sphere", {5, 3, 0.5}, {0, 0, 0}, 4.5},
    {"cut_hollow_sphere", {5, 3, 0.5}, {0, 6, 0}, 4.5},
    {"cut_hollow_sphere", {5, 9, 0.5}, {0, 8, 0}, 2.5},
    {"cut_hollow_sphere", {5, -9, 1}, {0, -5, 0}, -1}, /* a ball */
    {"cut_hollow_sphere", {5, -9, 1}, {0, 5, 0}, 9},
    {"cut_hollow_sphere", {3, 0, 5}, {0, 3, 0}, -1}, /* its rim closes at (0, 4, 0) */
    {"death_star", {5, 5, 6}, {10, 4, 0}, 7},
    {"death_star", {2, 1, 0}, {0, 0, 0}, 1}, /* a hollow ball */
    {"death_star", {2, 1, 0}, {1.5, 0, 0}, -0.5},
    {"death_star", {2, 1, 9}, {9, 0, 0}, 7},
    {"death_star", {2, 1, 9}, {0, 0, 0}, -2},
    {"death_star", {1, 9, 1}, {2, 4, 0}, 5}, /* a point */
    {"death_star", {1, 9, 0}, {0, 0, 0}, 1}, /* the surface of a ball */
    {"hex_prism", {1, 2}, {0, 3, 0}, 2},
    {"hex_prism", {1, 2}, {2, 0, 0}, 0.84529946162074843}, /* an edge is 2 / sqrt(3) away */
    {"tri_prism", {1, 2}, {0, 4, 0}, 2},
    {"tri_prism", {1, 2}, {0, -3, 0}, 2},
    {"octahedron", {3}, {5, 0, 0}, 2},
    {"octahedron", {3}, {3, 3, 3}, 3.4641016151377544},
    {"tetrahedron", {1.7320508075688772}, {3, 3, 3}, 3.4641016151377544},
    {"tetrahedron", {1.7320508075688772}, {-1, -1, -1}, 1.1547005383792515}, /* over a face */
    {"dodecahedron", {1.7320508075688772}, {2, -2, 2}, 1.7320508075688772},
    {"icosahedron", {1.9021130325903071}, {0, -2, 3.2360679774997898}, 1.9021130325903071},
    {"pyramid", {2, 1}, {0, 3, 0}, 2},
    {"pyramid", {2, 1}, {0, 0.25, 0}, -0.25},
    {"pyramid", {2, 1}, {3, 0, 3}, 2.8284271247461903}, /* beside a corner */
    {"rhombus", {2, 2, 2, 0.5}, {3, 0, 0}, 1.5},
    {"triangle", {0, 0, 0, 2, 0, 0, 1, 0, 0, 0.5}, {1, 2, 0}, 1.5}, /* a segment */
    {"triangle", {0, 0, 0, 2, 0, 0, 1, 0, 0, 0.5}, {5, 4, 0}, 4.5},
    {"triangle", {1, 1, 1, 1, 1, 1, 1, 1, 1, 0.5}, {1, 1, 3}, 1.5}, /* a point */
    {"quad", {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.5}, {1.5, 1, 2}, 1.5},
    {"quad", {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0.5}, {0.5, 1, 0}, -0.5},
    {"menger", {3, 1}, {0.2, 0, 0}, 0.5},     /* in the bars that are taken out */
    {"julia", {0, 0, 0, 0, 8}, {3, 0, 0}, 2}, /* without c it is the unit ball */
    {"julia", {0, 0, 0, 0, 8}, {0, 0.5, 0}, -0.5},
    {"mandelbulb", {2, 8}, {3, 4, 0}, 3},
    {"terrain", {2, 2, 2, 3, 0}, {0, 5, 0}, 4},
};

static void known_distances(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct sdf *sdf = sdf_find(node_type_find(known[i].type));
        double n[13];
        memcpy(n, known[i].n, sizeof n);
        if (sdf->prepare) {
            sdf->prepare(n);
        }
        const double got = sdf->shape(known[i].p, n);
        if (!(fabs(got - known[i].distance) < 1e-12)) {
            fail_msg("%s (row %zu): %.15g instead of %.15g", known[i].type, i, got,
                     known[i].distance);
        }
    }
}

/* --- whole fields --- */

/* Largest rate of change between two points: near each other, far apart, and along the gradient. */
static double steepness(struct random *random, const struct field *field)
{
    double p[3], q[3], direction[3], gradient[3], worst = 0;

    random_point(random, SIZE, p);
    const double d = field_distance(field, p);
    random_direction(random, direction);
    for (int k = 0; k < 2; k++) {
        const double step = k ? random_between(random, 0.01, 3) : 1e-4;
        along(p, direction, step, q);
        worst = fmax(worst, fabs(field_distance(field, q) - d) / step);
    }
    field_normal(field, p, 1e-5, gradient);
    along(p, gradient, 1e-4, q);
    worst = fmax(worst, fabs(field_distance(field, q) - d) / 1e-4);
    along(p, gradient, -1e-4, q);
    return fmax(worst, fabs(field_distance(field, q) - d) / 1e-4);
}

static void no_field_is_steeper_than_the_distance(void **state)
{
    (void)state;
    struct random random = {13};

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        /* Copies of what has no end cannot all be looked at. */
        const bool repeat = strcmp(type->record.name, "repeat") == 0;
        if (type->kind == KIND_SURFACE) {
            continue; /* a lower bound, which has a slack of its own: test_parametric */
        }
        const struct random_limits limits = {.depth = 1, .exact = true, .bounded = repeat};
        for (int round = 0; round < 200; round++) {
            struct scene *scene = random_scene(&random, type, &limits);
            struct field *field = compile_field(scene);
            for (int k = 0; k < 50; k++) {
                const double slope = steepness(&random, field);
                if (!(slope <= 1 + 1e-3)) {
                    fail_msg("%s: %g\n%s", type->record.name, slope, root_text(scene));
                }
            }
            field_unref(field);
            scene_destroy(scene);
        }
    }
}

/* Deeper, with bounds and unequal scales. Repetition is left out: over children whose distances are
 * bounds it may jump (never above the distance). */
static void no_nested_field_is_steeper(void **state)
{
    (void)state;
    struct random random = {14};
    const struct random_limits limits = {.depth = 3};

    for (int round = 0; round < 400;) {
        struct scene *scene =
            random_scene(&random, random_type(&random, KIND_COMBINE, &limits), &limits);
        char *text = scene_print(scene, false);
        struct field *field = compile_field(scene);
        if (!strstr(text, "repeat")) {
            round++;
            for (int k = 0; k < 50; k++) {
                const double slope = steepness(&random, field);
                if (!(slope <= 1 + 1e-3)) {
                    fail_msg("%g\n%s", slope, root_text(scene));
                }
            }
        }
        field_unref(field);
        free(text);
        scene_destroy(scene);
    }
}

/* Every point whose field is at most delta lies in the grown box; counts the points inside. */
static size_t check_box(struct random *random, const struct scene *scene)
{
    struct field *field = compile_field(scene);
    size_t solid = 0;

    for (int k = 0; k < 200; k++) {
        double p[3];
        random_point(random, 5, p);
        const double d = field_distance(field, p);
        struct bounds box = bounds_grow(field->bounds, fmax(d, 0) + 1e-5);
        solid += d <= 0;
        for (int j = 0; j < 3; j++) {
            if (!(p[j] >= box.low[j] && p[j] <= box.high[j])) {
                fail_msg("%g at %g %g %g is outside\n%s", d, p[0], p[1], p[2], root_text(scene));
            }
        }
    }
    field_unref(field);
    return solid;
}

static void boxes_hold_what_they_bound(void **state)
{
    (void)state;
    struct random random = {15};
    size_t solid = 0;

    for (int round = 0; round < 1500; round++) {
        const struct random_limits limits = {.depth = round % 4};
        const struct node_type *type =
            limits.depth ? random_type(&random, (enum node_kind)(KIND_COMBINE + round % 3), &limits)
                         : random_type(&random, KIND_SHAPE, &limits);
        struct scene *scene = random_scene(&random, type, &limits);
        solid += check_box(&random, scene);
        scene_destroy(scene);
    }
    assert_true(solid > 5000);
}

/* What bars across each other share when both grow is as wide as each of them, and thus reaches
 * farther towards its corners, which a turn makes sides of the box. */
static void boxes_of_crossings_hold_when_turned(void **state)
{
    static const char text[] = "{'format':'fieldcast/1','root':{'type':'intersection','transform':"
                               "{'rotation':[0.785,0,0]},'children':["
                               "{'type':'box','params':{'size':[0.4,0.4,12]},"
                               "'transform':{'translation':[-0.4,0,0]}},"
                               "{'type':'box','params':{'size':[0.4,12,0.4]},"
                               "'transform':{'translation':[0.4,0,0]}}]}}";
    struct scene *scene = json_text_valid_scene(text);
    struct random random = {16};

    (void)state;
    for (int round = 0; round < 20; round++) {
        assert_int_equal(check_box(&random, scene), 0);
    }
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_tables_have_the_same_rows),
        cmocka_unit_test(known_distances),
        cmocka_unit_test(no_field_is_steeper_than_the_distance),
        cmocka_unit_test(no_nested_field_is_steeper),
        cmocka_unit_test(boxes_hold_what_they_bound),
        cmocka_unit_test(boxes_of_crossings_hold_when_turned),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
