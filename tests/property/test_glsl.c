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
#include "tests/support/progress.h"
#include "tests/support/random_scene.h"

/* Half side of the cube of points: with the shapes in it, the size of the scenes. */
#define SIZE 4.0
#define TOLERANCE (1e-4 * SIZE)

/* A driver may cut off loops after 65,535 iterations, of map and surface of all fields together. */
enum { FIELDS_MAX = 4, POINTS_MAX = 1024, LOOPS_MAX = 65535 / 2 / FIELDS_MAX };

static struct probe probe;

/* Scenes that share one GLSL program. */
struct batch {
    struct scene *scenes[FIELDS_MAX];
    struct field *fields[FIELDS_MAX];
    size_t count;
    float points[POINTS_MAX][3];
    struct probe_answer answers[FIELDS_MAX * POINTS_MAX];
};

static struct batch batch;

static void batch_finish(void)
{
    for (size_t i = 0; i < batch.count; i++) {
        field_unref(batch.fields[i]);
        scene_destroy(batch.scenes[i]);
    }
    batch.count = 0;
}

static void random_points(struct random *random, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        for (int j = 0; j < 3; j++) {
            batch.points[i][j] = (float)random_between(random, -SIZE, SIZE);
        }
    }
}

static void to_double(const float p[3], double out[3])
{
    out[0] = p[0], out[1] = p[1], out[2] = p[2];
}

static void fail_scene(size_t index, const char *what, double much, size_t point)
{
    const float *p = batch.points[point];

    fail_msg("%s: %g at %.9g %.9g %.9g\n%s", what, much, (double)p[0], (double)p[1], (double)p[2],
             root_text(batch.scenes[index]));
}

static void compare_distances(size_t index, size_t points)
{
    for (size_t i = 0; i < points; i++) {
        double p[3];
        to_double(batch.points[i], p);
        const double want = field_distance(batch.fields[index], p);
        const double difference = fabs(want - batch.answers[index * points + i].distance);
        if (!(difference <= TOLERANCE)) {
            fail_scene(index, "distances differ", difference, i);
        }
    }
}

static void compare_surfaces(size_t index, size_t points)
{
    for (size_t i = 0; i < points; i++) {
        const struct probe_answer *answer = &batch.answers[index * points + i];
        if (!probe_agrees(batch.fields[index], batch.points[i], answer)) {
            fail_scene(index, "surfaces differ, leaf", answer->leaf, i);
        }
    }
}

struct plan {
    int rounds; /* with other numbers in the same shapes each time */
    size_t points;
    bool surface, in_block; /* as in probe.h */
};

static void change_numbers(struct random *random, size_t index, const struct random_limits *limits)
{
    const uint64_t shape = batch.fields[index]->structure_hash;

    do {
        random_numbers(random, batch.scenes[index]->root, limits);
        field_unref(batch.fields[index]);
        batch.fields[index] = compile_field(batch.scenes[index]);
        assert_true(batch.fields[index]->structure_hash == shape);
    } while (batch.fields[index]->loop_trips > LOOPS_MAX);
}

/* One program for all. Empties the batch. */
static void check_batch(struct random *random, const struct random_limits *limits, struct plan plan)
{
    struct error err = {0};
    struct probe_program program;

    if (!probe_program_init(&program, &probe, batch.fields, batch.count, plan.surface,
                            plan.in_block, &err)) {
        fail_msg("%s", err.message);
    }
    for (int round = 0; round < plan.rounds; round++) {
        random_points(random, plan.points);
        probe_run(&probe, &program, batch.fields, batch.count, batch.points, plan.points,
                  batch.answers);
        for (size_t i = 0; i < batch.count; i++) {
            compare_distances(i, plan.points);
            if (plan.surface) {
                compare_surfaces(i, plan.points);
            }
            change_numbers(random, i, limits);
        }
    }
    probe_program_finish(&program, &probe);
    batch_finish();
}

static void batch_add(struct scene *scene)
{
    batch.scenes[batch.count] = scene;
    batch.fields[batch.count++] = compile_field(scene);
}

/* Adds a scene whose loops no driver cuts off. */
static void batch_add_random(struct random *random, const struct node_type *type, int choice,
                             int chosen, const struct random_limits *limits)
{
    for (;;) {
        struct scene *scene = random_scene(random, type, limits);
        if (choice >= 0) {
            scene->root->params.values[choice].number[0] = chosen;
        }
        batch_add(scene);
        if (batch.fields[batch.count - 1]->loop_trips <= LOOPS_MAX) {
            return;
        }
        field_unref(batch.fields[--batch.count]);
        scene_destroy(batch.scenes[batch.count]);
    }
}

/* The first parameter with choices; -1: none. */
static int choice_of(const struct node_type *type)
{
    for (int i = 0; type->record.params[i].name; i++) {
        if (type->record.params[i].type == PARAM_ENUM) {
            return i;
        }
    }
    return -1;
}

static void every_row_agrees(void **state)
{
    (void)state;
    struct random random = {1};
    const struct random_limits limits = {.depth = 1};
    const struct plan plan = {.rounds = 25, .points = 400, .surface = true};

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind == KIND_MODEL || type->kind == KIND_CODE) {
            continue;
        }
        const int choice = choice_of(type);
        const char *const *choices = choice < 0 ? NULL : type->record.params[choice].choices;
        for (int k = 0; k == 0 || (choices && choices[k]); k++) {
            batch_add_random(&random, type, choice, k, &limits);
            if (batch.count == FIELDS_MAX) {
                check_batch(&random, &limits, plan);
            }
        }
    }
    check_batch(&random, &limits, plan);
}

static void nested_scenes_agree(void **state)
{
    (void)state;
    struct random random = {2};
    struct random_limits limits = {.lean = true};
    struct plan plan = {.rounds = 2, .points = 64};

    for (int i = 0; i < 120; i++) {
        const enum node_kind kind = (enum node_kind)(KIND_COMBINE + i % 4);
        limits.depth = 1 + i % 8;
        batch_add_random(&random, random_type(&random, kind, &limits), -1, 0, &limits);
        if (batch.count == FIELDS_MAX) {
            progress("%d scenes", i + 1);
            plan.surface = i % 5 == 0; /* it takes more than twice as long to compile */
            check_batch(&random, &limits, plan);
        }
    }
    check_batch(&random, &limits, plan);
}

/* The other tests read a texture, which software compiles ten times faster. */
static void numbers_may_come_from_a_block(void **state)
{
    (void)state;
    struct random random = {3};
    const struct random_limits limits = {.depth = 3, .lean = true};

    batch_add_random(&random, node_type_find("smooth_union"), -1, 0, &limits);
    check_batch(&random, &limits,
                (struct plan){.rounds = 3, .points = 400, .surface = true, .in_block = true});
}

static void empty_scenes_compile(void **state)
{
    (void)state;
    struct error err = {0};
    struct probe_program program;

    batch_add(scene_create_empty());
    assert_true(probe_program_init(&program, &probe, batch.fields, 1, true, false, &err));
    probe_run(&probe, &program, batch.fields, 1, batch.points, 1, batch.answers);
    assert_true(batch.answers[0].distance > 1e8f);
    assert_int_equal(batch.answers[0].leaf, 0);
    probe_program_finish(&program, &probe);
    batch_finish();
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

/* A test that fails leaves its scenes. */
static int empty_batch(void **state)
{
    (void)state;
    batch_finish();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(every_row_agrees, empty_batch),
        cmocka_unit_test_teardown(nested_scenes_agree, empty_batch),
        cmocka_unit_test_teardown(numbers_may_come_from_a_block, empty_batch),
        cmocka_unit_test_teardown(empty_scenes_compile, empty_batch),
    };

    return cmocka_run_group_tests(tests, set_up, tear_down);
}
