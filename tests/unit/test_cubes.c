/* SPDX-License-Identifier: MIT */
/* Which cubes of space pictures begin with: those of the same program, renewed for its numbers
 * where few are others; of few fields. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "renderer/engine/cubes.h"
#include "tests/support/json_text.h"

enum { FIELDS = 5, MANY = 9 }; /* one more than are kept; shapes of a larger one */

static struct engine_cubes *kept;
static struct engine_program *programs[FIELDS];

static struct cubes *take(size_t program, const float *params, uint32_t *out_picture)
{
    static const struct frame_uniforms frame = {.max_distance = 10};
    const struct engine_picture picture = {
        .program = programs[program], .params = params, .frame = &frame};

    return cubes_take(kept, &picture, out_picture);
}

/* A mark tells cubes apart: new ones have 0 there. Answers the one that was found, and in `*edits`
 * how often these cubes were renewed. */
static int32_t draw_renewed(size_t program, const float *params, int32_t mark, uint32_t *edits)
{
    uint32_t picture;
    struct cubes *cubes = take(program, params, &picture);
    const int32_t found = cubes->of[0][0].last;

    *edits = cubes->edit;
    cubes->of[0][0].last = mark;
    cubes_give(kept, programs[program], cubes);
    return found;
}

static int32_t draw(size_t program, const float *params, int32_t mark)
{
    uint32_t edits;

    return draw_renewed(program, params, mark, &edits);
}

static const float *params_of(size_t program)
{
    return programs[program]->field->params;
}

static void other_numbers_renew_them(void **state)
{
    const struct field *field = programs[0]->field;
    const size_t numbers = 4 * field->vec4_count, bytes = numbers * sizeof(float);
    float *other = malloc(bytes);
    uint32_t edits;

    (void)state;
    assert_non_null(other);
    memcpy(other, field->params, bytes);
    assert_int_equal(draw_renewed(0, other, 1, &edits), 0);
    assert_int_equal(draw_renewed(0, other, 1, &edits), 1);
    assert_int_equal(edits, 0);
    for (size_t i = 0; i < 4 * field->material_base; i++) {
        other[i] += 0.25f;
        assert_int_equal(draw_renewed(0, other, 1, &edits), 1);
        assert_int_equal(edits, i + 1);
    }
    free(other);
}

/* Numbers that belong to no operation: here behind the last material, where lists of points are. */
static void unknown_numbers_find_none(void **state)
{
    const struct field *field = programs[0]->field;
    const size_t bytes = 4 * field->vec4_count * sizeof(float);
    const size_t behind = 4 * (field->material_base + 2 * field->material_stride);
    float *other = malloc(bytes);

    (void)state;
    assert_non_null(other);
    assert_true(behind < 4 * field->vec4_count);
    memcpy(other, field->params, bytes);
    assert_int_equal(draw(0, other, 1), 0);
    other[behind] += 0.25f;
    assert_int_equal(draw(0, other, 1), 0);
    free(other);
}

/* A list of points lies behind the materials. */
static void points_belong_to_their_shape(void **state)
{
    struct error err = {0};
    struct scene *scene =
        json_text_valid_scene("{'format':'fieldcast/1','root':{'id':'r','type':'union','children':["
                              "{'id':'a','type':'sphere'},{'id':'b','type':'polygon'}]}}");
    struct field *field = field_compile(scene, &err);

    (void)state;
    assert_non_null(field);
    struct engine_program *program = engine_program_create(field, 0, 1);
    const size_t bytes = 4 * field->vec4_count * sizeof(float);
    float *other = malloc(bytes);
    memcpy(other, field->params, bytes);
    other[4 * (field->material_base + 2 * field->material_stride)] += 0.25f;
    uint8_t *changed = changes_of_operations(program, field->params, other);
    assert_non_null(changed);
    for (size_t i = 0; i < program->count; i++) {
        const struct operation *in = &program->operations[i];
        const struct node_type *type = program->kinds[in->kind].type;
        assert_int_equal(changed[i],
                         in->op == FIELD_SHAPE && strcmp(type->record.name, "polygon") == 0);
    }
    free(changed);
    free(other);
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

static struct field *many_spheres(int count)
{
    char text[2000] = "{'format':'fieldcast/1','root':{'id':'r','type':'union','children':[";
    struct error err = {0};

    for (int i = 0; i < count; i++) {
        char *end = text + strlen(text);
        snprintf(end, sizeof text - (size_t)(end - text),
                 "%s{'id':'s%d','type':'sphere','params':{'radius':%d}}", i > 0 ? "," : "", i,
                 i + 1);
    }
    strcat(text, "]}}");
    struct scene *scene = json_text_valid_scene(text);
    struct field *field = field_compile(scene, &err);
    assert_non_null(field);
    scene_destroy(scene);
    return field;
}

/* The first of many, one more, and half of them: too few are the same. */
static void another_structure_of_the_scene_finds_them(void **state)
{
    static const int counts[] = {MANY, MANY + 1, MANY / 2};
    static const int32_t found[] = {0, 1, 0};

    (void)state;
    for (size_t i = 0; i < 3; i++) {
        struct field *field = many_spheres(counts[i]);
        engine_program_destroy(programs[i]);
        programs[i] = engine_program_create(field, 0, 1);
        assert_int_equal(draw(i, params_of(i), (int32_t)i + 1), found[i]);
        field_unref(field);
    }
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
    uint32_t first, second;
    struct cubes *ours, *theirs;

    (void)state;
    draw(0, params_of(0), 1);
    ours = take(0, params_of(0), &first);
    theirs = take(0, params_of(0), &second);
    assert_int_equal(ours->of[0][0].last, 1);
    assert_int_equal(theirs->of[0][0].last, 0);
    assert_int_not_equal(first, second);
    cubes_give(kept, programs[0], ours);
    cubes_give(kept, programs[0], theirs);
}

/* The second one goes beyond what a picture may have. */
static void squares_that_take_too_much_are_unknown(void **state)
{
    static uint8_t pixels[2 * SQUARE * SQUARE];
    const struct frame_uniforms frame = {.camera = {.size = {2 * SQUARE, SQUARE}}};
    const struct engine_picture picture = {.program = programs[0], .frame = &frame};
    const struct engine_output output = {.channels = 1, .pixels = pixels, .stride = 2 * SQUARE};
    const struct engine_work work = {
        .tile = {0, 0, 2 * SQUARE, SQUARE}, .outputs = &output, .output_count = 1};
    struct seen seen = {{NULL}};
    struct seen_picture *opened = seen_open(&seen, &picture, &output, 1);
    size_t at = 0;

    (void)state;
    for (int i = 0; i < 2; i++) {
        struct seen_square *square = memory_alloc(1, sizeof *square);
        square->rect = (struct engine_rect){i * SQUARE, 0, SQUARE, SQUARE};
        square->bytes_of_values = i == 0 ? 1000 : cubes_bytes_most();
        seen_take(opened, square, &work);
    }
    const struct seen_square *known = seen_next(opened, &at);
    assert_non_null(known);
    assert_int_equal(known->rect.x, 0);
    assert_null(seen_next(opened, &at));
    assert_true(seen_bytes(&seen) < 10000);
    seen_finish(&seen);
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
        cmocka_unit_test_setup_teardown(other_numbers_renew_them, set_up, tear_down),
        cmocka_unit_test_setup_teardown(unknown_numbers_find_none, set_up, tear_down),
        cmocka_unit_test_setup_teardown(points_belong_to_their_shape, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_fields_have_their_own, set_up, tear_down),
        cmocka_unit_test_setup_teardown(another_structure_of_the_scene_finds_them, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(the_one_that_waited_longest_goes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_was_taken_is_gone, set_up, tear_down),
        cmocka_unit_test_setup_teardown(squares_that_take_too_much_are_unknown, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("cubes", tests, NULL, NULL);
}
