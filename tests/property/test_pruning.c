/* SPDX-License-Identifier: MIT */
/* What the engine leaves out of a cube of space changes no bit of the field in it: for each
 * operation with each of its kernels, and for each other node type below them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/engine/engine.h"
#include "renderer/field/field.h"
#include "renderer/sdf/sdf.h"
#include "tests/support/json_text.h"
#include "tests/support/random_scene.h"

enum { OPERATION_SCENES = 24, TYPE_SCENES = 6, EQUATION_SCENES = 48, COPY_SCENES = 40 };
enum { OPERATIONS_MAX = 64, CLUSTERS = 12, CLUSTER = 32, POINTS = CLUSTERS * CLUSTER };
#define SIZE 2.5

/* An operation with one of its kernels; `choice` NULL: it has none. */
struct operation {
    const struct node_type *type;
    const char *param, *choice;
    size_t ran, whole; /* operations, over all points */
};

static size_t list_operations(struct operation *out)
{
    size_t count = 0;

    for (size_t t = 0; t < node_type_count(); t++) {
        const struct node_type *type = node_type_at(t);
        const struct param *param = type->record.params;
        while (param->name && param->type != PARAM_ENUM) {
            param++;
        }
        for (size_t i = 0; type->kind == KIND_COMBINE && (i == 0 || param->choices[i]); i++) {
            assert_true(count < OPERATIONS_MAX);
            out[count++] = (struct operation){.type = type,
                                              .param = param->name,
                                              .choice = param->name ? param->choices[i] : NULL};
            if (!param->name) {
                break;
            }
        }
    }
    return count;
}

/* Of four operands; the second is of this type, by chance where it is NULL. */
static struct scene *scene_of(struct random *random, const struct operation *operation,
                              const struct node_type *type)
{
    const struct random_limits limits = {.depth = 2};
    struct error err = {0};
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out,
            "{'format':'fieldcast/1','materials':{'m0':{'shader':'phong'},"
            "'m1':{'shader':'phong'},'m2':{'shader':'phong'}},"
            "'root':{'type':'%s','params':{",
            operation->type->record.name);
    if (operation->choice) {
        fprintf(out, "'%s':'%s'", operation->param, operation->choice);
    }
    fprintf(out, "},'children':[");
    for (int i = 0; i < 4; i++) {
        const struct node_type *chosen =
            i == 1 && type ? type : random_type(random, KIND_SHAPE, &limits);
        fprintf(out, i ? "," : "");
        random_node(random, out, chosen, &limits);
    }
    fprintf(out, "]}}");
    fclose(out);
    struct scene *scene = json_text_scene(text, &err);
    if (!scene) {
        fail_msg("%s: %s\n%s", err.place, err.message, text);
    }
    free(text);
    return scene;
}

/* In clusters that are a little wider than a cube of this half, so that some are near its faces. */
static void choose_points(struct random *random, double half, float points[POINTS][3])
{
    for (int i = 0; i < CLUSTERS; i++) {
        double middle[3];
        for (int k = 0; k < 3; k++) {
            middle[k] = random_between(random, -SIZE, SIZE);
        }
        for (int n = 0; n < CLUSTER; n++) {
            for (int k = 0; k < 3; k++) {
                points[i * CLUSTER + n][k] =
                    (float)(middle[k] + random_between(random, -half, half) * 1.2);
            }
        }
    }
}

static void compare(const struct field *field, const struct scene *scene, struct operation *sums,
                    const float (*points)[3], float half)
{
    static float whole[POINTS], pruned[POINTS];

    for (size_t i = 0; engine_lanes(i) > 0; i++) {
        struct engine_program *program =
            engine_program_create((struct field *)field, engine_lanes(i), 1);
        assert_non_null(program);
        sums->whole += engine_distances(program, field->params, points, POINTS, INFINITY, whole);
        sums->ran += engine_distances(program, field->params, points, POINTS, half, pruned);
        for (int k = 0; k < POINTS; k++) {
            if (memcmp(&whole[k], &pruned[k], sizeof whole[k]) != 0) {
                fprintf(stderr, "%s\n", scene_print(scene, false));
                fail_msg("%d lanes, half %g, at (%.9g, %.9g, %.9g): %.9g by all, %.9g by its cube",
                         engine_lanes(i), half, points[k][0], points[k][1], points[k][2], whole[k],
                         pruned[k]);
            }
        }
        engine_program_destroy(program);
    }
}

/* `drawn`: NULL, or the field before nodes were hidden, which keeps them in the program. */
static struct field *compile(const struct scene *scene, const struct field *drawn)
{
    const struct field_options options = {.drawn = drawn};
    struct error err = {0};
    struct field *field = field_compile_as(scene, &options, &err);

    if (!field) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return field;
}

/* Takes the field. */
static void look_at_field(struct random *random, struct field *field, const struct scene *scene,
                          struct operation *sums)
{
    static const float halves[] = {0.7f, 0.15f, 0.03f};
    static float points[POINTS][3];

    for (size_t i = 0; i < sizeof halves / sizeof halves[0]; i++) {
        choose_points(random, halves[i], points);
        compare(field, scene, sums, (const float(*)[3])points, halves[i]);
    }
    field_unref(field);
}

/* Takes the scene. */
static void look_at_scene(struct random *random, struct scene *scene, struct operation *sums)
{
    look_at_field(random, compile(scene, NULL), scene, sums);
    scene_destroy(scene);
}

static void look_at(struct random *random, struct operation *operation,
                    const struct node_type *type)
{
    look_at_scene(random, scene_of(random, operation, type), operation);
}

/* Whether it stops to feel an operand that is far away. */
static bool may_prune(const struct operation *operation)
{
    const struct sdf *sdf = sdf_find(operation->type);
    struct random random = {.state = 1};
    struct scene *scene = scene_of(&random, operation, NULL);
    double numbers[SDF_NUMBERS_MAX];

    sdf_numbers(scene->root->params.type->params, scene->root->params.values, numbers);
    scene_destroy(scene);
    return sdf->reach && isfinite(sdf->reach(numbers));
}

static void every_operation_keeps_its_bits(void **state)
{
    static struct operation operations[OPERATIONS_MAX];
    struct random random = {.state = 1};
    const size_t count = list_operations(operations);
    size_t pruning = 0;
    (void)state;

    for (size_t i = 0; i < count; i++) {
        struct operation *operation = &operations[i];
        for (int n = 0; n < OPERATION_SCENES; n++) {
            look_at(&random, operation, NULL);
        }
        if (may_prune(operation)) {
            pruning++;
            if (operation->ran >= operation->whole) {
                fail_msg("%s %s leaves nothing out", operation->type->record.name,
                         operation->choice ? operation->choice : "");
            }
        }
    }
    assert_true(pruning > 10);
}

static void hide(struct node *node)
{
    struct value *value = &node->common.values[record_type_find(node->common.type, "visible")];

    value->number[0] = false;
    value->set = true;
}

/* Each of the four operands, and two of them. */
static void hidden_operands_keep_their_bits(void **state)
{
    static struct operation operations[OPERATIONS_MAX];
    struct random random = {.state = 4};
    const size_t count = list_operations(operations);

    (void)state;
    for (size_t i = 0; i < count; i++) {
        for (size_t n = 0; n < 8; n++) {
            struct scene *scene = scene_of(&random, &operations[i], NULL);
            struct field *drawn = compile(scene, NULL);

            hide(scene->root->children[n % 4]);
            hide(scene->root->children[n / 2]);
            struct field *field = compile(scene, drawn);
            assert_true(field->structure_hash == drawn->structure_hash);
            field_unref(drawn);
            look_at_field(&random, field, scene, &operations[i]);
            scene_destroy(scene);
        }
    }
}

static void every_type_keeps_its_bits(void **state)
{
    static struct operation operations[OPERATIONS_MAX];
    struct random random = {.state = 2};
    const size_t count = list_operations(operations);
    size_t next = 0, ran = 0, whole = 0;
    (void)state;

    for (size_t t = 0; t < node_type_count(); t++) {
        const struct node_type *type = node_type_at(t);
        const bool steps = type->kind == KIND_EQUATION || type->kind == KIND_SURFACE;
        const int scenes = steps ? EQUATION_SCENES : TYPE_SCENES;
        for (int n = 0; n < scenes && type->kind != KIND_MODEL; n++) {
            look_at(&random, &operations[next++ % count], type);
        }
    }
    for (size_t i = 0; i < count; i++) {
        ran += operations[i].ran;
        whole += operations[i].whole;
    }
    assert_true(ran < whole);
}

/* Copies of which only the nearest are looked at: too many reach to each point, or each is
 * endless. Their distance jumps from point to point. */
static struct scene *scene_of_copies(struct random *random, bool endless)
{
    struct error err = {0};
    char text[1024];

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1','root':{'type':'union','children':[{'type':'repeat','params':"
             "{'count':[7,7,7],'spacing':[1,1,1]},'children':[{'type':'sphere','params':"
             "{'radius':0.1}}]},{'type':'repeat','params':%s,'children':[{'type':'%s','transform':{"
             "'scale':[0.2,0.2,%d],'rotation':[%.3f,%.3f,0]}}]}]}}",
             endless ? "{'spacing':[1.5,0.8,0.7],'count':[2,-1,3]}"
                     : "{'spacing':[0.9,0.9,0.9],'count':[-1,-1,-1]}",
             endless ? "ellipse" : "box", endless ? 1 : 9, random_between(random, 0, 1.5),
             random_between(random, 0, 1.5));
    struct scene *scene = json_text_scene(text, &err);
    if (!scene) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return scene;
}

static void copies_that_are_left_out_keep_the_bits(void **state)
{
    struct operation sums = {0};
    struct random random = {.state = 3};

    (void)state;
    for (int i = 0; i < COPY_SCENES; i++) {
        look_at_scene(&random, scene_of_copies(&random, i % 2), &sums);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_operation_keeps_its_bits),
                                       cmocka_unit_test(hidden_operands_keep_their_bits),
                                       cmocka_unit_test(every_type_keeps_its_bits),
                                       cmocka_unit_test(copies_that_are_left_out_keep_the_bits)};

    return cmocka_run_group_tests_name("pruning", tests, NULL, NULL);
}
