/* SPDX-License-Identifier: MIT */
/* Streams of pictures: when an encoder is asked for a key, and that what a viewer gets on a line of
 * any speed can always be decoded. The encoder tells in each picture which one it builds on. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "renderer/worker/stream_encoder.h"
#include "server/net/send_queue.h"

/* --- an encoder whose pictures depend on each other --- */

struct delta {
    uint32_t last; /* picture, counted from 1; 0: none */
    bool key;
    FILE *out;
};

static void *delta_open(void *about)
{
    (void)about;
    return memory_alloc(1, sizeof(struct delta));
}

static bool delta_begin(void *state, const struct image shapes[AOV_COUNT],
                        const struct encode_params *params, bool key, FILE *out, struct error *err)
{
    struct delta *delta = state;

    (void)shapes;
    (void)params;
    (void)err;
    delta->key = key;
    delta->out = out;
    return true;
}

static bool delta_add(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    (void)state;
    (void)aov;
    (void)rows;
    (void)err;
    return true;
}

/* The bytes: what it builds on, 0 for nothing. */
static bool delta_end(void *state, struct stream_packet *out, struct error *err)
{
    struct delta *delta = state;
    const uint32_t base = delta->key ? 0 : delta->last;

    (void)err;
    fwrite(&base, sizeof base, 1, delta->out);
    delta->last++;
    *out = (struct stream_packet){.codec = CODEC_JPEG, .key = delta->key};
    return true;
}

static const struct stream_class deltas = {delta_open, delta_begin, delta_add, delta_end, free};

/* A picture as a buffer. */
static struct shared_buffer *push(struct stream_encoder *stream, struct stream_packet *out)
{
    static const struct image shapes[AOV_COUNT];
    char *bytes = NULL;
    size_t length = 0;
    FILE *file = open_memstream(&bytes, &length);

    assert_true(stream_encoder_begin(stream, shapes, &(struct encode_params){0}, file, NULL));
    assert_true(stream_encoder_end(stream, out, NULL));
    fclose(file);
    struct shared_buffer *buffer = shared_buffer_create(bytes, length);
    free(bytes);
    return buffer;
}

static bool push_is_key(struct stream_encoder *stream)
{
    struct stream_packet packet;

    shared_buffer_unref(push(stream, &packet));
    return packet.key;
}

static void a_stream_begins_with_a_key_and_gives_one_when_asked(void **state)
{
    static const struct image shapes[AOV_COUNT];
    struct stream_encoder *stream = stream_encoder_open(&deltas, NULL);

    (void)state;
    assert_true(push_is_key(stream));
    assert_false(push_is_key(stream));
    stream_encoder_ask_key(stream);
    assert_true(push_is_key(stream));
    assert_false(push_is_key(stream));
    /* One that is given up in the middle is as if it had never been: a key is still asked for. */
    stream_encoder_ask_key(stream);
    assert_true(stream_encoder_begin(stream, shapes, &(struct encode_params){0}, NULL, NULL));
    assert_true(push_is_key(stream));
    assert_true(stream_encoder_begin(stream, shapes, &(struct encode_params){0}, NULL, NULL));
    assert_false(push_is_key(stream));
    stream_encoder_close(stream);
}

static void pictures_are_keys(void **state)
{
    struct stream_encoder *stream = stream_encoder_open(&picture_stream, NULL);
    uint8_t pixels[4 * 4 * 4] = {0};
    struct image image = {4, 4, 3, PIXEL_RGBA8, pixels, sizeof pixels};
    const struct image shapes[AOV_COUNT] = {[AOV_COLOR] = image};
    static const enum codec codecs[] = {CODEC_JPEG, CODEC_PNG};

    (void)state;
    for (int i = 0; i < 4; i++) {
        const struct encode_params params = {.format = codecs[i % 2]};
        struct stream_packet packet;
        uint8_t *single;
        char *bytes = NULL;
        size_t length = 0, single_length;
        FILE *file = open_memstream(&bytes, &length);

        assert_true(stream_encoder_begin(stream, shapes, &params, file, NULL));
        assert_true(stream_encoder_add(stream, AOV_COLOR, &image, NULL));
        assert_true(stream_encoder_end(stream, &packet, NULL));
        fclose(file);
        assert_true(packet.key);
        assert_int_equal(packet.codec, params.format);
        assert_true(image_encode(&image, &params, &single, &single_length, NULL));
        assert_int_equal(length, single_length);
        assert_memory_equal(bytes, single, length);
        free(bytes);
        free(single);
    }
    stream_encoder_close(stream);
}

/* --- the queue behind it --- */

/* A viewer behind a line. */
struct viewer {
    struct send_queue send_queue;
    struct stream_encoder *stream;
    uint32_t number, decoded; /* the newest picture made, and seen */
    int keys, shown, dropped;
};

static void start(struct viewer *viewer)
{
    *viewer = (struct viewer){.stream = stream_encoder_open(&deltas, NULL)};
    send_queue_init(&viewer->send_queue);
}

static void finish(struct viewer *viewer)
{
    send_queue_finish(&viewer->send_queue);
    stream_encoder_close(viewer->stream);
}

/* Returns what send_queue_frame does. */
static uint32_t show(struct viewer *viewer, uint8_t flags)
{
    struct stream_packet packet;

    if (send_queue_wants_key(&viewer->send_queue, 0)) {
        stream_encoder_ask_key(viewer->stream);
    }
    struct shared_buffer *bytes = push(viewer->stream, &packet);
    const struct frame_header header = {.codec = packet.codec,
                                        .flags = flags | (packet.key ? FRAME_KEY : 0),
                                        .number = ++viewer->number,
                                        .payload_bytes = (uint32_t)bytes->length};
    const uint32_t given_up = send_queue_frame(&viewer->send_queue, &header, bytes);

    viewer->keys += packet.key;
    viewer->dropped += given_up > 0;
    shared_buffer_unref(bytes);
    return given_up;
}

/* The line takes a piece. A whole frame is one that can be decoded. */
static void take(struct viewer *viewer)
{
    static uint8_t bytes[SEND_QUEUE_PART_BYTES + FRAME_HEADER_BYTES];
    struct send_queue_piece piece;
    uint32_t base;

    if (!send_queue_next(&viewer->send_queue, bytes, &piece) || !piece.frame_done) {
        return;
    }
    memcpy(&base, bytes + FRAME_HEADER_BYTES, sizeof base);
    if (base != 0 && base != viewer->decoded) {
        fail_msg("picture %u needs %u, but the last seen is %u", piece.frame_done, base,
                 viewer->decoded);
    }
    viewer->decoded = piece.frame_done;
    viewer->shown++;
}

static void a_line_that_keeps_up_gets_one_key(void **state)
{
    struct viewer viewer;

    (void)state;
    start(&viewer);
    for (int i = 0; i < 50; i++) {
        assert_int_equal(show(&viewer, 0), 0);
        take(&viewer);
    }
    assert_int_equal(viewer.keys, 1);
    assert_int_equal(viewer.shown, 50);
    finish(&viewer);
}

/* What waits is needed by what comes: that is given up, and the next one takes its place. */
static void a_frame_takes_no_place_that_it_needs(void **state)
{
    struct viewer viewer;

    (void)state;
    start(&viewer);
    assert_int_equal(show(&viewer, 0), 0);
    take(&viewer);
    assert_int_equal(show(&viewer, 0), 0);
    assert_int_equal(show(&viewer, 0), 3); /* itself */
    assert_true(send_queue_wants_key(&viewer.send_queue, 0));
    assert_int_equal(show(&viewer, 0), 2); /* a key */
    assert_false(send_queue_wants_key(&viewer.send_queue, 0));
    take(&viewer);
    assert_int_equal(viewer.decoded, 4);
    assert_int_equal(viewer.keys, 2);
    finish(&viewer);
}

/* One that is not queued at all takes those with it that follow. */
static void a_lost_frame_takes_its_dependants(void **state)
{
    struct viewer viewer;
    struct shared_buffer *bytes;
    struct stream_packet packet;

    (void)state;
    start(&viewer);
    show(&viewer, 0);
    take(&viewer);
    shared_buffer_unref(push(viewer.stream, &packet));
    viewer.number++;
    send_queue_skip(&viewer.send_queue, 0);
    assert_true(send_queue_wants_key(&viewer.send_queue, 0));
    for (int i = 0; i < 3; i++) { /* made before the request for a key came */
        bytes = push(viewer.stream, &packet);
        const struct frame_header header = {.number = ++viewer.number, .payload_bytes = 4};

        assert_int_equal(send_queue_frame(&viewer.send_queue, &header, bytes), viewer.number);
        assert_true(send_queue_is_empty(&viewer.send_queue));
        shared_buffer_unref(bytes);
    }
    assert_int_equal(show(&viewer, 0), 0);
    take(&viewer);
    assert_int_equal(viewer.decoded, viewer.number);
    finish(&viewer);
}

/* Moving and still pictures on lines of any speed, some of them not queued. */
static void what_arrives_can_be_decoded(void **state)
{
    (void)state;
    for (unsigned line = 0; line < 200; line++) {
        struct viewer viewer;
        unsigned chance = 12345 + line;

        start(&viewer);
        for (int i = 0; i < 300; i++) {
            chance = chance * 1103515245 + 12345;
            if ((chance >> 16) % 200 < line) {
                take(&viewer);
            }
            show(&viewer, (chance >> 24) % 3 == 0 ? FRAME_STILL : 0);
            if ((chance >> 20) % 16 == 0) {
                send_queue_skip(&viewer.send_queue, 0);
            }
        }
        while (!send_queue_is_empty(&viewer.send_queue)) {
            take(&viewer);
        }
        assert_true(viewer.shown > 0 && viewer.shown + viewer.dropped == 300);
        finish(&viewer);
    }
}

static struct shared_buffer *buffer_of(size_t length, uint8_t value)
{
    uint8_t *bytes = memory_alloc(length, 1);

    memset(bytes, value, length);
    struct shared_buffer *buffer = shared_buffer_create(bytes, length);
    free(bytes);
    return buffer;
}

static void assert_piece(struct send_queue *queue, enum send_queue_kind kind, bool first, bool last,
                         uint8_t value)
{
    static uint8_t bytes[SEND_QUEUE_PART_BYTES + FRAME_HEADER_BYTES];
    struct send_queue_piece piece;

    assert_true(send_queue_next(queue, bytes, &piece));
    assert_int_equal(piece.kind, kind);
    assert_int_equal(piece.first, first);
    assert_int_equal(piece.last, last);
    assert_int_equal(bytes[piece.length - 1], value);
}

static void what_is_behind_goes_last_and_in_one_go(void **state)
{
    struct shared_buffer *behind = buffer_of(SEND_QUEUE_PART_BYTES + 5, 1);
    struct shared_buffer *text = buffer_of(9, 2), *frame = buffer_of(7, 3);
    const struct frame_header header = {.number = 1, .flags = FRAME_KEY};
    struct send_queue queue;

    (void)state;
    send_queue_init(&queue);
    send_queue_behind(&queue, behind);
    send_queue_text(&queue, text);
    send_queue_frame(&queue, &header, frame);
    assert_piece(&queue, SEND_QUEUE_TEXT, true, true, 2);
    assert_piece(&queue, SEND_QUEUE_BINARY, true, true, 3);
    assert_piece(&queue, SEND_QUEUE_BINARY, true, false, 1);
    /* A message that is begun is finished: nothing may stand between its pieces. */
    send_queue_text(&queue, text);
    assert_piece(&queue, SEND_QUEUE_BINARY, false, true, 1);
    assert_piece(&queue, SEND_QUEUE_TEXT, true, true, 2);
    assert_true(send_queue_is_empty(&queue));
    send_queue_behind(&queue, behind);
    assert_false(send_queue_is_empty(&queue));
    send_queue_finish(&queue);
    shared_buffer_unref(behind);
    shared_buffer_unref(text);
    shared_buffer_unref(frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stream_begins_with_a_key_and_gives_one_when_asked),
        cmocka_unit_test(pictures_are_keys),
        cmocka_unit_test(a_line_that_keeps_up_gets_one_key),
        cmocka_unit_test(a_frame_takes_no_place_that_it_needs),
        cmocka_unit_test(a_lost_frame_takes_its_dependants),
        cmocka_unit_test(what_arrives_can_be_decoded),
        cmocka_unit_test(what_is_behind_goes_last_and_in_one_go),
    };

    return cmocka_run_group_tests_name("stream", tests, NULL, NULL);
}
