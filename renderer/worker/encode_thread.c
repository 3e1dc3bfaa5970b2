/* SPDX-License-Identifier: MIT */
/* Two lists under one lock: pictures that are encoded, and those that are done. A thread works on
 * one picture without the lock; meanwhile others only append to its rows. Which of the threads a
 * picture is for does not change. */
#include "encode_thread.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "renderer/patient.h"
#include "renderer/slice.h"

enum {
    SLICE_PIXELS = 1 << 14, /* encoded at a time: some 2 ms of PNG */
    FULL_BYTES = 32 << 20,
    SMALL_PIXELS = 1 << 16, /* a JPEG of them takes less time than a thread takes to wake up */
    LARGE_PIXELS = 1 << 22, /* with more, no picture is urgent */
};

enum lane { LANE_URGENT, LANE_PATIENT, LANES };

struct rows {
    enum aov aov;
    struct image image;
    int taken; /* rows of it that are encoded */
    struct rows *next;
};

struct work {
    struct encoding result; /* the first member: what the owner holds */
    struct stream_encoder *stream;
    FILE *out; /* into `bytes` */
    char *bytes;
    size_t length;
    struct rows *rows; /* the oldest first */
    size_t waiting_bytes;
    uint64_t pixels; /* of the whole picture */
    bool is_small;   /* its owner encodes it */
    bool ended, whole, failed;
    struct work *next;
};

struct encode_thread {
    pthread_t threads[LANES];
    int started; /* of the threads */
    pthread_mutex_t lock;
    pthread_cond_t change[LANES]; /* something for that thread */
    struct work *works, *done;    /* in order of arrival */
    bool stop;
    int wake_fd;
};

static uint64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

static void append(struct work **list, struct work *work)
{
    while (*list) {
        list = &(*list)->next;
    }
    work->next = NULL;
    *list = work;
}

static struct work *take_first(struct work **list)
{
    struct work *first = *list;

    if (first) {
        *list = first->next;
    }
    return first;
}

static void drop_rows(struct work *work)
{
    struct rows *first = work->rows;

    work->rows = first->next;
    work->waiting_bytes -= first->image.bytes;
    image_finish(&first->image);
    free(first);
}

/* --- the threads --- */

bool encode_is_urgent(int priority, uint64_t pixels)
{
    return priority <= ENCODE_URGENT && pixels <= LARGE_PIXELS;
}

static enum lane lane_of(const struct work *work)
{
    return encode_is_urgent(work->result.priority, work->pixels) ? LANE_URGENT : LANE_PATIENT;
}

static bool is_before(const struct work *a, const struct work *b)
{
    return a->result.priority != b->result.priority ? a->result.priority < b->result.priority
                                                    : a->pixels < b->pixels;
}

static struct work *find_next(const struct encode_thread *encode_thread, enum lane lane)
{
    struct work *best = NULL;

    for (struct work *work = encode_thread->works; work; work = work->next) {
        if (!work->is_small && lane_of(work) == lane && (work->rows || work->ended) &&
            (!best || is_before(work, best))) {
            best = work;
        }
    }
    return best;
}

/* The next few of the oldest rows. */
static struct image slice_of(const struct rows *rows)
{
    const int left = rows->image.height - rows->taken, some = SLICE_PIXELS / rows->image.width + 1;
    const size_t stride = rows->image.bytes / (size_t)rows->image.height;
    struct image slice = rows->image;

    slice.height = left < some ? left : some;
    slice.bytes = (size_t)slice.height * stride;
    slice.pixels = (uint8_t *)rows->image.pixels + (size_t)rows->taken * stride;
    return slice;
}

static bool encode_slice(struct work *work, struct rows *rows)
{
    const struct image slice = slice_of(rows);

    rows->taken += slice.height;
    return stream_encoder_add(work->stream, rows->aov, &slice, &work->result.error);
}

static void wake_owner(const struct encode_thread *encode_thread)
{
    const uint64_t one = 1;

    if (write(encode_thread->wake_fd, &one, sizeof one) < 0) {
        /* The counter is full, so the reader is awake anyway. */
    }
}

static void finish(struct encode_thread *encode_thread, struct work *work)
{
    struct work **at = &encode_thread->works;

    while (*at != work) {
        at = &(*at)->next;
    }
    *at = work->next;
    append(&encode_thread->done, work);
    wake_owner(encode_thread);
}

/* One step of a picture, without the lock. False: it was the last. */
static bool encode(struct encode_thread *encode_thread, struct work *work)
{
    struct rows *rows = work->rows;
    const bool wanted = !work->ended || work->whole;
    const uint64_t start = now_us();

    pthread_mutex_unlock(&encode_thread->lock);
    if (wanted && rows) {
        work->failed = !encode_slice(work, rows);
    } else if (wanted) {
        work->result.ok =
            stream_encoder_end(work->stream, &work->result.packet, &work->result.error);
    }
    work->result.encode_us += (uint32_t)(now_us() - start);
    pthread_mutex_lock(&encode_thread->lock);
    if (!wanted || !rows || work->failed) {
        finish(encode_thread, work);
        return false;
    }
    if (rows->taken == rows->image.height) {
        drop_rows(work);
        wake_owner(encode_thread);
    }
    return true;
}

/* Without the lock. Where one client draws alone, encoding goes on beside that. */
static void give_way(struct encode_thread *encode_thread)
{
    pthread_mutex_unlock(&encode_thread->lock);
    patient_give_way(PATIENT_SHARED);
    pthread_mutex_lock(&encode_thread->lock);
}

static void serve(struct encode_thread *encode_thread, enum lane lane)
{
    pthread_mutex_lock(&encode_thread->lock);
    while (!encode_thread->stop) {
        if (!find_next(encode_thread, lane)) {
            pthread_cond_wait(&encode_thread->change[lane], &encode_thread->lock);
            continue;
        }
        if (lane == LANE_PATIENT) {
            give_way(encode_thread);
        }
        encode(encode_thread, find_next(encode_thread, lane)); /* that may be another one now */
    }
    pthread_mutex_unlock(&encode_thread->lock);
}

static void *serve_urgent(void *data)
{
    serve(data, LANE_URGENT);
    return NULL;
}

static void *serve_patient(void *data)
{
    serve(data, LANE_PATIENT);
    return NULL;
}

/* --- for the owner --- */

static bool start_threads(struct encode_thread *encode_thread)
{
    pthread_t *threads = encode_thread->threads;

    slice_short(); /* it encodes a picture and waits for the next; drawing never waits */
    const bool urgent =
        pthread_create(&threads[LANE_URGENT], NULL, serve_urgent, encode_thread) == 0;
    slice_drawing();
    if (!urgent) {
        return false;
    }
    encode_thread->started++;
    if (!patient_create(&threads[LANE_PATIENT], serve_patient, encode_thread)) {
        return false;
    }
    encode_thread->started++;
    return true;
}

struct encode_thread *encode_thread_create(int wake_fd, struct error *err)
{
    struct encode_thread *encode_thread = memory_alloc(1, sizeof *encode_thread);

    encode_thread->wake_fd = wake_fd;
    pthread_mutex_init(&encode_thread->lock, NULL);
    for (int lane = 0; lane < LANES; lane++) {
        pthread_cond_init(&encode_thread->change[lane], NULL);
    }
    if (!start_threads(encode_thread)) {
        error_set(err, ERROR_UNAVAILABLE, "", "no thread for encoding pictures");
        encode_thread_destroy(encode_thread);
        return NULL;
    }
    return encode_thread;
}

void encode_thread_destroy(struct encode_thread *encode_thread)
{
    struct work *left;

    if (!encode_thread) {
        return;
    }
    pthread_mutex_lock(&encode_thread->lock);
    encode_thread->stop = true;
    for (int lane = 0; lane < LANES; lane++) {
        pthread_cond_signal(&encode_thread->change[lane]);
    }
    pthread_mutex_unlock(&encode_thread->lock);
    while (encode_thread->started > 0) {
        pthread_join(encode_thread->threads[--encode_thread->started], NULL);
    }
    while ((left = take_first(&encode_thread->works)) ||
           (left = take_first(&encode_thread->done))) {
        encoding_destroy(&left->result);
    }
    for (int lane = 0; lane < LANES; lane++) {
        pthread_cond_destroy(&encode_thread->change[lane]);
    }
    pthread_mutex_destroy(&encode_thread->lock);
    free(encode_thread);
}

struct encoding *encode_thread_begin(struct encode_thread *encode_thread,
                                     struct stream_encoder *stream,
                                     const struct image shapes[AOV_COUNT],
                                     const struct encode_params *params, int priority, void *data,
                                     struct error *err)
{
    struct work *work = memory_alloc(1, sizeof *work);

    work->out = open_memstream(&work->bytes, &work->length);
    if (!work->out) {
        abort();
    }
    work->stream = stream;
    if (!stream_encoder_begin(stream, shapes, params, work->out, err)) {
        encoding_destroy(&work->result);
        return NULL;
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        work->pixels += (uint64_t)shapes[i].width * (uint64_t)shapes[i].height;
    }
    work->is_small = params->format == CODEC_JPEG && work->pixels <= SMALL_PIXELS;
    work->result.priority = priority;
    work->result.data = data;
    pthread_mutex_lock(&encode_thread->lock);
    append(&encode_thread->works, work);
    pthread_mutex_unlock(&encode_thread->lock);
    return &work->result;
}

static struct work *work_of(struct encoding *encoding)
{
    return (struct work *)(void *)encoding;
}

/* The thread that the picture is for, alone: one that is woken for nothing takes the lock, and may
 * wait for a processor then. */
static void wake_thread(struct encode_thread *encode_thread, const struct work *work)
{
    if (!work->is_small) {
        pthread_cond_signal(&encode_thread->change[lane_of(work)]);
    }
}

void encode_thread_add(struct encode_thread *encode_thread, struct encoding *encoding, enum aov aov,
                       struct image image)
{
    struct work *work = work_of(encoding);
    struct rows *rows = memory_alloc(1, sizeof *rows), **end = &work->rows;

    *rows = (struct rows){.aov = aov, .image = image};
    pthread_mutex_lock(&encode_thread->lock);
    while (*end) {
        end = &(*end)->next;
    }
    *end = rows;
    work->waiting_bytes += image.bytes;
    wake_thread(encode_thread, work);
    pthread_mutex_unlock(&encode_thread->lock);
}

void encode_thread_end(struct encode_thread *encode_thread, struct encoding *encoding, bool whole)
{
    struct work *work = work_of(encoding);

    pthread_mutex_lock(&encode_thread->lock);
    const bool is_mine = work->is_small && !work->ended;
    work->ended = true;
    work->whole = whole;
    while (is_mine && encode(encode_thread, work)) {
    }
    wake_thread(encode_thread, work);
    pthread_mutex_unlock(&encode_thread->lock);
}

bool encode_thread_is_full(struct encode_thread *encode_thread, const struct encoding *encoding)
{
    const struct work *work = (const struct work *)(const void *)encoding;
    bool full;

    pthread_mutex_lock(&encode_thread->lock);
    full = work->waiting_bytes > FULL_BYTES;
    pthread_mutex_unlock(&encode_thread->lock);
    return full;
}

struct encoding *encode_thread_take(struct encode_thread *encode_thread)
{
    struct work *work;

    pthread_mutex_lock(&encode_thread->lock);
    work = take_first(&encode_thread->done);
    pthread_mutex_unlock(&encode_thread->lock);
    if (!work) {
        return NULL;
    }
    fclose(work->out); /* sets `bytes` and `length` */
    work->out = NULL;
    work->result.bytes = (uint8_t *)work->bytes;
    work->result.length = work->length;
    return &work->result;
}

void encoding_destroy(struct encoding *encoding)
{
    struct work *work = encoding ? work_of(encoding) : NULL;

    if (!work) {
        return;
    }
    while (work->rows) {
        drop_rows(work);
    }
    if (work->out) {
        fclose(work->out);
    }
    free(work->bytes);
    free(work);
}
