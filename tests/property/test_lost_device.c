/* SPDX-License-Identifier: MIT */
/* A device that is lost while a row of tiles is begun anew ends the picture. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "renderer/draw/draw_internal.h"
#include "renderer/job_internal.h"
#include "tests/support/drawing.h"

enum { SIDE = 64, SLOW_US = 2000000 };

static bool lose_device(struct draw *draw, struct draw_picture *picture, int index,
                        struct error *err)
{
    (void)draw, (void)picture, (void)index;
    return error_set(err, ERROR_UNAVAILABLE, "", "the device is lost");
}

/* The second tile is slow, and given up: for that it is waited for. */
static void a_tile_that_cannot_be_given_up_ends_the_picture(void **state)
{
    struct renderer *renderer = drawing_renderer(SIDE);
    struct job_desc desc = drawing_desc(4 * SIDE, SIDE);

    (void)state;
    renderer_use_stage(renderer, RENDER_FRAGMENT);
    struct resident *resident = drawing_resident(renderer, "tests/golden/nodes/sphere/scene.json");
    desc.samples = 1;
    struct job *job = job_create(resident, &desc, NULL);
    while (job_step(job) == JOB_WAITING) {
        renderer_poll(renderer, 0);
    }
    assert_int_equal(job->started, 1);
    assert_true(job->row.pace.doublings > 0);
    struct draw_backend broken = *job->picture.backend;
    broken.wait = lose_device;
    job->picture.backend = &broken;
    job->sample = (struct watch){SLOW_US, SLOW_US};
    assert_int_equal(job_step(job), JOB_FAILED);
    assert_string_equal(job_error(job)->message, "the device is lost");
    assert_int_equal(job->started, 2);
    job_destroy(job);
    resident_destroy(resident);
    renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tile_that_cannot_be_given_up_ends_the_picture),
    };

    return cmocka_run_group_tests_name("lost device", tests, NULL, NULL);
}
