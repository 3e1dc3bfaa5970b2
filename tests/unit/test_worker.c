/* SPDX-License-Identifier: MIT */
/* The render process over its socket: edits, whose turn it is, cancelling, its pulse, its end. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <cmocka.h>

#include "renderer/renderer.h"
#include "tests/support/json_text.h"
#include "tests/support/picture.h"
#include "tests/support/text_file.h"
#include "tests/support/worker_peer.h"

static void worker_says_what_it_draws_with(void **state)
{
    (void)state;
    peer_expect(TO_FRONT_READY);
    assert_true(strlen(peer.packet.ready.name) > 0);
    assert_true(strlen(peer.packet.ready.device) > 0);
    assert_int_equal(peer.packet.ready.stage,
                     peer.packet.ready.software ? RENDER_ENGINE : RENDER_COMPUTE);
}

/* The same document, drawn in this process. */
static void draw_here(const char *ops, struct picture *out)
{
    const struct renderer_params params = {.device = {.index = -1}};
    struct renderer *renderer = renderer_create(&params, NULL);
    const struct job_desc desc = {
        .width = 80, .height = 60, .level = -1, .samples = 1, .transparent = -1, .exact = true};
    size_t length, bytes_length;
    char *document = text_file_read(PEER_EXAMPLE, &length);
    struct scene *scene = scene_parse(document, length, NULL);
    struct resident *resident = resident_create(renderer, scene, 1);
    cJSON *json = json_text_parse(ops, NULL);
    struct image image;
    uint8_t *bytes;

    assert_true(resident_edit(resident, json, 2, NULL));
    assert_true(renderer_render(resident, &desc, &image, NULL));
    assert_true(image_encode(&image, &(struct encode_params){.format = CODEC_PNG}, &bytes,
                             &bytes_length, NULL));
    assert_true(picture_read_memory(out, bytes, bytes_length));
    free(bytes);
    image_finish(&image);
    resident_destroy(resident);
    renderer_destroy(renderer);
    cJSON_Delete(json);
    free(document);
}

static void render_and_edit(void **state)
{
    static const char ops[] = "[{'op':'set','at':'/nodes/ball/params/radius','value':0.9}]";
    struct picture first, second, here;

    (void)state;
    peer_send_scene("s", 1);
    peer_send_render(1, 0, 80, 60, ",'delivery':{'exact':true}");
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, 1);
    assert_int_equal(peer.packet.frame.revision, 1);
    assert_true(peer.packet.frame.newest);
    assert_int_equal(peer.packet.frame.width, 80);
    assert_int_equal(peer.packet.frame.codec, CODEC_PNG);
    assert_true(peer.packet.frame.times.us[FRAME_SHADE] > 0 &&
                peer.packet.frame.times.us[FRAME_ENCODE] > 0);
    assert_true(picture_read_memory(&first, peer.packet.payload, peer.packet.payload_length));

    peer_send_edit(2, ops);
    peer_send_render(2, 0, 80, 60, "");
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.revision, 2);
    assert_true(picture_read_memory(&second, peer.packet.payload, peer.packet.payload_length));
    assert_false(picture_compare(&first, &second, NULL).greatest == 0);

    draw_here(ops, &here);
    assert_int_equal(picture_compare(&second, &here, NULL).greatest, 0);
    assert_true(picture_compare(&second, &here, NULL).same);
    picture_finish(&first);
    picture_finish(&second);
    picture_finish(&here);
}

static void structural_edit(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    assert_int_equal(peer.packet.state.revision, 1);
    peer_send_edit(2,
                   "[{'op':'insert','into':'/nodes/root','before':null,'value':{'type':'torus'}}]");
    peer_send_render(1, 0, 40, 30, "");
    peer_send_render(2, 0, 40, 30, ",'delivery':{'exact':true}");
    /* In whatever order they come: the compiler may be faster than the first picture. */
    for (bool shown = false, drawn = false; !shown || !drawn;) {
        const int kind = peer_receive();

        assert_int_not_equal(kind, TO_FRONT_COUNT);
        if (kind == TO_FRONT_SHOWN) {
            assert_int_equal(peer.packet.state.revision, 2);
            shown = true;
        } else if (kind == TO_FRONT_FRAME && peer.packet.frame.job == 2) {
            assert_int_equal(peer.packet.frame.revision, 2);
            drawn = true;
        } else if (kind == TO_FRONT_FRAME) {
            assert_int_equal(peer.packet.frame.newest, peer.packet.frame.revision == 2);
        }
    }
}

static void priority_comes_first(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_long_render(1, 3);
    peer_send_render(2, 0, 40, 30, "");
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, 2);
    peer_send_cancel(1);
}

/* A large picture of one scene, as urgent as can be, and small ones of another beside it. */
static void scenes_take_turns(void **state)
{
    enum { SMALL = 8, LARGE = 100 };

    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_scene("t", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_long_render(LARGE, 0);
    for (int job = 1; job <= SMALL; job++) {
        peer_send_render_of("t", job, job % 4, 40, 30, "");
        peer_expect(TO_FRONT_FRAME);
        assert_int_equal(peer.packet.frame.job, job);
    }
    peer_send_cancel(LARGE);
}

/* What takes no time is no turn: beginning, handing over rows, ending. The picture is as small as
 * the smallest tile, so that it has one, however slow the machine is. */
static void one_tile_takes_one_turn(void **state)
{
    enum { SMALL = 8, LARGE = 100 };

    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_scene("t", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_long_render(LARGE, 0);
    for (int job = 1; job <= SMALL; job++) {
        int turns = 0;

        peer_send_render_of("t", job, 0, 8, 6, "");
        while (peer_receive() != TO_FRONT_FRAME) {
            assert_int_not_equal(peer.packet.kind, TO_FRONT_COUNT);
            turns +=
                peer.packet.kind == TO_FRONT_DRAWING && peer.packet.suspect.job == (uint32_t)job;
        }
        assert_int_equal(peer.packet.frame.job, job);
        assert_int_equal(turns, 1);
    }
    peer_send_cancel(LARGE);
}

static void cancelled_requests_end(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_long_render(1, 0);
    peer_send_long_render(2, 0);
    peer_send_render(3, 1, 40, 30, "");
    peer_send_cancel(1);
    peer_send_cancel(2);
    peer_send_cancel(77);
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, 3);
    do {
        peer_ping(9);
    } while (!peer.packet.pong.idle);
    assert_int_equal(peer.packet.pong.counters.pictures, 1);
    assert_true(peer.packet.pong.resident_bytes > 0);
}

/* The number behind a word of its status, as hexadecimal digits. */
static unsigned long status_of(pid_t process, const char *word)
{
    char path[64], line[256];
    unsigned long value = ~0ul;

    snprintf(path, sizeof path, "/proc/%d/status", (int)process);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file)) {
        if (strncmp(line, word, strlen(word)) == 0) {
            value = strtoul(line + strlen(word), NULL, 16);
        }
    }
    fclose(file);
    return value;
}

/* Also where the program was started with all privileges. */
static void worker_is_confined(void **state)
{
    static const char *const none[] = {"CapEff:", "CapPrm:", "CapInh:"};
    struct rlimit core;

    (void)state;
    peer_expect(TO_FRONT_READY);
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++) {
        assert_int_equal(status_of(peer.child, none[i]), 0);
    }
    assert_int_equal(status_of(peer.child, "NoNewPrivs:"), 1);
    assert_int_equal(prlimit(peer.child, RLIMIT_CORE, NULL, &core), 0);
    assert_int_equal(core.rlim_max, 0);
}

/* It tells how far the drawing thread has come, and when that has nothing to do. */
static void pulse_counts_steps(void **state)
{
    uint64_t steps;

    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    do {
        peer_ping(1);
    } while (!peer.packet.pong.idle);
    steps = peer.packet.pong.steps;
    peer_ping(2);
    assert_true(peer.packet.pong.idle);
    assert_true(peer.packet.pong.steps == steps);
    peer_send_long_render(1, 3);
    do {
        peer_ping(3);
    } while (peer.packet.pong.counters.tiles == 0); /* in the middle of a picture */
    assert_false(peer.packet.pong.idle);
    assert_true(peer.packet.pong.steps > steps);
    assert_int_equal(peer.packet.pong.counters.pictures, 0);
    peer_send_cancel(1);
    peer_send_render(2, 3, 40, 30, "");
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, 2);
}

/* Nobody has to listen to it, and whoever talks nonsense there gets no answer. */
static void pulse_gone(void **state)
{
    static const uint32_t nonsense[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};

    (void)state;
    peer_expect(TO_FRONT_READY);
    assert_int_equal(send(peer.pulse_fd, nonsense, sizeof nonsense, MSG_NOSIGNAL), sizeof nonsense);
    peer_send_scene("s", 1);
    peer_send_render(1, 0, 40, 30, "");
    peer_expect(TO_FRONT_FRAME);
}

static void dropped_scene(void **state)
{
    (void)state;
    peer_send_scene("s", 1);
    peer_expect(TO_FRONT_SHOWN);
    peer_send_render(1, 0, 400, 300, "");
    peer_send_packet(peer.fd, &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = "s"}});
    peer_send_render(2, 0, 40, 30, "");
    peer_expect(TO_FRONT_FAILED);
    assert_int_equal(peer.packet.failed.job, 2);
    assert_int_equal(peer.packet.failed.error.kind, ERROR_NOT_FOUND);
    peer_expect(TO_FRONT_FRAME);
    assert_int_equal(peer.packet.frame.job, 1);
}

static void stop_ends_a_render(void **state)
{
    (void)state;
    assert_int_equal(peer_start(NULL), 0);
    peer_expect(TO_FRONT_READY);
    peer_send_scene("s", 1);
    peer_send_long_render(1, 0);
    peer_send_text(TO_WORKER_STOP, "{}");
    while (peer_receive() != TO_FRONT_COUNT) {
    }
    assert_int_equal(peer_end(), 0);
}

/* The front is gone in the middle of a picture. */
static void front_gone(void **state)
{
    (void)state;
    assert_int_equal(peer_start(NULL), 0);
    peer_expect(TO_FRONT_READY);
    peer_send_scene("s", 1);
    peer_send_long_render(1, 0);
    assert_int_equal(peer_end(), 0);
}

static void check_broken_stream(const void *bytes, size_t length)
{
    assert_int_equal(peer_start(NULL), 0);
    peer_expect(TO_FRONT_READY);
    peer_send_bytes(bytes, length);
    peer_expect(TO_FRONT_FAILED);
    assert_int_equal(peer.packet.failed.error.kind, ERROR_SYNTAX);
    assert_int_equal(peer_receive(), TO_FRONT_COUNT);
    assert_int_equal(peer_end(), 1);
}

static void malformed_packets(void **state)
{
    static const uint32_t huge[3] = {TO_WORKER_STOP, UINT32_MAX, 0};
    static const char garbage[] = "\x08\0\0\0\x05\0\0\0\0\0\0\0{\"a\":";
    static const char list[] = "\x08\0\0\0\x02\0\0\0\0\0\0\0[]";
    static const char unknown[] = "\x63\0\0\0\x02\0\0\0\0\0\0\0{}";
    static const char payload[] = "\x08\0\0\0\x02\0\0\0\1\0\0\0{}x"; /* that `stop` never has */

    (void)state;
    check_broken_stream(huge, sizeof huge);
    check_broken_stream(garbage, sizeof garbage - 1);
    check_broken_stream(list, sizeof list - 1);
    check_broken_stream(unknown, sizeof unknown - 1);
    check_broken_stream(payload, sizeof payload - 1);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(worker_says_what_it_draws_with, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(worker_is_confined, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(render_and_edit, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(structural_edit, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(priority_comes_first, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(scenes_take_turns, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(one_tile_takes_one_turn, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(cancelled_requests_end, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(pulse_counts_steps, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(pulse_gone, peer_start, peer_stop),
        cmocka_unit_test_setup_teardown(dropped_scene, peer_start, peer_stop),
        cmocka_unit_test(stop_ends_a_render),
        cmocka_unit_test(front_gone),
        cmocka_unit_test(malformed_packets),
    };

    if (peer_is_worker(argc, argv)) {
        return peer_run_worker();
    }
    return cmocka_run_group_tests_name("worker", tests, NULL, NULL);
}
