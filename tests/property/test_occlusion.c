/* SPDX-License-Identifier: MIT */
/* Ambient occlusion is one integral, whatever number of samples looks for it: against closed forms
 * and sums of a thousand places, in whole pictures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum { WIDTH = 160, HEIGHT = 40 };

static const double view_height = 0.6, view_x = 0.25; /* seen from above, 5 up */
static const double reach = 1;
static const char own_reach[] = "'occlusion_strength':1,'occlusion_reach':1";

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

/* A floor at 0, and a wall that begins at x = -1. */
static const char wall[] = "{'type':'plane'},{'type':'plane','params':{"
                           "'normal':[1,0,0],'offset':-1}}";
/* A floor, and a ball that lies on it at x = -1.1. */
static const double ball_radius = 0.5, ball_x = -1.1;
static const char ball[] = "{'type':'plane'},{'type':'sphere','params':{'radius':0.5},"
                           "'transform':{'translation':[-1.1,0.5,0]}}";

static struct image draw(const char *children, const char *render)
{
    char text[1024];

    snprintf(text, sizeof text,
             "{'format':'fieldcast/1','camera':{'type':'orthographic','height':%g,"
             "'position':[%g,5,0],'target':[%g,0,0],'up':[0,0,-1]},'render':{%s},"
             "'root':{'type':'union','children':[%s]}}",
             view_height, view_x, view_x, render, children);
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);
    desc.samples = 1;
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, AOV_OCCLUSION);
    resident_destroy(resident);
    return image;
}

static struct image draw_samples(const char *children, int samples)
{
    char render[160];

    snprintf(render, sizeof render, "%s,'occlusion_samples':%d", own_reach, samples);
    return draw(children, render);
}

static double dark_at(const struct image *image, int i)
{
    return 1 - (double)((const float *)image->pixels)[i];
}

static void place_of(int i, double out[2])
{
    out[0] = view_x + (i % WIDTH + 0.5 - 0.5 * WIDTH) * view_height / HEIGHT;
    out[1] = (i / WIDTH + 0.5 - 0.5 * HEIGHT) * view_height / HEIGHT;
}

/* The integral of glsl/shadow.glsl beside the wall: (1 - sqrt(a / reach))^2 at the distance a. */
static double beside_wall(const double at[2])
{
    const double a = at[0] + 1;

    return a <= 0 ? -1 : a >= reach ? 0 : pow(1 - sqrt(a / reach), 2);
}

/* The same integral beside the ball, as a sum. -1: the ball hides the floor. */
static double beside_ball(const double at[2])
{
    enum { PLACES = 1000 };
    const double aside = hypot(at[0] - ball_x, at[1]);
    double sum = 0;

    if (aside < ball_radius + 0.02) {
        return -1;
    }
    for (int i = 0; i < PLACES; i++) {
        const double t = reach * pow((i + 0.5) / PLACES, 2);
        const double d = fmin(t, hypot(aside, t - ball_radius) - ball_radius);
        sum += fmax(0, 1 - d / t) / PLACES;
    }
    return sum;
}

struct found {
    double mean, exact, worst; /* of the darkening; the worst difference of one pixel */
};

static struct found compare(const struct image *image, double (*exact)(const double at[2]))
{
    struct found found = {0};
    int count = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double at[2];
        place_of(i, at);
        const double want = exact(at);
        if (want >= 0 && at[0] < reach - 1) {
            const double got = dark_at(image, i);
            found.mean += got;
            found.exact += want;
            found.worst = fmax(found.worst, fabs(got - want));
            count++;
        }
    }
    assert_true(count > WIDTH * HEIGHT / 5);
    found.mean /= count;
    found.exact /= count;
    return found;
}

static const struct {
    const char *children;
    double (*exact)(const double at[2]);
} scenes[] = {{wall, beside_wall}, {ball, beside_ball}};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static void any_number_of_samples_darkens_alike(void **state)
{
    static const int samples[] = {1, 3, 5, 8, 16};

    (void)state;
    for (int s = 0; s < SCENES; s++) {
        for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
            struct image image = draw_samples(scenes[s].children, samples[i]);
            const struct found found = compare(&image, scenes[s].exact);
            print_message("scene %d, %2d samples: mean %.4f of %.4f, off by %.4f at most\n", s,
                          samples[i], found.mean, found.exact, found.worst);
            const double room = samples[i] < 3 ? 0.25 : samples[i] < 5 ? 0.05 : 0.02;
            if (fabs(found.mean - found.exact) > room * found.exact) {
                fail_msg("mean darkening %g by %d samples, expected %g", found.mean, samples[i],
                         found.exact);
            }
            assert_true(found.worst < 0.8 / (samples[i] * samples[i]));
            image_finish(&image);
        }
    }
}

static void levels_darken_alike(void **state)
{
    (void)state;
    for (int s = 0; s < SCENES; s++) {
        double first = 0;
        for (int level = 0; level < QUALITY_COUNT; level++) {
            char render[160];
            snprintf(render, sizeof render, "%s,'level':'%s'", own_reach, quality_names[level]);
            struct image image = draw(scenes[s].children, render);
            const double mean = compare(&image, scenes[s].exact).mean;
            first = level == 0 ? mean : first;
            if (fabs(mean - first) > 0.05 * first) {
                fail_msg("%s darkens by %g, %s by %g", quality_names[level], mean, quality_names[0],
                         first);
            }
            image_finish(&image);
        }
    }
}

/* 0.06 of the five from the camera to its target is a reach of 0.3. */
static void the_reach_follows_the_camera(void **state)
{
    (void)state;
    struct image own = draw(wall, "'occlusion_reach':0.3"), follows = draw(wall, "");
    struct image farther = draw(wall, "'occlusion_reach':0.6");

    assert_true(drawing_is_same(&own, &follows));
    assert_false(drawing_is_same(&own, &farther));
    image_finish(&own);
    image_finish(&follows);
    image_finish(&farther);
}

static void the_strength_scales_what_is_kept_off(void **state)
{
    (void)state;
    struct image whole = draw(wall, own_reach);
    struct image half = draw(wall, "'occlusion_strength':0.5,'occlusion_reach':1");
    struct image none = draw(wall, "'occlusion_strength':0,'occlusion_reach':1");
    struct image most = draw(wall, "'occlusion_strength':4,'occlusion_reach':1");
    int black = 0;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        assert_true(fabs(dark_at(&half, i) - 0.5 * dark_at(&whole, i)) < 1e-3);
        assert_true(dark_at(&none, i) == 0);
        assert_true(dark_at(&most, i) <= 1);
        black += dark_at(&most, i) == 1;
    }
    assert_true(black > 100);
    image_finish(&whole);
    image_finish(&half);
    image_finish(&none);
    image_finish(&most);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_samples_darkens_alike),
        cmocka_unit_test(levels_darken_alike),
        cmocka_unit_test(the_reach_follows_the_camera),
        cmocka_unit_test(the_strength_scales_what_is_kept_off),
    };

    return cmocka_run_group_tests_name("occlusion", tests, start, end);
}
