/* SPDX-License-Identifier: MIT */
/* A floor reaches as far beside a shape as it does far from it, although rays that pass a shape
 * closely have used most of their steps there. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

enum { WIDTH = 512, HEIGHT = 384 };

/* The eye is as high as the ball, which hides the middle of the horizon. */
static const char scene_text[] =
    "{'format': 'fieldcast/1', 'camera': {'position': [0, 1, 5], 'target': [0, 0.7, 0], 'fov': 30},"
    " 'render': {'level': 'draft', 'max_distance': 200},"
    " 'root': {'id': 'root', 'type': 'union', 'children': [{'id': 'floor', 'type': 'plane'},"
    "  {'id': 'ball', 'type': 'sphere', 'params': {'radius': 0.6},"
    "   'transform': {'translation': [0, 0.7, 0]}}]}}";

/* How far the floor is in a row of pixels below the eye's height. */
static double floor_distance(int y)
{
    const double half = tan(15 * M_PI / 180), tilt = atan2(0.3, 5);
    const double slope = (2 * (y + 0.5) / HEIGHT - 1) * half;

    return 1 / sin(atan(slope) + tilt);
}

static struct image draw_depth(void)
{
    struct renderer *renderer = drawing_renderer(0);
    struct resident *resident = resident_create(renderer, drawing_parse(scene_text), 1);
    struct job_desc desc = drawing_desc(WIDTH, HEIGHT);

    desc.as_floats = true;
    struct image depth = drawing_of(resident, &desc, AOV_DEPTH);
    resident_destroy(resident);
    renderer_destroy(renderer);
    return depth;
}

static void a_floor_ends_in_a_line(void **state)
{
    struct image depth = draw_depth();
    int rows = 0;

    (void)state;
    for (int y = 0; y < HEIGHT; y++) {
        const float *row = (const float *)depth.pixels + (size_t)y * WIDTH;
        const double expected = floor_distance(y);

        if (expected < 5 || expected > 150) {
            continue; /* above the horizon, before the ball, at the end of rays */
        }
        rows++;
        for (int x = 0; x < WIDTH; x++) {
            if (!isfinite(row[x]) || row[x] <= 0) {
                fail_msg("the floor ends at pixel %d, %d, %g away", x, y, expected);
            }
        }
    }
    assert_true(rows > 10);
    image_finish(&depth);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_floor_ends_in_a_line),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
