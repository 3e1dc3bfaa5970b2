/* SPDX-License-Identifier: MIT */
/* The search for the nearest patch: it never tells more than the distance to any point of a patch,
 * also where patches lie in each other, where they are strongly bent, and where it has to stop
 * early. Near the patches it tells no less either. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "renderer/sdf/patches.h"
#include "tests/support/random_scene.h"

enum { LEVELS = PATCHES_LEVELS_MIN, ACROSS = 97, ASKED = 400, PATCHES = 256 };
#define THICKNESS 0.04

static void sphere(double s, double t, double out[3])
{
    out[0] = sin(M_PI * s) * cos(2 * M_PI * t);
    out[1] = cos(M_PI * s);
    out[2] = sin(M_PI * s) * sin(2 * M_PI * t);
}

/* Each patch along s lies in all others. */
static void wrapped(double s, double t, double out[3])
{
    out[0] = cos(2 * M_PI * t);
    out[1] = 0.1 * sin(100 * M_PI * s);
    out[2] = sin(2 * M_PI * t);
}

static void needle(double s, double t, double out[3])
{
    out[0] = 2 * s - 1;
    out[1] = 0.002 * t;
    out[2] = 0;
}

static void wound(double s, double t, double out[3])
{
    const double r = 0.3 + 0.2 * s;

    out[0] = r * cos(40 * t);
    out[1] = 0.2 * s + 0.1 * sin(7 * t);
    out[2] = r * sin(40 * t);
}

static void crumpled(double s, double t, double out[3])
{
    out[0] = 2 * s - 1 + 0.1 * sin(19 * t + 3 * s);
    out[1] = 0.2 * sin(17 * s) * cos(23 * t);
    out[2] = 2 * t - 1 + 0.1 * cos(21 * s - t);
}

/* At s = 0 all along t is one point. */
static void cone(double s, double t, double out[3])
{
    out[0] = s * cos(2 * M_PI * t);
    out[1] = s;
    out[2] = s * sin(2 * M_PI * t);
}

typedef void surface(double s, double t, double out[3]);

static double *numbers_of(surface *at)
{
    const int across = patches_points(LEVELS);
    double *points = calloc((size_t)(3 * across * across), sizeof *points);
    double *numbers = calloc(4 * patches_rows(LEVELS), sizeof *numbers);

    assert_non_null(points);
    assert_non_null(numbers);
    for (int i = 0; i < across * across; i++) {
        at((double)(i / across) / (across - 1), (double)(i % across) / (across - 1),
           points + (size_t)(3 * i));
    }
    patches_write(LEVELS, THICKNESS, points, numbers);
    free(points);
    return numbers;
}

static double way(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

enum { STEPS = 12, POINTS = PATCHES * (STEPS + 1) * (STEPS + 1) };

/* Of all patches; freed by the caller. */
static double (*points_of(const double *numbers))[3]
{
    double(*points)[3] = calloc(POINTS, sizeof *points);

    assert_non_null(points);
    for (int i = 0; i < POINTS; i++) {
        const int at = i / PATCHES;
        patches_point(numbers, i % PATCHES, (double)(at % (STEPS + 1)) / STEPS,
                      (double)(at / (STEPS + 1)) / STEPS, points[i]);
    }
    return points;
}

/* The distance to the nearest point. */
static double nearest(double (*points)[3], const double p[3])
{
    double best = INFINITY;

    for (int i = 0; i < POINTS; i++) {
        const double x = points[i][0] - p[0], y = points[i][1] - p[1], z = points[i][2] - p[2];
        const double square = x * x + y * y + z * z;
        best = square < best ? square : best;
    }
    return sqrt(best);
}

static void beside(struct random *random, const double *numbers, double far, double out[3])
{
    patches_point(numbers, (int)random_between(random, 0, PATCHES - 0.01),
                  random_between(random, 0, 1), random_between(random, 0, 1), out);
    for (int k = 0; k < 3; k++) {
        out[k] += random_between(random, -far, far);
    }
}

static const struct {
    surface *at;
    double missed; /* by points near the surface, at most; INFINITY: it stops early there */
} rows[] = {{sphere, 0.012},   {wrapped, INFINITY}, {needle, INFINITY},
            {wound, INFINITY}, {crumpled, 0.012},   {cone, 0.012}};

static void distances_are_at_most_those_to_points(void **state)
{
    struct random random = {.state = 3};
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double *numbers = numbers_of(rows[i].at);
        double(*points)[3] = points_of(numbers);
        for (int n = 0; n < ASKED; n++) {
            double p[3];
            beside(&random, numbers, n % 2 ? 0.05 : 0.5, p);
            const double most = nearest(points, p) - THICKNESS / 2;
            const double got = patches_distance(p, numbers);
            if (!(got <= most + 1e-6) || (n % 2 && got < most - rows[i].missed)) {
                fail_msg("row %zu: at (%g, %g, %g): %g instead of %g", i, p[0], p[1], p[2], got,
                         most);
            }
        }
        free(points);
        free(numbers);
    }
}

/* Near the patches as fast as the way; elsewhere as patches_loose() says. */
static void distances_change_no_faster_than_the_way(void **state)
{
    struct random random = {.state = 4};
    (void)state;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double *numbers = numbers_of(rows[i].at);
        const double side = numbers[3], loose = patches_loose(numbers);
        for (int n = 0; n < 20 * ASKED; n++) {
            double p[3], q[3];
            beside(&random, numbers, n % 2 ? 0.4 * side : 3 * side, p);
            for (int k = 0; k < 3; k++) {
                q[k] = p[k] + random_between(&random, -1, 1) * (n % 4 < 2 ? 1e-3 : 0.5) * side;
            }
            const double a = patches_distance(p, numbers), b = patches_distance(q, numbers);
            const bool near = fmax(a, b) + THICKNESS / 2 < 0.6 * side && isfinite(rows[i].missed);
            if (!(fabs(a - b) <= (1 + 1e-3) * way(p, q) + (near ? 1e-6 * side : loose))) {
                fail_msg("row %zu: from (%g, %g, %g) on %g: %g, %g", i, p[0], p[1], p[2], way(p, q),
                         a, b);
            }
        }
        free(numbers);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_at_most_those_to_points),
        cmocka_unit_test(distances_change_no_faster_than_the_way),
    };

    return cmocka_run_group_tests_name("patches", tests, NULL, NULL);
}
