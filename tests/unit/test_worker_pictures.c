/* SPDX-License-Identifier: MIT */
/* What the render process draws: outputs, regions, streams, and what it refuses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tests/support/worker_peer.h"

#define HEAVY_EXAMPLE "protocol/examples/snail.json"

static void outputs_are_drawn(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    peer_send_render(1, 0, 40, 30, ",'format':'npy','aov':'id'");
    peer_send_request("s", 2, 0, "'width':40,'height':30,'format':'npy','aov':'id'");
    peer_send_request("s", 3, 0,
                      "'width':40,'height':30,'format':'jpg','quality':50,"
                      "'delivery':{'chroma_halved':true},'camera':{'position':[0,9,0.1],'fov':20}");
    do {
        peer_expect(TO_FRONT_FRAME);
        if (peer.packet.frame.job == 2) {
            assert_int_equal(peer.packet.frame.codec, CODEC_NPY);
            assert_int_equal(peer.packet.payload_length, 128 + 40 * 30 * 4);
        }
        if (peer.packet.frame.job == 3) {
            assert_int_equal(peer.packet.frame.codec, CODEC_JPEG);
            assert_memory_equal(peer.packet.payload, "\xff\xd8\xff", 3);
        }
    } while (peer.packet.frame.job != 3);
}

/* What a render with these members comes back as. */
static void check_frame(const char *more, enum codec codec, int width, int height)
{
    peer_send_render(1, 0, 40, 30, more);
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.codec, codec);
    assert_int_equal(peer.packet.frame.width, width);
    assert_int_equal(peer.packet.frame.height, height);
}

static void what_is_asked(void **state)
{
    enum { COLOR_TYPE = 25, RGB = 2, RGB_ALPHA = 6 }; /* in the IHDR of a PNG */

    (void)state;
    peer_send_scene("s", 1);
    check_frame(",'aov':'color,depth'", CODEC_ZIP, 40, 30);
    assert_memory_equal(peer.packet.payload, "PK\3\4", 4);
    check_frame(",'delivery':{'zipped':true}", CODEC_ZIP, 40, 30);
    check_frame(",'region':[30,7,10,2]", CODEC_PNG, 10, 2);
    check_frame(",'level':'draft','transparent':true", CODEC_PNG, 40, 30);
    assert_int_equal(peer.packet.payload[COLOR_TYPE], RGB_ALPHA);
    check_frame(",'transparent':false", CODEC_PNG, 40, 30);
    assert_int_equal(peer.packet.payload[COLOR_TYPE], RGB);
}

/* Of a stream that goes on from the picture of an order. */
static void check_streamed(int job, const char *stream, int base, bool key, const char *more)
{
    char members[256];

    snprintf(members, sizeof members, ",'quality':80,'delivery':{'stream':'%s','base':%d,%s}",
             stream, base, more);
    peer_send_render(job, 0, 80, 60, members);
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, job);
    assert_int_equal(peer.packet.frame.key, key);
}

/* The front names the order whose picture its client has: it may be none of the last one. */
static void streams_go_on_from_what_the_client_has(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    check_streamed(1, "a", 0, true, "'exact':true");
    check_streamed(2, "a", 1, false, "'exact':true");
    assert_int_equal(peer.packet.payload_length, 2);
    check_streamed(3, "a", 2, false, "'whole':true");
    assert_int_equal(peer.packet.payload_length, 2 + peer.packet.frame.whole_bytes);
    assert_memory_equal(peer.packet.payload + 3, "PNG", 3);
    check_streamed(4, "b", 3, true, "'exact':true");
    check_streamed(5, "a", 2, true, "'exact':true"); /* 3 got lost on its way */
    check_streamed(6, "a", 5, false, "'exact':true");
    check_streamed(7, "a", 0, true, "'exact':true"); /* none is wanted */
    check_streamed(8, "a", 7, false, "'exact':true");
    /* One that is given up is none that somebody could lack. */
    peer_send_example("heavy", 1, HEAVY_EXAMPLE);
    peer_send_request("heavy", 9, 0,
                      "'width':2000,'height':2000,'samples':4,'delivery':{'stream':'a','base':8}");
    do {
        peer_expect(TO_FRONT_DRAWING);
    } while (peer.packet.suspect.job != 9);
    peer_send_cancel(9);
    check_frame("", CODEC_PNG, 40, 30); /* encoded after what there was of 9 */
    check_streamed(10, "a", 8, false, "'exact':true");
    assert_true(peer.packet.frame.whole_bytes == 0);
}

/* A client keeps no round but the last one, so it could put none together. */
static void rounds_are_whole(void **state)
{
    static const char more[] = ",'samples':4,'delivery':{'stream':'a','base':%d,'exact':true,%s}";
    char members[256];
    int rounds = 0;

    (void)state;
    peer_send_scene("s", 1);
    snprintf(members, sizeof members, more, 0, "'in_rounds':false");
    peer_send_render(1, 0, 320, 240, members);
    peer_expect(TO_FRONT_FRAME);
    snprintf(members, sizeof members, more, 1, "'in_rounds':true");
    peer_send_render(2, 0, 320, 240, members);
    do {
        peer_expect(TO_FRONT_FRAME);
        assert_int_equal(peer.packet.frame.job, 2);
        assert_true(peer.packet.frame.key);
        rounds++;
    } while (peer.packet.frame.more);
    assert_int_equal(peer.packet.frame.rounds.done, peer.packet.frame.rounds.count);
    assert_true(rounds > 0);
}

/* A picture counts as the part of it that is asked for. */
static void streams_are_kept_beside_parts_of_large_pictures(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    check_streamed(1, "a", 0, true, "'exact':true");
    peer_send_render(2, 0, 8192, 8192,
                     ",'region':[4000,4000,16,16],'delivery':{'stream':'b','exact':true}");
    peer_expect(TO_FRONT_FRAME);
    check_streamed(3, "a", 1, false, "'exact':true");
}

/* The front gives up what it hears nothing of. The picture is one row of tiles, which takes minutes
 * of a processor. */
static void long_rows_are_told_to_go_on(void **state)
{
    (void)state;
    peer_send_example("heavy", 1, HEAVY_EXAMPLE);
    peer_send_request(
        "heavy", 1, 0,
        "'width':16384,'height':16384,'region':[0,8192,16384,64],'level':'final',"
        "'camera':{'position':[-2,1.9,6.6],'target':[0,0.42,0],'fov':32,'aperture':0.05}");
    peer_expect(TO_FRONT_PROGRESS);
    assert_int_equal(peer.packet.job.job, 1);
    peer_ping(1);
    assert_int_equal(peer.packet.pong.counters.pictures, 0);
    peer_send_cancel(1);
}

static void check_failed(const char *more, enum error_kind kind, const char *place)
{
    char members[512];

    snprintf(members, sizeof members, "'width':40,'height':30%s", more);
    peer_send_request("s", 5, 0, members);
    peer_expect(TO_FRONT_FAILED);
    assert_int_equal(peer.packet.failed.job, 5);
    assert_int_equal(peer.packet.failed.error.kind, kind);
    assert_string_equal(peer.packet.failed.error.place, place);
    assert_true(strlen(peer.packet.failed.error.message) > 0);
}

static void impossible_requests_are_refused(void **state)
{
    (void)state;
    check_failed("", ERROR_NOT_FOUND, "scene");
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    check_failed(",'aov':'smell'", ERROR_INVALID, "/aov");
    check_failed(",'format':'gif'", ERROR_INVALID, "/format");
    check_failed(",'aov':'position'", ERROR_INVALID, "aov");
    check_failed(",'format':'jpg','transparent':true", ERROR_INVALID, "format");
    check_failed(",'level':'best'", ERROR_INVALID, "/level");
    check_failed(",'region':[39,0,2,2]", ERROR_LIMIT, "region");
    check_failed(",'region':[1,2]", ERROR_INVALID, "/region");
    check_failed(",'samples':9", ERROR_INVALID, "/samples");
    check_failed(",'format':'jpg','quality':400", ERROR_INVALID, "/quality");
    check_failed(",'camera':{'fov':500}", ERROR_INVALID, "/camera/fov");
    check_failed(",'isolate':[7]", ERROR_INVALID, "/isolate/0");
    check_failed(",'delivery':{'by':'air'}", ERROR_INVALID, "/delivery/by");
    peer_send_document("t", 4, "{}");
    peer_check_broken("t", 4, ERROR_INVALID);
    peer_send_document("t", 5, "{");
    peer_check_broken("t", 5, ERROR_SYNTAX);
    peer_send_edit(2, "[{'op':'remove','at':'/nodes/nobody'}]");
    peer_check_broken("s", 2, ERROR_NOT_FOUND);
    peer_send_render(6, 0, 40, 30, "");
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.revision, 1);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(outputs_are_drawn, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(what_is_asked, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(streams_go_on_from_what_the_client_has, peer_start,
                                        peer_stop),
        cmocka_unit_test_setup_teardown(rounds_are_whole, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(streams_are_kept_beside_parts_of_large_pictures, peer_start,
                                        peer_stop),
        cmocka_unit_test_setup_teardown(long_rows_are_told_to_go_on, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(impossible_requests_are_refused, peer_start, peer_stop),
    };

    if (peer_is_worker(argc, argv)) {
        return peer_run_worker();
    }
    return cmocka_run_group_tests_name("worker pictures", tests, NULL, NULL);
}
