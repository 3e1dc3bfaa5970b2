/* SPDX-License-Identifier: MIT */
/* Copies around an axis: the same as so many nodes, or a bound of them where they are very many.
 * Copies along axes are in test_field.c. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#include "tests/support/modified.h"

#define BOX(x, y, z, more) "{'type':'box','params':{'size':[" #x "," #y "," #z "]}" more "}"
#define AT(x, y, z) ",'transform':{'translation':[" #x "," #y "," #z "]}"

static struct modified around_axis(int count, const char *child)
{
    char params[64];

    snprintf(params, sizeof params, "{'count':%d,'radius':0}", count);
    struct modified modified = modified_create("repeat_polar", params, child);
    modified.n[0] = count;
    return modified;
}

/* At a random point: the least distance of all copies, and the field. */
static void look(struct random *random, const struct modified *modified, double size, double p[3],
                 double *out_want, double *out_got)
{
    for (int i = 0; i < 3; i++) {
        p[i] = random_between(random, -size, size);
    }
    p[1] *= random_below(random, 2) ? 0.03 : 1; /* between flat copies */
    *out_want = modified_meaning_find("repeat_polar")(modified->child, p, modified->n);
    *out_got = field_distance(modified->whole, p);
}

static void assert_is_copies(struct random *random, const struct modified *modified, int points)
{
    for (int k = 0; k < points; k++) {
        double p[3], want, got;
        look(random, modified, k % 2 ? 3 : 0.5, p, &want, &got);
        if (!(fabs(got - want) < 1e-5)) {
            fail_msg("%g instead of %g at %g %g %g\n%s", got, want, p[0], p[1], p[2],
                     modified->text);
        }
    }
}

static void copies_around_an_axis_are_copies(void **state)
{
    (void)state;
    struct random random = {45};
    int few = 0;

    for (int round = 0; round < 300; round++) {
        struct modified modified = modified_random(&random, node_type_find("repeat_polar"), true);
        few += modified.whole->loop_trips < modified.n[0];
        assert_is_copies(&random, &modified, 60);
        modified_finish(&modified);
    }
    assert_true(few > 50); /* not all copies were looked at */
}

/* Seen from the axis the middle of a box's angle is not the direction of its middle. */
static void boxes_beside_the_axis_are_copies(void **state)
{
    (void)state;
    struct random random = {50};
    struct modified modified = around_axis(5, BOX(0.4, 0.3, 2, AT(0.3, 0, 1.02)));

    assert_int_equal(modified.whole->loop_trips, 3);
    assert_is_copies(&random, &modified, 3000);
    modified_finish(&modified);
}

/* More copies than are looked at, around the axis and beside it: a bound, not much too small. */
static void very_many_copies_are_a_bound(void **state)
{
    (void)state;
    static const char *const children[] = {BOX(3, 0.2, 0.01, AT(0.5, 0, 0)),
                                           BOX(0.5, 1, 4, AT(0.75, 0, 0))};
    struct random random = {46};

    for (int i = 0; i < 2; i++) {
        struct modified modified = around_axis(1000, children[i]);
        assert_in_range(modified.whole->loop_trips, SDF_REPEAT_CELLS_MAX - 1, SDF_REPEAT_CELLS_MAX);
        for (int k = 0; k < 500; k++) {
            double p[3], want, got;
            look(&random, &modified, k % 2 ? 3 : 0.5, p, &want, &got);
            assert_true(want < 0 ? got < 0 : got <= want + 1e-6);
            assert_true(got > want - 0.06 * hypot(p[0], p[2]) - 0.03 * fabs(want));
            assert_true(modified_steepness(&random, &modified) <= 1 + 1e-3);
            assert_true(modified_outside(&modified, p) <= 1e-5);
        }
        modified_finish(&modified);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(copies_around_an_axis_are_copies),
        cmocka_unit_test(boxes_beside_the_axis_are_copies),
        cmocka_unit_test(very_many_copies_are_a_bound),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
