/* SPDX-License-Identifier: MIT */
/* Mirrors and glass cost nothing where they are not: only their pixels get rays, and all other
 * pixels are the same bytes with the effects and without. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum { WIDTH = 160, HEIGHT = 90 };

#define SCENE(material, render)                                                                    \
    "{'format':'fieldcast/1','camera':{'position':[0,0.5,4],'target':[0,0,0]},"                    \
    "'lights':[{'id':'sun','type':'directional','shadow':'none'}],"                                \
    "'environment':{'floor':true,'floor_height':-1},"                                              \
    "'render':{'antialiasing':'none','occlusion':false," render "},"                               \
    "'materials':{'clear':{'shader':'standard','properties':{" material "}}},"                     \
    "'root':{'id':'root','type':'union','children':["                                              \
    "{'id':'ball','type':'sphere','material':'clear',"                                             \
    "'params':{'radius':0.7},'transform':{'translation':[-0.8,0,0]}},"                             \
    "{'id':'box','type':'box','transform':{'translation':[0.8,0,0]}}]}}"
#define MIRROR "'metallic':1,'roughness':0"
#define GLASS "'transmission':1,'roughness':0"
#define MATT "'roughness':1"
#define ON "'ray_depth':1"
#define OFF "'reflections':false,'refractions':false"

enum { BALL = 2 }; /* its number: after the root */

static struct renderer *renderer;

struct drawn {
    struct image color, id;
    uint64_t rays; /* that the colour took */
};

static struct drawn draw(const char *text)
{
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    const uint64_t before = renderer_counters(renderer).rays;
    struct drawn drawn = {.color = drawing_of(resident, &desc, AOV_COLOR)};

    drawn.rays = renderer_counters(renderer).rays - before;
    desc.as_floats = true;
    drawn.id = drawing_of(resident, &desc, AOV_ID);
    resident_destroy(resident);
    return drawn;
}

static void drawn_finish(struct drawn *drawn)
{
    image_finish(&drawn->color);
    image_finish(&drawn->id);
}

static bool is_ball(const struct drawn *drawn, int pixel)
{
    return ((const uint32_t *)drawn->id.pixels)[pixel] == BALL;
}

static uint64_t ball_pixels(const struct drawn *drawn)
{
    uint64_t count = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        count += is_ball(drawn, i);
    }
    assert_true(count > WIDTH * HEIGHT / 50);
    return count;
}

static void only_mirrors_get_mirrored_rays(void **state)
{
    struct drawn mirror = draw(SCENE(MIRROR, ON));

    (void)state;
    assert_int_equal(mirror.rays, ball_pixels(&mirror));
    drawn_finish(&mirror);
}

/* Through glass one ray is refracted and one reflected, at most. */
static void only_glass_gets_broken_rays(void **state)
{
    struct drawn glass = draw(SCENE(GLASS, ON));

    (void)state;
    assert_in_range(glass.rays, ball_pixels(&glass), 2 * ball_pixels(&glass));
    drawn_finish(&glass);
}

static void no_rays_without_need(void **state)
{
    static const char *const texts[] = {SCENE(MATT, ON), SCENE(MIRROR, OFF), SCENE(GLASS, OFF),
                                        SCENE(MIRROR, "'level':'draft'")};

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct drawn drawn = draw(texts[i]);
        assert_int_equal(drawn.rays, 0);
        drawn_finish(&drawn);
    }
}

static void assert_same_elsewhere(const char *with, const char *without)
{
    struct drawn on = draw(with), off = draw(without);
    int differ = 0, changed = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const bool same = memcmp((const uint32_t *)on.color.pixels + i,
                                 (const uint32_t *)off.color.pixels + i, 4) == 0;
        differ += !same && !is_ball(&on, i);
        changed += !same && is_ball(&on, i);
    }
    assert_int_equal(differ, 0);
    assert_true(changed > 0);
    drawn_finish(&on);
    drawn_finish(&off);
}

static void other_pixels_stay(void **state)
{
    (void)state;
    assert_same_elsewhere(SCENE(MIRROR, ON), SCENE(MIRROR, OFF));
    assert_same_elsewhere(SCENE(GLASS, ON), SCENE(GLASS, OFF));
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
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_mirrors_get_mirrored_rays),
        cmocka_unit_test(only_glass_gets_broken_rays),
        cmocka_unit_test(no_rays_without_need),
        cmocka_unit_test(other_pixels_stay),
    };

    return cmocka_run_group_tests_name("effects", tests, start, stop);
}
