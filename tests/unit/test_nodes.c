/* SPDX-License-Identifier: MIT */
/* The registry and the tables beside it keep their own rules. */
#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/limits.h"
#include "protocol/nodes.h"
#include "protocol/registry/rows.h"

/* Saved in binary forms and hashes: rows may be added, none may change. */
static const struct {
    int number;
    const char *name;
} numbers[] = {
    {1, "sphere"},
    {2, "ellipsoid"},
    {3, "box"},
    {4, "round_box"},
    {5, "torus"},
    {6, "cylinder"},
    {7, "capsule"},
    {8, "cone"},
    {9, "plane"},
    {10, "box_frame"},
    {11, "capped_torus"},
    {12, "link"},
    {13, "round_cylinder"},
    {14, "capped_cone"},
    {15, "round_cone"},
    {16, "solid_angle"},
    {17, "cut_sphere"},
    {18, "cut_hollow_sphere"},
    {19, "death_star"},
    {40, "hex_prism"},
    {41, "tri_prism"},
    {42, "octahedron"},
    {43, "tetrahedron"},
    {44, "dodecahedron"},
    {45, "icosahedron"},
    {46, "pyramid"},
    {47, "rhombus"},
    {48, "triangle"},
    {49, "quad"},
    {70, "gyroid"},
    {71, "mandelbulb"},
    {72, "menger"},
    {73, "julia"},
    {74, "terrain"},
    {75, "implicit"},
    {76, "parametric"},
    {101, "union"},
    {102, "intersection"},
    {103, "difference"},
    {104, "smooth_union"},
    {105, "smooth_intersection"},
    {106, "smooth_difference"},
    {107, "exclusive"},
    {108, "morph"},
    {201, "round"},
    {202, "shell"},
    {203, "mirror"},
    {204, "repeat"},
    {205, "twist"},
    {206, "elongate"},
    {207, "bend"},
    {208, "displace"},
    {209, "displace_noise"},
    {210, "repeat_polar"},
    {211, "extrude"},
    {212, "revolve"},
    {213, "offset_space"},
    {301, "group"},
    {302, "material"},
    {303, "model"},
    {304, "field"},
    {401, "circle"},
    {402, "rectangle"},
    {403, "round_rectangle"},
    {404, "triangle2"},
    {405, "regular_polygon"},
    {406, "polygon"},
    {407, "star"},
    {408, "ring"},
    {409, "arc"},
    {410, "vesica"},
    {411, "cross"},
    {412, "bezier"},
    {413, "heart"},
    {414, "ellipse"},
    {415, "segment"},
};

static void numbers_are_stable(void **state)
{
    (void)state;
    assert_int_equal(sizeof numbers / sizeof numbers[0], node_type_count());
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const struct node_type *type = node_type_find(numbers[i].name);
        assert_non_null(type);
        assert_int_equal(type->number, numbers[i].number);
    }
    assert_null(node_type_find("sphre"));
    assert_null(node_type_find(""));
    assert_null(node_type_at(node_type_count()));
}

/* Each table has numbers of its own (rows.h), so that rows added in two places do not meet. */
static void numbers_are_in_the_range_of_their_table(void **state)
{
    static const struct {
        const struct node_type *rows;
        int first, last;
    } tables[] = {
        {node_shapes, 1, 39},        {node_solids, 40, 69},      {node_fractals, 70, 99},
        {node_operations, 101, 199}, {node_modifiers, 201, 299}, {node_structure, 301, 399},
        {node_flat, 401, 499},
    };
    size_t count = 0;
    (void)state;
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        for (const struct node_type *type = tables[i].rows; type->record.name; type++, count++) {
            assert_in_range(type->number, tables[i].first, tables[i].last);
        }
    }
    assert_int_equal(count, node_type_count());
}

static void rows_are_distinct(void **state)
{
    (void)state;
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *a = node_type_at(i);
        assert_ptr_equal(node_type_find(a->record.name), a);
        for (size_t j = 0; j < i; j++) {
            const struct node_type *b = node_type_at(j);
            assert_int_not_equal(a->number, b->number);
            assert_string_not_equal(a->record.name, b->record.name);
            if (*a->glsl && a->kind != KIND_GROUP && b->kind != KIND_GROUP) {
                assert_string_not_equal(a->glsl, b->glsl);
            }
        }
    }
}

static void rows_are_complete(void **state)
{
    (void)state;
    static const struct {
        enum node_group group;
        const char *prefix;
    } kinds[] = {
        [KIND_SHAPE] = {GROUP_PRIMITIVE, "sd_"},    [KIND_COMBINE] = {GROUP_OPERATION, "op_"},
        [KIND_DISTANCE] = {GROUP_MODIFIER, "mod_"}, [KIND_DOMAIN] = {GROUP_MODIFIER, "dom_"},
        [KIND_GROUP] = {GROUP_STRUCTURE, "op_"},    [KIND_FLAT] = {GROUP_SHAPE, "sd2_"},
        [KIND_MODEL] = {GROUP_STRUCTURE, ""},       [KIND_CODE] = {GROUP_STRUCTURE, ""},
        [KIND_EQUATION] = {GROUP_PRIMITIVE, ""},    [KIND_SURFACE] = {GROUP_PRIMITIVE, ""},
    };
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        char name[64];
        assert_int_equal(type->group, kinds[type->kind].group);
        if (type->kind != KIND_MODEL && type->kind != KIND_CODE && type->kind != KIND_EQUATION &&
            type->kind != KIND_SURFACE) {
            snprintf(name, sizeof name, "%s%s", kinds[type->kind].prefix,
                     type->kind == KIND_GROUP ? "union" : type->record.name);
            assert_string_equal(type->glsl, name);
        }
        assert_true(type->number > 0 && type->number < NODE_NUMBERS);
        assert_true(type->lipschitz >= 0);
        assert_true(*type->words && *type->source);
        assert_true(*node_group_name(type->group));
    }
}

static void assert_default_holds(const struct record_type *type, int index)
{
    struct record record;
    struct error err = {0};
    const struct param *param = &type->params[index];
    cJSON *json = param_default(param);

    record_init(&record, type);
    if (!record_set(&record, index, json, param->name, &err)) {
        fail_msg("%s: default of %s: %s", type->name, err.place, err.message);
    }
    for (int i = 0; i < param_components(param->type); i++) {
        assert_true(record.values[index].number[i] == param->def[i]);
    }
    cJSON_Delete(json);
    record_finish(&record);
}

static void check_table(const struct record_type *type)
{
    int main = 0, index = 0;

    assert_true(isupper((unsigned char)*type->doc));
    assert_int_equal(type->doc[strlen(type->doc) - 1], '.');
    for (const struct param *param = type->params; param->name; param++, index++) {
        double min, max;
        param_range(param, &min, &max);
        assert_int_equal(record_type_find(type, param->name), index);
        assert_true(isupper((unsigned char)*param->doc));
        assert_int_equal(param->doc[strlen(param->doc) - 1], '.');
        assert_true(min < max && param->step >= 0);
        assert_true(min >= -LIMIT_COORDINATE && max <= LIMIT_COORDINATE);
        assert_int_equal(param->type == PARAM_ENUM, param->choices != NULL);
        assert_true(!param->uniform || param->type == PARAM_VEC3);
        assert_true(!param->direction || param->type == PARAM_VEC3);
        assert_default_holds(type, index);
        main += param->main;
    }
    assert_true(main <= 2);
    assert_int_equal(record_type_count(type), (size_t)index);
}

static void tables_hold_their_defaults(void **state)
{
    (void)state;
    for (size_t i = 0; i < node_type_count(); i++) {
        check_table(&node_type_at(i)->record);
    }
    const struct record_type *const records[] = {&node_common_type, &scene_info_type, &camera_type,
                                                 &environment_type, &primitive_type,  &shader_type,
                                                 &model_type};
    for (size_t i = 0; i < sizeof records / sizeof records[0]; i++) {
        check_table(records[i]);
    }
    check_table(&transform_type);
    check_table(&render_type);
    for (const struct record_type *type = light_types; type->name; type++) {
        check_table(type);
        assert_ptr_equal(record_type_in(light_types, type->name), type);
    }
    for (const struct record_type *type = volume_types; type->name; type++) {
        check_table(type);
    }
    for (const struct record_type *type = shader_types; type->name; type++) {
        check_table(type);
    }
    assert_null(record_type_in(light_types, "sunshine"));
}

static void limits_have_rows(void **state)
{
    (void)state;
    size_t count;
    const struct limit *limits = limits_table(&count);

#define X(...) +1
    assert_int_equal(count, 0 LIMITS(X));
#undef X
    for (size_t i = 0; i < count; i++) {
        assert_true(limits[i].value > 0 && *limits[i].unit && *limits[i].doc);
        for (const char *c = limits[i].name; *c; c++) {
            assert_true(islower((unsigned char)*c) || *c == '_');
        }
    }
    assert_string_equal(limits[0].name, "document_bytes");
}

static void kinds_of_error(void **state)
{
    (void)state;
    assert_string_equal(error_kind_name(ERROR_NOT_FOUND), "not_found");
    assert_int_equal(error_kind_status(ERROR_NOT_FOUND), 404);
    assert_int_equal(error_kind_status(ERROR_INTERNAL), 500);
    assert_false(error_set(NULL, ERROR_INVALID, "", "nobody listens"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_stable),
        cmocka_unit_test(numbers_are_in_the_range_of_their_table),
        cmocka_unit_test(rows_are_distinct),
        cmocka_unit_test(rows_are_complete),
        cmocka_unit_test(tables_hold_their_defaults),
        cmocka_unit_test(limits_have_rows),
        cmocka_unit_test(kinds_of_error),
    };

    return cmocka_run_group_tests_name("nodes", tests, NULL, NULL);
}
