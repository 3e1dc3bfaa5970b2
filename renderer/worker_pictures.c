/* SPDX-License-Identifier: MIT */
/* The pictures that the render process draws: tile by tile, then encoded by another thread. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "worker_parts.h"

enum {
    PROGRESS_US = 1000000, /* how often a long picture is told to go on */
    SHARED_US = 1000000,   /* a client that has been here will be back */
};

static uint64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

void worker_drop_task(struct worker *w, struct task **at)
{
    struct task *gone = *at;

    *at = gone->next;
    turns_leave(&w->turns, gone->turn);
    job_destroy(gone->job);
    stream_encoder_close(gone->stream);
    free(gone->scene);
    free(gone);
}

static bool begin_encoding(struct worker *w, struct task *task, struct error *err)
{
    struct image shapes[AOV_COUNT];

    for (int i = 0; i < AOV_COUNT; i++) {
        shapes[i] = job_image_shape(task->job, (enum aov)i);
        task->width = shapes[i].width ? shapes[i].width : task->width;
        task->height = shapes[i].width ? shapes[i].height : task->height;
    }
    task->encoding =
        encoder_begin(w->encoder, task->stream, shapes, &task->encode, task->priority, task, err);
    return task->encoding;
}

/* The picture's job and its encoding. */
static bool begin_task(struct worker *w, const struct packet_render *packet, struct task *task,
                       struct error *err)
{
    const struct worker_scene *entry = *worker_find_scene(w, task->scene);
    struct job_desc desc = job_desc_of(packet->request);

    if (!entry) {
        return error_set(err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", task->scene);
    }
    desc.careful = packet->careful;
    desc.patience = packet->patience;
    task->encode = encode_params_of(packet->request);
    task->stream = stream_encoder_open(&picture_stream);
    if (render_request_is(packet->request, "key")) {
        stream_encoder_ask_key(task->stream);
    }
    task->encode.limit_bytes = LIMIT_IMAGE_BYTES;
    task->job = job_create(entry->resident, &desc, err);
    if (!task->job) {
        return false;
    }
    task->revision = job_revision(task->job);
    task->newest = task->revision == resident_revision(entry->resident);
    return begin_encoding(w, task, err);
}

/* Somebody else's picture waits too. */
static bool has_company(const struct worker *w, const struct turn *turn)
{
    const struct task *task = w->tasks;

    while (task && task->turn == turn) {
        task = task->next;
    }
    return task;
}

void worker_on_render(struct worker *w, const struct packet_render *packet,
                      const struct error *malformed)
{
    struct task *task = memory_alloc(1, sizeof *task);
    struct task **last = &w->tasks;
    struct error err = *malformed;

    task->number = packet->job;
    task->scene = memory_text(packet->scene);
    task->turn = turns_join(&w->turns, *packet->account ? packet->account : packet->scene);
    task->priority = packet->priority;
    task->received_us = task->told_us = now_us();
    if (err.kind != ERROR_NONE || !begin_task(w, packet, task, &err)) {
        worker_send_failed(w, task->number, &err, false);
        worker_drop_task(w, &task);
        return;
    }
    if (has_company(w, task->turn)) {
        w->shared_until_us = task->received_us + SHARED_US;
    }
    while (*last) {
        last = &(*last)->next;
    }
    *last = task;
}

/* It stays until the encoder gives it back. */
static void give_up(struct worker *w, struct task *task)
{
    task->answered = true;
    job_destroy(task->job);
    task->job = NULL;
    if (!task->between) {
        encoder_end(w->encoder, task->encoding, false);
    }
}

void worker_on_cancel(struct worker *w, uint32_t job)
{
    for (struct task *task = w->tasks; task; task = task->next) {
        if (task->number == job) {
            give_up(w, task);
            return;
        }
    }
}

static bool is_drawing(const struct task *task)
{
    return task->job && !task->between;
}

/* In the middle of a tile; NULL: none. */
static struct task *find_within_tile(const struct worker *w)
{
    struct task *task = w->tasks;

    while (task && !(is_drawing(task) && job_is_within_tile(task->job))) {
        task = task->next;
    }
    return task;
}

/* Waits for neither a compiler nor the encoder. */
static bool can_go_on(const struct worker *w, const struct task *task)
{
    return job_step_possible(task->job) && !encoder_is_full(w->encoder, task->encoding);
}

/* That of the account whose turn it is. Who would need the textures that another's tile is in lets
 * that go on in its own turn, so the tile is as urgent as whatever waits for it. */
struct task *worker_choose_task(struct worker *w)
{
    struct task *within = find_within_tile(w);

    turns_begin(&w->turns);
    for (struct task *task = w->tasks; task; task = task->next) {
        if (is_drawing(task) && (task == within || can_go_on(w, task))) {
            const struct turns_offer offer = {task->priority,
                                              (uint64_t)task->width * (uint64_t)task->height,
                                              within && job_is_sampled(task->job) ? within : task};

            turns_offer(&w->turns, task->turn, &offer);
        }
    }
    return turns_choose(&w->turns);
}

static void hand_rows_over(struct worker *w, struct task *task)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const enum aov aov = (enum aov)i;

        if (job_image_shape(task->job, aov).width > 0) {
            encoder_add(w->encoder, task->encoding, aov, job_take_rows(task->job, aov));
        }
    }
    if (now_us() - task->told_us > PROGRESS_US) {
        task->told_us = now_us();
        worker_send(w, &(struct packet){.kind = TO_FRONT_PROGRESS, .job = {task->number}});
    }
}

static void take_times(struct task *task)
{
    task->times = job_times(task->job);
    task->rounds = job_rounds(task->job);
    task->times.us[FRAME_QUEUE] = (uint32_t)(task->begun_us - task->received_us);
}

/* The next one begins when this one is encoded. */
static void finish_round(struct worker *w, struct task *task)
{
    take_times(task);
    task->between = true;
    encoder_end(w->encoder, task->encoding, true);
}

static void finish_drawing(struct worker *w, struct task *task)
{
    take_times(task);
    job_destroy(task->job);
    task->job = NULL;
    encoder_end(w->encoder, task->encoding, true);
}

/* What is drawn from here on, if anything: the front knows it should this be the end. */
static void tell_drawing(struct worker *w, const struct task *task)
{
    const uint32_t job = task ? task->number : 0;

    if (job == w->told_job) {
        return;
    }
    w->told_job = job;
    worker_send_suspect(w, TO_FRONT_DRAWING,
                        &(struct packet_suspect){.scene = task ? task->scene : "", .job = job});
    if (task) {
        worker_flush_all(w);
    }
}

/* What its tiles have taken so far. */
static uint64_t drawn_us(const struct task *task)
{
    const struct job_times times = job_times(task->job);
    uint64_t us = 0;

    for (int i = 0; i < FRAME_STAGES; i++) {
        us += times.us[i];
    }
    return us;
}

static enum job_state step(struct worker *w, struct task *task)
{
    renderer_share(w->renderer, now_us() < w->shared_until_us);
    const uint64_t before = drawn_us(task);
    const enum job_state state = job_step(task->job);

    turns_charge(&w->turns, task->turn, task->priority, drawn_us(task) - before);
    return state;
}

void worker_step(struct worker *w, struct task *task)
{
    tell_drawing(w, task);
    if (!task) {
        return;
    }
    if (task->begun_us == 0) {
        task->begun_us = now_us();
    }
    switch (step(w, task)) {
    case JOB_WAITING:
    case JOB_RUNNING:
        break;
    case JOB_ROWS:
        hand_rows_over(w, task);
        break;
    case JOB_ROUND:
        finish_round(w, task);
        break;
    case JOB_DONE:
        finish_drawing(w, task);
        break;
    case JOB_FAILED:
        worker_send_failed(w, task->number, job_error(task->job), true);
        if (job_error(task->job)->kind == ERROR_UNAVAILABLE) {
            w->status = WORKER_DEVICE_LOST;
        }
        give_up(w, task);
        break;
    }
}

/* True when there is more to come. */
static bool answer(struct worker *w, struct task *task)
{
    struct error err = task->encoding->error;

    if (task->answered) {
        return false;
    }
    task->times.us[FRAME_ENCODE] = task->encoding->encode_us;
    if (task->encoding->ok) {
        worker_send_frame(w, task);
        if (!task->between || begin_encoding(w, task, &err)) {
            return task->between;
        }
    }
    worker_send_failed(w, task->number, &err, false);
    return false;
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
        if (answer(w, *at)) {
            (*at)->between = false;
        } else {
            worker_drop_task(w, at);
        }
        encoding_destroy(encoding);
    }
}
