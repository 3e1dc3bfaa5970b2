/* SPDX-License-Identifier: MIT */
/* Streams of differences, put together by a reader that follows protocol/README.md: by random
 * pictures and changes, in any bands of rows, behind a line that loses frames. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jpeglib.h>

#include "protocol/memory.h"
#include "renderer/worker/delta.h"
#include "renderer/worker/kept_streams.h"
#include "server/net/send_queue.h"
#include "tests/support/picture.h"
#include "tests/support/random_scene.h"

enum { PIXEL_BYTES = 4, SEQUENCES = 60, PICTURES = 12, LONGEST = 100, ROOM = 2 };

static struct random chance = {7};

/* --- pictures --- */

static struct picture make_picture(int width, int height)
{
    struct picture picture = {width, height,
                              memory_alloc((size_t)width * (size_t)height, PIXEL_BYTES)};

    for (int i = 0; i < width * height; i++) {
        uint8_t *pixel = picture.pixels + (ptrdiff_t)PIXEL_BYTES * i;
        pixel[0] = (uint8_t)(i % width * 2);
        pixel[1] = (uint8_t)(i / width * 3);
        pixel[2] = 90;
        pixel[3] = (uint8_t)random_below(&chance, 256); /* means nothing */
    }
    return picture;
}

/* A rectangle of another colour somewhere, or none. */
static void change(struct picture *picture, int side)
{
    const int left = (int)random_below(&chance, (size_t)picture->width);
    const int top = (int)random_below(&chance, (size_t)picture->height);
    const uint8_t value = (uint8_t)random_below(&chance, 256);

    for (int y = top; y < top + side && y < picture->height; y++) {
        for (int x = left; x < left + side && x < picture->width; x++) {
            uint8_t *pixel = picture->pixels + (ptrdiff_t)PIXEL_BYTES * (y * picture->width + x);
            pixel[x % 2] = value;
            pixel[2] = (uint8_t)(x * y);
        }
    }
}

static struct image image_of(const struct picture *picture)
{
    const size_t bytes = (size_t)picture->width * (size_t)picture->height * PIXEL_BYTES;

    return (struct image){picture->width, picture->height, 3, PIXEL_RGBA8, picture->pixels, bytes};
}

static struct picture read_jpeg(const uint8_t *bytes, size_t length)
{
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct picture picture = {0};

    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, bytes, length);
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&jpeg);
    picture.width = (int)jpeg.output_width;
    picture.height = (int)jpeg.output_height;
    picture.pixels = memory_alloc((size_t)picture.width * (size_t)picture.height, PIXEL_BYTES);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row =
            picture.pixels + (size_t)jpeg.output_scanline * (size_t)picture.width * PIXEL_BYTES;
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    jpeg_destroy_decompress(&jpeg);
    return picture;
}

static struct picture read_file(const uint8_t *bytes, size_t length)
{
    struct picture picture;

    if (bytes[0] == 0xff) {
        return read_jpeg(bytes, length);
    }
    assert_true(picture_read_memory(&picture, bytes, length));
    return picture;
}

static struct picture whole_file(const struct picture *picture, const struct encode_params *params)
{
    const struct image image = image_of(picture);
    uint8_t *bytes;
    size_t length;

    assert_true(image_encode(&image, params, &bytes, &length, NULL));
    struct picture read = read_file(bytes, length);
    free(bytes);
    return read;
}

/* --- a reader --- */

static size_t number_at(const uint8_t *at)
{
    return at[0] + 256U * at[1];
}

/* From square `from` of the atlas to square `to` of the picture. */
static void put_square(struct picture *picture, size_t to, const struct picture *atlas, size_t from)
{
    const int across = (picture->width + DELTA_SIDE - 1) / DELTA_SIDE;
    const int columns = atlas->width / DELTA_SIDE;
    const int left = (int)to % across * DELTA_SIDE, top = (int)to / across * DELTA_SIDE;

    for (int y = 0; y < DELTA_SIDE && top + y < picture->height; y++) {
        for (int x = 0; x < DELTA_SIDE && left + x < picture->width; x++) {
            const int row = (int)from / columns * DELTA_SIDE + y;
            const int column = (int)from % columns * DELTA_SIDE + x;

            memcpy(picture->pixels +
                       (ptrdiff_t)PIXEL_BYTES * ((top + y) * picture->width + left + x),
                   atlas->pixels + (ptrdiff_t)PIXEL_BYTES * (row * atlas->width + column),
                   PIXEL_BYTES);
        }
    }
}

/* Puts what has changed into the picture; answers how many squares. */
static size_t put_delta(struct picture *picture, const uint8_t *bytes, size_t length)
{
    const size_t runs = number_at(bytes), head = 2 + 4 * runs;
    struct picture atlas = {0};
    size_t count = 0;

    if (length > head) {
        atlas = read_file(bytes + head, length - head);
    }
    for (size_t i = 0; i < runs; i++) {
        const size_t first = number_at(bytes + 2 + 4 * i), many = number_at(bytes + 4 + 4 * i);

        for (size_t k = 0; k < many; k++) {
            put_square(picture, first + k, &atlas, count++);
        }
    }
    picture_finish(&atlas);
    return count;
}

/* --- a stream --- */

struct sent {
    struct stream_packet packet;
    uint8_t *bytes;
    size_t length;
};

static void begin(struct stream_encoder *stream, const struct picture *picture,
                  const struct encode_params *params, FILE *out)
{
    struct image shapes[AOV_COUNT] = {[AOV_COLOR] = image_of(picture)};

    shapes[AOV_COLOR].pixels = NULL;
    assert_true(stream_encoder_begin(stream, shapes, params, out, NULL));
}

/* Rows from one to another. */
static void add_rows(struct stream_encoder *stream, const struct picture *picture, int from, int to)
{
    struct image rows = image_of(picture);
    const size_t stride = rows.bytes / (size_t)rows.height;

    rows.height = to - from;
    rows.pixels = picture->pixels + (size_t)from * stride;
    rows.bytes = (size_t)rows.height * stride;
    assert_true(stream_encoder_add(stream, AOV_COLOR, &rows, NULL));
}

/* In bands of random heights. Caller frees the bytes. */
static struct sent encode(struct stream_encoder *stream, const struct picture *picture,
                          const struct encode_params *params)
{
    struct sent sent = {0};
    FILE *out = open_memstream((char **)&sent.bytes, &sent.length);

    begin(stream, picture, params, out);
    for (int y = 0; y < picture->height;) {
        const int left = picture->height - y, some = 1 + (int)random_below(&chance, 40);
        const int end = y + (some < left ? some : left);
        add_rows(stream, picture, y, end);
        y = end;
    }
    assert_true(stream_encoder_end(stream, &sent.packet, NULL));
    fclose(out);
    return sent;
}

/* What is shown after it. */
static void show(struct picture *shown, const struct sent *sent)
{
    if (sent->packet.key) {
        picture_finish(shown);
        *shown = read_file(sent->bytes, sent->length);
    } else {
        put_delta(shown, sent->bytes, sent->length - sent->packet.whole_bytes);
    }
}

/* The greatest difference of a channel. */
static int apart(const struct picture *a, const struct picture *b)
{
    int most = 0;

    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    for (int i = 0; i < PIXEL_BYTES * a->width * a->height; i++) {
        const int difference = i % PIXEL_BYTES < 3 ? abs(a->pixels[i] - b->pixels[i]) : 0;
        most = difference > most ? difference : most;
    }
    return most;
}

/* Given up in the middle now and then; asked for a key now and then. */
static void disturb(struct stream_encoder *stream, const struct picture *picture,
                    const struct encode_params *params)
{
    if (random_below(&chance, 5) == 0) {
        struct picture other = make_picture(picture->width, picture->height);
        FILE *out = fopen("/dev/null", "w");

        begin(stream, &other, params, out);
        add_rows(stream, &other, 0, 1 + (int)random_below(&chance, (size_t)other.height));
        fclose(out);
        picture_finish(&other);
    }
    if (random_below(&chance, 8) == 0) {
        stream_encoder_ask_key(stream);
    }
}

/* Answers how many of its pictures were differences. */
static int check_sequence(const struct encode_params *params)
{
    struct stream_encoder *stream = stream_encoder_open(&delta_stream, NULL);
    struct picture picture = make_picture(1 + (int)random_below(&chance, LONGEST),
                                          1 + (int)random_below(&chance, LONGEST));
    struct picture shown = {0};
    int deltas = 0;

    for (int i = 0; i < PICTURES; i++) {
        disturb(stream, &picture, params);
        struct sent sent = encode(stream, &picture, params);
        show(&shown, &sent);
        struct picture want = whole_file(&picture, params);
        /* Where colours are halved a square's are its own, and those of a whole file are not. */
        assert_int_equal(apart(&shown, params->chroma_halved ? &shown : &want), 0);
        if (params->whole && !sent.packet.key) {
            struct picture whole = read_file(sent.bytes + sent.length - sent.packet.whole_bytes,
                                             sent.packet.whole_bytes);
            assert_int_equal(apart(&whole, &want), 0);
            picture_finish(&whole);
        }
        deltas += !sent.packet.key;
        picture_finish(&want);
        free(sent.bytes);
        change(&picture, (int)random_below(&chance, 24));
    }
    picture_finish(&picture);
    picture_finish(&shown);
    stream_encoder_close(stream);
    return deltas;
}

static void what_is_put_together_is_the_whole_picture(void **state)
{
    static const struct encode_params all[] = {
        {.format = CODEC_PNG, .fast = true},
        {.format = CODEC_PNG, .fast = true, .whole = true},
        {.format = CODEC_JPEG, .quality = 88, .fast = true},
        {.format = CODEC_JPEG, .quality = 60, .whole = true},
    };
    int deltas = 0;

    (void)state;
    for (int i = 0; i < SEQUENCES; i++) {
        deltas += check_sequence(&all[i % 4]);
    }
    print_message("%d of %d pictures were differences\n", deltas, SEQUENCES * PICTURES);
    assert_true(deltas > SEQUENCES * PICTURES / 3);
}

/* Mean of the squares of the differences of channels. */
static double error_of(const struct picture *a, const struct picture *b)
{
    double sum = 0;

    for (int i = 0; i < PIXEL_BYTES * a->width * a->height; i++) {
        const double difference = i % PIXEL_BYTES < 3 ? a->pixels[i] - b->pixels[i] : 0;
        sum += difference * difference;
    }
    return sum / (a->width * a->height);
}

/* Squares come with all their colours: the picture is no worse than the whole file, however often
 * they come. */
static void halved_colours_are_no_worse_than_those_of_the_whole(void **state)
{
    const struct encode_params params = {
        .format = CODEC_JPEG, .quality = 60, .chroma_halved = true, .fast = true};
    struct stream_encoder *stream = stream_encoder_open(&delta_stream, NULL);
    struct picture picture = make_picture(LONGEST, LONGEST), shown = {0};

    (void)state;
    for (int i = 0; i < 4 * PICTURES; i++) {
        struct sent sent = encode(stream, &picture, &params);
        assert_true(sent.packet.key == (i == 0));
        show(&shown, &sent);
        struct picture want = whole_file(&picture, &params);
        assert_true(error_of(&shown, &picture) <= error_of(&want, &picture) + ROOM);
        picture_finish(&want);
        free(sent.bytes);
        change(&picture, 9);
    }
    picture_finish(&picture);
    picture_finish(&shown);
    stream_encoder_close(stream);
}

static bool is_key(struct stream_encoder *stream, const struct picture *picture,
                   const struct encode_params *params)
{
    struct sent sent = encode(stream, picture, params);

    free(sent.bytes);
    return sent.packet.key;
}

static void a_picture_of_another_kind_is_a_key(void **state)
{
    struct encode_params params = {.format = CODEC_PNG};
    struct stream_encoder *stream = stream_encoder_open(&delta_stream, NULL);
    struct picture picture = make_picture(70, 50), other = make_picture(50, 70);

    (void)state;
    assert_true(is_key(stream, &picture, &params));
    assert_false(is_key(stream, &picture, &params));
    assert_true(is_key(stream, &other, &params));
    assert_false(is_key(stream, &other, &params));
    params.format = CODEC_JPEG;
    assert_true(is_key(stream, &other, &params));
    params.quality = 70;
    assert_true(is_key(stream, &other, &params));
    assert_false(is_key(stream, &other, &params));
    for (int i = 0; i < 50 * 70; i++) {
        other.pixels[PIXEL_BYTES * i] ^= 1;
    }
    assert_true(is_key(stream, &other, &params)); /* all has changed */
    assert_false(is_key(stream, &other, &params));
    stream_encoder_close(stream);
    picture_finish(&picture);
    picture_finish(&other);
}

static void nothing_new_is_two_bytes(void **state)
{
    const struct encode_params params = {.format = CODEC_PNG};
    struct stream_encoder *stream = stream_encoder_open(&delta_stream, NULL);
    struct picture picture = make_picture(70, 50);

    (void)state;
    assert_true(is_key(stream, &picture, &params));
    for (int i = 0; i < 70 * 50; i++) {
        picture.pixels[PIXEL_BYTES * i + 3] ^= 255; /* means nothing */
    }
    struct sent sent = encode(stream, &picture, &params);
    assert_int_equal(sent.length, 2);
    assert_false(sent.packet.key);
    free(sent.bytes);
    stream_encoder_close(stream);
    picture_finish(&picture);
}

/* --- behind a line --- */

enum { CHAINS = 3 };

struct chain {
    struct stream_encoder *stream;
    struct picture picture, shown;
};

/* What is in the queue shows which picture it is by a frame of its own. */
struct viewer {
    struct send_queue queue;
    struct chain chains[CHAINS];
    struct sent made[4096]; /* by number */
    uint8_t chain_of[4096];
    uint32_t number;
    int shown, deltas;
};

static void draw(struct viewer *viewer)
{
    const struct encode_params params = {.format = CODEC_PNG, .fast = true};
    const uint8_t at = (uint8_t)random_below(&chance, CHAINS);
    struct chain *chain = &viewer->chains[at];

    change(&chain->picture, 10);
    if (send_queue_wants_key(&viewer->queue, at)) {
        stream_encoder_ask_key(chain->stream);
    }
    struct sent sent = encode(chain->stream, &chain->picture, &params);
    struct shared_buffer *bytes = shared_buffer_create(sent.bytes, sent.length);
    const struct frame_header header = {
        .codec = CODEC_PNG,
        .flags = (uint8_t)((sent.packet.key ? FRAME_KEY : FRAME_DELTA) | (at ? FRAME_STILL : 0)),
        .number = ++viewer->number,
        .chain = at,
        .payload_bytes = (uint32_t)sent.length};

    viewer->made[viewer->number] = sent;
    viewer->chain_of[viewer->number] = at;
    viewer->deltas += !sent.packet.key;
    send_queue_frame(&viewer->queue, &header, bytes);
    shared_buffer_unref(bytes);
}

/* The line takes a piece. */
static uint32_t take(struct viewer *viewer)
{
    static uint8_t bytes[SEND_QUEUE_PART_BYTES + FRAME_HEADER_BYTES];
    struct send_queue_piece piece;

    if (!send_queue_next(&viewer->queue, bytes, &piece) || !piece.frame_done) {
        return 0;
    }
    show(&viewer->chains[viewer->chain_of[piece.frame_done]].shown,
         &viewer->made[piece.frame_done]);
    viewer->shown++;
    return piece.frame_done;
}

/* Each picture that arrives is the newest of its chain when it was made, or can be told to be. */
static void what_a_line_loses_spoils_nothing(void **state)
{
    (void)state;
    for (unsigned line = 1; line < 40; line++) {
        struct viewer *viewer = memory_alloc(1, sizeof *viewer);

        send_queue_init(&viewer->queue);
        for (int i = 0; i < CHAINS; i++) {
            viewer->chains[i] =
                (struct chain){stream_encoder_open(&delta_stream, NULL), make_picture(60, 40), {0}};
        }
        for (int i = 0; i < 150; i++) {
            draw(viewer);
            while (random_below(&chance, 40) < line) {
                const uint32_t number = take(viewer);
                const struct chain *chain = &viewer->chains[viewer->chain_of[number]];
                if (number > 0 && number == viewer->number) {
                    assert_int_equal(apart(&chain->shown, &chain->picture), 0);
                }
            }
        }
        assert_true(viewer->shown > 0 && viewer->deltas > 0);
        for (uint32_t i = 1; i <= viewer->number; i++) {
            free(viewer->made[i].bytes);
        }
        for (int i = 0; i < CHAINS; i++) {
            stream_encoder_close(viewer->chains[i].stream);
            picture_finish(&viewer->chains[i].picture);
            picture_finish(&viewer->chains[i].shown);
        }
        send_queue_finish(&viewer->queue);
        free(viewer);
    }
}

/* --- streams that are kept --- */

static void streams_are_kept_by_name_as_far_as_there_is_room(void **state)
{
    struct kept_streams streams = {0};
    struct kept_stream *first = kept_streams_take(&streams, "a", &delta_stream);
    struct kept_stream *second = kept_streams_take(&streams, "a", &delta_stream);

    (void)state;
    assert_ptr_not_equal(first, second); /* who takes one has it alone */
    first->order = 5;
    first->bytes = LIMIT_DELTAS_BYTES / 2;
    second->order = 4;
    kept_streams_give_back(&streams, second);
    kept_streams_give_back(&streams, first);
    assert_ptr_equal(kept_streams_take(&streams, "a", &delta_stream), first);
    second = kept_streams_take(&streams, "a", &delta_stream);
    assert_int_equal(second->order, 0); /* another one: of each name one is kept */
    kept_streams_give_back(&streams, second);
    kept_streams_give_back(&streams, first);
    second = kept_streams_take(&streams, "b", &delta_stream);
    assert_int_equal(second->order, 0);
    second->bytes = LIMIT_DELTAS_BYTES / 2 + 1;
    kept_streams_give_back(&streams, second);
    first = kept_streams_take(&streams, "a", &delta_stream);
    assert_int_equal(first->order, 0); /* another one: there was no room for both */
    kept_streams_give_back(&streams, first);
    assert_ptr_equal(kept_streams_take(&streams, "b", &delta_stream), second);
    kept_streams_give_back(&streams, second);
    kept_streams_give_back(&streams, NULL);
    kept_streams_finish(&streams);
}

static void give_back(struct kept_streams *streams, const char *name, int order, int side)
{
    struct kept_stream *stream = kept_streams_take(streams, name, &delta_stream);

    kept_stream_begin(stream, side, side);
    kept_stream_end(stream, (uint32_t)order, side, side);
    kept_streams_give_back(streams, stream);
}

static uint32_t order_of(struct kept_streams *streams, const char *name)
{
    struct kept_stream *stream = kept_streams_take(streams, name, &delta_stream);
    const uint32_t order = stream->order;

    kept_streams_give_back(streams, stream);
    return order;
}

/* Of a picture that is too large nothing is kept, but many small ones take room too. */
static void streams_count_as_much_as_they_hold(void **state)
{
    enum { LARGE = 8192, NOT_TOO_LARGE = 2048, MANY = 3000 };

    struct kept_streams streams = {0};
    char name[16];

    (void)state;
    give_back(&streams, "a", 5, 300);
    give_back(&streams, "large", 6, LARGE);
    assert_int_equal(order_of(&streams, "a"), 5);
    assert_int_equal(order_of(&streams, "large"), 6);
    for (int i = 0; i < LIMIT_DELTAS_BYTES / (4 * NOT_TOO_LARGE * NOT_TOO_LARGE); i++) {
        snprintf(name, sizeof name, "%d", i);
        give_back(&streams, name, 7, NOT_TOO_LARGE);
    }
    assert_int_equal(order_of(&streams, "a"), 0);
    /* One that was given up may have left something. */
    struct kept_stream *given_up = kept_streams_take(&streams, "c", &delta_stream);
    kept_stream_begin(given_up, NOT_TOO_LARGE, NOT_TOO_LARGE);
    kept_stream_begin(given_up, LARGE, LARGE);
    assert_true(given_up->bytes > 4 * NOT_TOO_LARGE * NOT_TOO_LARGE);
    kept_stream_end(given_up, 6, 1, 1); /* the picture in its place is small */
    assert_true(given_up->bytes < 4 * NOT_TOO_LARGE * NOT_TOO_LARGE);
    kept_streams_give_back(&streams, given_up);
    give_back(&streams, "b", 8, 1);
    for (int i = 0; i < MANY; i++) {
        snprintf(name, sizeof name, "%d", i);
        give_back(&streams, name, 9, 1);
    }
    assert_int_equal(order_of(&streams, "b"), 0);
    kept_streams_finish(&streams);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_put_together_is_the_whole_picture),
        cmocka_unit_test(halved_colours_are_no_worse_than_those_of_the_whole),
        cmocka_unit_test(a_picture_of_another_kind_is_a_key),
        cmocka_unit_test(nothing_new_is_two_bytes),
        cmocka_unit_test(what_a_line_loses_spoils_nothing),
        cmocka_unit_test(streams_are_kept_by_name_as_far_as_there_is_room),
        cmocka_unit_test(streams_count_as_much_as_they_hold),
    };

    return cmocka_run_group_tests_name("differences", tests, NULL, NULL);
}
