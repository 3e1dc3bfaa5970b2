/* SPDX-License-Identifier: MIT */
/* The engine's distances are those of the evaluator in C, at random points of random scenes of
 * every node type; and all widths of vectors give the same bits. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "renderer/sdf/sdf.h"
#include "tests/support/code_engine.h"
#include "tests/support/random_scene.h"

enum { SCENES = 6, POINTS = 60 };
#define SIZE 4.0
#define TOLERANCE 1e-4 /* relative to what is greater than 1 */
#define NEARBY 1e-5    /* where the distance jumps, that of a point so near will do */

/* As the engine tells it: by all subtrees, also where their boxes would tell of a greater one. */
static double distance_in_c(const struct field *field, const double p[3])
{
    return field_surface(field, p, NULL).distance;
}

/* Whether it lies among those of the point and of those around it. */
static bool agrees(const struct field *field, const float point[3], double got)
{
    double low = INFINITY, high = -INFINITY;

    for (int corner = -1; corner < 8; corner++) {
        double p[3];
        for (int i = 0; i < 3; i++) {
            p[i] = point[i] + (corner < 0 ? 0 : (corner >> i & 1) ? NEARBY : -NEARBY);
        }
        const double d = distance_in_c(field, p);
        low = fmin(low, d);
        high = fmax(high, d);
        const double room = TOLERANCE * fmax(1, fmax(fabs(low), fabs(high)));
        if (got >= low - room && got <= high + room) {
            return true;
        }
    }
    return false;
}

static void look_at(struct random *random, const struct field *field, const struct scene *scene)
{
    float points[POINTS][3], got[POINTS];

    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < 3; k++) {
            points[i][k] = (float)random_between(random, -SIZE, SIZE);
        }
    }
    engine_agree(field, (const float(*)[3])points, POINTS, got);
    for (int i = 0; i < POINTS; i++) {
        if (!agrees(field, points[i], got[i])) {
            const double p[3] = {points[i][0], points[i][1], points[i][2]};
            fprintf(stderr, "%s\n", scene_print(scene, false)); /* fail_msg would cut it */
            fail_msg("at (%.9g, %.9g, %.9g): engine %.9g, C %.9g", p[0], p[1], p[2], got[i],
                     distance_in_c(field, p));
        }
    }
}

static void every_type_agrees(void **state)
{
    const struct random_limits limits = {.depth = 3};
    struct random random = {.state = 2024};
    size_t seen = 0;
    (void)state;

    for (size_t t = 0; t < node_type_count(); t++) {
        const struct node_type *type = node_type_at(t);
        for (int i = 0; i < SCENES && sdf_find(type); i++) {
            struct error err = {0};
            struct scene *scene = random_scene(&random, type, &limits);
            struct field *field = field_compile(scene, &err);
            assert_non_null(field);
            look_at(&random, field, scene);
            field_unref(field);
            scene_destroy(scene);
            seen++;
        }
    }
    assert_true(seen >= (size_t)SCENES * 60);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_type_agrees)};

    return cmocka_run_group_tests_name("engine at points", tests, NULL, NULL);
}
