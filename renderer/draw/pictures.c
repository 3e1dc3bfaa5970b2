/* SPDX-License-Identifier: MIT */
#include "pictures.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/memory.h"
#include "renderer/crash.h"
#include "renderer/image/decode.h"
#include "renderer/patient.h"

struct picture {
    struct asset *asset;
    int references;
    bool done;
    struct engine_map maps[ENGINE_MAPS]; /* levels 0: none */
    struct error err;                    /* the file's own words */
    struct error problem;
    uint32_t us;
    struct picture *next;
};

struct pictures {
    pthread_t thread;
    struct picture *first; /* in order of arrival */
    struct picture *reading;
    int64_t begun_cpu_us;
    int limit_ms;

    pthread_mutex_t lock; /* guards what follows, and the picture in it while it is read */
    pthread_cond_t change;
    struct picture *work;
    bool worked, stop;
};

static int64_t clock_in_us(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

/* --- the thread --- */

static void give_way(void)
{
    patient_give_way(PATIENT_ALONE);
}

static void read_file(struct picture *picture)
{
    static const struct frame_uniforms any = {.sky_kind = SKY_IMAGE}; /* a picture needs no more */
    const struct asset *asset = picture->asset;
    struct decoded decoded = {0};

    if (image_decode(asset->bytes, asset->length, give_way, &decoded, &picture->err)) {
        engine_maps_make(&any, decoded.rgba, decoded.width, decoded.height, picture->maps);
    }
}

static void *work(void *data)
{
    struct pictures *pictures = data;

    crash_thread(CRASH_READING);
    pthread_mutex_lock(&pictures->lock);
    while (!pictures->stop) {
        struct picture *picture = pictures->work;

        if (!picture || pictures->worked) {
            pthread_cond_wait(&pictures->change, &pictures->lock);
            continue;
        }
        pthread_mutex_unlock(&pictures->lock);
        const int64_t begun = clock_in_us(CLOCK_MONOTONIC);
        read_file(picture);
        picture->us = (uint32_t)(clock_in_us(CLOCK_MONOTONIC) - begun);
        pthread_mutex_lock(&pictures->lock);
        pictures->worked = true;
        pthread_cond_broadcast(&pictures->change);
    }
    pthread_mutex_unlock(&pictures->lock);
    return NULL;
}

/* --- the list --- */

static void forget(struct pictures *pictures, struct picture *picture)
{
    struct picture **at = &pictures->first;

    while (*at != picture) {
        at = &(*at)->next;
    }
    *at = picture->next;
    asset_unref(picture->asset);
    engine_maps_finish(picture->maps);
    free(picture);
}

struct picture *pictures_want(struct pictures *pictures, struct asset *asset)
{
    struct picture **at = &pictures->first;

    while (*at && strcmp((*at)->asset->id, asset->id) != 0) {
        at = &(*at)->next;
    }
    if (!*at) {
        *at = memory_alloc(1, sizeof **at);
        (*at)->asset = asset_ref(asset);
    }
    (*at)->references++;
    return *at;
}

/* What is being read stays until it was. */
void picture_unref(struct pictures *pictures, struct picture *picture)
{
    if (picture && --picture->references == 0 && picture != pictures->reading) {
        forget(pictures, picture);
    }
}

const char *picture_id(const struct picture *picture)
{
    return picture->asset->id;
}

bool picture_is_done(const struct picture *picture)
{
    return picture->done;
}

struct engine_map *picture_maps(struct picture *picture)
{
    return picture->maps[0].levels > 0 ? picture->maps : NULL;
}

const struct error *picture_problem(const struct picture *picture)
{
    return &picture->problem;
}

uint32_t picture_us(const struct picture *picture)
{
    return picture->us;
}

/* --- reading --- */

struct picture *pictures_next(struct pictures *pictures, struct picture **out_reading)
{
    struct picture *next = pictures->first;

    *out_reading = pictures->reading;
    while (next && next->done) {
        next = next->next;
    }
    return pictures->reading ? NULL : next;
}

void pictures_allow(struct pictures *pictures, struct picture *picture, int limit_ms)
{
    pictures->reading = picture;
    pictures->begun_cpu_us = pictures_cpu_us(pictures);
    pictures->limit_ms = limit_ms;
    pthread_mutex_lock(&pictures->lock);
    pictures->work = picture;
    pictures->worked = false;
    pthread_cond_broadcast(&pictures->change);
    pthread_mutex_unlock(&pictures->lock);
}

/* Whether it was read, at the latest when the time is over. */
static bool wait_for_it(struct pictures *pictures, int wait_ms)
{
    struct timespec until;
    bool worked;

    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += (long)(wait_ms % 1000) * 1000000;
    until.tv_sec += wait_ms / 1000 + until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_mutex_lock(&pictures->lock);
    while (wait_ms > 0 && !pictures->worked &&
           pthread_cond_clockwait(&pictures->change, &pictures->lock, CLOCK_MONOTONIC, &until) ==
               0) {
    }
    worked = pictures->worked;
    pthread_mutex_unlock(&pictures->lock);
    return worked;
}

bool pictures_collect(struct pictures *pictures, int wait_ms)
{
    static const char place[] = "/environment/image";
    struct picture *picture = pictures->reading;

    if (!picture || !wait_for_it(pictures, wait_ms)) {
        return false;
    }
    pictures->reading = NULL;
    picture->done = true;
    if (picture->err.kind != ERROR_NONE) {
        error_set(&picture->problem, picture->err.kind, place, "%s", picture->err.message);
        picture->asset->problem = picture->problem;
    }
    if (picture->references == 0) {
        forget(pictures, picture);
    }
    return true;
}

int64_t pictures_cpu_us(const struct pictures *pictures)
{
    clockid_t clock;

    return pthread_getcpuclockid(pictures->thread, &clock) == 0 ? clock_in_us(clock) : 0;
}

bool pictures_stuck(const struct pictures *pictures, struct pictures_stuck *out)
{
    const int64_t spent_us =
        pictures->reading ? pictures_cpu_us(pictures) - pictures->begun_cpu_us : 0;

    if (spent_us <= (int64_t)pictures->limit_ms * 1000) {
        return false;
    }
    *out = (struct pictures_stuck){picture_id(pictures->reading), (int)(spent_us / 1000),
                                   pictures->limit_ms};
    return true;
}

/* --- birth and death --- */

struct pictures *pictures_create(void)
{
    struct pictures *pictures = memory_alloc(1, sizeof *pictures);

    pthread_mutex_init(&pictures->lock, NULL);
    pthread_cond_init(&pictures->change, NULL);
    if (!patient_create(&pictures->thread, work, pictures)) {
        abort();
    }
    return pictures;
}

void pictures_destroy(struct pictures *pictures)
{
    if (!pictures) {
        return;
    }
    pthread_mutex_lock(&pictures->lock);
    pictures->stop = true;
    pthread_cond_broadcast(&pictures->change);
    pthread_mutex_unlock(&pictures->lock);
    pthread_join(pictures->thread, NULL);
    pictures->reading = NULL;
    while (pictures->first) {
        forget(pictures, pictures->first);
    }
    pthread_cond_destroy(&pictures->change);
    pthread_mutex_destroy(&pictures->lock);
    free(pictures);
}
