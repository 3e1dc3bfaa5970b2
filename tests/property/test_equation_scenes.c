/* SPDX-License-Identifier: MIT */
/* Equations among ordinary shapes: in a union, a smooth union, a difference and a twist, by the
 * engine and by shaders. The oracle is the same scene with the ordinary shape that the equation
 * describes, marched in double precision, and light is that of this scene. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"
#include "tests/support/oracle.h"

enum { WIDTH = 200, HEIGHT = 150, EVERY = 4 };

static const enum render_stage stages[] = {RENDER_ENGINE, RENDER_COMPUTE};
enum { STAGES = sizeof stages / sizeof stages[0] };

static const struct shape {
    const char *ordinary, *equation;
} ball = {"'type':'sphere','params':{'radius':0.6}",
          "'type':'implicit','params':{'equation':'x^2 + y^2 + z^2 < 0.36'}"},
  ring = {"'type':'torus','params':{'radius':0.6,'tube':0.2}",
          "'type':'implicit','params':{'equation':"
          "'(x^2 + y^2 + z^2 + 0.32)^2 < 1.44*(x^2 + z^2)'}"},
  ring_of_roots = {"'type':'torus','params':{'radius':0.6,'tube':0.2}",
                   "'type':'implicit','params':{'equation':"
                   "'(sqrt(x^2 + z^2) - 0.6)^2 + y^2 < 0.04'}"},
  block = {"'type':'box','params':{'size':[0.6,1.6,1]}",
           "'type':'implicit','params':{'equation':'max(|x|/0.3, |z|/0.5) < 1',"
           "'size':[2,1.6,2]}"};

/* Each the same twice. The second one has an end where that of its domain is: its slope has no
 * bound there. */
static const struct shape
    hill = {"'type':'implicit','params':{'equation':'exp(y) < 2*x','size':[2,3,1.6]}",
            "'type':'implicit','params':{'equation':'y < log(2*x)','size':[2,3,1.6]}"},
    slide = {"'type':'implicit','params':{'equation':'exp(y) = 2*x','size':[2,3,1.6],"
             "'mode':'sheet'}",
             "'type':'implicit','params':{'equation':'y = log(2*x)','size':[2,3,1.6],"
             "'mode':'sheet'}"};

#define BOX "{'type':'box','params':{'size':[0.9,0.9,0.9]}"
#define AT(x, y, z) "'transform':{'translation':[" #x "," #y "," #z "]}"

/* Soft shadows and occlusion follow distances, of which an equation gives an estimate: so much of
 * the picture may be darker or lighter than by the ordinary shape. Off an edge of what max() makes,
 * only the nearer plane is known; where a root is steep, an estimate is not believed. A blend is
 * made of bounds, and thinner. */
#define HARDLY 0.002
#define AT_ROOTS 0.01
#define AT_EDGES 0.05
#define IN_BLENDS 0.015

/* The shape stands between both texts. A blend follows distances, of which an equation has a bound,
 * so its reference is the C evaluator's field of the same scene. */
static const struct composition {
    const char *name, *before, *behind;
    const struct shape *shape;
    bool blends;
    double off;
} compositions[] = {
    {"union", "'type':'union','children':[" BOX "},{", "," AT(0.5, 0.3, 0.3) "}]", &ring, false,
     HARDLY},
    {"union of code", "'type':'union','children':[" BOX "},{", "," AT(0.5, 0.3, 0.3) "}]",
     &ring_of_roots, false, AT_ROOTS},
    {"difference", "'type':'difference','children':[" BOX "},{", "," AT(0.3, 0.5, 0.4) "}]", &ball,
     false, HARDLY},
    {"difference of code", "'type':'difference','children':[" BOX "},{", "," AT(0.3, 0.3, 0.3) "}]",
     &ring_of_roots, false, HARDLY},
    {"twist",
     "'type':'twist','params':{'rate':1},'children':[{'type':'union','children':["
     "{'type':'sphere','params':{'radius':0.45}," AT(0.4, 0, 0) "},{",
     "}]}]", &block, false, AT_EDGES},
    {"smooth union", "'type':'smooth_union','params':{'k':0.2},'children':[" BOX "},{",
     "," AT(0.5, 0.5, 0.3) "}]", &ball, true, HARDLY},
    {"smooth union of code", "'type':'smooth_union','params':{'k':0.2},'children':[" BOX "},{",
     "," AT(0.5, 0.3, 0.3) "}]", &ring_of_roots, true, IN_BLENDS},
    {"end of a domain", "'type':'union','children':[{", "," AT(0, 0.8, 0) "}]", &hill, false,
     HARDLY},
    {"end of a sheet", "'type':'union','children':[{", "," AT(0, 0.8, 0) "}]", &slide, false,
     HARDLY},
};
enum { COMPOSITIONS = sizeof compositions / sizeof compositions[0] };

static struct renderer *renderer;

static struct scene *scene_of(const struct composition *composition, bool by_equation)
{
    const struct shape *shape = composition->shape;
    char *text = NULL;

    assert_true(asprintf(&text,
                         "{'format':'fieldcast/1','camera':{'position':[2.2,1.9,3.1],"
                         "'target':[0.1,0,0],'fov':36},'lights':[{'type':'directional',"
                         "'direction':[-0.5,-1,-0.4],'intensity':3,'shadow':'soft'}],"
                         "'root':{'type':'union','children':[{'type':'plane','params':"
                         "{'offset':-0.8}},{%s%s%s}]}}",
                         composition->before, by_equation ? shape->equation : shape->ordinary,
                         composition->behind) > 0);
    struct scene *scene = drawing_parse(text);
    free(text);
    return scene;
}

/* --- where surfaces are --- */

static bool is_near(const struct oracle_found *found, double depth, double footprint)
{
    const double off = fabs(depth - found->t);

    return off <= 1e-3 * found->t || off * found->slant <= footprint;
}

static void surfaces_are_those_of(const struct scene *wanted, const struct composition *composition)
{
    static const struct oracle_bounds bounds = {
        .overlap = 0.995, .depths = 0.005, .normals = 0.02, .ids = 0.01};
    const struct oracle_params params = {.width = WIDTH / EVERY,
                                         .height = HEIGHT / EVERY,
                                         .every = EVERY,
                                         .tolerance = 1e-6,
                                         .end_of_sight = 0.95,
                                         .degrees = 5,
                                         .is_near = is_near};
    struct oracle *oracle = oracle_create(wanted, &params);

    for (int i = 0; i < STAGES; i++) {
        renderer_use_stage(renderer, stages[i]);
        struct resident *resident = resident_create(renderer, scene_of(composition, true), 1);
        const struct oracle_tally tally = oracle_judge(oracle, renderer, resident);
        resident_destroy(resident);
        assert_true(tally.both > params.width * params.height / 2);
        assert_true(oracle_agrees(render_stage_names[stages[i]], &tally, &bounds, true));
    }
    oracle_destroy(oracle);
}

/* --- light on them --- */

static struct image light_of(const struct composition *composition, bool by_equation, enum aov aov)
{
    struct resident *resident = resident_create(renderer, scene_of(composition, by_equation), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.samples = 1;
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, aov);
    resident_destroy(resident);
    return image;
}

static void light_is_that_of_ordinary_shapes(const struct composition *composition, enum aov aov)
{
    const int places = WIDTH * HEIGHT;

    for (int i = 0; i < STAGES; i++) {
        renderer_use_stage(renderer, stages[i]);
        struct image image = light_of(composition, true, aov);
        struct image wanted = light_of(composition, false, aov);
        const struct light_difference found = drawing_compare_light(&image, &wanted, 0.1);
        image_finish(&image);
        image_finish(&wanted);
        print_message("# %s, %s: %d of %d places off, %d dark ones\n",
                      render_stage_names[stages[i]], aov == AOV_SHADOW ? "shadows" : "occlusion",
                      found.off, places, found.dark);
        assert_true(found.dark > places / 100);
        assert_true(found.off <= places * composition->off);
    }
}

static void equations_are_drawn_as_ordinary_shapes(void **state)
{
    const struct composition *composition = *state;
    struct scene *wanted = scene_of(composition, composition->blends);

    surfaces_are_those_of(wanted, composition);
    scene_destroy(wanted);
    light_is_that_of_ordinary_shapes(composition, AOV_SHADOW);
    light_is_that_of_ordinary_shapes(composition, AOV_OCCLUSION);
}

/* --- walls --- */

/* At a jump a sheet has a wall that the function's slope elsewhere tells nothing of: an estimate of
 * the distance by slopes leads through it. */
static struct image shadow_of_wall(const char *kind)
{
    char *text = NULL;

    assert_true(
        asprintf(&text,
                 "{'format':'fieldcast/1','camera':{'position':[1.5,5,7],'target':[0,-0.5,0],"
                 "'fov':40},'lights':[{'type':'directional','direction':[-0.3,-1,-0.2],"
                 "'shadow':'%s'}],'root':{'type':'union','children':[{'type':'plane',"
                 "'params':{'offset':-2}},{'type':'implicit','params':{'equation':"
                 "'4 + x = 9*sign(y)','mode':'sheet','thickness':0.3,'clip':'ball',"
                 "'radius':1.5}}]}}",
                 kind) > 0);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    desc.samples = 1;
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_SHADOW);
    resident_destroy(resident);
    free(text);
    return image;
}

static void walls_cast_soft_shadows(void **state)
{
    (void)state;
    for (int i = 0; i < STAGES; i++) {
        renderer_use_stage(renderer, stages[i]);
        struct image hard = shadow_of_wall("hard"), soft = shadow_of_wall("soft");
        const float *sharp = hard.pixels, *values = soft.pixels;
        int dark = 0, lit = 0;
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            dark += sharp[hard.channels * k] < 0.1f;
            lit += sharp[hard.channels * k] < 0.1f && values[soft.channels * k] > 0.6f;
        }
        image_finish(&hard);
        image_finish(&soft);
        print_message("# %s: %d of %d places in the shadow are lit\n",
                      render_stage_names[stages[i]], lit, dark);
        assert_true(dark > WIDTH * HEIGHT / 50);
        assert_true(lit <= dark / 50);
    }
}

static int start(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    return 0;
}

static int stop(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    static struct CMUnitTest tests[COMPOSITIONS + 1];

    for (int i = 0; i < COMPOSITIONS; i++) {
        tests[i] = (struct CMUnitTest){compositions[i].name, equations_are_drawn_as_ordinary_shapes,
                                       NULL, NULL, (void *)&compositions[i]};
    }
    tests[COMPOSITIONS] = (struct CMUnitTest)cmocka_unit_test(walls_cast_soft_shadows);
    return _cmocka_run_group_tests("scenes with equations", tests, COMPOSITIONS + 1, start, stop);
}
