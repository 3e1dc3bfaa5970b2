/* SPDX-License-Identifier: MIT */
/* Value noise: its numbers, how far it goes and how steep it is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "renderer/sdf/noise.h"
#include "tests/support/random_scene.h"

static void random_point(struct random *random, double size, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = random_between(random, -size, size);
    }
}

static void noise_keeps_its_bounds(void **state)
{
    (void)state;
    struct random random = {48};
    double steepest = 0, greatest = 0, sum = 0;

    for (int k = 0; k < 200000; k++) {
        double p[3], q[3], direction[3];
        random_point(&random, 30, p);
        random_direction(&random, direction);
        for (int i = 0; i < 3; i++) {
            q[i] = p[i] + 1e-4 * direction[i];
        }
        const double value = noise_value(p, 7);
        steepest = fmax(steepest, fabs(noise_value(q, 7) - value) / 1e-4);
        greatest = fmax(greatest, fabs(value));
        sum += value;
        const double all = noise_octaves(p, 5, 7),
                     slope = fabs(noise_octaves(q, 5, 7) - all) / 1e-4;
        assert_true(fabs(all) <= noise_greatest(5) && slope <= noise_slope(5));
    }
    assert_true(steepest <= noise_slope(1) && steepest > 0.7 * noise_slope(1));
    assert_true(greatest <= noise_greatest(1) && greatest > 0.9);
    assert_true(fabs(sum / 200000) < 0.02);
    assert_true(noise_greatest(1) == 1 && noise_greatest(3) == 1.75);
}

static void noise_is_what_its_whole_points_say(void **state)
{
    (void)state;
    struct random random = {49};
    int same = 0;

    for (int k = 0; k < 1000; k++) {
        uint32_t at[3], seed = (uint32_t)random_below(&random, 1000000);
        double p[3], far[3];
        for (int i = 0; i < 3; i++) {
            at[i] = (uint32_t)random_below(&random, 65536);
            p[i] = at[i];
            far[i] = p[i] + random_between(&random, 0, 1) - 3 * 65536.0;
        }
        const double number = noise_lattice(at[0], at[1], at[2], seed);
        assert_true(noise_value(p, seed) == number && number == (float)number);
        same += number == noise_lattice(at[0], at[1], at[2], seed + 1);
        const double near[3] = {far[0] + 65536, far[1] + 2 * 65536.0, far[2]};
        assert_true(fabs(noise_value(far, seed) - noise_value(near, seed)) < 1e-6); /* repeats */
    }
    assert_true(same < 5);
    const double end[3] = {65536 - 1e-9, 7.5, 3.5}, start[3] = {0, 7.5, 3.5};
    assert_true(fabs(noise_value(end, 1) - noise_value(start, 1)) < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise_keeps_its_bounds),
        cmocka_unit_test(noise_is_what_its_whole_points_say),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
