/* SPDX-License-Identifier: MIT */
/* What of a scene is a number in the field's buffer, and what is its shape. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "renderer/field/shader.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/pair.h"
#include "tests/support/random_scene.h"

/* --- numbers --- */

static void numbers_lie_where_the_header_says(void **state)
{
    (void)state;
    struct pair pair =
        pair_of("{'type':'smooth_union','params':{'k':0.5},'transform':{'scale':[2,2,2]},"
                "'children':[{'type':'box','visible':false},"
                "{'type':'round_box','material':'b','params':{'size':[3,4,5],'radius':0.25},"
                "'transform':{'translation':[10,20,30]}},"
                "{'type':'capsule','params':{'a':[1,2,3],'b':[4,5,6],'radius':7}}]}",
                "'materials':{'a':{'shader':'phong'},'b':{'shader':'phong','properties':{"
                "'diffuse':[0.125,0.25,0.5],'specular':[0.5,0.75,1],'emission':[4,5,6],"
                "'ambient':[1,0.5,0.25],'shininess':99,'reflectivity':0.5,'ior':2,"
                "'opacity':1,'attenuation_distance':2,"
                "'attenuation_color':[1,0.36787944117144233,0]}}},");
    const struct field *field = pair.field;
    const float want[] = {
        0.5f * 2, 3,   0,     0, /* k, order */
        0.5f,     0,   0,     -10, 0,    0.5f,
        0,        -20, 0,     0,   0.5f, -30, /* round_box */
        2,        3,   2,     -1,  0,    3,
        4,        5,   0.25f, 0,   0,    0, /* scale, leaf, slot, solid, away */
        0.5f,     0,   0,     0,   0,    0.5f,
        0,        0,   0,     0,   0.5f, 0, /* capsule */
        2,        4,   0,     -1,  0,    1,
        2,        3,   4,     5,   6,    7,
    };
    const size_t own = sizeof want / sizeof want[0];

    for (size_t i = 0; i < own; i++) {
        if (field->params[i] != want[i]) {
            fail_msg("number %zu is %g instead of %g", i, (double)field->params[i],
                     (double)want[i]);
        }
    }
    assert_int_equal(field->material_base, own / 4);
    const float material[FIELD_MATERIAL_NUMBERS] = {
        0.125f, 0.25f, 0.5f,  99, 0.5f, 0.75f, 1, 0, 4, 5,    6,        0,
        1,      0.5f,  0.25f, 0,  0.5f, 0,     2, 0, 0, 0.5f, 4.60517f, 0,
    };
    for (int i = 0; i < FIELD_MATERIAL_NUMBERS; i++) {
        assert_float_equal(field->params[own + 2 * FIELD_MATERIAL_NUMBERS + i], material[i], 1e-6);
    }
    assert_true(field->params[own] > 0.79f); /* the default's diffuse */
    pair_finish(&pair);
}

static void transforms_that_overflow_are_refused(void **state)
{
    (void)state;
    struct error err = {0};
    char text[4096] = "{'format':'fieldcast/1','root':";

    for (int i = 0; i < 4; i++) {
        char level[128];
        snprintf(level, sizeof level,
                 "{'id':'g%d','type':'group','transform':{'scale':0.000001},"
                 "'children':[",
                 i);
        strcat(text, level);
    }
    strcat(text, BALL("") "]}]}]}]}}");
    struct scene *scene = json_text_scene(text, &err);
    assert_non_null(scene);
    assert_null(field_compile(scene, &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.place, "/nodes/g2/transform");
    scene_destroy(scene);
}

/* --- shape --- */

static struct node *random_below_node(struct random *random, struct node *node)
{
    while (node->child_count && random_below(random, 3)) {
        node = node->children[random_below(random, node->child_count)];
    }
    return node;
}

static void set_text(struct record *record, const char *name, const char *text)
{
    struct error err = {0};
    cJSON *json = cJSON_CreateString(text);

    assert_true(record_set(record, record_type_find(record->type, name), json, "", &err));
    cJSON_Delete(json);
}

static void numeric_edits_keep_the_shape(void **state)
{
    (void)state;
    struct random random = {23};
    const struct random_limits limits = {.depth = 4};
    struct scene *scene = random_scene(&random, node_type_find("smooth_union"), &limits);
    struct field *field = compile_field(scene);
    const uint64_t shape = field->structure_hash;
    char *map = shader_map(field), *surface = shader_surface(field);

    field_unref(field);
    for (int i = 0; i < 1000; i++) {
        struct node *node = random_below_node(&random, scene->root);
        char name[8];
        snprintf(name, sizeof name, "m%zu", random_below(&random, 3));
        switch (random_below(&random, 4)) {
        case 0:
            set_text(&node->common, "material", name);
            break;
        case 1:
            scene->materials.items[random_below(&random, 3)]->record.values[1].number[0] =
                random_between(&random, 0, 1);
            break;
        case 2:
            scene->camera.values[1].number[0] = random_between(&random, -9, 9);
            break;
        default:
            random_numbers(&random, node, &limits);
        }
        field = compile_field(scene);
        assert_true(field->structure_hash == shape);
        if (i % 50 == 0) {
            char *map_now = shader_map(field), *surface_now = shader_surface(field);
            assert_string_equal(map, map_now);
            assert_string_equal(surface, surface_now);
            free(map_now);
            free(surface_now);
        }
        field_unref(field);
    }
    free(map);
    free(surface);
    scene_destroy(scene);
}

/* Any two of these differ in shape. */
static void structural_changes_change_the_shape(void **state)
{
    (void)state;
#define PAIR "'children':[" BALL("") "," BOX "]}"
    static const char *const roots[] = {
        NOTHING,
        BALL(""),
        BOX,
        "{'type':'union'," PAIR,
        "{'type':'intersection'," PAIR,
        "{'type':'difference'," PAIR,
        "{'type':'smooth_union'," PAIR,
        "{'type':'smooth_intersection'," PAIR,
        "{'type':'smooth_difference'," PAIR,
        "{'type':'round'," PAIR,
        "{'type':'shell'," PAIR,
        "{'type':'mirror'," PAIR,
        "{'type':'repeat'," PAIR,
        "{'type':'twist'," PAIR,
        "{'type':'union','children':[" BOX "," BALL("") "]}",
        "{'type':'union','children':[" BALL("") "," BALL("") "]}",
        "{'type':'union','children':[" BALL("") "," BALL("") "," BALL("") "]}",
        "{'type':'union','children':[" BALL("") ",{'type':'intersection','children':[" BALL(
            "") "," BALL("") "]}]}",
        "{'type':'mirror','children':[{'type':'round'," PAIR "]}",
        "{'type':'round','children':[{'type':'mirror'," PAIR "]}",
    };
#undef PAIR
    enum { COUNT = sizeof roots / sizeof roots[0] };
    uint64_t hashes[COUNT];
    for (size_t i = 0; i < COUNT; i++) {
        struct pair pair = pair_of(roots[i], "");
        hashes[i] = pair.field->structure_hash;
        for (size_t j = 0; j < i; j++) {
            if (hashes[j] == hashes[i]) {
                fail_msg("the same shape:\n%s\n%s", roots[i], roots[j]);
            }
        }
        pair_finish(&pair);
    }
    /* Hidden nodes are no part of it, nor are groups of one. */
    struct pair a = pair_of("{'type':'union','children':[" HIDDEN "," BALL("") "]}", "");
    struct pair b = pair_of("{'type':'group','children':[" BALL("") "]}", "");
    assert_true(a.field->structure_hash == hashes[1] && b.field->structure_hash == hashes[1]);
    pair_finish(&a);
    pair_finish(&b);
    /* Unions of unions are one. */
    a = pair_of("{'type':'union','children':[" BALL("") "," BALL("") "," BALL("") "]}", "");
    b = pair_of("{'type':'union','children':[" BALL("") ",{'type':'group','children':[" BALL(
                    "") "," BALL("") "]}]}",
                "");
    assert_true(a.field->structure_hash == b.field->structure_hash);
    pair_finish(&a);
    pair_finish(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_lie_where_the_header_says),
        cmocka_unit_test(transforms_that_overflow_are_refused),
        cmocka_unit_test(numeric_edits_keep_the_shape),
        cmocka_unit_test(structural_changes_change_the_shape),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
