/* SPDX-License-Identifier: MIT */
/* Folders in the format of Schneider's thesis: its listings as they are printed, what else may
 * stand in such files, and what is refused where. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/import/import.h"
#include "protocol/import/text.h"
#include "protocol/json.h"
#include "protocol/limits.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/text_file.h"

#define LISTINGS "tests/import/thesis/"
#define SCENES "tests/import/scenes/"
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

static const char *const listings[] = {
    LISTINGS "primitives/hex_prism.json",      LISTINGS "shaders/blend_shader.json",
    LISTINGS "materials/blend_material.json",  LISTINGS "materials/blend_material1.json",
    LISTINGS "materials/blend_material2.json", LISTINGS "models/Esfera.json",
    LISTINGS "models/TresEsferas.json",
};

static struct error err;
static cJSON *notes;

static struct scene *convert(const struct import_file *files, size_t count, const char *wanted)
{
    cJSON_Delete(notes);
    notes = NULL;
    err = (struct error){0};
    return import_scene(&(struct import_source){.files = files, .count = count, .scene = wanted},
                        &notes, &err);
}

/* The listings and one scene. */
static struct scene *import_with(const char *scene_path)
{
    struct import_file files[COUNT(listings) + 1];
    struct scene *scene;

    for (size_t i = 0; i < COUNT(files); i++) {
        files[i].path = i < COUNT(listings) ? listings[i] : scene_path;
        files[i].text = text_file_read(files[i].path, &files[i].length);
    }
    scene = convert(files, COUNT(files), NULL);
    for (size_t i = 0; i < COUNT(files); i++) {
        free((char *)files[i].text);
    }
    if (!scene) {
        fail_msg("%s:%d:%d: %s", err.place, err.line, err.column, err.message);
    }
    return scene;
}

/* Files written out here, with ' for ": path, text, path, text, ..., NULL. */
static struct scene *import_texts(const char *path, ...)
{
    struct import_file files[8];
    size_t count = 0;
    va_list args;
    struct scene *scene;

    va_start(args, path);
    for (; path; path = va_arg(args, const char *)) {
        const char *text = json_text(va_arg(args, const char *));

        files[count++] = (struct import_file){path, text, strlen(text)};
    }
    va_end(args);
    scene = convert(files, count, NULL);
    while (count > 0) {
        free((char *)files[--count].text);
    }
    return scene;
}

static double distance(const struct scene *scene, double x, double y, double z)
{
    struct field *field = compile_field(scene);
    const double d = field_distance(field, (double[3]){x, y, z});

    field_unref(field);
    return d;
}

static void assert_surface(const struct scene *scene, double x, double y, double z)
{
    const double d = distance(scene, x, y, z);

    if (fabs(d) > 1e-6) {
        fail_msg("at %g, %g, %g the surface is %g away", x, y, z, d);
    }
}

/* --- the listings --- */

static void check_spheres(const struct scene *scene)
{
    /* Three of radius 0.5 about (0.3, 0.2), (0.1, 0.4), (0.3, 0.1). */
    assert_surface(scene, 0.8, 0.2, 0);
    assert_surface(scene, 0.1, 0.9, 0);
    assert_surface(scene, 0.3, -0.4, 0);
    assert_surface(scene, 0.3 + 0.5 * sqrt(0.5), 0.1 - 0.5 * sqrt(0.5), 0);
    /* One about (0.3 - 0.8, 0.2), scaled by 1, 2 and 4. */
    assert_surface(scene, -1, 0.2, 0);
    assert_surface(scene, -0.5, 1.2, 0);
    assert_surface(scene, -0.5, -0.8, 0);
    assert_surface(scene, -0.5, 0.2, 2);
    assert_true(distance(scene, -0.5, 0.2, 1.9) < 0);
    assert_true(distance(scene, -0.5, 1.3, 0) > 0);
}

static void scene_as_printed(void **state)
{
    struct scene *scene = import_with(LISTINGS "scenes/Cena1.json");

    (void)state;
    assert_string_equal(record_text(&scene->info, "name"), "Cena1");
    assert_int_equal(scene->models.count, 2);
    assert_int_equal(scene->materials.count, 3);
    check_spheres(scene);
    /* The object that ends too early is told. */
    assert_int_equal(cJSON_GetArraySize(notes), 1);
    assert_non_null(strstr(notes->child->valuestring, "Cena1.json:8:1: "));
    scene_destroy(scene);
}

static void scene_of_the_draft(void **state)
{
    struct scene *scene = import_with(SCENES "draft.json");

    (void)state;
    check_spheres(scene);
    assert_int_equal(cJSON_GetArraySize(notes), 0);
    scene_destroy(scene);
}

static void materials_are_imported(void **state)
{
    struct scene *scene = import_with(LISTINGS "scenes/Cena1.json");
    const struct resource *shader = resource_find(&scene->shaders, "Blend-Shader");
    const struct resource *material = resource_find(&scene->materials, "blend_material");
    const double color[] = {0.5, 0.1, 0.5};

    (void)state;
    assert_non_null(shader);
    assert_string_equal(record_text(&shader->record, "doc"), "Blend Shader");
    assert_true(record_is(&shader->record, "lighting", "unlit"));
    assert_non_null(strstr(record_text(&shader->record, "code"), "\n\nfloat3 shade("));
    assert_ptr_equal(material->shader, shader);
    assert_memory_equal(record_vector(&material->record, "_Color1"), color, sizeof color);
    assert_true(record_number(&material->record, "_Blend") == 0.61803398874);
    const struct param *blend = &material->record.type->params[2];
    assert_int_equal(blend->type, PARAM_FLOAT);
    assert_true(blend->min == 0 && blend->max == 1);
    assert_int_equal(material->record.type->params[0].type, PARAM_COLOR);

    /* Inherited where a child says nothing. */
    const struct resource *three = resource_find(&scene->models, "TresEsferas");
    assert_string_equal(node_material(scene, three->root->children[0])->name, "blend_material1");
    assert_string_equal(node_material(scene, three->root->children[1])->name, "blend_material2");
    assert_string_equal(record_text(&three->root->common, "name"), "TresEsferas");
    scene_destroy(scene);
}

static void primitives_are_imported(void **state)
{
    struct scene *scene = import_with(SCENES "prisms.json");
    const struct resource *prism = resource_find(&scene->primitives, "HexPrism");

    (void)state;
    assert_non_null(prism);
    /* Apothem 0.5, half as high as 0.25. */
    assert_surface(scene, 0, 0.5, 0);
    assert_surface(scene, 0.5 * sqrt(3) / 2, 0.25, 0.1);
    assert_surface(scene, 0.2, 0, 0.25);
    /* A cuboid with these edges, a ball cut out at its top. */
    assert_surface(scene, 2.5, 0.1, 0);
    assert_surface(scene, 2, -0.75, 0);
    assert_surface(scene, 2, 0, 1);
    assert_surface(scene, 2, 0.25, 0);
    scene_destroy(scene);
}

/* What the scene does not say: everything is in the picture, and something shines. */
static void check_seen(const struct scene *scene, const double p[3])
{
    const double *eye = record_vector(&scene->camera, "position");
    const double *target = record_vector(&scene->camera, "target");
    const double half = record_number(&scene->camera, "fov") / 2 * M_PI / 180;
    double along = 0, length = 0, reach = 0;

    for (int i = 0; i < 3; i++) {
        along += (p[i] - eye[i]) * (target[i] - eye[i]);
        length += (target[i] - eye[i]) * (target[i] - eye[i]);
        reach += (p[i] - eye[i]) * (p[i] - eye[i]);
    }
    assert_true(along / sqrt(length * reach) >= cos(half) - 1e-9);
}

static void camera_and_light(void **state)
{
    struct scene *scene = import_with(LISTINGS "scenes/Cena1.json");

    (void)state;
    check_seen(scene, (double[3]){-0.5, 0.2, 2});
    check_seen(scene, (double[3]){-0.5, 0.2, -2});
    check_seen(scene, (double[3]){0.8, 0.2, 0});
    check_seen(scene, (double[3]){-0.5, 1.2, 0});
    assert_int_equal(scene->lights.count, 1);
    scene_destroy(scene);
}

/* A listing by itself is worth a look. */
static void without_a_scene(void **state)
{
    for (size_t i = 0; i < COUNT(listings); i++) {
        struct import_file files[COUNT(listings)];
        const bool needs_shader = strstr(listings[i], "/materials/") != NULL;
        const bool needs_more = strstr(listings[i], "/models/") != NULL;
        size_t count = 0;

        for (size_t k = 0; k < COUNT(listings); k++) {
            if (k == i || (needs_shader && strstr(listings[k], "/shaders/")) ||
                (needs_more && !strstr(listings[k], "/models/"))) {
                files[count].path = listings[k];
                files[count].text = text_file_read(listings[k], &files[count].length);
                count++;
            }
        }
        struct scene *scene = convert(files, count, NULL);
        if (!scene) {
            fail_msg("%s: %s:%d: %s", listings[i], err.place, err.line, err.message);
        }
        assert_int_equal(scene->root->child_count, 1);
        struct field *field = compile_field(scene);
        assert_int_equal(field->shape_count, strstr(listings[i], "TresEsferas") ? 3 : 1);
        field_unref(field);
        scene_destroy(scene);
        while (count > 0) {
            free((char *)files[--count].text);
        }
    }
    (void)state;
}

static void side_by_side(void **state)
{
    struct scene *scene =
        import_texts("a.json", "{'model': {'type': 'Primitives/Sphere', 'data': [2]}}", "b.json",
                     "{'model': {'type': 'Primitives/Box', 'data': [2, 2, 2]}}", NULL);

    (void)state;
    assert_non_null(scene);
    assert_surface(scene, 2, 0, 0);
    assert_surface(scene, 3, 0, 0);
    assert_surface(scene, 5, 0, 0);
    scene_destroy(scene);
}

/* --- what else may be written --- */

#define ONE_NODE(node) "{'scene': [" node "]}"

static void built_in_types(void **state)
{
    static const struct {
        const char *type, *data;
        double surface[3];
    } rows[] = {
        {"Sphere", "0.7", {0, 0.7, 0}},      {"Cuboid", "2, 4, 6", {1, 0, 0}},
        {"Box", "2, 4, 6", {0, 0, 3}},       {"Cylinder", "3, 0.5", {0, 3, 0}},
        {"Plane", "0, 1, 0, 2", {5, -2, 3}},
    };
    char text[256];

    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        snprintf(text, sizeof text, ONE_NODE("{'type': 'Primitives/%s', 'data': [%s]}"),
                 rows[i].type, rows[i].data);
        struct scene *scene = import_texts("s.json", text, NULL);
        assert_non_null(scene);
        assert_surface(scene, rows[i].surface[0], rows[i].surface[1], rows[i].surface[2]);
        scene_destroy(scene);
    }
}

static void operations_are_imported(void **state)
{
    static const char *const rows[][2] = {
        {"Union", "union"},
        {"Intersection", "intersection"},
        {"Subtraction", "difference"},
        {"SmoothUnion", "smooth_union"},
        {"SmoothIntersection", "smooth_intersection"},
        {"SmoothSubtraction", "smooth_difference"},
    };
    char text[256];

    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        const bool smooth = rows[i][0][1] == 'm';

        snprintf(text, sizeof text,
                 ONE_NODE("{'type': 'Operations/%s'%s, 'children':"
                          " [{'type': 'Primitives/Sphere'}, {'type': 'Primitives/Box'}]}"),
                 rows[i][0], smooth ? ", 'data': [0.25]" : "");
        struct scene *scene = import_texts("s.json", text, NULL);
        assert_non_null(scene);
        const struct node *node = scene->root->children[0];
        assert_string_equal(node->type->record.name, rows[i][1]);
        assert_int_equal(node->child_count, 2);
        if (smooth) {
            assert_true(record_number(&node->params, "k") == 0.25);
        }
        scene_destroy(scene);
    }
}

/* "round_box" as "RoundBox". */
static void camel(const char *name, char *out)
{
    bool first = true;

    for (; *name; name++) {
        if (*name != '_') {
            *out++ = (char)(first && *name >= 'a' ? *name - 'a' + 'A' : *name);
        }
        first = *name == '_';
    }
    *out = '\0';
}

static const char *group_of(const struct node_type *type)
{
    return type->group == GROUP_PRIMITIVE || type->group == GROUP_SHAPE ? "Primitives"
           : type->group == GROUP_MODIFIER                              ? "Modifiers"
                                                                        : "Operations";
}

/* Without data each is as the registry makes it; a file's own names are Models and the rest. */
static void every_type_has_a_name(void **state)
{
    size_t named = 0;
    char text[256], name[64];

    (void)state;
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);

        if (type->kind == KIND_MODEL || type->kind == KIND_CODE || type->kind == KIND_EQUATION ||
            type->kind == KIND_SURFACE) {
            continue;
        }
        camel(type->record.name, name);
        for (int again = 0; again < 1 + (type->group == GROUP_MODIFIER); again++) {
            snprintf(text, sizeof text,
                     ONE_NODE("{'type': '%s/%s', 'children': [{'type': 'Primitives/Sphere'}]}"),
                     again ? "Operations" : group_of(type), name);
            struct scene *scene = import_texts("s.json", text, NULL);
            if (!scene) {
                fail_msg("%s: %s", text, err.message);
            }
            assert_ptr_equal(scene->root->children[0]->type, type);
            scene_destroy(scene);
        }
        named++;
    }
    assert_int_equal(named + 4, node_type_count());
}

static const struct node *first_node(struct scene **out, const char *node)
{
    char text[512];

    snprintf(text, sizeof text, ONE_NODE("%s"), node);
    *out = import_texts("s.json", text, NULL);
    if (!*out) {
        fail_msg("%s: %d:%d: %s", node, err.line, err.column, err.message);
    }
    return (*out)->root->children[0];
}

/* Numbers in the order of the row: vectors as their parts, switches as 0 and 1, a choice by its
 * place, points as pairs. What is not reached keeps its default. */
static void data_in_order(void **state)
{
    static const struct {
        const char *node, *params;
    } rows[] = {
        {"{'type': 'Primitives/Torus', 'data': [2, 0.5]}", "{'radius':2,'tube':0.5}"},
        {"{'type': 'Primitives/Torus', 'data': [2, 0.5, 0, 0, 0, 0, 0, 0]}",
         "{'radius':2,'tube':0.5}"},
        {"{'type': 'Primitives/RoundBox', 'data': [2, 3, 4]}", "{'size':[2,3,4]}"},
        {"{'type': 'Primitives/RoundBox', 'data': [2, 3, 4, 0.5]}",
         "{'size':[2,3,4],'radius':0.5}"},
        {"{'type': 'Primitives/Quad', 'data': [0,0,0, 1,0,0, 1,1,0, 0,1,0, 0.25]}",
         "{'a':[0,0,0],'b':[1,0,0],'c':[1,1,0],'d':[0,1,0],'thickness':0.25}"},
        {"{'type': 'Primitives/Polygon', 'data': [0, 0, 1, 0, 1, 1, 0.5, 2, 0, 1]}",
         "{'points':[[0,0],[1,0],[1,1],[0.5,2],[0,1]]}"},
        {"{'type': 'Modifiers/Mirror', 'data': [0, 1, 1]}", "{'axes':[false,true,true]}"},
        {"{'type': 'Operations/Repeat', 'data': [1, 2, 3, 4, -1, 0]}",
         "{'spacing':[1,2,3],'count':[4,-1,0]}"},
        {"{'type': 'Modifiers/Twist', 'data': [0.75]}", "{'rate':0.75}"},
        {"{'type': 'Operations/SmoothUnion', 'data': [0.25, 1]}", "{'k':0.25,'kernel':'cubic'}"},
        {"{'type': 'Operations/Morph', 'data': [0.25]}", "{'t':0.25}"},
    };

    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct scene *scene;
        const struct node *node = first_node(&scene, rows[i].node);
        cJSON *json = cJSON_CreateObject();
        record_print(&node->params, json);
        char *text = json_print(json, false);

        json_text_assert_equal(text, rows[i].params);
        free(text);
        cJSON_Delete(json);
        scene_destroy(scene);
    }
}

/* The thesis' prism has the name of ours. */
static void files_come_first(void **state)
{
    static const char prism[] = "{'name': 'HexPrism', 'id': 40,"
                                " 'code': 'float sdf(vec3 p) { return length(p) - 1.0; }'}";
    struct scene *scene =
        import_texts("s.json", ONE_NODE("{'type': 'Primitives/HexPrism'}"), "p.json", prism, NULL);

    (void)state;
    assert_non_null(scene);
    assert_int_equal(scene->root->children[0]->type->kind, KIND_CODE);
    scene_destroy(scene);
}

/* The camera is far enough away for what is larger than a ball of 1. */
static void camera_sees_built_in_types(void **state)
{
    struct scene *scene;

    (void)state;
    first_node(&scene, "{'type': 'Primitives/Torus', 'data': [5, 1]}");
    check_seen(scene, (double[3]){6, 0, 0});
    check_seen(scene, (double[3]){0, 0, -6});
    scene_destroy(scene);
    first_node(&scene, "{'type': 'Modifiers/Repeat', 'data': [4, 1, 1, 5, 0, 0],"
                       " 'children': [{'type': 'Primitives/Octahedron', 'data': [1]}]}");
    check_seen(scene, (double[3]){9, 0, 0});
    check_seen(scene, (double[3]){-9, 0, 0});
    scene_destroy(scene);
}

/* Code of the thesis says each property once more, with the type of its annotation. */
static void properties_of_every_type(void **state)
{
    static const char shader[] =
        "{'name': 'Pos', 'properties': ['[float] _F', '[float2] _F2', '[float3] _F3',"
        " '[float4] _F4', '[int] _I', '[int2] _I2', '[int3] [Range(-4, 4)] _I3', '[int4] _I4'],"
        " 'code': 'float _F; float2 _F2; float3 _F3; float4 _F4; int _I; int2 _I2; int3 _I3;"
        " int4 _I4;\nfloat3 shade(FragmentProperties p) { return float3(_I2.y % 3, _I3.z,"
        " _I4.w) + _F3 * _F4.xyz * _F2.x * _F * float(_I); }'}";
    static const char material[] =
        "{'base_shader': 'Pos', 'properties': [{'name': '_I2', 'type': 'int2', 'value': '(1, 5)'},"
        " {'name': '_I3', 'type': 'int3', 'value': '(1, 2, -3)'},"
        " {'name': '_I4', 'value': '(1, 2, 3, 4)'}]}";
    static const double three[] = {1, 2, -3};
    struct scene *scene = import_texts("pos.json", shader, "m.json", material, NULL);

    (void)state;
    if (!scene) {
        fail_msg("%s:%d:%d: %s", err.place, err.line, err.column, err.message);
    }
    const struct record *record = &resource_find(&scene->materials, "m")->record;
    assert_int_equal(record->type->params[record_type_find(record->type, "_I2")].type, PARAM_IVEC2);
    assert_memory_equal(record_vector(record, "_I3"), three, sizeof three);
    field_unref(compile_field(scene));
    scene_destroy(scene);
    assert_null(import_texts("pos.json", shader, "m.json",
                             "{'base_shader': 'Pos', 'properties': [{'name': '_I2',"
                             " 'value': '(1, 0.5)'}]}",
                             NULL));
    assert_non_null(strstr(err.message, "0.5 (y) is not a whole number"));
}

/* What a document cannot hold of a name is replaced; it reads back. */
static void names_that_are_no_text(void **state)
{
    static const char model[] = "{'model': {'type': 'Primitives/Sphere'}}";
    static const char *const paths[] = {"sc\xe9ne.json",
                                        "d/a\x01\x7f"
                                        "b.json",
                                        "\xff.json", "\xed\xa0\x80.json"};
    static const char *const names[] = {"sc\xef\xbf\xbdne",
                                        "a\xef\xbf\xbd\xef\xbf\xbd"
                                        "b",
                                        "\xef\xbf\xbd", "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd"};

    (void)state;
    for (size_t i = 0; i < COUNT(paths); i++) {
        struct scene *scene = import_texts(paths[i], model, NULL);
        assert_non_null(scene);
        assert_string_equal(record_text(&scene->info, "name"), names[i]);
        char *text = scene_print(scene, false);
        struct scene *again = scene_parse(text, strlen(text), &err);
        if (!again) {
            fail_msg("%s: %s", err.place, err.message);
        }
        scene_destroy(again);
        free(text);
        scene_destroy(scene);
    }
}

/* Colours go into the picture as the shader gives them. */
static void colours_are_kept(void **state)
{
    struct scene *scene = import_with(LISTINGS "scenes/Cena1.json");

    (void)state;
    assert_true(record_is(&scene->render, "tone_map", "none"));
    scene_destroy(scene);
}

/* Printed there: Rx and Ry with the signs of a turn the other way, Rz as ours. */
static void rotations_are_imported(void **state)
{
    static const struct {
        const char *axis;
        double end[3];
    } rows[] = {{"x", {0, 0, -3}}, {"y", {0, 3, 0}}, {"z", {-3, 0, 0}}};
    char text[256];

    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        snprintf(text, sizeof text,
                 ONE_NODE("{'type': 'Operations/Union', 'transform': {'rotation':"
                          " {'%s': 1.5707963267948966}}, 'children': [{'type': 'Primitives/Sphere',"
                          " 'data': [1], 'transform': {'position': {'y': 2}}}]}"),
                 rows[i].axis);
        struct scene *scene = import_texts("s.json", text, NULL);
        assert_non_null(scene);
        assert_surface(scene, rows[i].end[0], rows[i].end[1], rows[i].end[2]);
        scene_destroy(scene);
    }
}

static void ids_are_made_of_names(void **state)
{
    static const char material[] = "{'base_shader': 'phong'}";
    static const char shader[] =
        "{'name': 'phong', 'properties': [],"
        " 'code': 'float3 shade(FragmentProperties p) { return float3(1); }'}";
    struct scene *scene =
        import_texts("a/pele clara.json", material,
                     "b/pele\xc3\xa9"
                     "clara.json",
                     material, "c/\xc3\xa9.json", material, "phong.json", shader, NULL);

    (void)state;
    assert_non_null(scene);
    assert_non_null(resource_find(&scene->materials, "pele-clara"));
    assert_non_null(resource_find(&scene->materials, "pele-clara-2"));
    assert_non_null(resource_find(&scene->materials, "material"));
    /* A built-in shader has the name. */
    assert_non_null(resource_find(&scene->shaders, "phong-2"));
    assert_string_equal(record_text(&scene->root->children[1]->common, "name"), "pele\xc3\xa9"
                                                                                "clara");
    scene_destroy(scene);
}

static void commas_and_line_breaks(void **state)
{
    struct scene *scene = import_texts(
        "s.json",
        "{'name': 'a'\n 'scene': [{'type': 'Primitives/Sphere' 'data': [1]}\r\n"
        "{'type': 'Primitives/Box'}]}",
        "p.json", "{'id': 40, 'code': 'float sdf(vec3 p) {\r\n\treturn length(p);\r\n}'}", NULL);

    (void)state;
    assert_non_null(scene);
    assert_int_equal(scene->root->child_count, 2);
    assert_int_equal(cJSON_GetArraySize(notes), 3);
    assert_string_equal(notes->child->valuestring,
                        "s.json:2:2: read as if there were a ',' before this");
    assert_string_equal(record_text(&scene->primitives.items[0]->record, "code"),
                        "float sdf(vec3 p) {\n\treturn length(p);\n}");
    scene_destroy(scene);
}

/* --- what is refused --- */

#define NODE ONE_NODE
#define SPHERE "'type': 'Primitives/Sphere'"

static const struct {
    const char *text;
    int line, column;
    const char *message;
} refused[] = {
    {"", 1, 1, "the file ends here, expected an object"},
    {"[]", 1, 1, "expected an object"},
    {"{'scene': [}", 1, 12, "expected a value, not '}'"},
    {"{\n'scene': [],\n}", 3, 1, "expected the name of a member in quotes, not '}'"},
    {"{'scene': [1,]}", 1, 14, "expected a value, not ']'"},
    {"{'scene': []", 1, 13, "the file ends here, expected ',' or '}'"},
    {"{'scene': []} x", 1, 15, "expected the end of the file, not 'x'"},
    {"{'scene' []}", 1, 10, "expected ':'"},
    {"{'name': 'x\n\n", 1, 10, "the text that begins here does not end"},
    {"{'name': '\\x'}", 1, 11, "no escape of JSON"},
    {"{'name': '\\ud800'}", 1, 11, "no escape of JSON"},
    {"{'name': '\x01'}", 1, 11, "a control character"},
    {"{'name': '\xff'}", 1, 11, "not UTF-8"},
    {"{'scene': 01}", 1, 11, "expected a number"},
    {"{'scene': .5}", 1, 11, "expected a value, not '.'"},
    {"{'scene': 1e999}", 1, 11, "this number is too large"},
    {"{'scene': [], 'scene': []}", 1, 24, "stands in the object already"},
    {"{'scene': [1, 'a': 2]}", 1, 18, "expected ',' or ']', not ':'"},
    {"{'other': 1}", 1, 1, "neither a scene"},
    {"{'scene': {}}", 1, 11, "scene: expected a list"},
    {"{'scene': [], 'nmae': 1}", 1, 23, "did you mean \"name\"?"},
    {NODE("1"), 1, 12, "expected a node"},
    {NODE("{}"), 1, 12, "expected one member type"},
    {NODE("{'type': 'Sphere'}"), 1, 21, "is no type"},
    {NODE("{'type': 'Primitives/Sphera'}"), 1, 21, "no file has the primitive"},
    {NODE("{'type': 'Primitives/Sphera'}"), 1, 21, "did you mean \"Primitives/Sphere\"?"},
    {NODE("{'type': 'Modifiers/Twists'}"), 1, 21, "did you mean \"Modifiers/Twist\"?"},
    {NODE("{'type': 'Modifiers/Union'}"), 1, 21, "is no type"},
    {NODE("{'type': 'Primitives/RoundBox', 'data': [1, 1]}"), 1, 52,
     "data: expected 3 numbers for RoundBox"},
    {NODE("{'type': 'Primitives/CappedTorus', 'data': [1, 1, 1, 1, 1, 1, 1, 1, 1]}"), 1, 80,
     "data: more than 8 numbers"},
    {NODE("{'type': 'Modifiers/Repeat', 'data': [1, 1, 1, 2]}"), 1, 49,
     "data: expected 3 numbers for count, and 1 is left"},
    {NODE("{'type': 'Modifiers/Mirror', 'data': [1, 2, 0]}"), 1, 49,
     "data: expected 0 or 1 for each axis for axes"},
    {NODE("{'type': 'Modifiers/Repeat', 'data': [1, 1, 1, 0.5, 1, 1]}"), 1, 12,
     "count: 0.5 (x) is not a whole number"},
    {NODE("{'type': 'Operations/SmoothUnion', 'data': [1, 99]}"), 1, 55,
     "data: expected the place of one of its choices, from 0 for kernel"},
    {NODE("{'type': 'Primitives/Polygon', 'data': [1, 0, 0, 1, 0, 0, 1]}"), 1, 51,
     "data: expected x and y of each point for points"},
    {NODE("{'type': 'Operations/Union', 'data': [1]}"), 1, 49,
     "data: expected 0 numbers for Union"},
    {NODE("{'type': 'Operations/Unoin'}"), 1, 21, "did you mean \"Operations/Union\"?"},
    {NODE("{'type': 'Models/Nobody'}"), 1, 21, "no file has the model \"Nobody\""},
    {NODE("{" SPHERE ", 'data': []}"), 1, 50, "data: expected 1 number for Sphere"},
    {NODE("{" SPHERE ", 'data': ['1']}"), 1, 51, "data: expected a number"},
    {NODE("{" SPHERE ", 'data': [1,2,3,4,5,6,7,8,9]}"), 1, 67, "more than 8 numbers"},
    {NODE("{" SPHERE ",\n'data': [-1]}"), 1, 12, "radius: -1 is "},
    {NODE("{" SPHERE ", 'material_id': 0}"), 1, 57, "material_id: 0 is none of the 0"},
    {NODE("{" SPHERE ", 'transform': {'pos': 1}}"), 1, 63, "no member \"pos\" here"},
    {NODE("{" SPHERE ", 'transform': {'scale': {'x': 0}}}"), 1, 12, "scale: 0 (x)"},
    {NODE("{" SPHERE ", 'transform': {'position': [1]}}"), 1, 68, "expected an object"},
    {"{'id': 31, 'code': ''}", 1, 8, "id: expected a whole number of at least 32"},
    {"{'id': 33, 'code': 1}", 1, 20, "code: expected a text in quotes"},
    {"{'properties': ['_A'], 'code': ''}", 1, 17, "expected a property as"},
    {"{'properties': ['[half] _A'], 'code': ''}", 1, 17, "expected a property as"},
    {"{'properties': ['[float] [Range(0)] _A'], 'code': ''}", 1, 17, "[Range(0, 1)]"},
    {"{'base_shader': 'x'}", 1, 17, "no file has the shader \"x\""},
};

static void faulty_files_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(refused); i++) {
        struct scene *scene = import_texts("f/s.json", refused[i].text, NULL);

        if (scene || strcmp(err.place, "f/s.json") != 0 || err.line != refused[i].line ||
            err.column != refused[i].column || !strstr(err.message, refused[i].message)) {
            fail_msg("%s\n  expected %d:%d: %s\n  got %s:%d:%d: %s", refused[i].text,
                     refused[i].line, refused[i].column, refused[i].message, err.place, err.line,
                     err.column, err.message);
        }
    }
}

static void refused_materials(void **state)
{
    static const char shader[] = "{'name': 'S', 'properties': ['[float] [Range(0, 1)] _A',"
                                 " '[float3] _B'], 'code': ''}";

    static const struct {
        const char *property, *message;
    } rows[] = {
        {"{'name': '_C', 'type': 'float', 'value': '1'}", "has no property \"_C\""},
        {"{'name': '_A', 'type': 'float3', 'value': '1'}", "_A is a float"},
        {"{'name': '_A', 'type': 'float', 'value': 'x'}", "expected a text as \"0.5\""},
        {"{'name': '_A', 'type': 'float', 'value': '(1, 2)'}", "expected a text as"},
        {"{'name': '_A', 'type': 'float', 'value': '2'}", "2 is above the maximum 1"},
        {"{'name': '_A', 'type': 'float', 'value': 'nan'}", "expected a text as"},
        {"{'name': '_B', 'type': 'float3', 'value': '(1, 2)'}", "\"(0.5, 1, 0)\""},
        {"{'name': '_B', 'type': 'float3', 'value': '(1, 2, 3, 4)'}", "(0.5, 1, 0)"},
        {"{'name': '_B', 'type': 'float3'}", "expected a text as"},
        {"{'nome': '_B'}", "name is missing"},
        {"1", "expected a property"},
    };
    char text[256];

    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        snprintf(text, sizeof text, "{'base_shader': 'S',\n'properties': [%s]}", rows[i].property);
        struct scene *scene = import_texts("s.json", shader, "m.json", text, NULL);
        if (scene || strcmp(err.place, "m.json") != 0 || err.line < 1 ||
            !strstr(err.message, rows[i].message)) {
            fail_msg("%s\n  got %s:%d: %s", text, err.place, err.line, err.message);
        }
    }
}

/* One node on each line, and the root above them. */
static void too_many_nodes_are_refused(void **state)
{
    char *text, *quoted;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    (void)state;
    fputs("{'scene': [", out);
    for (int i = 0; i < LIMIT_NODES + 9; i++) {
        fprintf(out, "%s{'type':'Operations/Union'}", i ? ",\n" : "\n");
    }
    fputs("]}", out);
    fclose(out);
    quoted = json_text(text);
    free(text);
    const struct import_file file = {"s.json", quoted, length};
    assert_null(convert(&file, 1, NULL));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.place, "s.json");
    assert_int_equal(err.line, LIMIT_NODES + 1);
    assert_string_equal(err.message, "100001 nodes are above the maximum 100000");
    free(quoted);
}

static void too_many_properties_are_refused(void **state)
{
    char list[17 * 16] = "", shader[400];

    (void)state;
    for (int i = 0; i < LIMIT_DECLARED + 1; i++) {
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s'[int] _%d'", i ? "," : "", i);
    }
    snprintf(shader, sizeof shader, "{'code': '', 'properties': [%s]}", list);
    assert_null(import_texts("m.json", "{'base_shader': 's'}", "s.json", shader, NULL));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.place, "s.json");
    assert_int_equal(err.column, 28);
    assert_string_equal(err.message, "17 properties are above the maximum 16");
}

/* A name of its own goes before one that a file has by the way. */
static void names_go_before_others(void **state)
{
    static const char model[] = "{'name': 'm', 'model': {'type': 'Primitives/Sphere'}}";
    static const char other[] = "{'name': 'o', 'model': {'type': 'Primitives/Box'}}";

    (void)state;
    struct scene *scene =
        import_texts("a.json", model, "m.json", other, "b.json", model, "s.json",
                     "{'scene': [{'type': 'Models/m'}, {'type': 'Models/o'}]}", NULL);
    assert_non_null(scene);
    for (int i = 0; i < 2; i++) {
        assert_string_equal(record_text(&scene->root->children[i]->params, "model"), "o");
    }
    scene_destroy(scene);
    assert_null(import_texts("a.json", model, "c.json", other, "b.json", model, "s.json",
                             "{'scene': [{'type': 'Models/m'}]}", NULL));
    assert_non_null(strstr(err.message, "\"m\" may be the model of a.json or of b.json"));
}

static void ambiguous_references_are_refused(void **state)
{
    static const char empty[] = "{\"name\": \"A\", \"scene\": []}";
    static const char model[] = "{'model': {'type': 'Primitives/Sphere'}}";
    static const char user[] = "{'scene': [{'type': 'Models/m'}]}";
    const struct import_file two[] = {{"x/a.json", empty, strlen(empty)},
                                      {"x/b.json", empty, strlen(empty)}};

    (void)state;
    assert_null(import_texts("x/a.json", empty, "x/b.json", empty, NULL));
    assert_non_null(strstr(err.message, "there are 2 scenes: \"A\", \"A\"; say which"));
    struct scene *scene = convert(two, 2, "b"); /* by its file */
    assert_non_null(scene);
    scene_destroy(scene);
    assert_null(convert(two, 2, "A"));
    assert_non_null(strstr(err.message, "may be the scene of x/a.json or of x/b.json"));
    assert_null(import_texts("x/m.json", model, "y/m.json", model, "s.json", user, NULL));
    assert_non_null(strstr(err.message, "may be the model of x/m.json or of y/m.json"));
    assert_null(import_texts("readme.txt", "", NULL));
    assert_non_null(strstr(err.message, "there is no file"));
}

static void models_in_a_circle_are_refused(void **state)
{
    (void)state;
    assert_null(import_texts("a.json", "{'model': {'type': 'Models/b'}}", "b.json",
                             "{'model': {'type': 'Models/a'}}", NULL));
    assert_int_equal(err.kind, ERROR_CONFLICT);
    assert_non_null(strstr(err.message, "/models/a"));
    assert_non_null(strstr(err.message, "/models/b"));
}

static int finish(void **state)
{
    (void)state;
    cJSON_Delete(notes);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_as_printed),
        cmocka_unit_test(scene_of_the_draft),
        cmocka_unit_test(materials_are_imported),
        cmocka_unit_test(primitives_are_imported),
        cmocka_unit_test(camera_and_light),
        cmocka_unit_test(without_a_scene),
        cmocka_unit_test(side_by_side),
        cmocka_unit_test(built_in_types),
        cmocka_unit_test(operations_are_imported),
        cmocka_unit_test(every_type_has_a_name),
        cmocka_unit_test(data_in_order),
        cmocka_unit_test(files_come_first),
        cmocka_unit_test(camera_sees_built_in_types),
        cmocka_unit_test(properties_of_every_type),
        cmocka_unit_test(names_that_are_no_text),
        cmocka_unit_test(colours_are_kept),
        cmocka_unit_test(rotations_are_imported),
        cmocka_unit_test(ids_are_made_of_names),
        cmocka_unit_test(commas_and_line_breaks),
        cmocka_unit_test(faulty_files_are_refused),
        cmocka_unit_test(refused_materials),
        cmocka_unit_test(too_many_nodes_are_refused),
        cmocka_unit_test(too_many_properties_are_refused),
        cmocka_unit_test(names_go_before_others),
        cmocka_unit_test(ambiguous_references_are_refused),
        cmocka_unit_test(models_in_a_circle_are_refused),
    };

    cmocka_set_message_output(CM_OUTPUT_TAP);
    return cmocka_run_group_tests(tests, NULL, finish);
}
