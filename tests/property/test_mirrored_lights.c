/* SPDX-License-Identifier: MIT */
/* Small lights in a picture of the environment, as mirrors and glass show them: a picture of one
 * sample for each pixel is near the mean of 64, where rays without width would show bright dots. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

/* Pixels of a side; samples of each along a side; texels of the environment. */
enum { SIDE = 48, FINE = 8, COLUMNS = 1024, ROWS = 512, LIGHT_EVERY = 16 };

#define IMAGE_ID "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"

static const char scene_text[] =
    "{'format':'fieldcast/1','camera':{'position':[0,0,2],'fov':60},'lights':[],"
    "'environment':{'type':'image','image':'" IMAGE_ID "'},"
    "'render':{'antialiasing':'none','occlusion':false,'tone_map':'none',"
    "'max_distance':100,'ray_depth':%d},"
    "'materials':{'m':{'shader':'standard','properties':{%s}}},"
    "'root':{'id':'root','type':'union','material':'m','children':["
    "{'type':'sphere','params':{'radius':%g},'transform':{'translation':[%g,0,%g]}},"
    "{'type':'box','params':{'size':[%g,%g,1]},'transform':{'translation':[%g,0,-0.5]}}"
    "]}}";

#define MIRROR "'metallic':1,'roughness':0"
#define DULL "'metallic':1,'roughness':0.1"
#define GLASS "'transmission':1,'roughness':0,'ior':1.5"

/* A ball and a box, at places along x; which part of the error of narrow rays may stay. */
static const struct looked {
    const char *name, *material;
    int depth;
    double radius, ball_x, ball_z, side, box_x, part;
} cases[] = {
    {"flat mirror", MIRROR, 2, 0.1, 9, 0, 4, 0, 0.5},
    {"hardly curved mirror", MIRROR, 2, 20, 0, -20, 0.1, 50, 0.2},
    {"ball", MIRROR, 2, 0.8, 0, 0, 0.1, 9, 0.03},
    {"ball without rays", MIRROR, 0, 0.8, 0, 0, 0.1, 9, 0.03},
    {"ball that is not quite smooth", DULL, 2, 0.8, 0, 0, 0.1, 9, 0.05},
    {"small ball", MIRROR, 2, 0.2, 0, 0, 0.1, 9, 0.05},
    {"ball beside a box", MIRROR, 4, 0.5, -0.5, 0, 0.8, 0.5, 0.2},
    {"glass ball", GLASS, 4, 0.8, 0, 0, 0.1, 9, 0.15},
};
enum { CASES = sizeof cases / sizeof cases[0] };

static struct renderer *renderer;

/* A Radiance file in flat rows: dark, with texels of light far apart. */
static void give_lights(void)
{
    static unsigned char bytes[128 + 4 * COLUMNS * ROWS];
    size_t length = (size_t)sprintf(
        (char *)bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", ROWS, COLUMNS);

    for (int i = 0; i < COLUMNS * ROWS; i++) {
        const int x = i % COLUMNS, y = i / COLUMNS;
        const bool light = x % LIGHT_EVERY < 2 && y % LIGHT_EVERY < 2;

        memset(bytes + length, 128, 3);
        bytes[length + 3] = light ? 128 + 6 : 128 - 3;
        length += 4;
    }
    renderer_asset(renderer, IMAGE_ID, bytes, length);
}

static struct image draw(const struct looked *look, int side)
{
    char text[2048];
    struct job_desc desc = drawing_desc(side, side);
    struct resident *resident;
    struct image image;

    snprintf(text, sizeof text, scene_text, look->depth, look->material, look->radius, look->ball_x,
             look->ball_z, look->side, look->side, look->box_x);
    desc.as_floats = true;
    desc.transparent = 1;
    resident = resident_create(renderer, drawing_parse(text), 1);
    image = drawing_of(resident, &desc, AOV_COLOR);
    resident_destroy(resident);
    return image;
}

static float green(const struct image *image, int x, int y)
{
    return ((const float *)image->pixels)[(y * image->width + x) * image->channels + 1];
}

/* The mean over a pixel of a picture with FINE times as many along each side; below 0 where not all
 * of the pixel is covered. */
static double mean_green(const struct image *fine, int x, int y)
{
    double sum = 0;

    for (int i = 0; i < FINE * FINE; i++) {
        const int place = (y * FINE + i / FINE) * fine->width + x * FINE + i % FINE;
        const float *pixel = (const float *)fine->pixels + place * fine->channels;

        if (pixel[3] < 1) {
            return -1;
        }
        sum += (double)pixel[1];
    }
    return sum / (FINE * FINE);
}

static double square(double x)
{
    return x * x;
}

/* What one sample is off by, against what one of the fine picture is, with its narrow rays. */
static void one_sample_is_near_the_mean(void **state)
{
    (void)state;
    for (const struct looked *look = cases; look < cases + CASES; look++) {
        struct image one = draw(look, SIDE), fine = draw(look, SIDE * FINE);
        double off = 0, narrow_off = 0;
        int pixels = 0;

        for (int i = 0; i < SIDE * SIDE; i++) {
            const int x = i % SIDE, y = i / SIDE;
            const double mean = mean_green(&fine, x, y);

            if (mean < 0) {
                continue;
            }
            pixels++;
            off += square((double)green(&one, x, y) - mean);
            narrow_off += square((double)green(&fine, x * FINE + 4, y * FINE + 4) - mean);
        }
        assert_true(pixels > 30);
        if (!(off < look->part * narrow_off)) {
            fail_msg("%s: %.3f of the variance, not below %.3f", look->name, off / narrow_off,
                     look->part);
        }
        image_finish(&one);
        image_finish(&fine);
    }
}

static int set_up(void **state)
{
    (void)state;
    renderer = drawing_renderer(0);
    give_lights();
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_sample_is_near_the_mean)};

    return cmocka_run_group_tests(tests, set_up, tear_down);
}
