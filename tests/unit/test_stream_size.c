/* SPDX-License-Identifier: MIT */
/* How large moving pictures are, from what the last ones took. The clock goes on meanwhile, so on a
 * busy machine they take longer: never less. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "server/clock.h"
#include "server/live/room_state.h"
#include "server/live/session.h"
#include "server/live/stream_size.h"

enum { WIDTH = 640, HEIGHT = 360, EDITS = 40, MANY = 1000 };

static struct room room;
static struct stream stream;
static struct session session = {.room = &room, .stream = &stream};
static struct stream_view view;

static int set_up(void **state)
{
    (void)state;
    memset(&room.rate, 0, sizeof room.rate);
    memset(&stream, 0, sizeof stream);
    render_request_init(&view.picture);
    record_put(&view.picture.picture, "width", WIDTH);
    record_put(&view.picture.picture, "height", HEIGHT);
    stream.job_rate = &stream.rate; /* one is ordered */
    return 0;
}

static double side_now(void)
{
    stream_size_choose(&session, &view);
    return stream_size_scale(&session, &view, STREAM_MOVING);
}

static void isolate(const char *ids)
{
    struct error err = {0};
    cJSON *list = cJSON_Parse(ids);

    id_set_finish(&view.picture.isolate);
    assert_true(id_set_read(&view.picture.isolate, list, MANY, "isolate", &err));
    cJSON_Delete(list);
    stream_size_isolate(&stream);
}

static int tear_down(void **state)
{
    (void)state;
    render_request_finish(&view.picture);
    return 0;
}

/* A moving picture is ordered that takes so long. */
static void order(double ms)
{
    const double scale = stream_size_scale(&session, &view, STREAM_MOVING);

    stream.job_pixels = (int64_t)(WIDTH * scale * HEIGHT * scale);
    stream.job_asked_us = clock_us() - (int64_t)(1000 * ms);
}

/* It comes; answers the side of the next one, as a part of the view's. */
static double after_order(double drawn_part)
{
    stream_size_learn(&session, drawn_part);
    return side_now();
}

static double after_picture(double ms, double drawn_part)
{
    order(ms);
    return after_order(drawn_part);
}

/* Many of the same come. */
static void after_pictures(double ms, double drawn_part)
{
    for (int i = 0; i < EDITS; i++) {
        after_picture(ms, drawn_part);
    }
}

static void pictures_that_take_long_become_smaller(void **state)
{
    (void)state;
    assert_true(after_picture(180, 1) <= 0.5);
    assert_true(after_picture(4 * 180, 1) < 0.5);
}

/* One of another size is drawn whole. */
static void pictures_that_are_copied_become_no_larger(void **state)
{
    (void)state;
    const double side = after_picture(180, 1);

    for (int i = 0; i < EDITS; i++) {
        assert_true(after_picture(1, 0.1) <= side);
    }
}

static void pictures_that_are_drawn_in_less_time_become_larger(void **state)
{
    double side = after_picture(180, 1);
    int i = 0;

    (void)state;
    while (side < 1 && i++ < MANY) {
        side = after_picture(1, 0.9);
    }
    assert_true(side == 1);
}

/* They are drawn whole at first, whatever those of others took that were copied. */
static void those_of_who_comes_later_begin_no_larger(void **state)
{
    (void)state;
    const double side = after_picture(180, 1);

    after_pictures(1, 0.1);
    memset(&stream, 0, sizeof stream);
    assert_true(side_now() <= side);
}

/* What is isolated takes little, copies of the whole scene do, and the whole scene takes much. */
static void the_whole_scene_is_no_larger_after_what_was_isolated(void **state)
{
    const double side = after_picture(180, 1);

    (void)state;
    after_pictures(1, 0.1);
    isolate("[\"ball\"]");
    after_pictures(1, 1);
    assert_true(side_now() == 1);
    isolate("[]");
    assert_true(side_now() <= side);
}

/* Nor are others' pictures. */
static void others_learn_nothing_of_what_is_isolated(void **state)
{
    const double side = after_picture(180, 1);

    (void)state;
    isolate("[\"ball\"]");
    after_pictures(1, 1);
    memset(&stream, 0, sizeof stream);
    isolate("[]");
    assert_true(side_now() <= side);
}

/* What was ordered of the one before tells nothing of the next. */
static void what_is_isolated_next_begins_as_the_whole_scene(void **state)
{
    const double side = after_picture(180, 1);

    (void)state;
    isolate("[\"ball\"]");
    after_pictures(1, 1);
    order(1);
    isolate("[\"crate\"]");
    assert_true(after_order(1) <= side);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(pictures_that_take_long_become_smaller, set_up, tear_down),
        cmocka_unit_test_setup_teardown(pictures_that_are_copied_become_no_larger, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(pictures_that_are_drawn_in_less_time_become_larger, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(those_of_who_comes_later_begin_no_larger, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(the_whole_scene_is_no_larger_after_what_was_isolated,
                                        set_up, tear_down),
        cmocka_unit_test_setup_teardown(others_learn_nothing_of_what_is_isolated, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(what_is_isolated_next_begins_as_the_whole_scene, set_up,
                                        tear_down),
    };

    return cmocka_run_group_tests_name("stream_size", tests, NULL, NULL);
}
