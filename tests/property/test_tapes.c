/* SPDX-License-Identifier: MIT */
/* The tapes of an interpreter that are renewed after edits of numbers are those that are made anew:
 * the same cubes, with the same operations, where the texture says that they are, of which only
 * what has changed is written. TAPES_EDITS: how many edits there are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/edit.h"
#include "protocol/json.h"
#include "renderer/engine/tapes.h"
#include "renderer/field/field.h"
#include "renderer/glsl/interface.h"
#include "tests/support/edited_scene.h"
#include "tests/support/edits.h"

enum { EDITS = 160, EDITS_OF_A_LIFE = 20, SCATTERED = 400, MANY = 1000, MOVES = 40, PART = 4 };

typedef uint32_t texel[4];

/* A texture as it is on the device. */
struct image {
    texel *texels;
    size_t rows, written;
};

/* A scene with its tapes. */
struct taped {
    struct scene *scene;
    struct field *field;
    struct vocabulary vocabulary;
    struct engine_program *program;
    struct engine_tapes *tapes;
    struct image image;
    struct image anew; /* of tapes that are made anew: the same memory, slow to get */
};

static const struct engine_extent extent = {.reach = 60, .scale = 7, .least = 0.014f};

/* --- textures --- */

static void write_rows(void *data, size_t first, size_t count, const uint32_t (*texels)[4])
{
    struct image *image = data;

    assert_true(first + count <= image->rows);
    memcpy(image->texels + first * TAPES_ROW, texels, count * TAPES_ROW * sizeof *texels);
    image->written += count;
}

static void bring(struct image *image, struct engine_tapes *tapes)
{
    const size_t rows = engine_tapes_rows(tapes);

    if (rows != image->rows) {
        free(image->texels);
        image->texels = calloc(rows * TAPES_ROW, sizeof *image->texels);
        image->rows = rows;
    }
    image->written = 0;
    engine_tapes_tell(tapes, write_rows, image);
}

static void assert_same_cubes(const texel *a, const texel *b, size_t first_a, size_t first_b,
                              const uint32_t at[2])
{
    const uint32_t *x = a[first_a + at[0]], *y = b[first_b + at[1]];
    const uint32_t *words_a = a[a[0][1]], *words_b = b[b[0][1]];

    assert_int_equal(x[2], y[2]);
    assert_int_equal(x[3], y[3]);
    assert_memory_equal(words_a + x[1], words_b + y[1], x[2] * sizeof *words_a);
    assert_int_equal(x[0] != 0, y[0] != 0);
    for (uint32_t k = 0; x[0] && k < 8; k++) {
        assert_same_cubes(a, b, first_a, first_b, (const uint32_t[2]){x[0] + k, y[0] + k});
    }
}

static void assert_same_spaces(const texel *a, const texel *b)
{
    for (int i = 0; i < 3; i++) {
        const int at = TAPE_SPACES + TAPE_SPACE_TEXELS * i;
        assert_same_cubes(a, b, a[at][0], b[at][0], (const uint32_t[2]){0, 0});
        assert_same_cubes(a, b, a[at][0], b[at][0], (const uint32_t[2]){a[at][1], b[at][1]});
        assert_int_equal(a[at][2], b[at][2]);
        assert_memory_equal(a[at + 1], b[at + 1], sizeof a[at]);
    }
}

/* --- scenes --- */

static void read_tapes(struct taped *t)
{
    t->vocabulary = vocabulary_of(t->field);
    t->program = engine_program_create(t->field, 0, 2);
    t->tapes = engine_tapes_create(t->program, t->field->params, &extent, &t->vocabulary);
}

static void leave_tapes(struct taped *t)
{
    engine_tapes_destroy(t->tapes);
    engine_program_destroy(t->program);
    vocabulary_finish(&t->vocabulary);
}

static struct taped begin(struct scene *scene)
{
    struct taped t = {.scene = scene, .field = field_compile(scene, NULL)};

    assert_non_null(t.field);
    read_tapes(&t);
    bring(&t.image, t.tapes);
    return t;
}

static void finish(struct taped *t)
{
    leave_tapes(t);
    field_unref(t->field);
    scene_destroy(t->scene);
    free(t->image.texels);
    free(t->anew.texels);
}

/* What a new texture would be. */
static void check(struct taped *t)
{
    struct engine_tapes *tapes =
        engine_tapes_create(t->program, t->field->params, &extent, &t->vocabulary);

    if (t->anew.texels) {
        memset(t->anew.texels, 0, t->anew.rows * TAPES_ROW * sizeof *t->anew.texels);
    }
    bring(&t->anew, tapes);
    assert_same_spaces((const texel *)t->image.texels, (const texel *)t->anew.texels);
    engine_tapes_destroy(tapes);
}

/* Answers whether the tapes were renewed: not where nothing can be drawn any more, or they are of
 * another structure. */
static bool follow(struct taped *t, const cJSON *ops)
{
    struct error err;

    if (!edit_apply(t->scene, ops, NULL, NULL, &err)) {
        return false;
    }
    struct field *field = field_compile(t->scene, &err);
    if (!field) {
        return false;
    }
    const bool same = field->structure_hash == t->field->structure_hash &&
                      field->transmissive == t->field->transmissive;
    field_unref(t->field);
    t->field = field;
    const bool renewed = same && engine_tapes_renew(t->tapes, t->program, field->params, &extent);
    if (!renewed) {
        leave_tapes(t);
        read_tapes(t);
    }
    bring(&t->image, t->tapes);
    check(t);
    return renewed;
}

static void renewed_tapes_are_new_ones(void **state)
{
    (void)state;
    const char *asked = getenv("TAPES_EDITS");
    const size_t edits = asked ? (size_t)atoi(asked) : EDITS;
    struct random random = {91};
    size_t renewed = 0;

    for (size_t i = 0, life = 0; i < edits; life++) {
        struct taped t = begin(edited_scene(&random, life, SCATTERED));
        for (int k = 0; k < EDITS_OF_A_LIFE && i < edits; k++, i++) {
            cJSON *ops = edited_scene_ops(&random, t.scene, k);
            renewed += t.scene->root->child_count > 1 && follow(&t, ops);
            cJSON_Delete(ops);
        }
        finish(&t);
    }
    print_message("%zu of %zu were renewed\n", renewed, edits);
    assert_true(renewed > edits / 2);
}

/* One shape is dragged to and fro, and out of the scene. */
static void a_drag_writes_a_small_part(void **state)
{
    (void)state;
    struct random random = {92};
    struct taped t = begin(edited_scene_scattered(&random, MANY, 2));
    const char *id = t.scene->root->children[MANY / 2]->id;
    size_t written = 0, rows = 0;

    for (int i = 0; i < MOVES; i++) {
        cJSON *ops = edits_format("[{'op':'set','at':'/nodes/%s/transform/translation','value':"
                                  "[%.3f,%.3f,%.3f]}]",
                                  id, i % 16 * 0.1, i % 7 * 0.1, i % 50 * 0.1);
        assert_true(follow(&t, ops));
        written += t.image.written;
        rows += t.image.rows;
        cJSON_Delete(ops);
    }
    print_message("%zu of %zu rows were written\n", written, rows);
    assert_true(written < rows / PART);
    finish(&t);
}

static void colours_write_nothing(void **state)
{
    (void)state;
    struct random random = {93};
    struct taped t = begin(edited_scene_scattered(&random, SCATTERED, 3));
    cJSON *ops = edits_format("[{'op':'set','at':'/materials/m2/properties/base_color','value':"
                              "[0.1,0.2,0.3]}]");

    assert_true(follow(&t, ops));
    assert_int_equal(t.image.written, 0);
    cJSON_Delete(ops);
    finish(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(renewed_tapes_are_new_ones),
        cmocka_unit_test(a_drag_writes_a_small_part),
        cmocka_unit_test(colours_write_nothing),
    };

    return cmocka_run_group_tests_name("tapes", tests, NULL, NULL);
}
