/* SPDX-License-Identifier: MIT */
/* What shapes are made of: numbers of every shader, colours of those that are code of ours, shapes
 * that light goes through, and the floor. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/scene.h"
#include "renderer/glsl/interface.h"
#include "tests/support/compiled.h"
#include "tests/support/json_text.h"
#include "tests/support/probe.h"
#include "tests/support/random_scene.h"

enum { POINTS = 2000 };
#define FAR 1e9f

/* A scene and its field, of a document in which ' stands for ". */
struct pair {
    struct scene *scene;
    struct field *field;
};

static struct pair pair_of(const char *parts, const char *root)
{
    char text[4096];
    struct pair pair;

    snprintf(text, sizeof text, "{'format':'fieldcast/1',%s'root':%s}", parts, root);
    pair.scene = json_text_valid_scene(text);
    pair.field = compile_field(pair.scene);
    return pair;
}

static void pair_finish(struct pair *pair)
{
    field_unref(pair->field);
    scene_destroy(pair->scene);
}

static void random_points(float out[POINTS][3])
{
    struct random random = {7};

    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = (float)random_between(&random, -3, 3);
        }
    }
}

/* What GLSL says of the points. */
static void ask(const struct field *field, float field_mask, float (*points)[3], size_t count,
                struct probe_answer *out)
{
    struct error err = {0};
    struct probe probe;
    struct probe_program program;
    struct field *const fields[] = {(struct field *)field};

    assert_true(probe_init(&probe, &err));
    probe.field_mask = field_mask;
    if (!probe_program_init(&program, &probe, fields, 1, true, false, &err)) {
        fail_msg("%s", err.message);
    }
    probe_run(&probe, &program, fields, 1, points, count, out);
    probe_program_finish(&program, &probe);
    probe_finish(&probe);
}

/* --- numbers --- */

static void every_shader_has_its_numbers(void **state)
{
    (void)state;
    /* diffuse, gloss, specular, emission, ambient, reflectivity, transmission, ior, model,
     * absorption */
    static const struct {
        const char *material;
        double want[20];
    } rows[] = {
        {"{'shader':'phong','properties':{'diffuse':[0.1,0.2,0.3],'opacity':0.25,'ior':2,"
         "'reflectivity':0.5,'attenuation_color':[1,0.1,0.01],'attenuation_distance':0.5}}",
         {0.1, 0.2, 0.3, 32,  0.2,  0.2, 0.2, 0, 0,       0,
          1,   1,   1,   0.5, 0.75, 2,   0,   0, 4.60517, 9.21034}},
        {"{'shader':'blinn','properties':{'ambient':[0.5,0.25,0],'emission':[3,2,1],"
         "'shininess':5,'specular':[1,0.5,0]}}",
         {0.8, 0.8, 0.8, 5, 1, 0.5, 0, 3, 2, 1, 0.5, 0.25, 0, 0, 0, 1.5, 1, 0, 0, 0}},
        /* Fresnel at normal incidence: (0.5 / 2.5)^2 = 0.04 */
        {"{'shader':'standard','properties':{'base_color':[0.84,0.44,0.04],'metallic':0.5,"
         "'roughness':0.3,'transmission':0.7}}",
         {0.42, 0.22, 0.02, 0.3, 0.44, 0.24, 0.04, 0, 0, 0, 1, 1, 1, 0.44, 0.7, 1.5, 2, 0, 0, 0}},
        {"{'shader':'unlit','properties':{'color':[7,0.5,0]}}",
         {0, 0, 0, 1, 0, 0, 0, 7, 0.5, 0, 1, 1, 1, 0, 0, 1.5, 0, 0, 0, 0}},
        /* Light that is swallowed at once stays a number. */
        {"{'shader':'standard','properties':{'attenuation_color':[0,0,0],"
         "'attenuation_distance':1e-30,'base_color':[0,0,0]}}",
         {0, 0, 0, 0.5, 0.04, 0.04, 0.04, 0, 0, 0, 1, 1, 1, 0.04, 0, 1.5, 2, 65000, 65000, 65000}},
    };
    static const int places[20] = {0,  1,  2,  3,  4,  5,  6,  8,  9,  10,
                                   12, 13, 14, 16, 17, 18, 19, 20, 21, 22};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char parts[512];
        const double origin[3] = {0};
        snprintf(parts, sizeof parts, "'materials':{'m':%s},", rows[i].material);
        struct pair pair = pair_of(parts, "{'type':'sphere','material':'m'}");
        struct field_surface at = field_surface(pair.field, origin, NULL);
        for (int j = 0; j < 20; j++) {
            if (fabs(at.material[places[j]] - rows[i].want[j]) > 1e-4) {
                fail_msg("number %d is %g, not %g\n%s", places[j], at.material[places[j]],
                         rows[i].want[j], parts);
            }
        }
        pair_finish(&pair);
    }
}

#define TWO(a, b)                                                                                  \
    "'materials':{'a':" a ",'b':" b "},",                                                          \
        "{'type':'smooth_union','params':{'k':2},'children':["                                     \
        "{'type':'sphere','material':'a','transform':{'translation':[-0.6,0,0]}},"                 \
        "{'type':'sphere','material':'b','transform':{'translation':[0.6,0,0]}}]}"

/* Roughness is no shininess: where they meet one gives way to the other, all else is mixed. */
static void a_blend_of_models_has_one_of_them(void **state)
{
    (void)state;
    struct pair pair =
        pair_of(TWO("{'shader':'standard','properties':{'roughness':0.25,'ior':1.5}}",
                    "{'shader':'phong','properties':{'shininess':100,'ior':2.5}}"));

    for (int i = -5; i <= 5; i++) {
        const double p[3] = {0.03 + 0.1 * i, 0.4, 0};
        struct field_surface at = field_surface(pair.field, p, NULL);
        const bool left = p[0] < 0;
        assert_true(at.material[FIELD_GLOSS] == (left ? 0.25 : 100));
        assert_true(at.material[FIELD_MODEL] == (left ? MODEL_STANDARD : MODEL_PHONG));
        assert_true(at.material[FIELD_IOR] > 1.6 && at.material[FIELD_IOR] < 2.4);
    }
    pair_finish(&pair);
}

/* --- colours of ours --- */

static void colours_of_ours_agree(void **state)
{
    (void)state;
    static float points[POINTS][3];
    static struct probe_answer answers[POINTS];
    struct pair pair =
        pair_of("'materials':{'c':{'shader':'checker','properties':{'color1':[1,0,0],"
                "'color2':[0,1,0],'scale':0.5,'shininess':7,'reflectivity':0.5}},"
                "'n':{'shader':'normals'}},",
                "{'type':'union','children':[{'type':'box','material':'c',"
                "'transform':{'translation':[1,0,0],'rotation':[0,0.4,0]}},"
                "{'type':'sphere','material':'n','transform':{'translation':[-1,0,0]}}]}");

    random_points(points);
    ask(pair.field, 0, points, POINTS, answers);
    assert_int_equal(pair.field->shader_count, 2);
    assert_null(pair.field->user_code);
    int counts[3] = {0};
    for (int i = 0; i < POINTS; i++) {
        const float *m = answers[i].material;
        if (answers[i].leaf == 3) { /* the probe's normal is the point itself */
            for (int j = 0; j < 3; j++) {
                assert_float_equal(m[FIELD_EMISSION + j], fmaxf(0.5f + 0.5f * points[i][j], 0),
                                   1e-6);
            }
            counts[2]++;
            continue;
        }
        double x = points[i][0] - 1, z = points[i][2], sum = 0;
        double local[3] = {cos(0.4) * x - sin(0.4) * z, points[i][1], sin(0.4) * x + cos(0.4) * z};
        bool near_wall = false;
        for (int j = 0; j < 3; j++) {
            double cell = local[j] / 0.5;
            cell += (cell < 0.5 ? 1.0 : -1.0) / 64; /* walls are this much outside */
            near_wall = near_wall || fabs(cell - round(cell)) < 1e-4;
            sum += floor(cell);
        }
        const bool first = fmod(fabs(sum), 2) == 0;
        if (!near_wall) {
            assert_true(m[0] == (first ? 1 : 0) && m[1] == (first ? 0 : 1) && m[2] == 0);
            counts[first]++;
        }
        assert_true(m[FIELD_GLOSS] == 7 && m[FIELD_REFLECTIVITY] == 0.5f);
    }
    assert_true(counts[0] > 300 && counts[1] > 300 && counts[2] > 500);
    pair_finish(&pair);
}

/* By x^2 + a sin(z) and the length of its gradient, in the object's own space, black to white. */
static double shade_of(const double p[3], bool slope)
{
    const double value = p[0] * p[0] + 0.5 * sin(p[2]);
    const double length = hypot(2 * p[0], 0.5 * cos(p[2]));

    return slope ? fmin(length / 4, 1) : fmin(fmax((value + 1) / 4, 0), 1);
}

static void maps_have_the_colours_of_their_functions(void **state)
{
    (void)state;
    static float points[POINTS][3];
    static struct probe_answer answers[POINTS];
    static const char map[] = "{'shader':'map','properties':{'function':'x^2 + a*sin(z)','a':0.5,"
                              "'low':[0,0,0],'middle':[0.5,0.5,0.5],'high':[1,1,1],'lines':0,"
                              "'roughness':0.25,";
    char materials[800];

    snprintf(materials, sizeof materials,
             "'materials':{'v':%s'from':-1,'to':3}},'s':%s'slope':true,'from':0,'to':4}}},", map,
             map);
    struct pair pair =
        pair_of(materials, "{'type':'union','children':[{'type':'box','material':'v',"
                           "'transform':{'translation':[1,0,0],'rotation':[0,0.4,0]}"
                           "},{'type':'sphere','material':'s',"
                           "'transform':{'translation':[-1,0,0]}}]}");
    random_points(points);
    ask(pair.field, 0, points, POINTS, answers);
    int counts[2] = {0};
    for (int i = 0; i < POINTS; i++) {
        const bool slope = answers[i].leaf == 3;
        const double at[3] = {points[i][0], points[i][1], points[i][2]};
        const double turn = slope ? 0 : 0.4, x = at[0] + (slope ? 1 : -1);
        const double local[3] = {cos(turn) * x - sin(turn) * at[2], at[1],
                                 sin(turn) * x + cos(turn) * at[2]};
        const double want = shade_of(local, slope);
        const struct field_surface here = field_surface(pair.field, at, NULL);

        for (int j = 0; j < 3; j++) {
            assert_float_equal(answers[i].material[FIELD_DIFFUSE + j], want, 1e-5);
            assert_float_equal(here.material[FIELD_DIFFUSE + j], want, 1e-5);
        }
        assert_true(answers[i].material[FIELD_GLOSS] == 0.25f);
        counts[slope]++;
    }
    assert_true(counts[0] > 500 && counts[1] > 500);
    pair_finish(&pair);
}

/* Dark at each value that a line has, and nowhere between two of them. */
static void a_map_has_its_lines(void **state)
{
    (void)state;
    struct pair pair = pair_of("'materials':{'m':{'shader':'map','properties':{'low':[1,1,1],"
                               "'middle':[1,1,1],'high':[1,1,1],'lines':8}}},",
                               "{'type':'box','material':'m','params':{'size':[4,4,4]}}");

    for (int i = 0; i <= 16; i++) {
        const double at[3] = {0.3, -1 + i / 8.0, 0.3}; /* without a function it is y */
        const double want = i % 2 == 0 ? 0.2 : 1;
        assert_float_equal(field_surface(pair.field, at, NULL).material[FIELD_DIFFUSE], want, 1e-6);
    }
    pair_finish(&pair);
}

static uint64_t structure_of(const char *properties)
{
    char materials[200];

    snprintf(materials, sizeof materials, "'materials':{'m':{'shader':'map','properties':%s}},",
             properties);
    struct pair pair = pair_of(materials, "{'type':'sphere','material':'m'}");
    const uint64_t hash = pair.field->structure_hash;
    pair_finish(&pair);
    return hash;
}

static void numbers_of_a_map_compile_nothing(void **state)
{
    (void)state;
    const uint64_t one = structure_of("{'function':'a*x'}");

    assert_true(structure_of("{'function':'a*x','a':3,'from':-2,'lines':0,'slope':true}") == one);
    assert_true(structure_of("{'function':'a*y'}") != one);
}

static void a_function_that_cannot_be_read_has_its_place(void **state)
{
    (void)state;
    struct error err = {0};
    struct scene *scene = json_text_valid_scene(
        "{'format':'fieldcast/1','materials':{'m':{'shader':'map','properties':{"
        "'function':'x +\\n2 *'}}},'root':{'type':'sphere','material':'m'}}");

    assert_null(field_compile(scene, &err));
    assert_string_equal(err.place, "/materials/m/properties/function");
    assert_int_equal(err.line, 2);
    scene_destroy(scene);
}

/* Rounding must not scatter two colours over a face, nor its rim have another one. */
static void a_face_between_two_cubes_has_the_inner_colour(void **state)
{
    (void)state;
    struct pair pair = pair_of("'materials':{'c':{'shader':'checker','properties':{"
                               "'color1':[1,1,1],'color2':[0,0,0]}}},",
                               "{'type':'box','material':'c','params':{'size':[2,2,2]}}");

    for (int axis = 0; axis < 3; axis++) {
        for (int side = -1; side <= 1; side++) {
            double in[3] = {0.3, 0.3, 0.3}, low[3] = {0.3, 0.3, 0.3}, high[3] = {0.3, 0.3, 0.3};
            low[axis] = side - 1e-3, high[axis] = side + 1e-3;
            in[axis] = side == 0 ? 0.5 : 0.5 * side;
            const double want = field_surface(pair.field, in, NULL).material[0];
            assert_true(field_surface(pair.field, low, NULL).material[0] == want);
            assert_true(field_surface(pair.field, high, NULL).material[0] == want);
        }
    }
    pair_finish(&pair);
}

static void only_code_of_users_is_theirs(void **state)
{
    (void)state;
    struct pair none = pair_of("'materials':{'a':{'shader':'blinn'},'c':{'shader':'checker'}},",
                               "{'type':'sphere','material':'a'}");

    assert_int_equal(none.field->shader_count, 0); /* nothing wears it, so nobody pays */
    struct pair both =
        pair_of("'shaders':{'mine':{'code':'vec3 shade() { return vec3(1); }'}},"
                "'materials':{'a':{'shader':'normals'},'b':{'shader':'mine'}},",
                "{'type':'sphere','material':'a','children':[{'type':'box','material':'b'}]}");
    assert_int_equal(both.field->shader_count, 2);
    assert_non_null(both.field->user_code);
    assert_string_equal(both.field->user_code->place, "/shaders/mine/code");
    pair_finish(&none);
    pair_finish(&both);
}

/* --- what light goes through --- */

#define CLEAR                                                                                      \
    "'materials':{'glass':{'shader':'standard','properties':{'transmission':%s}},"                 \
    "'veil':{'shader':'phong','properties':{'opacity':0.9}}},"
/* A glass ball with a bite taken by a solid, a solid plate with a bite taken by a glass, a blend of
 * both kinds, and a repeated veil. */
#define ROOT                                                                                       \
    "{'type':'union','children':["                                                                 \
    "{'type':'difference','transform':{'translation':[1.5,0,0]},'children':["                      \
    "{'type':'sphere','material':'glass'},{'type':'box','params':{'size':[0.4,2,0.4]}}]},"         \
    "{'type':'intersection','transform':{'translation':[0,1.5,0]},'children':["                    \
    "{'type':'box','material':'%s'},{'type':'sphere','material':'glass',"                          \
    "'params':{'radius':0.6}}]},"                                                                  \
    "{'type':'smooth_union','params':{'k':0.3,'kernel':'root'},'children':["                       \
    "{'type':'sphere','visible':%s},"                                                              \
    "{'type':'box','material':'glass','visible':%s,'transform':{'translation':[0.5,0,0]}}]},"      \
    "{'type':'repeat','visible':%s,'material':'veil','params':{'spacing':[1,1,1],"                 \
    "'count':[2,0,2]},'transform':{'translation':[0,-2,0]},"                                       \
    "'children':[{'type':'sphere','params':{'radius':0.3}}]}]}"

static struct pair clear_scene(const char *transmission, const char *plate, const char *solid,
                               const char *clear)
{
    char parts[512], root[2048];

    snprintf(parts, sizeof parts, CLEAR, transmission);
    snprintf(root, sizeof root, ROOT, plate, solid, clear, clear);
    return pair_of(parts, root);
}

/* Looking at one kind alone is looking at a scene without the other. */
static void assert_sees(const struct field *all, float field_mask, const struct field *left,
                        const char *what)
{
    static float points[POINTS][3];
    static struct probe_answer answers[POINTS];

    random_points(points);
    ask(all, field_mask, points, POINTS, answers);
    for (int i = 0; i < POINTS; i++) {
        const double p[3] = {points[i][0], points[i][1], points[i][2]};
        const double want = field_distance(left, p);
        if (fabs(want - answers[i].distance) > 1e-4) {
            fail_msg("%s: %g, not %g at %g %g %g", what, (double)answers[i].distance, want, p[0],
                     p[1], p[2]);
        }
    }
}

static void either_kind_can_be_looked_at_alone(void **state)
{
    (void)state;
    struct pair all = clear_scene("0.8", "", "true", "true");

    /* Without any glass or veil; the ball in the difference takes all of it along. */
    struct pair solid =
        pair_of("", "{'type':'union','children':[{'type':'sphere'},"
                    "{'type':'intersection','transform':{'translation':[0,1.5,0]},'children':["
                    "{'type':'box'},{'type':'sphere','params':{'radius':0.6}}]}]}");
    struct pair clear =
        pair_of("", "{'type':'union','children':["
                    "{'type':'difference','transform':{'translation':[1.5,0,0]},'children':["
                    "{'type':'sphere'},{'type':'box','params':{'size':[0.4,2,0.4]}}]},"
                    "{'type':'box','transform':{'translation':[0.5,0,0]}},"
                    "{'type':'repeat','params':{'spacing':[1,1,1],'count':[2,0,2]},"
                    "'transform':{'translation':[0,-2,0]},"
                    "'children':[{'type':'sphere','params':{'radius':0.3}}]}]}");
    assert_sees(all.field, 0, all.field, "all");
    assert_sees(all.field, FAR, solid.field, "solid");
    assert_sees(all.field, -FAR, clear.field, "clear");
    pair_finish(&all);
    pair_finish(&solid);
    pair_finish(&clear);
}

static void what_is_clear_lies_in_its_box(void **state)
{
    (void)state;
    struct pair all = clear_scene("0.8", "", "true", "true");
    const struct bounds *box = &all.field->transmissive_bounds;

    assert_true(all.field->transmissive);
    /* The ball with the bite, the blend as a whole, the veils; not the plate above. */
    assert_true(box->high[0] >= 2 && box->high[0] < 2.1);
    assert_true(box->low[1] <= -2.3 && box->low[1] > -2.4);
    assert_true(box->high[1] >= 0.5 && box->high[1] < 0.9);
    pair_finish(&all);
    struct pair none = clear_scene("0", "", "true", "false");
    assert_false(none.field->transmissive);
    pair_finish(&none);
    /* A solid cut by a glass is solid. */
    struct pair cut = pair_of("'materials':{'g':{'shader':'phong','properties':{'opacity':0}}},",
                              "{'type':'difference','children':[{'type':'sphere'},"
                              "{'type':'box','material':'g'}]}");
    assert_false(cut.field->transmissive);
    pair_finish(&cut);
}

static void transmission_compiles_nothing(void **state)
{
    (void)state;
    struct pair some = clear_scene("0.001", "", "true", "true");
    struct pair none = clear_scene("0", "glass", "true", "true");

    assert_true(some.field->structure_hash == none.field->structure_hash);
    pair_finish(&some);
    pair_finish(&none);
}

/* --- the floor --- */

#define FLOOR                                                                                      \
    "'environment':{'floor':true,'floor_height':%s,'floor_color':[0.5,0.25,0.125],"                \
    "'floor_reflectivity':%s},"

static struct pair floor_scene(const char *height, const char *reflectivity, const char *root)
{
    char parts[256];

    snprintf(parts, sizeof parts, FLOOR, height, reflectivity);
    return pair_of(parts, root);
}

static void the_floor_is_a_leaf_of_its_own(void **state)
{
    (void)state;
    static const char root[] = "{'type':'group','children':[{'type':'box'},"
                               "{'type':'sphere','visible':false}]}";
    struct pair pair = floor_scene("-1.5", "0.75", root);
    const struct field *field = pair.field;
    const double below[3] = {9, -2, 9}, above[3] = {3, -1, 0};
    struct field_surface at = field_surface(field, below, NULL);

    assert_true(fabs(at.distance + 0.5) < 1e-9);
    assert_true(fabs(field_distance(field, above) - 0.5) < 1e-9);
    assert_int_equal(at.number, 4); /* behind all three nodes */
    assert_null(field_leaf_id(field, at.number));
    assert_non_null(field_leaf_id(field, 2));
    assert_true(at.material[0] == 0.5 && at.material[1] == 0.25 && at.material[2] == 0.125);
    assert_true(at.material[FIELD_REFLECTIVITY] == 0.75 && at.material[FIELD_GLOSS] == 32);
    assert_true(isinf(field->bounds.high[0]) && isinf(field->bounds.low[2]));
    assert_true(field->bounds.high[1] >= 0.5);

    struct pair other = floor_scene("2", "0", root), without = pair_of("", root);
    assert_true(other.field->structure_hash == field->structure_hash);
    assert_true(without.field->structure_hash != field->structure_hash);
    assert_true(bounds_is_finite(&without.field->bounds));
    pair_finish(&pair);
    pair_finish(&other);
    pair_finish(&without);
}

static void a_floor_needs_no_scene(void **state)
{
    (void)state;
    static float points[POINTS][3];
    static struct probe_answer answers[POINTS];
    struct pair pair = floor_scene("1", "0", "{'type':'group'}");

    random_points(points);
    ask(pair.field, 0, points, POINTS, answers);
    for (int i = 0; i < POINTS; i++) {
        assert_float_equal(answers[i].distance, points[i][1] - 1, 1e-5);
        assert_int_equal(answers[i].leaf, 2);
        assert_float_equal(answers[i].material[1], 0.25, 0);
    }
    pair_finish(&pair);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shader_has_its_numbers),
        cmocka_unit_test(a_blend_of_models_has_one_of_them),
        cmocka_unit_test(colours_of_ours_agree),
        cmocka_unit_test(maps_have_the_colours_of_their_functions),
        cmocka_unit_test(a_map_has_its_lines),
        cmocka_unit_test(numbers_of_a_map_compile_nothing),
        cmocka_unit_test(a_function_that_cannot_be_read_has_its_place),
        cmocka_unit_test(a_face_between_two_cubes_has_the_inner_colour),
        cmocka_unit_test(only_code_of_users_is_theirs),
        cmocka_unit_test(either_kind_can_be_looked_at_alone),
        cmocka_unit_test(what_is_clear_lies_in_its_box),
        cmocka_unit_test(transmission_compiles_nothing),
        cmocka_unit_test(the_floor_is_a_leaf_of_its_own),
        cmocka_unit_test(a_floor_needs_no_scene),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
