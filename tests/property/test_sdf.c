/* SPDX-License-Identifier: MIT */
/* Distances in C: every registry row has its functions, shapes marked exact are exact, and no field
 * changes faster than the distance. */
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
#include "tests/support/predicates.h"
#include "tests/support/random_scene.h"

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
    size_t with = 0; /* without instances and code, which are no functions of ours */
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        const struct sdf *sdf = sdf_find(type);
        if (type->kind == KIND_MODEL || type->kind == KIND_CODE) {
            assert_null(sdf);
            continue;
        }
        with++;
        if (!sdf) {
            fail_msg("%s has no row in sdf.c", type->record.name);
        }
        bool shape = type->kind == KIND_SHAPE || type->kind == KIND_FLAT;
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
    double n[8];
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
};

static void known_distances(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const struct sdf *sdf = sdf_find(node_type_find(known[i].type));
        double n[8];
        memcpy(n, known[i].n, sizeof n);
        if (sdf->prepare) {
            sdf->prepare(n);
        }
        double got = sdf->shape(known[i].p, n);
        if (!(fabs(got - known[i].distance) < 1e-12)) {
            fail_msg("%s (row %zu): %.15g instead of %.15g", known[i].type, i, got,
                     known[i].distance);
        }
    }
}

/* --- inside or outside, by the words of the catalogue --- */

static bool (*member_of(const struct node_type *type))(const double p[3], const double *n)
{
    const struct predicate *predicate = predicate_find(type->record.name);
    if (!predicate) {
        fail_msg("no test knows what is inside of a %s", type->record.name);
    }
    return predicate->inside;
}

/* Numbers of a shape: as written, and ready for its function. */
static void random_shape(struct random *random, const struct node_type *type,
                         double raw[SDF_NUMBERS_MAX], double ready[SDF_NUMBERS_MAX])
{
    const struct random_limits limits = {.plain = true};
    struct scene *scene = random_scene(random, type, &limits);
    sdf_numbers(type->record.params, scene->root->params.values, raw);
    memcpy(ready, raw, 16 * sizeof *raw);
    if (sdf_find(type)->prepare) {
        sdf_find(type)->prepare(ready);
    }
    scene_destroy(scene);
}

/* The sign is right, and the ball with the distance as its radius holds no point of the other
 * side. */
static void shapes_never_overstate(void **state)
{
    (void)state;
    struct random random = {11};
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind != KIND_SHAPE) {
            continue;
        }
        const struct sdf *sdf = sdf_find(type);
        bool (*inside)(const double p[3], const double *n) = member_of(type);
        for (int round = 0; round < 500; round++) {
            double raw[SDF_NUMBERS_MAX] = {0}, ready[SDF_NUMBERS_MAX] = {0};
            random_shape(&random, type, raw, ready);
            for (int k = 0; k < 20; k++) {
                double p[3];
                random_point(&random, 2, p);
                double d = sdf->shape(p, ready);
                bool in = inside(p, raw);
                assert_true(fabs(d) < 1e-9 || in == (d < 0));
                for (int j = 0; j < 50; j++) {
                    double direction[3], q[3];
                    random_direction(&random, direction);
                    along(p, direction, fabs(d) * 0.9999, q);
                    if (inside(q, raw) != in) {
                        fail_msg("%s: %g overstates at %g %g %g", type->record.name, d, p[0], p[1],
                                 p[2]);
                    }
                }
            }
        }
    }
}

/* Does a point of the other side lie within |d| (1 + tolerance)? Searches directions, coarse to
 * fine. Together with shapes_never_overstate this makes d the distance. */
static bool other_side_at(struct random *random, const struct sdf *sdf, const double *n,
                          const double p[3], double d)
{
    double best[3], least = INFINITY, spread = 2;
    random_direction(random, best);
    for (int i = 0; i < 4000; i++) {
        double direction[3], offset[3], q[3], length = 0;
        random_direction(random, offset);
        for (int j = 0; j < 3; j++) {
            direction[j] = best[j] + spread * offset[j];
            length += direction[j] * direction[j];
        }
        for (int j = 0; j < 3; j++) {
            direction[j] /= sqrt(length);
        }
        along(p, direction, fabs(d) * 1.001 + 1e-6, q);
        double there = sdf->shape(q, n) * (d < 0 ? -1 : 1);
        if (there <= 0) {
            return true;
        }
        if (there < least) {
            least = there;
            memcpy(best, direction, sizeof best);
        } else {
            spread = fmax(spread * 0.99, 1e-4);
        }
    }
    return false;
}

static void exact_shapes_are_exact(void **state)
{
    (void)state;
    struct random random = {12};
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind != KIND_SHAPE || type->exactness != EXACT) {
            continue;
        }
        for (int round = 0; round < 400; round++) {
            double raw[SDF_NUMBERS_MAX] = {0}, ready[SDF_NUMBERS_MAX] = {0}, p[3];
            random_shape(&random, type, raw, ready);
            random_point(&random, 2, p);
            double d = sdf_find(type)->shape(p, ready);
            assert_true(d != 0); /* the chance to meet the surface is none */
            if (!other_side_at(&random, sdf_find(type), ready, p, d)) {
                fail_msg("%s: %g understates at %g %g %g", type->record.name, d, p[0], p[1], p[2]);
            }
        }
    }
}

/* --- whole fields --- */

/* Largest rate of change between two points: near each other, far apart, and along the gradient. */
static double steepness(struct random *random, const struct field *field)
{
    double p[3], q[3], direction[3], gradient[3], worst = 0;
    random_point(random, SIZE, p);
    double d = field_distance(field, p);
    random_direction(random, direction);
    for (int k = 0; k < 2; k++) {
        double step = k ? random_between(random, 0.01, 3) : 1e-4;
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
        const struct random_limits limits = {.depth = 1, .exact = true, .bounded = repeat};
        for (int round = 0; round < 200; round++) {
            struct scene *scene = random_scene(&random, type, &limits);
            struct field *field = compile_field(scene);
            for (int k = 0; k < 50; k++) {
                double slope = steepness(&random, field);
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
                double slope = steepness(&random, field);
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
static size_t check_boxes(uint64_t seed, int rounds)
{
    struct random random = {seed};
    size_t solid = 0;

    for (int round = 0; round < rounds; round++) {
        const struct random_limits limits = {.depth = round % 4};
        const struct node_type *type =
            limits.depth ? random_type(&random, (enum node_kind)(KIND_COMBINE + round % 3), &limits)
                         : random_type(&random, KIND_SHAPE, &limits);
        struct scene *scene = random_scene(&random, type, &limits);
        struct field *field = compile_field(scene);
        for (int k = 0; k < 200; k++) {
            double p[3];
            random_point(&random, 5, p);
            double d = field_distance(field, p);
            struct bounds box = bounds_grow(field->bounds, fmax(d, 0) + 1e-5);
            solid += d <= 0;
            for (int j = 0; j < 3; j++) {
                if (!(p[j] >= box.low[j] && p[j] <= box.high[j])) {
                    fail_msg("%g at %g %g %g is outside\n%s", d, p[0], p[1], p[2],
                             root_text(scene));
                }
            }
        }
        field_unref(field);
        scene_destroy(scene);
    }
    return solid;
}

static void boxes_hold_what_they_bound(void **state)
{
    (void)state;
    assert_true(check_boxes(15, 1500) > 10000);
    check_boxes(303, 1500); /* has a turned intersection whose parts are apart */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_tables_have_the_same_rows),
        cmocka_unit_test(known_distances),
        cmocka_unit_test(shapes_never_overstate),
        cmocka_unit_test(exact_shapes_are_exact),
        cmocka_unit_test(no_field_is_steeper_than_the_distance),
        cmocka_unit_test(no_nested_field_is_steeper),
        cmocka_unit_test(boxes_hold_what_they_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
