/* SPDX-License-Identifier: MIT */
/* Two lists under one lock: what is to be encoded, and what is done. */
#include "encoder.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "protocol/memory.h"

struct encoder {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t work;
    struct encoding *waiting, *done;
    bool stop;
    int wake_fd;
};

static uint64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

static void append(struct encoding **list, struct encoding *encoding)
{
    while (*list) {
        list = &(*list)->next;
    }
    encoding->next = NULL;
    *list = encoding;
}

static struct encoding *take_first(struct encoding **list)
{
    struct encoding **best = list;
    struct encoding *taken;

    for (struct encoding **at = list; *at; at = &(*at)->next) {
        if ((*at)->priority < (*best)->priority) {
            best = at;
        }
    }
    taken = *best;
    if (taken) {
        *best = taken->next;
        taken->next = NULL;
    }
    return taken;
}

static void encode(struct encoding *e)
{
    const uint64_t start = now_us();

    e->ok = image_encode(&e->image, &e->params, &e->bytes, &e->length, &e->error);
    e->encode_us = (uint32_t)(now_us() - start);
    image_finish(&e->image);
}

static void *thread_main(void *data)
{
    struct encoder *encoder = data;
    const uint64_t one = 1;

    pthread_mutex_lock(&encoder->lock);
    while (!encoder->stop) {
        struct encoding *encoding = take_first(&encoder->waiting);
        if (!encoding) {
            pthread_cond_wait(&encoder->work, &encoder->lock);
            continue;
        }
        pthread_mutex_unlock(&encoder->lock);
        encode(encoding);
        pthread_mutex_lock(&encoder->lock);
        append(&encoder->done, encoding);
        if (write(encoder->wake_fd, &one, sizeof one) < 0) {
            /* The counter is full, so the reader is awake anyway. */
        }
    }
    pthread_mutex_unlock(&encoder->lock);
    return NULL;
}

struct encoder *encoder_create(int wake_fd, struct error *err)
{
    struct encoder *encoder = memory_alloc(1, sizeof *encoder);

    encoder->wake_fd = wake_fd;
    pthread_mutex_init(&encoder->lock, NULL);
    pthread_cond_init(&encoder->work, NULL);
    if (pthread_create(&encoder->thread, NULL, thread_main, encoder) != 0) {
        error_set(err, ERROR_UNAVAILABLE, "", "no thread for encoding pictures");
        pthread_cond_destroy(&encoder->work);
        pthread_mutex_destroy(&encoder->lock);
        free(encoder);
        return NULL;
    }
    return encoder;
}

void encoder_destroy(struct encoder *encoder)
{
    struct encoding *left;

    if (!encoder) {
        return;
    }
    pthread_mutex_lock(&encoder->lock);
    encoder->stop = true;
    pthread_cond_signal(&encoder->work);
    pthread_mutex_unlock(&encoder->lock);
    pthread_join(encoder->thread, NULL);
    while ((left = take_first(&encoder->waiting)) || (left = take_first(&encoder->done))) {
        encoding_destroy(left);
    }
    pthread_cond_destroy(&encoder->work);
    pthread_mutex_destroy(&encoder->lock);
    free(encoder);
}

void encoder_add(struct encoder *encoder, struct encoding *encoding)
{
    pthread_mutex_lock(&encoder->lock);
    append(&encoder->waiting, encoding);
    pthread_cond_signal(&encoder->work);
    pthread_mutex_unlock(&encoder->lock);
}

struct encoding *encoder_take(struct encoder *encoder)
{
    struct encoding *encoding;

    pthread_mutex_lock(&encoder->lock);
    encoding = encoder->done;
    if (encoding) {
        encoder->done = encoding->next;
        encoding->next = NULL;
    }
    pthread_mutex_unlock(&encoder->lock);
    return encoding;
}

void encoding_destroy(struct encoding *encoding)
{
    if (encoding) {
        image_finish(&encoding->image);
        free(encoding->bytes);
        free(encoding);
    }
}
