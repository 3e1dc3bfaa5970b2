/* SPDX-License-Identifier: MIT */
/* Which cubes of space pictures begin with: those of the same program and shapes, of few fields. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/engine/cubes.h"
#include "tests/support/json_text.h"

enum { FIELDS = 5 }; /* one more than are kept */

static struct engine_cubes *kept;
static struct engine_program *programs[FIELDS];

/* A mark tells cubes apart: new ones have 0 there. */
static int32_t draw(size_t program, const float *params, int32_t mark)
{
    uint64_t numbers;
    uint32_t picture;
    struct cubes *cubes = cubes_take(kept, programs[program], params, &numbers, &picture);
    const int32_t found = cubes->of[0][0].last;

    cubes->of[0][0].last = mark;
    cubes_give(kept, programs[program], numbers, cubes);
    return found;
}

static const float *params_of(size_t program)
{
    return programs[program]->field->params;
}

static void same_shapes_find_theirs(void **state)
{
    const struct field *field = programs[0]->field;
    const size_t shapes = 4 * field->material_base, bytes = 4 * field->vec4_count * sizeof(float);
    float *other = malloc(bytes);

    (void)state;
    assert_non_null(other);
    memcpy(other, field->params, bytes);
    assert_int_equal(draw(0, field->params, 1), 0);
    assert_int_equal(draw(0, field->params, 2), 1);
    other[shapes] += 0.25f; /* a colour */
    assert_int_equal(draw(0, other, 3), 2);
    for (size_t i = 0; i < shapes; i++) {
        memcpy(other, field->params, bytes);
        other[i] += 0.25f;
        assert_int_equal(draw(0, other, 4), 0);
    }
    free(other);
}

/* A list of points lies behind the materials. */
static void other_points_find_none(void **state)
{
    struct error err = {0};
    struct scene *scene =
        json_text_valid_scene("{'format':'fieldcast/1','root':{'id':'r','type':'polygon'}}");
    struct field *field = field_compile(scene, &err);

    (void)state;
    assert_non_null(field);
    struct engine_program *program = engine_program_create(field, 0, 1);
    struct engine_program *before = programs[0];
    const size_t points = 4 * (field->material_base + 2 * field->material_stride);
    programs[0] = program;
    assert_int_equal(draw(0, field->params, 1), 0);
    assert_int_equal(draw(0, field->params, 1), 1);
    field->params[points] += 0.25f;
    assert_int_equal(draw(0, field->params, 1), 0);
    programs[0] = before;
    engine_program_destroy(program);
    field_unref(field);
    scene_destroy(scene);
}

static void other_fields_have_their_own(void **state)
{
    (void)state;
    assert_int_equal(draw(0, params_of(0), 1), 0);
    assert_int_equal(draw(1, params_of(1), 2), 0);
    assert_int_equal(draw(0, params_of(0), 1), 1);
    assert_int_equal(draw(1, params_of(1), 2), 2);
}

static void the_one_that_waited_longest_goes(void **state)
{
    (void)state;
    for (size_t i = 0; i + 1 < FIELDS; i++) {
        draw(i, params_of(i), (int32_t)i + 1);
    }
    draw(0, params_of(0), 1);
    draw(FIELDS - 1, params_of(FIELDS - 1), FIELDS);
    assert_int_equal(draw(0, params_of(0), 1), 1);
    assert_int_equal(draw(1, params_of(1), 2), 0);
    engine_cubes_forget(kept);
    assert_int_equal(draw(0, params_of(0), 1), 0);
}

/* Two pictures at once, and none twice. */
static void what_was_taken_is_gone(void **state)
{
    uint64_t numbers;
    uint32_t first, second;
    struct cubes *ours, *theirs;

    (void)state;
    draw(0, params_of(0), 1);
    ours = cubes_take(kept, programs[0], params_of(0), &numbers, &first);
    theirs = cubes_take(kept, programs[0], params_of(0), &numbers, &second);
    assert_int_equal(ours->of[0][0].last, 1);
    assert_int_equal(theirs->of[0][0].last, 0);
    assert_int_not_equal(first, second);
    cubes_give(kept, programs[0], numbers, ours);
    cubes_give(kept, programs[0], numbers, theirs);
}

static int set_up(void **state)
{
    static const char *const types[FIELDS] = {"sphere", "box", "torus", "capsule", "cylinder"};
    struct error err = {0};

    (void)state;
    kept = engine_cubes_create();
    for (size_t i = 0; i < FIELDS; i++) {
        char text[100];
        snprintf(text, sizeof text, "{'format':'fieldcast/1','root':{'id':'r','type':'%s'}}",
                 types[i]);
        struct scene *scene = json_text_valid_scene(text);
        struct field *field = field_compile(scene, &err);
        assert_non_null(field);
        programs[i] = engine_program_create(field, 0, 1);
        field_unref(field);
        scene_destroy(scene);
    }
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    for (size_t i = 0; i < FIELDS; i++) {
        engine_program_destroy(programs[i]);
    }
    engine_cubes_destroy(kept);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(same_shapes_find_theirs, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_points_find_none, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_fields_have_their_own, set_up, tear_down),
        cmocka_unit_test_setup_teardown(the_one_that_waited_longest_goes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_was_taken_is_gone, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("cubes", tests, NULL, NULL);
}
