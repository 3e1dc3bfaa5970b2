/* SPDX-License-Identifier: MIT */
/* The GLSL of every registry row, and of nested scenes, agrees with the C evaluator. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "tests/support/compiled.h"
#include "tests/support/probe.h"
#include "tests/support/random_scene.h"

/* Half side of the cube of points: with the shapes in it, the size of the scenes. */
#define SIZE 4.0
#define TOLERANCE (1e-4 * SIZE)

static struct probe probe;

struct batch {
    float points[PROBE_POINTS_MAX][3];
    struct probe_answer answers[PROBE_POINTS_MAX];
};

static void random_points(struct random *random, struct batch *batch, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (int j = 0; j < 3; j++) {
            batch->points[i][j] = (float)random_between(random, -SIZE, SIZE);
        }
    }
}

static void to_double(const float p[3], double out[3])
{
    out[0] = p[0], out[1] = p[1], out[2] = p[2];
}

static double compare_distances(const struct field *field, const struct batch *batch, size_t count)
{
    double worst = 0;
    for (size_t i = 0; i < count; i++) {
        double p[3];
        to_double(batch->points[i], p);
        double difference = fabs(field_distance(field, p) - batch->answers[i].distance);
        worst = difference <= worst ? worst : difference; /* NaN is worst of all */
    }
    return worst;
}

/* The leaf and material may differ only where two leaves are nearly equal: then they are those of
 * the C evaluator nearby. */
static bool surface_agrees(const struct field *field, const float point[3],
                           const struct probe_answer *answer)
{
    double p[3];
    to_double(point, p);
    for (int corner = -1; corner < 8; corner++) {
        double q[3];
        for (int j = 0; j < 3; j++) {
            q[j] = p[j] + (corner < 0 ? 0 : (corner >> j & 1) ? 1e-4 : -1e-4);
        }
        struct field_surface want = field_surface(field, q, NULL);
        bool same = want.number == answer->leaf;
        for (int j = 0; j < FIELD_MATERIAL_NUMBERS; j++) {
            /* Blends as narrow as 0.15 change by 1/(2k) per unit; shininess is up to 100. */
            double room = j == 3 ? 0.5 : 0.005;
            same = same && fabs(want.material[j] - answer->material[j]) <= room;
        }
        if (same) {
            return true;
        }
    }
    return false;
}

static size_t count_bad_surfaces(const struct field *field, const struct batch *batch, size_t count)
{
    size_t bad = 0;
    for (size_t i = 0; i < count; i++) {
        bad += !surface_agrees(field, batch->points[i], &batch->answers[i]);
    }
    return bad;
}

/* One program; `rounds` times other numbers in the same shape. */
static void check_scene(struct random *random, struct scene *scene,
                        const struct random_limits *limits, int rounds, size_t points,
                        const char *name)
{
    static struct batch batch;
    struct error err = {0};
    struct probe_program program;
    struct field *field = compile_field(scene);
    const uint64_t shape = field->shape_hash;
    if (!probe_program_init(&program, &probe, field, true, true, &err)) {
        fail_msg("%s: %s", name, err.message);
    }
    for (int round = 0; round < rounds; round++) {
        random_points(random, &batch, points);
        probe_run(&probe, &program, field, batch.points, points, 0, batch.answers);
        double worst = compare_distances(field, &batch, points);
        if (!(worst <= TOLERANCE)) {
            fail_msg("%s, round %d: distances differ by %g\n%s", name, round, worst,
                     root_text(scene));
        }
        size_t bad = count_bad_surfaces(field, &batch, points);
        if (bad > 0) {
            fail_msg("%s, round %d: %zu of %zu surfaces differ\n%s", name, round, bad, points,
                     root_text(scene));
        }
        random_numbers(random, scene->root, limits);
        field_unref(field);
        field = compile_field(scene);
        assert_true(field->shape_hash == shape);
    }
    field_unref(field);
    probe_program_finish(&program, &probe);
}

static void every_row_agrees(void **state)
{
    (void)state;
    struct random random = {1};
    const struct random_limits limits = {.depth = 1};
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        assert_non_null(sdf_find(type));
        struct scene *scene = random_scene(&random, type, &limits);
        check_scene(&random, scene, &limits, 25, 400, type->record.name);
        scene_destroy(scene);
    }
}

static void nested_scenes_agree(void **state)
{
    (void)state;
    struct random random = {2};
    for (int i = 0; i < 24; i++) {
        const struct random_limits limits = {.depth = 2 + i % 3};
        enum node_kind kind = (enum node_kind)(KIND_COMBINE + i % 4);
        const struct node_type *type = random_type(&random, kind, &limits);
        struct scene *scene = random_scene(&random, type, &limits);
        char name[64];
        snprintf(name, sizeof name, "nested scene %d (%s)", i, type->record.name);
        check_scene(&random, scene, &limits, 3, 300, name);
        scene_destroy(scene);
    }
}

/* The other tests read a texture, which software compiles ten times faster. */
static void numbers_may_come_from_a_block(void **state)
{
    (void)state;
    static struct batch batch;
    struct random random = {3};
    struct error err = {0};
    const struct random_limits limits = {.depth = 3};
    struct scene *scene = random_scene(&random, node_type_find("smooth_union"), &limits);
    struct field *field = compile_field(scene);
    struct probe_program program;
    assert_true(probe_program_init(&program, &probe, field, true, false, &err));
    random_points(&random, &batch, 1000);
    probe_run(&probe, &program, field, batch.points, 1000, 0, batch.answers);
    assert_true(compare_distances(field, &batch, 1000) <= TOLERANCE);
    assert_int_equal(count_bad_surfaces(field, &batch, 1000), 0);
    probe_program_finish(&program, &probe);
    field_unref(field);
    scene_destroy(scene);
}

static void empty_scenes_compile(void **state)
{
    (void)state;
    static struct batch batch;
    struct error err = {0};
    struct scene *scene = scene_create_empty();
    struct field *field = compile_field(scene);
    struct probe_program program;
    assert_true(probe_program_init(&program, &probe, field, true, false, &err));
    probe_run(&probe, &program, field, batch.points, 1, 0, batch.answers);
    assert_true(batch.answers[0].distance > 1e8f);
    assert_int_equal(batch.answers[0].leaf, 0);
    probe_program_finish(&program, &probe);
    field_unref(field);
    scene_destroy(scene);
}

static int set_up(void **state)
{
    (void)state;
    struct error err = {0};
    if (!probe_init(&probe, &err)) {
        error_print(&err, stderr);
        return -1;
    }
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    probe_finish(&probe);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_agrees),
        cmocka_unit_test(nested_scenes_agree),
        cmocka_unit_test(numbers_may_come_from_a_block),
        cmocka_unit_test(empty_scenes_compile),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
