/* SPDX-License-Identifier: MIT */
/* Shaders that read a field as data draw what the engine draws: of a scene that has everything, of
 * each kind of operation, of users' code, of more shapes than compilers take, after edits. An edit
 * within the vocabulary compiles nothing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/limits.h"
#include "renderer/engine/tapes.h"
#include "tests/support/drawing.h"
#include "tests/support/json_text.h"

enum {
    WIDTH = 32,
    HEIGHT = 18,
    STEPS = 1,      /* of 255, by which a pixel may differ; */
    PER_MILLE = 15, /* more of them are edges, where one ray meets another surface */
    POLL_MS = 2000,
    NUMBERS = 5, /* edits: more than there are uploads of a scene */
    MANY = LIMIT_COMPILED_SHAPES + 100,
};

#define HEAD "{'format':'fieldcast/1','camera':{'position':[0,1,5],'target':[0,0,0]},"
#define AT(x, y) "'transform':{'translation':[" #x "," #y ",0],'scale':[0.4,0.4,0.4]}"
/* A shape, an operation that mixes and one that chooses, a cut, changes of distance, of space and
 * both, and repetition in repetition. */
#define KINDS                                                                                      \
    HEAD                                                                                           \
        "'materials':{'red':{'shader':'standard','properties':{'base_color':[0.8,0.1,0.1]}}},"     \
        "'root':{'type':'union','children':["                                                      \
        "{'type':'smooth_union','params':{'k':3},'children':[{'type':'sphere'," AT(                \
            -2,                                                                                    \
            1) "},"                                                                                \
               "{'type':'box','material':'red'," AT(                                               \
                   -1.2,                                                                           \
                   0.8) "}]},"                                                                     \
                        "{'type':'difference','children':[{'type':'box'," AT(                      \
                            0,                                                                     \
                            1) "},"                                                                \
                               "{'type':'cylinder','material':'red'," AT(                          \
                                   0,                                                              \
                                   1) "}]},"                                                       \
                                      "{'type':'twist','params':{'rate':0.9}," AT(                 \
                                          2,                                                       \
                                          1) ",'children':[{'type':'box'}]},"                      \
                                             "{'type':'round','params':{'radius':0.1}," AT(        \
                                                 -2,                                               \
                                                 -1) ",'children':[{'type':'torus'}]},"            \
                                                     "{'type':'elongate','params':{'size':[1,0,0]" \
                                                     "}," AT(                                      \
                                                         0,                                        \
                                                         -1) ",'children':[{'type':'sphere'}]},"   \
                                                             "{'type':'repeat','params':{'"        \
                                                             "spacing':[1,1,1],'count':[3,0,2]}"   \
                                                             "," AT(2, -1) ",'children':[{'type':" \
                                                                           "'repeat','params':{'"  \
                                                                           "spacing':[0.4,0.4,0."  \
                                                                           "4],'count':[2,2,1]},"  \
                                                                           "'children':[{'type':'" \
                                                                           "sphere','params':{'"   \
                                                                           "radius':0.15}}]}]}]}}"
/* Too small for cubes. */
#define SMALL                                                                                      \
    HEAD "'root':{'type':'intersection','children':[{'id':'hides','type':'sphere'},"               \
         "{'type':'box'}]}}"
/* Copies that reach beyond their cells, behind a shape. */
#define REACHING                                                                                   \
    "{'format':'fieldcast/1','camera':{'position':[4,1.5,2],'target':[0,0,0]},"                    \
    "'root':{'type':'union','children':[{'type':'sphere',"                                         \
    "'transform':{'translation':[0,1.5,0],'scale':[0.3,0.3,0.3]}},"                                \
    "{'type':'repeat','params':{'spacing':[1,1,0.5],'count':[1,1,6]},'children':["                 \
    "{'type':'box','transform':{'rotation':[50,0,0],'scale':[0.5,0.12,1.2]}}]}]}}"
#define CODE                                                                                       \
    HEAD "'shaders':{'rings':{'code':'vec3 shade(FragmentProperties f) {"                          \
         " return vec3(step(0.0, sin(20.0 * f.object_position.y)), 0.4, 0.2); }'}},"               \
         "'materials':{'own':{'shader':'rings'}},'root':{'type':'union','children':["              \
         "{'type':'field','material':'own','params':{"                                             \
         "'code':'float sdf(vec3 p) { return max(length(p) - 0.8, p.y - 0.4); }'}},"               \
         "{'type':'implicit','params':{'equation':'x^4+y^4+z^4-1/4'}," AT(2, 0) "}]}}"

static struct renderer *renderer;
static bool refused; /* a program, by the driver */

static struct drawing draw(struct resident *resident)
{
    static const enum aov asked[] = {AOV_COLOR, AOV_DEPTH, AOV_ID, AOV_NORMAL};
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        desc.aovs[asked[i]] = true;
    }
    return drawing_outputs(renderer, resident, &desc);
}

static struct drawing draw_scene(struct scene *scene, enum render_stage stage)
{
    renderer_use_stage(renderer, stage);
    struct resident *resident = resident_create(renderer, scene, 1);
    struct drawing drawing = draw(resident);
    resident_destroy(resident);
    return drawing;
}

/* In how many thousandths of their bytes. */
static size_t difference(const struct image *a, const struct image *b)
{
    const uint8_t *x = a->pixels, *y = b->pixels;
    size_t different = 0;

    assert_int_equal(a->bytes, b->bytes);
    for (size_t i = 0; i < a->bytes; i++) {
        different += abs(x[i] - y[i]) > STEPS;
    }
    return a->bytes > 0 ? 1000 * different / a->bytes : 0;
}

static void compare(struct drawing *a, struct drawing *b)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const size_t per_mille = difference(&a->of[i], &b->of[i]);
        if (per_mille > PER_MILLE) {
            fail_msg("%s: %zu of 1000 differ", aov_name((enum aov)i), per_mille);
        }
    }
    drawing_finish(a);
    drawing_finish(b);
}

static void edit(struct resident *resident, const char *text)
{
    char *json = json_text(text);
    cJSON *ops = json_parse(json, strlen(json), NULL);

    assert_non_null(ops);
    assert_true(resident_edit(resident, ops, resident_revision(resident) + 1, NULL));
    cJSON_Delete(ops);
    free(json);
}

/* After the edit, both draw it. */
static void follow(struct resident *const both[2], const char *ops)
{
    struct drawing drawn[2];

    for (int i = 0; i < 2; i++) {
        renderer_use_stage(renderer, i ? RENDER_COMPUTE : RENDER_ENGINE);
        edit(both[i], ops);
        drawn[i] = draw(both[i]);
    }
    compare(&drawn[1], &drawn[0]);
}

static void is_the_engine_s(const char *text, enum render_stage stage)
{
    struct drawing engine = draw_scene(drawing_parse(text), RENDER_ENGINE);
    struct drawing own = draw_scene(drawing_parse(text), stage);

    compare(&own, &engine);
}

static void everything_is_the_engine_s(void **state)
{
    struct drawing engine = draw_scene(drawing_read(DRAWING_RICH), RENDER_ENGINE);
    struct drawing own = draw_scene(drawing_read(DRAWING_RICH), RENDER_COMPUTE);

    (void)state;
    compare(&own, &engine);
}

static void operations_are_the_engine_s(void **state)
{
    (void)state;
    is_the_engine_s(KINDS, RENDER_COMPUTE);
    is_the_engine_s(KINDS, RENDER_FRAGMENT);
    is_the_engine_s(REACHING, RENDER_COMPUTE);
}

static void open_both(struct resident *both[2], const char *text)
{
    for (int i = 0; i < 2; i++) {
        renderer_use_stage(renderer, i ? RENDER_COMPUTE : RENDER_ENGINE);
        both[i] = resident_create(renderer, drawing_parse(text), 1);
    }
}

/* An operation takes the side that is left. */
static void what_is_hidden_has_no_effect(void **state)
{
    struct resident *both[2];

    (void)state;
    open_both(both, SMALL);
    follow(both, "[{'op':'set','at':'/nodes/hides/visible','value':false}]");
    resident_destroy(both[0]);
    resident_destroy(both[1]);
}

static void users_code_is_the_engine_s(void **state)
{
    (void)state;
    is_the_engine_s(CODE, RENDER_COMPUTE);
}

static void other_pictures_are_noticed(void **state)
{
    struct drawing kinds = draw_scene(drawing_parse(KINDS), RENDER_ENGINE);
    struct drawing code = draw_scene(drawing_parse(CODE), RENDER_ENGINE);

    (void)state;
    assert_true(difference(&kinds.of[AOV_COLOR], &code.of[AOV_COLOR]) > PER_MILLE);
    drawing_finish(&kinds);
    drawing_finish(&code);
}

/* --- many shapes, and edits --- */

/* Spheres and boxes by turns, or spheres alone, in rows. */
static struct scene *make_many(int count)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    fputs(HEAD "'root':{'id':'all','type':'union','children':[", out);
    for (int i = 0; i < count; i++) {
        fprintf(out,
                "%s{'id':'n%d','type':'%s','transform':{'translation':[%g,%g,%g],"
                "'scale':[0.08,0.08,0.08]}}",
                i > 0 ? "," : "", i, i % 2 ? "box" : "sphere", (i % 20 - 9.5) * 0.2,
                (i / 20 % 10 - 4.5) * 0.2, -0.5 * (i / 200)); /* NOLINT(bugprone-*) */
    }
    fputs("]}}", out);
    fclose(out);
    struct scene *scene = drawing_parse(text);
    free(text);
    return scene;
}

/* The same bytes as of the scene when it is opened. */
static void is_a_new_scene_s(struct resident *resident)
{
    struct drawing own = draw(resident),
                   other = draw_scene(scene_copy(resident_scene(resident)), RENDER_COMPUTE);

    for (int i = 0; i < AOV_COUNT; i++) {
        assert_true(drawing_is_same(&own.of[i], &other.of[i]));
    }
    drawing_finish(&own);
    drawing_finish(&other);
}

static void edits_of_many_shapes_compile_nothing(void **state)
{
    struct resident *both[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        renderer_use_stage(renderer, i ? RENDER_COMPUTE : RENDER_ENGINE);
        both[i] = resident_create(renderer, make_many(MANY), 1);
    }
    struct drawing drawn[2] = {draw(both[0]), draw(both[1])};
    compare(&drawn[1], &drawn[0]);
    const uint64_t compiled = renderer_counters(renderer).compilations;
    assert_true(compiled > 0);
    for (int i = 0; i < NUMBERS; i++) {
        char ops[256];
        snprintf(ops, sizeof ops,
                 "[{'op':'set','at':'/nodes/n7/transform/translation','value':[%d,0.5,1.5]},"
                 "{'op':'set','at':'/nodes/n7/transform/scale','value':[0.5,0.5,0.5]}]",
                 i - 2);
        follow(both, ops);
    }
    is_a_new_scene_s(both[1]);
    follow(both, "[{'op':'set','at':'/nodes/n7/visible','value':false}]");
    follow(both, "[{'op':'insert','into':'/nodes/all','before':'n0','value':{'type':'box',"
                 "'transform':{'translation':[0,0,2]}}}]");
    assert_int_equal(renderer_counters(renderer).compilations, compiled);
    resident_destroy(both[0]);
    resident_destroy(both[1]);
}

/* What run() reads ahead for all but shapes. */
static void numbers_of_operations_are_read_ahead(void **state)
{
    (void)state;
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        const struct sdf *sdf = sdf_find(type);
        struct param_slot places[SDF_PARAMS_MAX];
        if (sdf && sdf->domain) {
            assert_in_range(sdf->domain->vec4s, 0, TAPE_AHEAD_OTHERS);
        }
        if (sdf && (sdf->combine || sdf->change)) {
            assert_in_range(field_layout(type->record.params, 0, places), 0, TAPE_AHEAD_OTHERS);
        }
    }
}

/* An interpreter begins; what is compiled goes on; both read new numbers. */
static void either_program_draws_the_same(void **state)
{
    struct resident *both[2];

    (void)state;
    renderer_use_programs(renderer, PROGRAMS_EITHER);
    open_both(both, SMALL);
    follow(both, "[{'op':'set','at':'/nodes/hides/params/radius','value':0.9}]");
    while (renderer_poll(renderer, POLL_MS)) {
    }
    follow(both, "[{'op':'set','at':'/nodes/hides/params/radius','value':0.8}]");
    follow(both, "[{'op':'set','at':'/nodes/hides/params/radius','value':0.7}]");
    renderer_use_programs(renderer, PROGRAMS_INTERPRETED);
    resident_destroy(both[0]);
    resident_destroy(both[1]);
}

/* What a tape leaves out matters nowhere in its cube: by far most of a scene. */
static void tapes_are_a_small_part_of_the_scene(void **state)
{
    struct scene *scene = make_many(MANY);
    struct field *field = field_compile(scene, NULL);
    struct engine_program *program = engine_program_create(field, 0, 0);
    struct vocabulary vocabulary = vocabulary_of(field);
    const struct engine_extent extent = {.reach = 100, .scale = 5, .least = 0.01f};
    struct engine_tapes *tapes;

    (void)state;
    assert_int_equal(vocabulary.count, 3);
    tapes = engine_tapes_create(program, field->params, &extent, &vocabulary);
    const struct engine_tapes_size size = engine_tapes_size(tapes);
    assert_true(size.cubes > 1000);
    assert_true(size.words < size.cubes * field->instruction_count / 10);
    engine_tapes_destroy(tapes);
    vocabulary_finish(&vocabulary);
    engine_program_destroy(program);
    field_unref(field);
    scene_destroy(scene);
}

/* The engine would draw instead. */
static void hear(void *data, const char *line)
{
    (void)data;
    refused = refused || strstr(line, "refuses");
}

static void no_program_was_refused(void **state)
{
    (void)state;
    assert_false(refused);
}

static int start(void **state)
{
    const struct renderer_params params = {
        .device = {.index = -1, .cache_dir = getenv("FIELDCAST_CACHE")},
        .programs = PROGRAMS_INTERPRETED,
        .log = hear};

    (void)state;
    renderer = renderer_create(&params, NULL);
    return renderer ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(operations_are_the_engine_s),
        cmocka_unit_test(what_is_hidden_has_no_effect),
        cmocka_unit_test(users_code_is_the_engine_s),
        cmocka_unit_test(other_pictures_are_noticed),
        cmocka_unit_test(edits_of_many_shapes_compile_nothing),
        cmocka_unit_test(numbers_of_operations_are_read_ahead),
        cmocka_unit_test(either_program_draws_the_same),
        cmocka_unit_test(tapes_are_a_small_part_of_the_scene),
        cmocka_unit_test(everything_is_the_engine_s),
        cmocka_unit_test(no_program_was_refused),
    };

    return cmocka_run_group_tests_name("interpreter", tests, start, end);
}
