/* SPDX-License-Identifier: MIT */
/* The encoding threads: pictures that come in pieces, in turns, are those that image_encode makes;
 * one that fails or is given up comes back at once; an urgent one waits for no other. */
#include <dirent.h>
#include <semaphore.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/memory.h"
#include "renderer/patient.h"
#include "renderer/worker/encode_thread.h"
#include "server/clock.h"
#include "tests/support/waits.h"

enum { WIDTH = 640, HEIGHT = 120, BAND = 30 }; /* too many for the owner to encode */

enum { THREADS = 16 };

static int wake_fd;
static int others; /* threads before those for pictures; sanitizers have some */
static struct encode_thread *encode_thread;
static struct stream_encoder *streams[4]; /* of the pictures that were begun */
static int stream_count;

/* Answers how many there are; `out`: the first of them. */
static int list_threads(int out[THREADS])
{
    DIR *threads = opendir("/proc/self/task");
    int count = 0;

    assert_non_null(threads);
    for (const struct dirent *entry; (entry = readdir(threads)) && count < THREADS;) {
        const int id = atoi(entry->d_name);
        if (id > 0) {
            out[count++] = id;
        }
    }
    closedir(threads);
    return count;
}

static int start(void **state)
{
    int threads[THREADS];

    (void)state;
    others = list_threads(threads);
    wake_fd = eventfd(0, EFD_CLOEXEC);
    encode_thread = encode_thread_create(wake_fd, NULL);
    return encode_thread ? 0 : -1;
}

static int stop(void **state)
{
    (void)state;
    encode_thread_destroy(encode_thread);
    while (stream_count > 0) {
        stream_encoder_close(streams[--stream_count]);
    }
    close(wake_fd);
    return 0;
}

static struct image make_image(int width, int height, unsigned seed)
{
    struct image image = {.width = width, .height = height, .channels = 3, .format = PIXEL_RGBA8};
    uint8_t *pixels;

    image.bytes = (size_t)width * (size_t)height * 4;
    image.pixels = pixels = memory_alloc(image.bytes, 1);
    for (size_t i = 0; i < image.bytes; i++) {
        seed = seed * 1103515245 + 12345;
        pixels[i] = (uint8_t)(seed >> 24);
    }
    return image;
}

static struct encoding *begin_of(const struct image *image, const struct encode_params *params,
                                 int priority)
{
    struct image shapes[AOV_COUNT] = {[AOV_COLOR] = *image};
    struct error err = {0};
    struct stream_encoder *stream = streams[stream_count++] =
        stream_encoder_open(&picture_stream, NULL);
    struct encoding *encoding =
        encode_thread_begin(encode_thread, stream, shapes, params, priority, NULL, &err);

    if (!encoding) {
        fail_msg("%s", err.message);
    }
    return encoding;
}

static struct encoding *begin(const struct image *image, const struct encode_params *params)
{
    return begin_of(image, params, 0);
}

static void add(struct encoding *encoding, const struct image *image, int y, int height)
{
    struct image rows = *image;
    const size_t stride = (size_t)image->width * 4;

    rows.height = height;
    rows.bytes = stride * (size_t)height;
    rows.pixels = memory_alloc(rows.bytes, 1);
    memcpy(rows.pixels, (const uint8_t *)image->pixels + (size_t)y * stride, rows.bytes);
    encode_thread_add(encode_thread, encoding, AOV_COLOR, rows);
}

static void sleep_until_woken(void)
{
    uint64_t count;

    assert_int_equal(read(wake_fd, &count, sizeof count), sizeof count);
}

static struct encoding *take(void)
{
    struct encoding *encoding;

    while (!(encoding = encode_thread_take(encode_thread))) {
        sleep_until_woken();
    }
    return encoding;
}

static void encodings_take_turns(void **state)
{
    const struct encode_params params[] = {{.format = CODEC_PNG}, {.format = CODEC_JPEG}};
    struct image images[] = {make_image(WIDTH, HEIGHT, 1), make_image(WIDTH, HEIGHT, 2)};
    struct encoding *encodings[2];

    (void)state;
    for (int i = 0; i < 2; i++) {
        encodings[i] = begin(&images[i], &params[i]);
        encodings[i]->data = &images[i];
    }
    for (int y = 0; y < HEIGHT; y += BAND) {
        add(encodings[0], &images[0], y, BAND);
        add(encodings[1], &images[1], y, BAND);
    }
    encode_thread_end(encode_thread, encodings[0], true);
    encode_thread_end(encode_thread, encodings[1], true);
    for (int i = 0; i < 2; i++) {
        struct encoding *encoding = take();
        const int which = encoding->data == &images[1];
        uint8_t *bytes;
        size_t length;

        assert_true(encoding->ok);
        assert_true(image_encode(&images[which], &params[which], &bytes, &length, NULL));
        assert_int_equal(encoding->length, length);
        assert_memory_equal(encoding->bytes, bytes, length);
        free(bytes);
        encoding_destroy(encoding);
        image_finish(&images[which]);
    }
}

static void failures_are_reported(void **state)
{
    const struct encode_params params = {.format = CODEC_PNG, .limit_bytes = 5000};
    struct image image = make_image(WIDTH, HEIGHT, 3);
    struct encoding *encoding = begin(&image, &params), *back;

    (void)state;
    add(encoding, &image, 0, 2 * BAND);
    back = take(); /* before its end */
    assert_ptr_equal(back, encoding);
    assert_false(back->ok);
    assert_int_equal(back->error.kind, ERROR_LIMIT);
    encoding_destroy(back);
    image_finish(&image);
}

static void given_up(void **state)
{
    struct image image = make_image(WIDTH, HEIGHT, 4);
    struct encoding *encoding = begin(&image, &(struct encode_params){.format = CODEC_PNG}), *back;

    (void)state;
    add(encoding, &image, 0, BAND);
    encode_thread_end(encode_thread, encoding, false);
    back = take();
    assert_ptr_equal(back, encoding);
    assert_false(back->ok);
    assert_int_equal(back->error.kind, ERROR_NONE);
    encoding_destroy(back);
    image_finish(&image);
}

/* So many rows at once that they are encoded in several goes. */
static void full_queues_are_encoded_in_parts(void **state)
{
    const struct encode_params params = {.format = CODEC_PNG, .fast = true};
    struct image image = make_image(4096, 2560, 5); /* 40 MiB */
    struct encoding *encoding = begin(&image, &params);
    uint8_t *bytes;
    size_t length;

    (void)state;
    add(encoding, &image, 0, image.height);
    assert_true(encode_thread_is_full(encode_thread, encoding));
    while (encode_thread_is_full(encode_thread, encoding)) {
        sleep_until_woken();
    }
    encode_thread_end(encode_thread, encoding, true);
    encoding = take();
    assert_true(image_encode(&image, &params, &bytes, &length, NULL));
    assert_int_equal(encoding->length, length);
    assert_memory_equal(encoding->bytes, bytes, length);
    free(bytes);
    encoding_destroy(encoding);
    image_finish(&image);
}

/* --- a stream whose rows take until they are let go on --- */

enum { STUCK_SECONDS = 60 }; /* then the test has failed */

static sem_t stuck, let_go;
static bool in_time;

static void *open_slow(void *about)
{
    (void)about;
    return NULL;
}

static bool begin_slow(void *state, const struct image shapes[AOV_COUNT],
                       const struct encode_params *params, bool key, FILE *out, struct error *err)
{
    (void)state;
    (void)shapes;
    (void)params;
    (void)key;
    (void)out;
    (void)err;
    return true;
}

static bool add_slow(void *state, enum aov aov, const struct image *rows, struct error *err)
{
    struct timespec end;

    (void)state;
    (void)aov;
    (void)rows;
    (void)err;
    clock_gettime(CLOCK_REALTIME, &end);
    end.tv_sec += STUCK_SECONDS;
    sem_post(&stuck);
    in_time = sem_timedwait(&let_go, &end) == 0;
    return true;
}

static bool end_slow(void *state, struct stream_packet *out, struct error *err)
{
    (void)state;
    (void)out;
    (void)err;
    return true;
}

static void close_slow(void *state)
{
    (void)state;
}

static const struct stream_class slow_stream = {open_slow, begin_slow, add_slow, end_slow,
                                                close_slow};

/* Of a slow picture of this size and priority, and an urgent one. */
static void assert_urgent_first(int priority, struct image slow_size)
{
    const struct encode_params params = {.format = CODEC_JPEG};
    const struct image shapes[AOV_COUNT] = {[AOV_COLOR] = slow_size};
    struct image image = make_image(WIDTH, HEIGHT, 7);
    struct stream_encoder *stream = streams[stream_count++] =
        stream_encoder_open(&slow_stream, NULL);
    struct encoding *slow = encode_thread_begin(encode_thread, stream, shapes, &params, priority,
                                                NULL, NULL),
                    *first;

    sem_init(&stuck, 0, 0);
    sem_init(&let_go, 0, 0);
    add(slow, &image, 0, 1); /* at once */
    encode_thread_end(encode_thread, slow, true);
    sem_wait(&stuck);
    struct encoding *urgent = begin(&image, &params);
    add(urgent, &image, 0, HEIGHT);
    encode_thread_end(encode_thread, urgent, true);
    first = take();
    sem_post(&let_go);
    assert_ptr_equal(first, urgent);
    assert_ptr_equal(take(), slow);
    assert_true(in_time);
    encoding_destroy(urgent);
    encoding_destroy(slow);
    sem_destroy(&stuck);
    sem_destroy(&let_go);
    image_finish(&image);
}

static void urgent_encodings_come_first(void **state)
{
    const struct image small = {.width = WIDTH, .height = HEIGHT};
    const struct image large = {.width = 4096, .height = 2160};

    (void)state;
    assert_urgent_first(ENCODE_URGENT + 1, small);
    assert_urgent_first(ENCODE_URGENT, large);
}

/* Drawing has all processors. */
static void patient_encodings_wait_while_something_is_drawn(void **state)
{
    const struct encode_params params = {.format = CODEC_PNG};
    struct image image = make_image(WIDTH, BAND, 8);
    struct encoding *encoding = begin_of(&image, &params, ENCODE_URGENT + 1);

    (void)state;
    patient_draws(PATIENT_URGENT);
    const int64_t begun_us = clock_us();
    add(encoding, &image, 0, BAND);
    encode_thread_end(encode_thread, encoding, true);
    assert_ptr_equal(take(), encoding);
    patient_draws(PATIENT_FREE);
    assert_true(clock_us() - begun_us >= (int64_t)2000 * PATIENT_WAIT_MS);
    assert_true(encoding->ok);
    encoding_destroy(encoding);
    image_finish(&image);
}

/* Nobody has to be waited for. */
static void the_owner_encodes_a_small_jpeg(void **state)
{
    const struct encode_params params = {.format = CODEC_JPEG};
    struct image image = make_image(WIDTH, BAND, 5);
    struct encoding *encoding = begin_of(&image, &params, ENCODE_URGENT + 1);
    uint8_t *bytes;
    size_t length;

    (void)state;
    patient_draws(PATIENT_URGENT); /* by the owner, who does not wait for himself */
    add(encoding, &image, 0, BAND);
    assert_null(encode_thread_take(encode_thread));
    const long waits = waits_of_thread();
    encode_thread_end(encode_thread, encoding, true);
    assert_int_equal(waits_of_thread(), waits);
    patient_draws(PATIENT_FREE);
    encode_thread_end(encode_thread, encoding, false); /* cancelled before it is taken */
    assert_ptr_equal(encode_thread_take(encode_thread), encoding);
    assert_true(encoding->ok);
    sleep_until_woken();
    assert_true(image_encode(&image, &params, &bytes, &length, NULL));
    assert_int_equal(encoding->length, length);
    assert_memory_equal(encoding->bytes, bytes, length);
    free(bytes);
    encoding_destroy(encoding);
    image_finish(&image);
}

/* How often the threads for pictures have waited. */
static int count_waits(void)
{
    int threads[THREADS], waits = 0;
    const int count = list_threads(threads);

    for (int i = others; i < count; i++) { /* in the order of their birth */
        char path[100], line[200];
        int own = 0;

        snprintf(path, sizeof path, "/proc/self/task/%d/status", threads[i]);
        FILE *status = fopen(path, "r");
        assert_non_null(status);
        while (fgets(line, sizeof line, status)) {
            sscanf(line, "voluntary_ctxt_switches: %d", &own);
        }
        fclose(status);
        waits += own;
    }
    return waits;
}

/* One that is woken takes the lock, and the owner waits for it while it has no processor. */
static void a_small_jpeg_wakes_no_thread(void **state)
{
    const struct encode_params params = {.format = CODEC_JPEG};
    struct image image = make_image(WIDTH, BAND, 8);
    int before, waits = count_waits();

    (void)state;
    do { /* until both threads have begun to wait */
        before = waits;
        usleep(20000);
        waits = count_waits();
    } while (waits < 2 || waits != before);
    struct encoding *encoding = begin(&image, &params);
    add(encoding, &image, 0, BAND);
    encode_thread_end(encode_thread, encoding, true);
    encoding_destroy(take());
    usleep(20000);
    assert_int_equal(count_waits(), waits);
    image_finish(&image);
}

static void left_behind(void **state)
{
    struct image image = make_image(WIDTH, HEIGHT, 6);

    (void)state;
    add(begin(&image, &(struct encode_params){.format = CODEC_NPY}), &image, 0, BAND);
    image_finish(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(encodings_take_turns, start, stop),
        cmocka_unit_test_setup_teardown(failures_are_reported, start, stop),
        cmocka_unit_test_setup_teardown(given_up, start, stop),
        cmocka_unit_test_setup_teardown(full_queues_are_encoded_in_parts, start, stop),
        cmocka_unit_test_setup_teardown(urgent_encodings_come_first, start, stop),
        cmocka_unit_test_setup_teardown(patient_encodings_wait_while_something_is_drawn, start,
                                        stop),
        cmocka_unit_test_setup_teardown(the_owner_encodes_a_small_jpeg, start, stop),
        cmocka_unit_test_setup_teardown(a_small_jpeg_wakes_no_thread, start, stop),
        cmocka_unit_test_setup_teardown(left_behind, start, stop),
    };

    return cmocka_run_group_tests_name("encode_thread", tests, NULL, NULL);
}
