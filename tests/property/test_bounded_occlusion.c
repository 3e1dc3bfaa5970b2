/* SPDX-License-Identifier: MIT */
/* Occlusion of what warps or is scaled along an axis, where the field is but a bound of the
 * distance: everything such was darker on all sides. A turned solid of revolution, waves that are
 * too small to be seen and a scaled cylinder are shapes that there is an exact field of. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum { WIDTH = 160, HEIGHT = 120, PLACES = WIDTH * HEIGHT };

static const enum render_stage stages[] = {RENDER_ENGINE, RENDER_COMPUTE};
enum { STAGES = sizeof stages / sizeof stages[0] };

static const char group[] = "'type':'group'";
static const char upright[] = "'type':'cylinder','params':{'radius':0.6,'height':1.2}";
static const char lying[] = "'type':'cylinder','params':{'radius':0.6,'height':1.2},"
                            "'transform':{'rotation':[1.5707963,0,0]}";
static const char ball[] = "'type':'sphere','params':{'radius':0.6}";

/* Part of the places whose occlusion may be another by 0.1. The floor around is darkened by the
 * bound of the shape, from further off than by the distance. */
#define HARDLY 0.005
#define AROUND 0.08

static const struct bounded {
    const char *name, *modifier, *shape, *exact;
    double off;
} all[] = {
    {"a twisted cylinder", "'type':'twist','params':{'rate':2}", upright, upright, AROUND},
    {"a strongly twisted cylinder", "'type':'twist','params':{'rate':4.5}", upright, upright,
     AROUND},
    {"a bent cylinder", "'type':'bend','params':{'rate':2}", lying, lying, AROUND},
    {"waves of space",
     "'type':'offset_space','params':{'amplitude':[0.004,0.004,0.004],"
     "'frequency':[150,150,150]}",
     ball, ball, HARDLY},
    {"waves", "'type':'displace','params':{'amplitude':0.004,'frequency':[200,200,200]}", ball,
     ball, HARDLY},
    {"noise", "'type':'displace_noise','params':{'amplitude':0.004,'frequency':60,'octaves':1}",
     ball, ball, HARDLY},
    {"a cylinder scaled along its axis", group,
     "'type':'cylinder','params':{'radius':0.6,'height':4},'transform':{'scale':[1,0.3,1]}",
     upright, AROUND},
    {"a cylinder scaled across", group,
     "'type':'cylinder','params':{'radius':2,'height':1.2},'transform':{'scale':[0.3,1,0.3]}",
     upright, HARDLY},
};
enum { ALL = sizeof all / sizeof all[0] };

static struct renderer *renderer;

static struct image occlusion_of(const char *modifier, const char *shape)
{
    char text[1024];

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1','camera':{'position':[2.2,1.9,3.1],'target':[0,0,0],"
             "'fov':36},'root':{'type':'union','children':["
             "{'type':'plane','params':{'offset':-0.65}},{%s,'children':[{%s}]}]}}",
             modifier, shape);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    desc.samples = 1;
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_OCCLUSION);
    resident_destroy(resident);
    return image;
}

static void occlusion_is_that_of_the_exact_field(void **state)
{
    const struct bounded *bounded = *state;

    for (int i = 0; i < STAGES; i++) {
        renderer_use_stage(renderer, stages[i]);
        struct image occlusion = occlusion_of(bounded->modifier, bounded->shape);
        struct image wanted = occlusion_of(group, bounded->exact);
        const struct light_difference found = drawing_compare_light(&occlusion, &wanted, 0.1);
        image_finish(&occlusion);
        image_finish(&wanted);
        print_message("# %s: %d of %d places off, %d dark ones\n", render_stage_names[stages[i]],
                      found.off, PLACES, found.dark);
        assert_true(found.dark > PLACES / 100);
        assert_true(found.off <= PLACES * bounded->off);
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
    static struct CMUnitTest tests[ALL];

    for (int i = 0; i < ALL; i++) {
        tests[i] = (struct CMUnitTest){all[i].name, occlusion_is_that_of_the_exact_field, NULL,
                                       NULL, (void *)&all[i]};
    }
    return _cmocka_run_group_tests("occlusion by bounds", tests, ALL, start, stop);
}
