/* SPDX-License-Identifier: MIT */
/* What a document brings along: instances of models are what they would be written out, users'
 * functions and shaders are the same in C and in GLSL. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/scene.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/probe.h"
#include "tests/support/random_scene.h"

enum { POINTS = 2000 };

static struct scene *scene_of(const char *parts, const char *root)
{
    char text[8192];

    snprintf(text, sizeof text, "{'format':'fieldcast/1',%s'root':%s}", parts, root);
    return json_text_valid_scene(text);
}

static void random_points(float out[POINTS][3], uint64_t seed)
{
    struct random random = {seed};

    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = (float)random_between(&random, -3, 3);
        }
    }
}

/* --- models --- */

#define MATERIALS                                                                                  \
    "'materials':{'a':{'shader':'phong','properties':{'diffuse':[1,0,0]}},"                        \
    "'b':{'shader':'phong','properties':{'diffuse':[0,1,0]}}},"
#define PAIR                                                                                       \
    "{'id':'%s','type':'smooth_union','params':{'k':0.3},'transform':{'rotation':[0.3,0,0]},"      \
    "'children':[{'type':'sphere','params':{'radius':0.5}},"                                       \
    "{'type':'box','material':'b','transform':{'translation':[0.6,0,0]}}]}"

static void instances_are_what_they_stand_for(void **state)
{
    (void)state;
    static float points[POINTS][3];
    char models[1024], written[2048], pair[512], other[512];

    snprintf(pair, sizeof pair, PAIR, "pair");
    snprintf(other, sizeof other, PAIR, "other");
    snprintf(models, sizeof models, MATERIALS "'models':{'pair':%s},", pair);
    snprintf(written, sizeof written,
             "{'type':'union','children':["
             "{'type':'group','material':'a','transform':{'translation':[1,0,0],'scale':0.5},"
             "'children':[%s]},{'type':'twist','params':{'rate':0.7},'children':[{'type':'group',"
             "'transform':{'translation':[-1,1,0]},'children':[%s]}]}]}",
             pair, other);
    struct scene *instanced = scene_of(
        models, "{'type':'union','children':["
                "{'id':'one','type':'model','params':{'model':'pair'},'material':'a',"
                "'transform':{'translation':[1,0,0],'scale':0.5}},"
                "{'type':'twist','params':{'rate':0.7},'children':[{'id':'two','type':'model',"
                "'params':{'model':'pair'},'transform':{'translation':[-1,1,0]}}]}]}");
    struct scene *explicit = scene_of(MATERIALS, written);
    struct field *a = compile_field(instanced), *b = compile_field(explicit);
    random_points(points, 1);
    for (int i = 0; i < POINTS; i++) {
        double p[3] = {points[i][0], points[i][1], points[i][2]};
        struct field_surface sa = field_surface(a, p, NULL), sb = field_surface(b, p, NULL);
        assert_true(sa.distance == sb.distance);
        assert_memory_equal(sa.material, sb.material, sizeof sa.material);
        const char *id = field_leaf_id(a, sa.number);
        assert_true(strcmp(id, "one") == 0 || strcmp(id, "two") == 0);
    }
    double near_one[3] = {1, 0, 0}, near_two[3] = {-1, 1, 0};
    assert_int_equal(field_surface(a, near_one, NULL).number, 2);
    assert_int_equal(field_surface(a, near_two, NULL).number, 4);
    field_unref(a);
    field_unref(b);
    scene_destroy(instanced);
    scene_destroy(explicit);
}

/* An arch whose parameters set a number, a component, a turn, a scale, and one of a model in it. */
#define ARCH                                                                                       \
    "'models':{'arch':{'params':["                                                                 \
    "{'name':'wide','type':'float','sets':'/nodes/bar/params/size.x','range':[0.1,9]},"            \
    "{'name':'blend','type':'float','sets':'/nodes/arch-root/params/k','range':[0.01,1]},"         \
    "{'name':'turn','type':'vec3','sets':'/nodes/bar/transform/rotation'},"                        \
    "{'name':'grow','type':'float','sets':'/nodes/knob/transform/scale','range':[0.1,4]},"         \
    "{'name':'round','type':'float','sets':'/nodes/knob/params/radius','range':[0.1,2]}],"         \
    "'root':{'id':'arch-root','type':'smooth_union','params':{'k':0.2},'children':["               \
    "{'id':'bar','type':'box','params':{'size':[1,0.4,0.5]}},"                                     \
    "{'id':'knob','type':'model','params':{'model':'knob','radius':0.3},"                          \
    "'transform':{'translation':[0,0.6,0]}}]}},"                                                   \
    "'knob':{'params':[{'name':'radius','type':'float','sets':'/nodes/ball/params/radius',"        \
    "'range':[0.01,5]}],'root':{'id':'ball','type':'sphere'}}},"
#define WRITTEN_ARCH                                                                               \
    "{'type':'smooth_union','params':{'k':%s},'transform':{'translation':[%d,0,0]},'children':["   \
    "{'type':'box','params':{'size':[%s,0.4,0.5]},'transform':{'rotation':[%s]}},"                 \
    "{'type':'sphere','params':{'radius':%s},"                                                     \
    "'transform':{'translation':[0,0.6,0],'scale':%s}}]}"

static void assert_same_distances(const struct field *a, const struct field *b)
{
    static float points[POINTS][3];

    random_points(points, 3);
    for (int i = 0; i < POINTS; i++) {
        const double p[3] = {points[i][0], points[i][1], points[i][2]};
        assert_true(field_distance(a, p) == field_distance(b, p));
    }
}

static void instances_have_numbers_of_their_own(void **state)
{
    (void)state;
    char written[2048];

    snprintf(written, sizeof written,
             "{'type':'union','children':[" WRITTEN_ARCH "," WRITTEN_ARCH "," WRITTEN_ARCH "]}",
             "0.2", -2, "1", "0,0,0", "0.3", "1", "0.2", 0, "2.5", "0,0.4,0.1", "0.3", "1", "0.6",
             2, "1", "0,0,0", "0.75", "1.5");
    struct scene *instanced = scene_of(
        ARCH, "{'type':'union','children':["
              "{'id':'one','type':'model','params':{'model':'arch'},"
              "'transform':{'translation':[-2,0,0]}},"
              "{'id':'two','type':'model','params':{'model':'arch','wide':2.5,'turn':[0,0.4,0.1]}},"
              "{'id':'three','type':'model','params':{'model':'arch','blend':0.6,'grow':1.5,"
              "'round':0.75},'transform':{'translation':[2,0,0]}}]}");
    struct scene *explicit = scene_of("", written);
    struct field *a = compile_field(instanced), *b = compile_field(explicit);

    assert_true(a->structure_hash == b->structure_hash);
    assert_same_distances(a, b);
    assert_memory_equal(&a->bounds, &b->bounds, sizeof a->bounds);
    field_unref(a);
    field_unref(b);
    scene_destroy(instanced);
    scene_destroy(explicit);
}

/* Models of models, each of two: the place and the number in the message are what counts. */
static void assert_too_much(int levels, const char *child, const char *word)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    assert_non_null(out);
    fprintf(out, "{'format':'fieldcast/1','models':{'m0':%s", child);
    for (int i = 1; i <= levels; i++) {
        fprintf(out,
                ",'m%d':{'type':'group','children':[{'type':'model','params':{'model':'m%d'}},"
                "{'type':'model','params':{'model':'m%d'}}]}",
                i, i - 1, i - 1);
    }
    fprintf(out, "},'root':{'id':'root','type':'model','params':{'model':'m%d'}}}", levels);
    fclose(out);
    struct error err = {0};
    struct scene *scene = json_text_valid_scene(text);
    assert_null(field_compile(scene, &err));
    assert_int_equal(err.kind, ERROR_LIMIT);
    assert_string_equal(err.place, "/nodes/root");
    if (!strstr(err.message, word)) {
        fail_msg("%s", err.message);
    }
    scene_destroy(scene);
    free(text);
}

static void models_that_grow_without_end_are_refused(void **state)
{
    (void)state;
    assert_too_much(20, "{'type':'sphere'}", "more than 100000 nodes");
    assert_too_much(20, "{'type':'group'}", "more than 100000 nodes");
    assert_too_much(40, "{'type':'group'}", "nested 65 levels deep, above the maximum 64");
}

/* --- users' code --- */

#define CODE                                                                                       \
    "'primitives':{'wave':{'params':[{'name':'radius','type':'float','default':0.5},"              \
    "{'name':'waves','type':'vec3','default':[9,7,5]},{'name':'steps','type':'int','default':3}]," \
    "'code':'float sdf(vec3 p) {\\n float d = length(p) - radius;\\n"                              \
    " for (int i = 0; i < 4; i++) { if (i < steps) { vec3 q = p * waves * (1.0 + float(i));\\n"    \
    " d += 0.01 * sin(q.x) * sin(q.y) * sin(q.z); } }\\n return d;\\n}','lipschitz':3,"            \
    "'size':[2,1.2,2]}},"                                                                          \
    "'shaders':{'rings':{'properties':[{'name':'tone','type':'color','default':[1,0.5,0]},"        \
    "{'name':'count','type':'float','default':4}],'code':'vec3 shade(FragmentProperties f) {"      \
    " return tone * (0.5 + 0.5 * sin(count * length(f.object_position)))"                          \
    " + 0.1 * abs(f.world_position); }'},"                                                         \
    "'flat':{'code':'vec3 shade(FragmentProperties f) { return vec3(0.25, 0.5, 0.75); }',"         \
    "'lighting':'unlit'}},"                                                                        \
    "'materials':{'r1':{'shader':'rings'},'r2':{'shader':'rings','properties':{"                   \
    "'tone':[0,0.2,1],'count':7}},'f':{'shader':'flat'},'p':{'shader':'phong'}},"
#define ROOT                                                                                       \
    "{'type':'union','children':["                                                                 \
    "{'id':'w','type':'field','params':{'primitive':'wave','radius':0.7},'material':'r1',"         \
    "'transform':{'translation':[-1,0,0],'rotation':[0.5,1,0]}},"                                  \
    "{'type':'smooth_union','params':{'k':0.8},'children':["                                       \
    "{'type':'sphere','material':'r2','transform':{'translation':[1,0,0]}},"                       \
    "{'type':'box','material':'f','transform':{'translation':[1,0.9,0],'scale':[1,0.5,1]}},"       \
    "{'type':'sphere','material':'p','transform':{'translation':[1.6,0.5,0]}}]},"                  \
    "{'type':'repeat','params':{'spacing':[1,1,1],'count':[3,0,2]},'material':'r1',"               \
    "'transform':{'translation':[0,-1.5,0]},'children':[{'type':'field','params':{"                \
    "'code':'float sdf(vec3 p) { return max(length(p) - 0.3, p.y); }'}}]}]}"

/* Where two shapes are equally near, either may be the one: points nearby tell. */
static bool agrees(const struct field *field, const float p[3], const struct probe_answer *got)
{
    for (int corner = -1; corner < 8; corner++) {
        double q[3];
        bool same = true;
        for (int j = 0; j < 3; j++) {
            q[j] = p[j] + (corner < 0 ? 0 : (corner >> j & 1) ? 1e-4 : -1e-4);
        }
        struct field_surface want = field_surface(field, q, NULL);
        same = want.number == got->leaf;
        for (int j = 0; j < FIELD_MATERIAL_NUMBERS; j++) {
            const bool told = j == FIELD_SHADER || j == FIELD_UNLIT; /* not in a Surface */
            same = same && (told || fabs(want.material[j] - got->material[j]) <= 0.01);
        }
        if (same) {
            return true;
        }
    }
    return false;
}

static void code_is_the_same_in_both_languages(void **state)
{
    (void)state;
    static float points[POINTS][3];
    static struct probe_answer answers[POINTS];
    struct error err = {0};
    struct probe probe;
    struct probe_program program;
    struct scene *scene = scene_of(CODE, ROOT);
    struct field *field = compile_field(scene);

    assert_int_equal(field->code_count, 2);
    assert_int_equal(field->shader_count, 2);
    assert_true(probe_init(&probe, &err));
    if (!probe_program_init(&program, &probe, &field, 1, true, false, &err)) {
        fail_msg("%s", err.message);
    }
    random_points(points, 2);
    probe_run(&probe, &program, &field, 1, points, POINTS, answers);
    int bad = 0;
    for (int i = 0; i < POINTS; i++) {
        double p[3] = {points[i][0], points[i][1], points[i][2]};
        assert_true(fabs(field_distance(field, p) - answers[i].distance) <= 3e-4);
        bad += !agrees(field, points[i], &answers[i]);
    }
    assert_int_equal(bad, 0);
    probe_program_finish(&program, &probe);
    probe_finish(&probe);
    field_unref(field);
    scene_destroy(scene);
}

static void numbers_of_code_compile_nothing(void **state)
{
    (void)state;
    struct scene *scene = scene_of(CODE, ROOT);
    struct scene *other = scene_of(
        CODE, "{'type':'union','children':["
              "{'id':'w','type':'field','params':{'primitive':'wave','radius':0.2,'steps':1,"
              "'waves':[1,2,3]},'material':'r2'},"
              "{'type':'smooth_union','params':{'k':0.1},'children':["
              "{'type':'sphere','material':'p'},{'type':'box','material':'f'},"
              "{'type':'sphere','material':'r1'}]},"
              "{'type':'repeat','params':{'spacing':[2,1,1],'count':[2,0,-1]},'material':'f',"
              "'children':[{'type':'field','params':{"
              "'code':'float sdf(vec3 p) { return max(length(p) - 0.3, p.y); }'}}]}]}");
    struct field *a = compile_field(scene), *b = compile_field(other);

    assert_true(a->structure_hash == b->structure_hash);
    field_unref(a);
    field_unref(b);
    scene_destroy(scene);
    scene_destroy(other);
}

static void bad_code_names_its_place(void **state)
{
    (void)state;
    static const struct {
        const char *parts, *root, *place;
        int line;
    } rows[] = {
        {"'primitives':{'bad':{'code':'float sdf(vec3 p) {\\n return q;\\n}'}},",
         "{'type':'field','params':{'primitive':'bad'}}", "/primitives/bad/code", 2},
        {"", "{'id':'here','type':'field','params':{'code':'\\n\\nfloat sdf(vec3 p) { return }'}}",
         "/nodes/here/params/code", 3},
        {"'shaders':{'bad':{'code':'vec3 shade() {\\n return 1.0 + true;\\n}'}},"
         "'materials':{'m':{'shader':'bad'}},",
         "{'type':'sphere','material':'m'}", "/shaders/bad/code", 2},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct scene *scene = scene_of(rows[i].parts, rows[i].root);
        struct error err = {0};
        assert_null(field_compile(scene, &err));
        assert_int_equal(err.kind, ERROR_COMPILE);
        assert_string_equal(err.place, rows[i].place);
        assert_int_equal(err.line, rows[i].line);
        assert_true(err.column > 0);
        scene_destroy(scene);
    }
}

static void code_is_tried_out(void **state)
{
    (void)state;
    struct error err = {0}, warning = {0};
    struct scene *scene = scene_of(
        "'primitives':{'hole':{'params':[{'name':'by','type':'float'}],"
        "'code':'float sdf(vec3 p) {\\n float r = length(p);\\n return r / by - 1.0;\\n}'}},",
        "{'type':'field','params':{'primitive':'hole'}}");
    struct field *field = compile_field(scene);

    assert_false(field_try(field, &warning, &err));
    assert_int_equal(err.kind, ERROR_COMPILE);
    assert_string_equal(err.place, "/primitives/hole/code");
    assert_int_equal(err.line, 3);
    field_unref(field);
    scene_destroy(scene);

    scene = scene_of("", "{'id':'n','type':'field','params':{"
                         "'code':'float sdf(vec3 p) { return 3.0 * (length(p) - 1.0); }'}}");
    field = compile_field(scene);
    assert_true(field_try(field, &warning, &err));
    assert_int_not_equal(warning.kind, ERROR_NONE);
    assert_string_equal(warning.place, "/nodes/n/params/code");
    field_unref(field);
    scene_destroy(scene);
}

static void a_box_cuts_code(void **state)
{
    (void)state;
    struct scene *scene =
        scene_of("", "{'type':'field','transform':{'scale':2},'params':{'size':[1,0,0],"
                     "'code':'float sdf(vec3 p) { return length(p) - 5.0; }'}}");
    struct field *field = compile_field(scene);
    const double inside[3] = {0, 3, 0}, outside[3] = {4, 0, 0}, far[3] = {0, 13, 0};

    assert_true(fabs(field_distance(field, inside) - -1) < 1e-5);
    assert_true(fabs(field_distance(field, outside) - 3) < 1e-5);
    assert_true(fabs(field_distance(field, far) - 3) < 1e-5);
    assert_true(field->bounds.high[0] == 1 && isinf(field->bounds.high[1]));
    field_unref(field);
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_are_what_they_stand_for),
        cmocka_unit_test(instances_have_numbers_of_their_own),
        cmocka_unit_test(models_that_grow_without_end_are_refused),
        cmocka_unit_test(code_is_the_same_in_both_languages),
        cmocka_unit_test(numbers_of_code_compile_nothing),
        cmocka_unit_test(bad_code_names_its_place),
        cmocka_unit_test(code_is_tried_out),
        cmocka_unit_test(a_box_cuts_code),
    };

    return cmocka_run_group_tests_name("models and code", tests, NULL, NULL);
}
