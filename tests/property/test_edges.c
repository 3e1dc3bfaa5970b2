/* SPDX-License-Identifier: MIT */
/* The edge of a ball lies on its circle to a tenth of a pixel, in every output that shows it, at
 * every size, with both kinds of cameras, by the engine and by compute shaders, and by fragment
 * shaders at the smaller sizes: the middle of a pixel is covered where it is inside of the
 * circle. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/drawing.h"

#define RADIUS 0.8
#define AWAY 3.0
#define FOV 40.0   /* degrees, across the height */
#define HEIGHT 2.1 /* of the orthographic picture */
#define ROOM 0.1   /* pixels */

static struct renderer *renderer;

static const struct {
    const char *name, *camera;
    double radius; /* of the circle, in halves of the picture's height */
} views[] = {
    {"perspective", "'fov': 40", 0},
    {"orthographic", "'type': 'orthographic', 'height': 2.1", 2 * RADIUS / HEIGHT},
};
static const int sizes[][2] = {{20, 15}, {131, 97}, {800, 600}};
#define SIZES (sizeof sizes / sizeof sizes[0])
static const enum aov outputs[] = {AOV_COLOR, AOV_DEPTH,    AOV_NORMAL,
                                   AOV_ID,    AOV_POSITION, AOV_ALBEDO};

static double circle_of(size_t view)
{
    const double tangent = RADIUS / sqrt(AWAY * AWAY - RADIUS * RADIUS);

    return views[view].radius > 0 ? views[view].radius : tangent / tan(FOV / 2 * M_PI / 180);
}

static struct resident *open_ball(const char *camera)
{
    char text[400];

    snprintf(text, sizeof text,
             "{'format': 'fieldcast/1', 'camera': {'position': [0, 0, 3], 'target': [0, 0, 0], %s},"
             " 'root': {'id': 'ball', 'type': 'sphere', 'params': {'radius': 0.8}}}",
             camera);
    return resident_create(renderer, drawing_parse(text), 1);
}

/* The last channel of colors is their cover; all channels of other outputs are 0 beside shapes, or
 * infinite. */
static bool is_covered(const struct image *image, enum aov aov, int x, int y)
{
    const size_t pixel = (size_t)y * (size_t)image->width + (size_t)x;
    const size_t size = image->bytes / (size_t)(image->width * image->height);
    const uint8_t *bytes = (const uint8_t *)image->pixels + pixel * size;

    if (aov == AOV_DEPTH) {
        const float depth = ((const float *)image->pixels)[pixel];
        return isfinite(depth) && depth > 0;
    }
    for (size_t i = aov == AOV_COLOR ? size - 1 : 0; i < size; i++) {
        if (bytes[i] != 0) {
            return true;
        }
    }
    return false;
}

/* The greatest distance from the circle, in pixels, of a pixel on its wrong side. `shift` moves the
 * circle. */
static double worst_pixel(struct resident *resident, const int size[2], enum aov aov, double radius,
                          double shift)
{
    struct job_desc desc = drawing_desc(size[0], size[1]);

    desc.samples = 1;
    desc.transparent = 1;
    desc.as_floats = aov != AOV_COLOR;
    struct image image = drawing_of(resident, &desc, aov);
    double worst = 0;
    int covered = 0;
    for (int y = 0; y < size[1]; y++) {
        for (int x = 0; x < size[0]; x++) {
            const double inside = radius * size[1] / 2 + shift -
                                  hypot(x + 0.5 - size[0] / 2.0, y + 0.5 - size[1] / 2.0);
            const bool is = is_covered(&image, aov, x, y);
            covered += is;
            if (is != (inside > 0)) {
                worst = fmax(worst, fabs(inside));
            }
        }
    }
    image_finish(&image);
    assert_true(covered > size[0] * size[1] / 10);
    return worst;
}

static void judge_view(size_t view, size_t size_count, double shift, double *out_worst)
{
    struct resident *resident = open_ball(views[view].camera);

    for (size_t s = 0; s < size_count; s++) {
        for (size_t o = 0; o < sizeof outputs / sizeof outputs[0]; o++) {
            const double worst =
                worst_pixel(resident, sizes[s], outputs[o], circle_of(view), shift);
            *out_worst = fmax(*out_worst, worst);
            if (shift == 0 && worst > ROOM) {
                fail_msg("%s, %d x %d, %s: off by %.3f pixels", views[view].name, sizes[s][0],
                         sizes[s][1], aov_name(outputs[o]), worst);
            }
        }
    }
    resident_destroy(resident);
}

/* At the first of the sizes. */
static void judge(enum render_stage stage, size_t size_count, double shift, double *out_worst)
{
    *out_worst = 0;
    renderer_use_stage(renderer, stage);
    for (size_t view = 0; view < sizeof views / sizeof views[0]; view++) {
        judge_view(view, size_count, shift, out_worst);
    }
}

static void the_engine_draws_the_circle(void **state)
{
    double worst;
    (void)state;

    judge(RENDER_ENGINE, SIZES, 0, &worst);
    print_message("# off by %.4f pixels at most\n", worst);
}

static void compute_shaders_draw_the_circle(void **state)
{
    double worst;
    (void)state;

    judge(RENDER_COMPUTE, SIZES, 0, &worst);
    print_message("# off by %.4f pixels at most\n", worst);
}

static void fragment_shaders_draw_the_circle(void **state)
{
    double worst;
    (void)state;

    judge(RENDER_FRAGMENT, SIZES - 1, 0, &worst);
    print_message("# off by %.4f pixels at most\n", worst);
}

static void another_circle_is_noticed(void **state)
{
    double worst;
    (void)state;

    judge(RENDER_ENGINE, SIZES - 1, 0.15, &worst);
    assert_true(worst > ROOM);
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
        cmocka_unit_test(the_engine_draws_the_circle),
        cmocka_unit_test(compute_shaders_draw_the_circle),
        cmocka_unit_test(fragment_shaders_draw_the_circle),
        cmocka_unit_test(another_circle_is_noticed),
    };

    return cmocka_run_group_tests(tests, start, stop);
}
