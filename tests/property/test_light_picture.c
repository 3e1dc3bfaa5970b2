/* SPDX-License-Identifier: MIT */
/* Shadows where geometry says, no occlusion where nothing is, and white balls that cannot be seen
 * in white surroundings: in whole pictures. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/support/compiled.h"
#include "tests/support/drawing.h"

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

static struct image draw(const char *text, int width, int height, enum aov aov)
{
    struct resident *resident = resident_create(renderer, drawing_parse(text), 1);
    struct job_desc desc = drawing_desc(width, height);

    desc.samples = 1;
    desc.as_floats = true;
    struct image image = drawing_of(resident, &desc, aov);
    resident_destroy(resident);
    return image;
}

static double value(const struct image *image, int x, int y, int channel)
{
    return ((const float *)image->pixels)[(y * image->width + x) * image->channels + channel];
}

/* --- a ball over the ground, seen from straight above --- */

enum { SIDE = 150 };

static const double view_height = 6, ball_radius = 0.7, ball_height = 1.1, sharpness = 6;
static const double towards[3] = {0.6, 0.7, 0.3872983346}; /* the light */

#define SPHERE "'type': 'sphere', 'params': {'radius': 0.7}"
/* Its bound is a third of the distance far from it, as for any sixth power. */
#define SEXTIC                                                                                     \
    "'type': 'implicit', 'params': {'equation': '(x^2 + y^2 + z^2)^3 = 0.7^6', 'size': [2, 2, 2]}"

static struct image draw_ball(const char *shadow, const char *ball)
{
    char *text;

    assert_true(asprintf(&text,
                         "{'format': 'fieldcast/1', 'camera': {'type': 'orthographic',"
                         " 'position': [0, 9, 0], 'target': [0, 0, 0], 'up': [0, 0, -1],"
                         " 'height': %g}, 'lights': [{'type': 'directional',"
                         " 'direction': [%.10g, %.10g, %.10g], 'shadow': '%s',"
                         " 'size': %g}], 'render': {'level': 'final'},"
                         " 'root': {'type': 'union', 'children': [{'type': 'plane'},"
                         " {%s, 'transform': {'translation': [0, %g, 0]}}]}}",
                         view_height, -towards[0], -towards[1], -towards[2], shadow, sharpness,
                         ball, ball_height) > 0);
    struct image image = draw(text, SIDE, SIDE, AOV_SHADOW);
    free(text);
    return image;
}

/* Where on the ground a pixel's middle is, or false where the ball hides it. */
static bool ground_at(int x, int y, double out[3])
{
    const double pixel = view_height / SIDE;

    out[0] = (x + 0.5 - 0.5 * SIDE) * pixel;
    out[1] = 0;
    out[2] = (y + 0.5 - 0.5 * SIDE) * pixel;
    return hypot(out[0], out[2]) > ball_radius + pixel;
}

/* To the ball from a place on the way to the light. */
static double ball_distance(const double from[3], double way)
{
    const double x = from[0] + way * towards[0], z = from[2] + way * towards[2];
    const double y = from[1] + way * towards[1] - ball_height;

    return sqrt(x * x + y * y + z * z) - ball_radius;
}

/* Where the way passes the ball's middle. */
static double nearest_way(const double from[3])
{
    return (ball_height - from[1]) * towards[1] - from[0] * towards[0] - from[2] * towards[2];
}

static void hard_shadow_ends_where_it_should(void **state)
{
    struct image image = draw_ball("hard", SPHERE);
    int dark = 0, bright = 0;

    (void)state;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double at[3];
        if (!ground_at(i % SIDE, i / SIDE, at)) {
            continue;
        }
        /* Negative within the shadow, by how far it is from its edge. */
        const double way = nearest_way(at), off = way > 0 ? ball_distance(at, way) : 1;
        const double got = value(&image, i % SIDE, i / SIDE, 0);
        if (got != 0 && got != 1) {
            fail_msg("grey in a hard shadow: %g at %g %g", got, at[0], at[2]);
        }
        if (fabs(off) > view_height / SIDE && got != (off > 0)) {
            fail_msg("%g at %g %g, %g from the edge", got, at[0], at[2], off);
        }
        dark += off < 0;
        bright += off > 0;
    }
    image_finish(&image);
    assert_true(dark > 500 && bright > 5000);
}

/* What glsl/shadow.glsl says a soft shadow is, by brute force; its rays begin three quarters of a
 * pixel above the ground. */
static double soft_shadow(const double ground_place[3])
{
    const double from[3] = {ground_place[0], 0.75 * view_height / SIDE, ground_place[2]};
    double least = 1;

    for (double way = 0.01; way < 12; way *= 1.002) {
        const double ground = towards[1], ball = ball_distance(from, way) / way;
        least = fmin(least, sharpness * fmin(ground, ball));
    }
    least = fmax(least, 0);
    return least * least * (3 - 2 * least);
}

static void check_soft_shadow(const char *ball, double room)
{
    struct image image = draw_ball("soft", ball);
    double most = 0;
    int half = 0;

    for (int i = 0; i < SIDE * SIDE; i++) {
        double at[3];
        if (!ground_at(i % SIDE, i / SIDE, at)) {
            continue;
        }
        const double want = soft_shadow(at), got = value(&image, i % SIDE, i / SIDE, 0);
        if (!(fabs(got - want) <= room)) {
            fail_msg("%g instead of %g at %g %g", got, want, at[0], at[2]);
        }
        most = fmax(most, fabs(got - want));
        half += want > 0.1 && want < 0.9;
    }
    image_finish(&image);
    assert_true(half > 300);
    print_message("soft shadow: off by %.4f at most\n", most);
}

static void soft_shadow_has_no_rings(void **state)
{
    (void)state;
    check_soft_shadow(SPHERE, 0.01);
}

/* The distance of a surface by an equation is but a bound: by it the shadow would be far wider. */
static void soft_shadows_of_equations_are_no_wider(void **state)
{
    (void)state;
    check_soft_shadow(SEXTIC, 0.1);
}

/* --- fields that are no distances --- */

/* A bowl cut out of an egg, things grown together, a bump that is only a bound. */
static const char still_life[] =
    "{'format': 'fieldcast/1', 'camera': {'type': 'orthographic', 'height': 3,"
    " 'position': [1, 5, 4], 'target': [0, 0.3, 0]}, 'lights': [{'type':"
    " 'directional', 'direction': [-0.6, -0.64, 0.48], 'size': 7}],"
    " 'render': {'level': 'final'},"
    " 'root': {'type': 'union', 'children': [{'type': 'plane'},"
    " {'type': 'difference', 'transform': {'translation': [-0.8, 0.25, 0.3]},"
    " 'children': [{'type': 'ellipsoid', 'params': {'radii': [0.7, 0.25, 0.5]}},"
    " {'type': 'ellipsoid', 'params': {'radii': [0.6, 0.3, 0.4]},"
    " 'transform': {'translation': [0, 0.2, 0]}}]},"
    " {'type': 'smooth_union', 'params': {'k': 0.3}, 'children': ["
    "{'type': 'box', 'params': {'size': [0.5, 0.5, 0.5]},"
    " 'transform': {'translation': [0.6, 0.25, 0]}}, {'type': 'torus',"
    " 'transform': {'translation': [0.7, 0.3, 0.5]}}]},"
    " {'type': 'displace', 'params': {'amplitude': 0.03, 'frequency': [12, 12, 12]},"
    " 'transform': {'translation': [0.1, 0.4, -0.7]}, 'children': ["
    "{'type': 'sphere', 'params': {'radius': 0.4}}]}]}}";

/* The same as soft_shadow, of any field. */
static double field_shadow(const struct field *field, const double from[3])
{
    static const double light[3] = {0.6, 0.64, -0.48};
    double least = 1;

    for (double way = 0.02; way < 6 && least > 0; way *= 1.004) {
        double p[3];
        for (int i = 0; i < 3; i++) {
            p[i] = from[i] + way * light[i];
        }
        least = fmin(least, 7 * field_distance(field, p) / way);
    }
    least = fmax(least, 0);
    return least * least * (3 - 2 * least);
}

static void soft_shadows_of_any_field_have_no_rings(void **state)
{
    enum { WIDTH = 120, HEIGHT = 90, STEP = 3 };
    struct image places = draw(still_life, WIDTH, HEIGHT, AOV_POSITION);
    struct image normals = draw(still_life, WIDTH, HEIGHT, AOV_NORMAL);
    struct image image = draw(still_life, WIDTH, HEIGHT, AOV_SHADOW);
    struct scene *scene = drawing_parse(still_life);
    struct field *field = compile_field(scene);
    int lit = 0, off = 0;

    (void)state;
    for (int i = 0; i < WIDTH * HEIGHT; i += STEP) {
        const int x = i % WIDTH, y = i / WIDTH;
        const double normal[3] = {value(&normals, x, y, 0), value(&normals, x, y, 1),
                                  value(&normals, x, y, 2)};
        double from[3];
        for (int j = 0; j < 3; j++) {
            from[j] = value(&places, x, y, j) + 0.75 * 3 / HEIGHT * normal[j];
        }
        if (0.6 * normal[0] + 0.64 * normal[1] - 0.48 * normal[2] > 0.1) {
            const double error = fabs(value(&image, x, y, 0) - field_shadow(field, from));
            lit++;
            off += error > 0.03;
        }
    }
    image_finish(&image);
    image_finish(&normals);
    image_finish(&places);
    field_unref(field);
    scene_destroy(scene);
    print_message("soft shadows: %d of %d off by more than 0.03\n", off, lit);
    assert_true(lit > 6000 / STEP && off * 200 <= lit);
}

/* --- the environment --- */

static void open_ground_is_not_occluded(void **state)
{
    struct image image = draw("{'format': 'fieldcast/1', 'camera': {'position': [0, 1, 5]},"
                              " 'root': {'type': 'plane', 'params': {'normal': [0.2, 1, 0.1]}}}",
                              80, 60, AOV_OCCLUSION);
    int ground = 0;

    (void)state;
    for (int i = 0; i < 80 * 60; i++) {
        const double open = value(&image, i % 80, i / 80, 0);
        ground += i / 80 > 40;
        if (i / 80 > 40 && !(fabs(open - 1) < 2e-3)) {
            fail_msg("occlusion %g of open ground", open);
        }
    }
    image_finish(&image);
    assert_true(ground > 1000);
}

/* Balls of standard material from smooth to rough, metal above, in an environment of 1 that also
 * is the background: nothing is to be seen. */
static void white_furnace_hides_white_balls(void **state)
{
    enum { BALLS = 5, WIDTH = 250, HEIGHT = 100 };
    char *text;
    size_t length;
    FILE *out = open_memstream(&text, &length);

    (void)state;
    assert_non_null(out);
    fprintf(out, "{'format': 'fieldcast/1', 'camera': {'type': 'orthographic', 'height':"
                 " 4, 'position': [4, 1, 9], 'target': [4, 1, 0]}, 'environment': {'type':"
                 " 'solid', 'color': [1, 1, 1]}, 'materials': {");
    for (int i = 0; i < 2 * BALLS; i++) {
        fprintf(out,
                "%s'm%d': {'shader': 'standard', 'properties': {'base_color': [1, 1, 1],"
                " 'metallic': %d, 'roughness': %g}}",
                i ? "," : "", i, i / BALLS, 0.2 + 0.2 * (i % BALLS));
    }
    fprintf(out, "}, 'root': {'type': 'union', 'children': [");
    for (int i = 0; i < 2 * BALLS; i++) {
        fprintf(out,
                "%s{'type': 'sphere', 'params': {'radius': 0.5}, 'material': 'm%d',"
                " 'transform': {'translation': [%d, %d, 0]}}",
                i ? "," : "", i, 2 * (i % BALLS), 2 * (i / BALLS));
    }
    fprintf(out, "]}}");
    assert_int_equal(fclose(out), 0);
    struct image image = draw(text, WIDTH, HEIGHT, AOV_COLOR);
    int balls = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double x = (i % WIDTH + 0.5) * 4 / HEIGHT - 1, y = 3 - (i / WIDTH + 0.5) * 4 / HEIGHT;
        const double off = hypot(remainder(x, 2), remainder(y, 2)) - 0.5;
        const double got = value(&image, i % WIDTH, i / WIDTH, 1);
        balls += off < 0;
        /* But for the very rim, whose normals stand across the ray. */
        if (fabs(off) > 4.0 / HEIGHT && !(fabs(got - 1) <= 0.02)) {
            fail_msg("%g at %g %g", got, x, y);
        }
    }
    image_finish(&image);
    free(text);
    assert_true(balls > 4000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hard_shadow_ends_where_it_should),
        cmocka_unit_test(soft_shadow_has_no_rings),
        cmocka_unit_test(soft_shadows_of_equations_are_no_wider),
        cmocka_unit_test(soft_shadows_of_any_field_have_no_rings),
        cmocka_unit_test(open_ground_is_not_occluded),
        cmocka_unit_test(white_furnace_hides_white_balls),
    };

    return cmocka_run_group_tests(tests, start, end);
}
