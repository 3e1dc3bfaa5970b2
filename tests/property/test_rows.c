/* SPDX-License-Identifier: MIT */
/* Every row of lights, volumes, shaders and outputs does something in pictures, and so does every
 * parameter of each: what only one side of the program knows is found here. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/nodes.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

enum { WIDTH = 64, HEIGHT = 48 };

static struct renderer *renderer;

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int end(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

/* --- a scene around one row --- */

/* Near enough to light and lens for all that happens there; the row's list is still empty. */
static const char around[] =
    "{'format':'fieldcast/1','camera':{'position':[0.3,1,2.4],'target':[0.1,-0.1,0]},"
    "'render':{'antialiasing':'none','tone_map':'none'},"
    "'environment':{'intensity':0.3,'floor':true,'floor_height':-0.5},"
    "'root':{'id':'root','type':'union','children':["
    "{'id':'ball','type':'sphere','transform':{'translation':[-0.4,0,0]}},"
    "{'id':'box','type':'box','params':{'size':[0.2,0.3,0.2]},"
    "'transform':{'translation':[0.5,-0.35,-0.2]}}]}}";
static const char sun[] = "{'type':'directional','intensity':2,'direction':[-1,-0.8,-0.7]}";

/* The row as a member of the document, where it is looked at. */
static cJSON *scene_of(const struct record_type *table, const cJSON *row)
{
    cJSON *scene = json_text_parse(around, NULL), *own = cJSON_Duplicate(row, true);
    cJSON *lights = cJSON_AddArrayToObject(scene, "lights");

    if (table == shader_types) {
        cJSON *materials = cJSON_AddObjectToObject(scene, "materials");
        cJSON *material = cJSON_AddObjectToObject(materials, "own");
        cJSON *root = cJSON_GetObjectItem(scene, "root");
        cJSON_AddItemToObject(material, "shader", cJSON_DetachItemFromObject(own, "type"));
        cJSON_AddItemToObject(material, "properties", own);
        cJSON_AddStringToObject(cJSON_GetObjectItem(root, "children")->child, "material", "own");
    } else {
        cJSON_AddItemToArray(
            table == light_types ? lights : cJSON_AddArrayToObject(scene, "volumes"), own);
    }
    if (table != light_types) {
        cJSON_AddItemToArray(lights, json_text_parse(sun, NULL));
    }
    return scene;
}

static struct image draw(cJSON *scene)
{
    char *text = cJSON_PrintUnformatted(scene);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.as_floats = true;
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct image image = drawing_of(resident, &desc, AOV_COLOR);

    resident_destroy(resident);
    free(text);
    cJSON_Delete(scene);
    return image;
}

/* --- values --- */

static double another(const struct param *param, double now, int component)
{
    double low, high;

    param_range(param, &low, &high);
    const double more = now * 1.6 + 0.35 + 0.1 * component, less = now * 0.5 - 0.1 * component;
    const double value = more < high ? more : fmax(less, low + 1e-3);
    return param->type == PARAM_INT ? ceil(value) : value;
}

/* A value that is not `now`, which has the row's type. */
static cJSON *another_value(const struct param *param, const cJSON *now)
{
    if (param->type == PARAM_BOOL) {
        return cJSON_CreateBool(!cJSON_IsTrue(now));
    }
    if (param->type == PARAM_EQUATION) {
        return cJSON_CreateString("x");
    }
    if (param_components(param->type) == 1) {
        return cJSON_CreateNumber(another(param, now->valuedouble, 0));
    }
    cJSON *list = cJSON_CreateArray();
    int i = 0;
    for (const cJSON *one = now->child; one; one = one->next) {
        cJSON_AddItemToArray(list, cJSON_CreateNumber(another(param, one->valuedouble, i++)));
    }
    return list;
}

/* Numbers that make the parameters of a row matter, where their defaults do not. */
static cJSON *plain_row(const struct record_type *type)
{
    static const struct {
        const char *name, *value;
    } values[] = {{"opacity", "0.5"},
                  {"transmission", "0.5"},
                  {"reflectivity", "0.3"},
                  {"roughness", "0.2"},
                  {"metallic", "0.2"},
                  {"radii", "[0.9,0.5,0.7]"},
                  {"softness", "0.5"},
                  {"scale", "0.3"},
                  {"density", "2"},
                  {"attenuation_color", "[0.9,0.6,0.3]"},
                  {"direction", "[-0.4,-0.8,-0.6]"}};
    cJSON *row = cJSON_CreateObject();

    cJSON_AddStringToObject(row, "type", type->name);
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        if (record_type_find(type, values[i].name) >= 0) {
            cJSON_AddItemToObject(row, values[i].name, cJSON_Parse(values[i].value));
        }
    }
    if (record_type_find(type, "range") >= 0) { /* a lamp, close to the box */
        cJSON_AddItemToObject(row, "position", cJSON_Parse("[0.75,0.3,0.3]"));
        cJSON_AddNumberToObject(row, "radius", 0.6);
    }
    return row;
}

/* Makes `name=value`, `name!=value` or `name~letter` true. */
static void fulfil(const struct record_type *type, cJSON *row, const char *when)
{
    const size_t end = strcspn(when, "!=~");
    const char *value = when + end + (when[end] == '!' ? 2 : 1);
    char name[40], sum[40];

    snprintf(name, sizeof name, "%.*s", (int)end, when);
    snprintf(sum, sizeof sum, "x + %s", value);
    const struct param *param = &type->params[record_type_find(type, name)];
    if (strstr(when, "!=")) {
        assert_non_null(cJSON_GetObjectItem(row, name)); /* plain_row knows a value */
    } else if (param->type == PARAM_ENUM) {
        cJSON_DeleteItemFromObject(row, name);
        cJSON_AddStringToObject(row, name, value);
    } else if (param->type == PARAM_EQUATION) {
        cJSON_AddStringToObject(row, name, sum);
    }
}

static void set(cJSON *row, const char *name, cJSON *value)
{
    cJSON_DeleteItemFromObject(row, name);
    cJSON_AddItemToObject(row, name, value);
}

/* --- every parameter of every row --- */

struct walk {
    const struct record_type *table, *type;
    int pictures;
};

static void assert_differs(const struct image *a, const struct image *b, const char *type,
                           const char *what)
{
    if (drawing_is_same(a, b)) {
        fail_msg("%s: %s changes nothing in the picture", type, what);
    }
}

static void walk_choices(struct walk *walk, const struct param *param, const cJSON *row)
{
    struct image before = {0};

    for (int i = 0; param->choices[i]; i++) {
        cJSON *other = cJSON_Duplicate(row, true);
        set(other, param->name, cJSON_CreateString(param->choices[i]));
        struct image image = draw(scene_of(walk->table, other));
        if (i > 0) {
            assert_differs(&before, &image, walk->type->name, param->choices[i]);
        }
        cJSON_Delete(other);
        image_finish(&before);
        before = image;
        walk->pictures++;
    }
    image_finish(&before);
}

static void walk_param(struct walk *walk, const struct param *param)
{
    cJSON *row = plain_row(walk->type);

    if (param->when) {
        fulfil(walk->type, row, param->when);
    }
    if (param->type == PARAM_ENUM) {
        walk_choices(walk, param, row);
        cJSON_Delete(row);
        return;
    }
    struct image before = draw(scene_of(walk->table, row));
    const cJSON *own = cJSON_GetObjectItem(row, param->name);
    cJSON *now = own ? cJSON_Duplicate(own, true) : param_default(param);
    set(row, param->name, another_value(param, now));
    struct image after = draw(scene_of(walk->table, row));
    assert_differs(&before, &after, walk->type->name, param->name);
    image_finish(&before);
    image_finish(&after);
    cJSON_Delete(now);
    cJSON_Delete(row);
    walk->pictures += 2;
}

static void walk_rows(const struct record_type *table)
{
    struct walk walk = {.table = table};

    for (walk.type = table; walk.type->name; walk.type++) {
        for (const struct param *param = walk.type->params; param->name; param++) {
            walk_param(&walk, param);
        }
    }
    print_message("%d pictures\n", walk.pictures);
}

static void every_parameter_of_every_light(void **state)
{
    (void)state;
    walk_rows(light_types);
}

static void every_parameter_of_every_volume(void **state)
{
    (void)state;
    walk_rows(volume_types);
}

static void every_parameter_of_every_shader(void **state)
{
    (void)state;
    walk_rows(shader_types);
}

/* --- rows among themselves --- */

static void no_two_rows_look_alike(void **state)
{
    static const struct record_type *const tables[] = {light_types, volume_types, shader_types};

    enum { MOST = 16 };

    (void)state;
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        struct image images[MOST] = {0};
        int count = 0;
        for (const struct record_type *type = tables[t]; type->name; type++) {
            assert_true(count < MOST);
            cJSON *row = plain_row(type);
            images[count] = draw(scene_of(tables[t], row));
            cJSON_Delete(row);
            for (int i = 0; i < count; i++) {
                assert_differs(&images[i], &images[count], type->name, tables[t][i].name);
            }
            count++;
        }
        for (int i = 0; i < count; i++) {
            image_finish(&images[i]);
        }
    }
}

/* --- outputs --- */

/* More than one value in the picture. */
static bool has_detail(const struct image *image)
{
    const uint8_t *bytes = image->pixels;
    const size_t pixel = image->bytes / ((size_t)image->width * (size_t)image->height);

    for (size_t i = pixel; i < image->bytes; i += pixel) {
        if (memcmp(bytes, bytes + i, pixel) != 0) {
            return true;
        }
    }
    return false;
}

static void every_output_in_every_form(void **state)
{
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);

    (void)state;
    for (int floats = 0; floats < 2; floats++) {
        struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
        desc.as_floats = floats == 1;
        for (int aov = 0; aov < AOV_COUNT; aov++) {
            desc.aovs[aov] = floats == 1 || aov_row(aov)->picture;
        }
        struct drawing drawing = drawing_outputs(renderer, resident, &desc);
        for (int i = 0; i < AOV_COUNT; i++) {
            const struct image *one = &drawing.of[i];
            const int size = 4 * aov_row(i)->channels;
            if (desc.aovs[i] && !has_detail(one)) {
                fail_msg("%s is the same everywhere", aov_name(i));
            }
            assert_true(floats == 0 || one->bytes == (size_t)(WIDTH * HEIGHT * size));
        }
        drawing_finish(&drawing);
    }
    resident_destroy(resident);
}

/* Black where a ray took no step, white from STEPS_WHITE on, and ever lighter between. */
static void steps_are_shown_by_their_scale(void **state)
{
    struct resident *resident = drawing_resident(renderer, DRAWING_RICH);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image shown = drawing_of(resident, &desc, AOV_STEPS);
    int compared = 0;

    (void)state;
    desc.as_floats = true;
    struct image raw = drawing_of(resident, &desc, AOV_STEPS);
    resident_destroy(resident);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double steps = (double)((const float *)raw.pixels)[i];
        const double place = fmin(steps / STEPS_WHITE, 1) * (STEPS_COLORS - 1);
        const int k = place < STEPS_COLORS - 2 ? (int)place : STEPS_COLORS - 2;
        for (int j = 0; j < 3; j++) {
            const double want =
                steps_colors[k][j] + (place - k) * (steps_colors[k + 1][j] - steps_colors[k][j]);
            const double got = ((const uint8_t *)shown.pixels)[4 * i + j];
            if (fabs(got - want) > 1) {
                fail_msg("%g steps are shown as %g, not %g", steps, got, want);
            }
        }
        compared += steps > 0;
    }
    assert_true(compared > WIDTH * HEIGHT / 4);
    image_finish(&shown);
    image_finish(&raw);
}

/* A ball before the ground, and two lights: the mean is taken over those that cast shadows. */
static void shadows_are_those_of_lights_that_throw_some(void **state)
{
    static const char *const lights[] = {
        "{'type':'directional','direction':[-1,-1,0],'shadow':'hard'}",
        "{'type':'directional','direction':[1,-1,0],'shadow':'none'}"};
    struct image images[3];

    (void)state;
    for (int i = 0; i < 3; i++) {
        cJSON *scene = json_text_parse(around, NULL),
              *list = cJSON_AddArrayToObject(scene, "lights");
        if (i < 2) {
            cJSON_AddItemToArray(list, json_text_parse(lights[0], NULL));
        }
        if (i > 0) {
            cJSON_AddItemToArray(list, json_text_parse(lights[1], NULL));
        }
        char *text = cJSON_PrintUnformatted(scene);
        struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
        struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
        desc.as_floats = true;
        images[i] = drawing_of(resident, &desc, AOV_SHADOW);
        resident_destroy(resident);
        free(text);
        cJSON_Delete(scene);
    }
    assert_true(drawing_is_same(&images[0], &images[1]));
    assert_true(has_detail(&images[0]));
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        assert_true(((const float *)images[2].pixels)[i] == 1);
    }
    for (int i = 0; i < 3; i++) {
        image_finish(&images[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_parameter_of_every_light),
        cmocka_unit_test(every_parameter_of_every_volume),
        cmocka_unit_test(every_parameter_of_every_shader),
        cmocka_unit_test(no_two_rows_look_alike),
        cmocka_unit_test(every_output_in_every_form),
        cmocka_unit_test(steps_are_shown_by_their_scale),
        cmocka_unit_test(shadows_are_those_of_lights_that_throw_some),
    };

    return cmocka_run_group_tests_name("rows", tests, start, end);
}
