/* SPDX-License-Identifier: MIT */
/* Samples are added as linear light, and what a screen shows is made of their mean: the numbers of
 * color are the light of its picture, in whatever way it is drawn. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum { WIDTH = 40, HEIGHT = 30 };

/* Half a step of dither, half of rounding, and what sums of a GPU are apart. */
static const double ROUNDING = 1.05;

/* A leaning lamp before the dark, of a light so strong on all channels. */
#define LAMP                                                                                       \
    "{'format':'fieldcast/1','camera':{'type':'orthographic','height':2,'position':[0,0,5]},"      \
    "'environment':{'type':'solid','color':[0,0,0]},"                                              \
    "'materials':{'lamp':{'shader':'phong','properties':{'diffuse':[0,0,0],'specular':[0,0,0],"    \
    "'emission':[%g,%g,%g]}}},"                                                                    \
    "'render':{'antialiasing':'full','samples':4,'transparent':%s},"                               \
    "'root':{'type':'box','material':'lamp','params':{'size':[0.7,9,0.2]},"                        \
    "'transform':{'rotation':[0,0,0.11]}}}"

/* Glass and a mirror between a lamp and the sky. */
#define LIGHT                                                                                      \
    "{'format':'fieldcast/1','camera':{'position':[0,0.6,4],'target':[0,0,0],'fov':40},"           \
    "'lights':[{'type':'directional','intensity':3}],"                                             \
    "'environment':{'zenith':[0.3,0.5,1.4],'horizon':[1.6,1.5,1.2]},"                              \
    "'materials':{'lamp':{'shader':'phong','properties':{'emission':[30,19,6]}},"                  \
    "'metal':{'shader':'standard','properties':{'metallic':1,'roughness':0.1}},"                   \
    "'glass':{'shader':'standard','properties':{'transmission':1,'roughness':0}}},"                \
    "'render':{'antialiasing':'%s','tone_map':'%s','exposure':0.5,'transparent':%s},"              \
    "'root':{'type':'union','children':["                                                          \
    "{'type':'box','material':'lamp','params':{'size':[0.2,2,0.2]},"                               \
    "'transform':{'translation':[-0.9,0,0],'rotation':[0,0,0.2]}},"                                \
    "{'type':'sphere','material':'metal','params':{'radius':0.5}},"                                \
    "{'type':'sphere','material':'glass','params':{'radius':0.4},"                                 \
    "'transform':{'translation':[1,0,0.2]}}]}}"

static struct renderer *renderer;

static struct image draw(const char *text, enum render_stage stage, bool as_floats)
{
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    renderer_use_stage(renderer, stage);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    desc.as_floats = as_floats;
    struct image image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    return image;
}

/* --- what a screen shows --- */

static void aces(double c[3])
{
    static const double into[3][3] = {
        {0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}};
    static const double back[3][3] = {{1.60475, -0.53108, -0.07367},
                                      {-0.10208, 1.10813, -0.00605},
                                      {-0.00327, -0.07276, 1.07602}};
    double v[3];

    for (int i = 0; i < 3; i++) {
        v[i] = (into[i][0] * c[0] + into[i][1] * c[1] + into[i][2] * c[2]) / 0.85;
        v[i] = (v[i] * (v[i] + 0.0245786) - 0.000090537) /
               (v[i] * (0.983729 * v[i] + 0.4329510) + 0.238081);
    }
    for (int i = 0; i < 3; i++) {
        c[i] = back[i][0] * v[0] + back[i][1] * v[1] + back[i][2] * v[2];
    }
}

static void show(double c[3], const char *tone_map)
{
    const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];

    if (strcmp(tone_map, "aces") == 0) {
        aces(c);
    }
    for (int i = 0; i < 3; i++) {
        c[i] /= strcmp(tone_map, "reinhard") == 0 ? 1 + luminance : 1;
        c[i] = fmin(fmax(c[i], 0), 1);
        c[i] = c[i] <= 0.0031308 ? 12.92 * c[i] : 1.055 * pow(c[i], 1 / 2.4) - 0.055;
    }
}

static void check_light(enum render_stage stage, const char *smoothing, const char *tone_map,
                        bool transparent)
{
    char text[2048];
    int bright = 0;

    snprintf(text, sizeof text, LIGHT, smoothing, tone_map, transparent ? "true" : "false");
    struct image picture = draw(text, stage, false), light = draw(text, stage, true);
    const uint8_t *bytes = picture.pixels;
    const float *values = light.pixels;

    assert_int_equal(light.channels, 4);
    for (int i = 0; i < WIDTH * HEIGHT; i++, bytes += 4, values += 4) {
        const double coverage = transparent ? values[3] : 1;
        double c[3];
        for (int k = 0; k < 3; k++) {
            c[k] = coverage > 0 ? values[k] / coverage * sqrt(2) : 0;
        }
        show(c, tone_map);
        for (int k = 0; k < 3; k++) {
            if (fabs(c[k] * 255 - bytes[k]) > ROUNDING) {
                fail_msg("%s, %s, %s: channel %d of pixel %d is %d, not %.2f",
                         render_stage_names[stage], smoothing, tone_map, k, i, bytes[k],
                         c[k] * 255);
            }
        }
        bright += values[0] > 2;
    }
    assert_in_range(bright, WIDTH * HEIGHT / 50, WIDTH * HEIGHT / 2);
    image_finish(&picture);
    image_finish(&light);
}

static void numbers_are_the_light_of_the_picture(void **state)
{
    static const enum render_stage stages[] = {RENDER_ENGINE, RENDER_COMPUTE, RENDER_FRAGMENT};

    (void)state;
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++) {
        check_light(stages[i], "full", "aces", false);
        check_light(stages[i], "adaptive", "reinhard", false);
        check_light(stages[i], "edges", "none", false);
        check_light(stages[i], "full", "aces", true);
    }
}

/* --- means --- */

static struct image draw_lamp(double emission, bool transparent, bool as_floats)
{
    char text[2048];

    snprintf(text, sizeof text, LAMP, emission, emission, emission, transparent ? "true" : "false");
    return draw(text, RENDER_ENGINE, as_floats);
}

/* Part of each pixel that the lamp covers. */
static void find_coverage(double out[WIDTH * HEIGHT])
{
    struct image image = draw_lamp(1, true, true);

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        out[i] = ((const float *)image.pixels)[4 * i + 3];
    }
    image_finish(&image);
}

static void means_of_what_a_screen_can_show_are_plain(void **state)
{
    double coverage[WIDTH * HEIGHT];
    struct image image = draw_lamp(0.9, false, true);
    int edge = 0;

    (void)state;
    find_coverage(coverage);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(fabs(((const float *)image.pixels)[4 * i] - 0.9 * coverage[i]) < 1e-5);
        edge += coverage[i] > 0 && coverage[i] < 1;
    }
    assert_true(edge > HEIGHT);
    image_finish(&image);
}

/* The plain mean would be white from the second of sixteen samples on. */
static void edges_of_lamps_are_smooth(void **state)
{
    double coverage[WIDTH * HEIGHT];
    struct image image = draw_lamp(60, false, false);
    int few = 0, most = 0;

    (void)state;
    find_coverage(coverage);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int level = ((const uint8_t *)image.pixels)[4 * i];
        if (coverage[i] > 0 && coverage[i] < 0.3) {
            assert_in_range(level, 40, 170);
            few++;
        } else if (coverage[i] > 0.7 && coverage[i] < 0.9) {
            assert_in_range(level, 180, 253);
            most++;
        }
    }
    assert_true(few > HEIGHT / 4 && most > HEIGHT / 4);
    image_finish(&image);
}

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_the_light_of_the_picture),
        cmocka_unit_test(means_of_what_a_screen_can_show_are_plain),
        cmocka_unit_test(edges_of_lamps_are_smooth),
    };

    return cmocka_run_group_tests_name("linear light", tests, start, end);
}
