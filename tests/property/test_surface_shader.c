/* SPDX-License-Identifier: MIT */
/* Shaders of users that say all of a surface: the same pixels as ours with the same numbers, of
 * mirrors, of glass and of what shines through it; and the same in C. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/compiled.h"
#include "tests/support/drawing.h"

enum { WIDTH = 96, HEIGHT = 72 };

static struct renderer *renderer;

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    renderer_use_stage(renderer, RENDER_COMPUTE); /* as users' shaders are drawn */
    return 0;
}

static int end(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

/* A ball of the material in a tumbler of the same, on a floor in the sun, beside a box. */
static struct scene *scene_of(const char *material, const char *code)
{
    char text[4096];

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1','camera':{'position':[0.4,1.1,3],'target':[0,0,0]},"
             "'lights':[{'id':'sun','type':'directional','intensity':3,'shadow':'hard',"
             "'direction':[-0.6,-0.8,-0.4]}],"
             "'environment':{'floor':true,'floor_height':-0.6},"
             "'render':{'level':'final','antialiasing':'none','occlusion':false},"
             "'shaders':{'mine':{'properties':[{'name':'tint','type':'color',"
             "'default':[0.9,0.5,0.25]}],'code':'%s'}},"
             "'materials':{'own':%s},'root':{'id':'root','type':'union','children':["
             "{'id':'ball','type':'sphere','material':'own','params':{'radius':0.5},"
             "'transform':{'translation':[-0.4,0,0]}},"
             "{'id':'box','type':'box','params':{'size':[0.4,0.8,0.4]},"
             "'transform':{'translation':[0.6,-0.2,-0.4],'rotation':[0,0.5,0]}}]}}",
             code, material);
    return drawing_parse(text);
}

static struct image draw(const char *material, const char *code)
{
    struct resident *resident = resident_create(renderer, scene_of(material, code), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    struct image image = drawing_of(resident, &desc, AOV_COLOR);

    resident_destroy(resident);
    return image;
}

#define MINE "{'shader':'mine'}"
#define OURS(properties) "{'shader':'standard','properties':{" properties "}}"
#define SURFACE(members)                                                                           \
    "Surface shade(FragmentProperties at) { Surface s = Surface(tint); " members " return s; }"
/* Unused by materials of ours, which have to be drawn with a shader beside them as well. */
#define UNUSED "vec3 shade() { return tint; }"

static void a_copy_of_ours_is_the_same_picture(void **state)
{
    static const struct {
        const char *ours, *mine;
    } pairs[] = {
        {OURS("'base_color':[0.9,0.5,0.25],'metallic':1,'roughness':0"),
         SURFACE("s.metallic = 1.0; s.roughness = 0.0;")},
        {OURS("'base_color':[0.9,0.5,0.25],'transmission':1,'roughness':0,'ior':1.4"),
         SURFACE("s.transmission = 1.0; s.roughness = 0.0; s.ior = 1.4;")},
        {OURS("'base_color':[0.9,0.5,0.25],'roughness':0.7,'emission':[0.5,0,0.25]"),
         SURFACE("s.roughness = 0.7; s.emission = vec3(0.5, 0, 0.25);")},
        /* What is left after one unit of length: exp(-absorption). */
        {OURS("'base_color':[0.9,0.5,0.25],'transmission':1,'roughness':0,"
              "'attenuation_color':[1,0.5,0.25]"),
         SURFACE("s.transmission = 1.0; s.roughness = 0.0;"
                 "s.absorption = -log(vec3(1.0, 0.5, 0.25));")},
    };

    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        struct image ours = draw(pairs[i].ours, UNUSED), mine = draw(MINE, pairs[i].mine);
        struct image plain = draw(OURS("'base_color':[0.9,0.5,0.25]"), UNUSED);
        int differ = 0, seen = 0;
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            const uint32_t a = ((const uint32_t *)ours.pixels)[k];
            differ += a != ((const uint32_t *)mine.pixels)[k];
            seen += a != ((const uint32_t *)plain.pixels)[k];
        }
        if (differ > 0 || seen < 400) {
            fail_msg("%d pixels differ from %s; %d from what is matt", differ, pairs[i].ours, seen);
        }
        image_finish(&ours);
        image_finish(&mine);
        image_finish(&plain);
    }
}

/* A mirror by its reflectivity alone; what is rough gets no rays. */
static void reflectivity_mirrors(void **state)
{
    (void)state;
    const uint64_t before = renderer_counters(renderer).rays;
    struct image matt = draw(MINE, SURFACE("s.roughness = 0.6;"));
    const uint64_t none = renderer_counters(renderer).rays - before;
    struct image mirror = draw(MINE, SURFACE("s.reflectivity = 1.0; s.roughness = 0.0;"));
    const uint64_t rays = renderer_counters(renderer).rays - before - none;

    assert_true(none == 0 && rays > 400);
    assert_false(drawing_is_same(&matt, &mirror));
    image_finish(&matt);
    image_finish(&mirror);
}

/* Half of the ball is glass and half is not, by the place. */
#define HALVES                                                                                     \
    SURFACE("s.roughness = 0.0;"                                                                   \
            "s.transmission = step(0.0, at.object_position.x);")

/* Seen as what they are: numbers of the picture against those of the C evaluator. */
static void pictures_and_c_agree(void **state)
{
    struct scene *scene = scene_of(MINE, HALVES);
    struct field *field = compile_field(scene);
    struct resident *resident = resident_create(renderer, scene_of(MINE, HALVES), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    int clear = 0, solid = 0;

    (void)state;
    desc.as_floats = true;
    struct image places = drawing_of(resident, &desc, AOV_POSITION);
    struct image ids = drawing_of(resident, &desc, AOV_ID);
    struct image optics = drawing_of(resident, &desc, AOV_OPTICAL);
    struct image albedo = drawing_of(resident, &desc, AOV_ALBEDO);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (((const uint32_t *)ids.pixels)[i] != 2) {
            continue;
        }
        const float *at = (const float *)places.pixels + 3 * i;
        const double p[3] = {(double)at[0], (double)at[1], (double)at[2]};
        if (fabs(p[0] + 0.4) < 1e-3) {
            continue;
        }
        const struct field_surface want = field_surface(field, p, NULL);
        const float *o = (const float *)optics.pixels + 4 * i;
        assert_true(fabs((double)o[0] - want.material[FIELD_REFLECTIVITY]) < 0.003);
        assert_true(fabs((double)o[1] - want.material[FIELD_IOR]) < 0.002);
        assert_true(fabs(1 - (double)o[2] - want.material[FIELD_TRANSMISSION]) < 0.003);
        assert_true(fabs((double)o[3] - want.material[FIELD_GLOSS]) < 0.002);
        for (int c = 0; c < 3; c++) {
            const double got = (double)((const float *)albedo.pixels)[3 * i + c];
            assert_true(fabs(got - want.material[FIELD_DIFFUSE + c]) < 0.001);
        }
        clear += o[2] < 0.5f;
        solid += o[2] > 0.5f;
    }
    assert_true(field->transmissive && clear > 200 && solid > 200);
    image_finish(&places);
    image_finish(&ids);
    image_finish(&optics);
    image_finish(&albedo);
    resident_destroy(resident);
    field_unref(field);
    scene_destroy(scene);
}

/* Light from the right goes through the glass half, and the other half keeps it off. */
static void what_is_not_clear_throws_a_shadow(void **state)
{
    (void)state;
    struct image glass = draw(MINE, SURFACE("s.transmission = 1.0; s.roughness = 0.0;"));
    struct image wall = draw(MINE, SURFACE("s.transmission = 0.0; s.roughness = 0.0;"));
    struct image matt = draw(MINE, SURFACE("s.roughness = 0.0;"));
    int differ = 0, lit = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        for (int c = 0; c < 3; c++) {
            const int a = ((const uint8_t *)wall.pixels)[4 * i + c];
            differ += abs(a - ((const uint8_t *)matt.pixels)[4 * i + c]) > 6;
            lit += ((const uint8_t *)glass.pixels)[4 * i + c] > a + 40;
        }
    }
    print_message("%d differ, %d are lit through glass\n", differ, lit);
    assert_true(differ < 3 * WIDTH * HEIGHT / 100 && lit > 200);
    image_finish(&glass);
    image_finish(&wall);
    image_finish(&matt);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_copy_of_ours_is_the_same_picture),
        cmocka_unit_test(reflectivity_mirrors),
        cmocka_unit_test(pictures_and_c_agree),
        cmocka_unit_test(what_is_not_clear_throws_a_shadow),
    };

    return cmocka_run_group_tests_name("surfaces by users' shaders", tests, start, end);
}
