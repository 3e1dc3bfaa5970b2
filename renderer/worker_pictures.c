/* SPDX-License-Identifier: MIT */
/* The pictures that the render process draws: tile by tile, then encoded by another thread. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "protocol/messages.h"
#include "worker_parts.h"

enum { OLDEST_EVERY = 8 }; /* tiles */

uint64_t worker_now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

void worker_drop_task(struct task **at)
{
    struct task *gone = *at;

    *at = gone->next;
    job_destroy(gone->job);
    free(gone->scene);
    free(gone);
}

static bool read_format(const cJSON *packet, struct encode_params *out, struct error *err)
{
    const int format = image_format_find(json_member_text(packet, "format", "png"));

    if (format < 0) {
        return error_set(err, ERROR_INVALID, "format", "\"%s\" is not png, jpg or npy",
                         json_member_text(packet, "format", ""));
    }
    *out = (struct encode_params){
        .format = (enum image_format)format,
        .quality = (int)json_member_number(packet, "quality", 0),
        .chroma_halved = json_member_bool(packet, "chroma_halved", false),
        .fast = json_member_bool(packet, "fast", false),
    };
    return true;
}

bool worker_read_camera(const cJSON *packet, struct record *out, bool *out_given, struct error *err)
{
    const cJSON *camera = cJSON_GetObjectItemCaseSensitive(packet, "camera");

    *out_given = camera != NULL;
    return !camera || record_read(out, camera, "/camera", err);
}

int worker_read_int(const cJSON *packet, const char *name, int fallback)
{
    const double value = json_member_number(packet, name, fallback);

    return value >= 0 && value < 1e9 ? (int)value : -1;
}

static struct job *make_job(struct worker *w, const cJSON *packet, struct task *task,
                            struct error *err)
{
    const char *name = json_member_text(packet, "scene", "");
    const char *aov_text = json_member_text(packet, "aov", "color");
    const int aov = aov_find(aov_text);
    struct held *held = *worker_find_scene(w, name);
    struct record camera;
    struct job *job = NULL;
    bool given;

    if (!held) {
        error_set(err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", name);
        return NULL;
    }
    if (aov < 0) {
        error_set(err, ERROR_INVALID, "aov", "\"%s\" is not color, depth, normal or id", aov_text);
        return NULL;
    }
    record_init(&camera, &camera_type);
    if (read_format(packet, &task->encode, err) &&
        worker_read_camera(packet, &camera, &given, err)) {
        const struct job_desc desc = {
            .width = worker_read_int(packet, "width", 0),
            .height = worker_read_int(packet, "height", 0),
            .camera = given ? &camera : NULL,
            .aov = (enum aov)aov,
            .samples = worker_read_int(packet, "samples", 0),
            .exact = json_member_bool(packet, "exact", false),
            .as_floats = task->encode.format == IMAGE_NPY,
        };
        task->width = desc.width;
        task->height = desc.height;
        job = job_create(held->resident, &desc, err);
    }
    record_finish(&camera);
    if (job) {
        task->revision = job_revision(job);
        task->newest = task->revision == resident_revision(held->resident);
    }
    return job;
}

void worker_on_render(struct worker *w, const cJSON *packet)
{
    struct task *task = memory_alloc(1, sizeof *task);
    struct task **last = &w->tasks;
    struct error err = {0};

    task->number = (uint64_t)json_member_number(packet, "job", 0);
    task->scene = memory_text(json_member_text(packet, "scene", ""));
    task->priority = (int)json_member_number(packet, "priority", 0);
    task->received_us = worker_now_us();
    task->job = make_job(w, packet, task, &err);
    if (!task->job) {
        worker_send_failed(w, task->number, &err);
        worker_drop_task(&task);
        return;
    }
    while (*last) {
        last = &(*last)->next;
    }
    *last = task;
}

void worker_on_cancel(struct worker *w, const cJSON *packet)
{
    const uint64_t number = (uint64_t)json_member_number(packet, "job", 0);

    for (struct task **at = &w->tasks; *at; at = &(*at)->next) {
        if ((*at)->number == number) {
            if ((*at)->job) {
                worker_drop_task(at);
            } else {
                (*at)->cancelled = true;
            }
            return;
        }
    }
}

/* Now and then the oldest, so that a stream of urgent ones cannot stop a picture for good.
 * Those waiting for a compiler let others pass. */
struct task **worker_choose_task(struct worker *w)
{
    const bool oldest = w->steps % OLDEST_EVERY == 0;
    struct task **best = NULL;

    for (struct task **at = &w->tasks; *at; at = &(*at)->next) {
        if ((*at)->job && (!best || (!oldest && (*at)->priority < (*best)->priority)) &&
            job_step_possible((*at)->job)) {
            best = at;
        }
    }
    return best;
}

static void hand_to_encoder(struct worker *w, struct task *task)
{
    struct encoding *encoding = memory_alloc(1, sizeof *encoding);

    encoding->job = task->number;
    encoding->priority = task->priority;
    encoding->params = task->encode;
    encoding->data = task;
    task->times = job_times(task->job);
    encoding->image = job_take_image(task->job);
    job_destroy(task->job);
    task->job = NULL;
    encoder_add(w->encoder, encoding);
}

/* Whose code draws from here on, if anybody's. */
static void tell_drawing(struct worker *w, const struct task *task)
{
    const uint64_t shape = task ? job_shape_with_code(task->job) : 0;

    if (shape == w->told_drawing) {
        return;
    }
    w->told_drawing = shape;
    worker_send_suspect(w, "drawing", shape ? task->scene : "", shape ? task->revision : 0, shape);
    if (shape) {
        worker_flush_all(w);
    }
}

void worker_step(struct worker *w, struct task **at)
{
    struct task *task = at ? *at : NULL;

    tell_drawing(w, task);
    if (!task) {
        return;
    }
    w->steps++;
    if (task->begun_us == 0) {
        task->begun_us = worker_now_us();
    }
    switch (job_step(task->job)) {
    case JOB_WAITING:
    case JOB_RUNNING:
        break;
    case JOB_DONE:
        hand_to_encoder(w, task);
        break;
    case JOB_FAILED:
        worker_send_failed(w, task->number, job_error(task->job));
        if (job_error(task->job)->kind == ERROR_UNAVAILABLE) {
            w->status = WORKER_DEVICE_LOST;
        }
        worker_drop_task(at);
        break;
    }
}

void worker_collect_encodings(struct worker *w)
{
    struct encoding *encoding;
    uint64_t count;

    if (read(w->wake_fd, &count, sizeof count) < 0) {
        return;
    }
    while ((encoding = encoder_take(w->encoder))) {
        struct task **at = &w->tasks;
        while (*at != encoding->data) {
            at = &(*at)->next;
        }
        if (!(*at)->cancelled && encoding->ok) {
            worker_send_frame(w, *at, encoding);
        } else if (!(*at)->cancelled) {
            worker_send_failed(w, (*at)->number, &encoding->error);
        }
        worker_drop_task(at);
        encoding_destroy(encoding);
    }
}
