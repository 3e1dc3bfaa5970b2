/* SPDX-License-Identifier: MIT */
#include "scene_reader.h"

#include <pthread.h>
#include <stdlib.h>
#include <time.h>

#include "protocol/memory.h"
#include "renderer/crash.h"
#include "renderer/field/field.h"
#include "renderer/patient.h"
#include "renderer/portrait.h"

struct scene_reader {
    pthread_t thread;
    bool reading;
    int64_t begun_cpu_us;

    pthread_mutex_t lock; /* guards what follows; without it, what is read belongs to the thread */
    pthread_cond_t change;
    struct scene_document document;
    struct opened_scene opened;
    bool given, done, stop;
};

struct opened_scene scene_document_open(const struct scene_document *document)
{
    struct opened_scene opened = {0};

    if (document->scene) {
        return opened_scene_make(document->scene, document->drawn);
    }
    /* Both ends are ours, so the strict reading of strangers' JSON is left out. */
    cJSON *json = cJSON_ParseWithLength(document->text, document->length);

    if (!json) {
        error_set(&opened.error, ERROR_SYNTAX, "", "the document is not JSON");
        return opened;
    }
    struct scene *scene =
        document->portrait ? portrait_scene(json, &opened.error) : scene_read(json, &opened.error);
    cJSON_Delete(json);
    return scene ? opened_scene_make(scene, document->drawn) : opened;
}

static void *work(void *data)
{
    struct scene_reader *reader = data;

    crash_thread(CRASH_OPENING);
    pthread_mutex_lock(&reader->lock);
    while (!reader->stop) {
        if (!reader->given) {
            pthread_cond_wait(&reader->change, &reader->lock);
            continue;
        }
        const struct scene_document document = reader->document;
        pthread_mutex_unlock(&reader->lock);
        const struct opened_scene opened = scene_document_open(&document);
        pthread_mutex_lock(&reader->lock);
        reader->opened = opened;
        reader->given = false;
        reader->done = true;
    }
    pthread_mutex_unlock(&reader->lock);
    return NULL;
}

static int64_t cpu_us(const struct scene_reader *reader)
{
    clockid_t clock;
    struct timespec t = {0};

    if (pthread_getcpuclockid(reader->thread, &clock) == 0) {
        clock_gettime(clock, &t);
    }
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

void scene_reader_begin(struct scene_reader *reader, const struct scene_document *document)
{
    reader->reading = true;
    reader->begun_cpu_us = cpu_us(reader);
    pthread_mutex_lock(&reader->lock);
    reader->document = *document;
    reader->given = true;
    pthread_cond_signal(&reader->change);
    pthread_mutex_unlock(&reader->lock);
}

bool scene_reader_take(struct scene_reader *reader, struct opened_scene *out)
{
    bool done;

    pthread_mutex_lock(&reader->lock);
    done = reader->done;
    if (done) {
        *out = reader->opened;
        reader->opened = (struct opened_scene){0};
        reader->done = false;
        reader->reading = false;
    }
    pthread_mutex_unlock(&reader->lock);
    return done;
}

bool scene_reader_stuck(const struct scene_reader *reader)
{
    return reader->reading && cpu_us(reader) - reader->begun_cpu_us > (int64_t)LIMIT_OPEN_MS * 1000;
}

struct scene_reader *scene_reader_create(void)
{
    struct scene_reader *reader = memory_alloc(1, sizeof *reader);

    pthread_mutex_init(&reader->lock, NULL);
    pthread_cond_init(&reader->change, NULL);
    if (!patient_create(&reader->thread, work, reader)) {
        abort();
    }
    return reader;
}

void scene_reader_destroy(struct scene_reader *reader)
{
    if (!reader) {
        return;
    }
    pthread_mutex_lock(&reader->lock);
    reader->stop = true;
    pthread_cond_signal(&reader->change);
    pthread_mutex_unlock(&reader->lock);
    pthread_join(reader->thread, NULL);
    if (!reader->document.scene) {
        scene_destroy(reader->opened.scene);
    }
    field_unref(reader->opened.field);
    pthread_cond_destroy(&reader->change);
    pthread_mutex_destroy(&reader->lock);
    free(reader);
}
