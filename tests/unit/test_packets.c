/* SPDX-License-Identifier: MIT */
/* Packets between the front and the render process, as bytes and back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/worker/worker_protocol.h"

/* Packets come whole out of any pieces. */
static void packets_come_whole_out_of_pieces(void **state)
{
    static uint8_t payload[] = "some bytes";
    const struct packet sent = {.kind = TO_WORKER_ASSET,
                                .asset = {"a file"},
                                .payload = payload,
                                .payload_length = sizeof payload};
    struct packet_reader pieces = {0};
    struct packet out;
    size_t length;
    uint8_t *bytes = packet_pack(PACKET_TO_WORKER, &sent, &length);

    (void)state;
    for (int round = 0; round < 3; round++) {
        for (size_t i = 0; i < length; i++) {
            assert_int_equal(packet_reader_next(&pieces, PACKET_TO_WORKER, &out), 0);
            packet_reader_add(&pieces, bytes + i, 1);
        }
        assert_int_equal(packet_reader_next(&pieces, PACKET_TO_WORKER, &out), 1);
        assert_int_equal(out.kind, TO_WORKER_ASSET);
        assert_string_equal(out.asset.asset, "a file");
        assert_int_equal(out.payload_length, sizeof payload);
        assert_memory_equal(out.payload, payload, sizeof payload);
        packet_finish(&out);
    }
    packet_reader_finish(&pieces);
    free(bytes);
}

/* What a packet says when it has been bytes. */
static struct packet there(enum packet_way way, const struct packet *sent)
{
    struct packet_reader whole = {0};
    struct packet out = {0};
    size_t length;
    uint8_t *bytes = packet_pack(way, sent, &length);

    packet_reader_add(&whole, bytes, length);
    assert_int_equal(packet_reader_next(&whole, way, &out), 1);
    assert_int_equal(out.kind, sent->kind);
    free(bytes);
    packet_reader_finish(&whole);
    return out;
}

/* What the reader says of a packet that is of this length by its head, and goes on later. */
static int first_seen(enum packet_way way, int kind, size_t at, uint32_t part_length)
{
    struct packet_reader reader = {0};
    struct packet out;
    size_t length;
    uint8_t *bytes = packet_pack(way, &(struct packet){.kind = kind}, &length);

    memcpy(bytes + at, &part_length, sizeof part_length);
    packet_reader_add(&reader, bytes, length);
    const int seen = packet_reader_next(&reader, way, &out);
    packet_reader_finish(&reader);
    free(bytes);
    return seen;
}

/* Others would be nonsense. */
static void documents_and_edits_have_any_length(void **state)
{
    enum { JSON_AT = 4, PAYLOAD_AT = 8 };

    (void)state;
    assert_int_equal(first_seen(PACKET_TO_WORKER, TO_WORKER_SCENE, PAYLOAD_AT, UINT32_MAX), 0);
    assert_int_equal(first_seen(PACKET_TO_WORKER, TO_WORKER_EDIT, JSON_AT, UINT32_MAX), 0);
    assert_int_equal(first_seen(PACKET_TO_WORKER, TO_WORKER_ASSET, PAYLOAD_AT, UINT32_MAX), -1);
    assert_int_equal(first_seen(PACKET_TO_WORKER, TO_WORKER_STOP, JSON_AT, UINT32_MAX), -1);
    assert_int_equal(first_seen(PACKET_TO_FRONT, TO_FRONT_FRAME, PAYLOAD_AT, UINT32_MAX), -1);
    assert_int_equal(first_seen(PACKET_TO_FRONT, TO_FRONT_FRAME, JSON_AT, UINT32_MAX), -1);
}

static void members_to_worker(void **state)
{
    const struct packet_judge judge = {0xfedcba9876543210, "a", ERROR_CRASHED, 7, 8, 9};
    struct render_request request;
    struct packet got;

    (void)state;
    got = there(PACKET_TO_WORKER, &(struct packet){.kind = TO_WORKER_JUDGE, .judge = judge});
    assert_true(got.judge.structure_hash == judge.structure_hash);
    assert_string_equal(got.judge.asset, "a");
    assert_int_equal(got.judge.refused, ERROR_CRASHED);
    assert_int_equal(got.judge.measured_ms, 7);
    assert_int_equal(got.judge.limit_ms, 8);
    assert_int_equal(got.judge.times, 9);
    packet_finish(&got);
    render_request_init(&request);
    record_put(&request.camera, "fov", 20);
    assert_true(render_request_check(&request, REQUEST_JSON, NULL));
    got = there(PACKET_TO_WORKER, &(struct packet){.kind = TO_WORKER_RENDER,
                                                   .render = {.job = 7,
                                                              .scene = "s",
                                                              .account = "a",
                                                              .priority = 3,
                                                              .patience = 2,
                                                              .careful = true,
                                                              .request = &request}});
    assert_int_equal(got.render.job, 7);
    assert_string_equal(got.render.account, "a");
    assert_int_equal(got.render.priority, 3);
    assert_int_equal(got.render.patience, 2);
    assert_true(got.render.careful);
    assert_true(render_request_equal(got.render.request, &request));
    packet_finish(&got);
    render_request_finish(&request);
}

static void members_to_front(void **state)
{
    struct packet sent = {.kind = TO_FRONT_FRAME,
                          .frame = {.job = 7, .revision = 1e15, .more = true, .whole_bytes = 9}};
    struct packet got;

    (void)state;
    sent.frame.rounds = (struct picture_rounds){4, 16};
    sent.frame.codec = CODEC_ZIP;
    sent.frame.drawn_part = 0.25;
    for (int i = 0; i < FRAME_STAGES; i++) {
        sent.frame.times.us[i] = (uint32_t)i + 1;
    }
    got = there(PACKET_TO_FRONT, &sent);
    assert_memory_equal(&got.frame, &sent.frame, sizeof got.frame);
    packet_finish(&got);
    sent = (struct packet){.kind = TO_FRONT_WARNED,
                           .state = {.scene = "s", .revision = 5, .warning = WARNING_ASSET}};
    error_set_at(&sent.state.error, ERROR_TOO_SLOW, "/here", 3, 4, "text");
    sent.state.error.measured_ms = 11;
    sent.state.error.limit_ms = 12;
    got = there(PACKET_TO_FRONT, &sent);
    assert_int_equal(got.state.warning, WARNING_ASSET);
    assert_memory_equal(&got.state.error, &sent.state.error, sizeof got.state.error);
    packet_finish(&got);
    sent = (struct packet){.kind = TO_FRONT_SLOW,
                           .suspect = {.scene = "s",
                                       .revision = 5,
                                       .structure_hash = 0xfedcba9876543210,
                                       .asset = "a",
                                       .still = true,
                                       .measured_ms = 1,
                                       .limit_ms = 2}};
    got = there(PACKET_TO_FRONT, &sent);
    assert_true(got.suspect.structure_hash == sent.suspect.structure_hash && got.suspect.still);
    assert_string_equal(got.suspect.asset, "a");
    assert_int_equal(got.suspect.limit_ms, 2);
    packet_finish(&got);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_come_whole_out_of_pieces),
        cmocka_unit_test(documents_and_edits_have_any_length),
        cmocka_unit_test(members_to_worker),
        cmocka_unit_test(members_to_front),
    };

    return cmocka_run_group_tests_name("packets", tests, NULL, NULL);
}
