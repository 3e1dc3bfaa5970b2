/* SPDX-License-Identifier: MIT */
/* The pictures that the render process draws: tile by tile, then encoded by another thread. */
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "delta.h"
#include "depths.h"
#include "guide.h"
#include "protocol/memory.h"
#include "renderer/crash.h"
#include "renderer/patient.h"
#include "worker_internal.h"

enum {
    PROGRESS_US = 1000000, /* how often a long picture is told to go on */
    SHARED_US = 1000000,   /* a client that has been here will be back */
    STEP_US = 8000,        /* a step in company takes, of pictures that can pause */
};

static uint64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000 + (uint64_t)t.tv_nsec / 1000;
}

void worker_drop_job(struct worker *w, struct worker_job **at)
{
    struct worker_job *gone = *at;

    *at = gone->next;
    turns_leave(&w->turns, gone->turn);
    job_destroy(gone->drawing);
    if (gone->kept) {
        kept_streams_give_back(&w->streams, gone->kept);
    } else {
        stream_encoder_close(gone->stream);
    }
    free(gone->scene);
    free(gone);
}

static bool begin_encoding(struct worker *w, struct worker_job *job, struct error *err)
{
    struct image shapes[AOV_COUNT];

    for (int i = 0; i < AOV_COUNT; i++) {
        shapes[i] = job_image_info(job->drawing, (enum aov)i);
        job->width = shapes[i].width ? shapes[i].width : job->width;
        job->height = shapes[i].width ? shapes[i].height : job->height;
    }
    if (job->kept) {
        kept_stream_begin(job->kept, job->width, job->height);
    }
    if (job->kept && (job->base == 0 || job->kept->order != job->base)) {
        stream_encoder_ask_key(job->stream);
    }
    job->encoding = encode_thread_begin(w->encode_thread, job->stream, shapes, &job->encode,
                                        job->priority, job, err);
    return job->encoding;
}

static void open_stream(struct worker *w, const struct render_request *request,
                        struct worker_job *job)
{
    const char *name = record_text(&request->delivery, "stream");
    const bool depths = render_request_is(request, "depths");

    if (*name) {
        job->kept =
            kept_streams_take(&w->streams, name, depths ? &depths_delta_stream : &delta_stream);
        job->stream = job->kept->encoder;
        job->base = (uint32_t)record_number(&request->delivery, "base");
        return;
    }
    job->stream = render_request_is(request, "guide")
                      ? stream_encoder_open(&guide_stream, job_field(job->drawing))
                  : depths ? stream_encoder_open(&depths_stream, NULL)
                           : stream_encoder_open(&picture_stream, NULL);
}

/* The picture's job and its encoding. */
static bool begin_job(struct worker *w, const struct packet_render *packet, struct worker_job *job,
                      struct error *err)
{
    const struct worker_scene *entry = *worker_find_scene(w, job->scene);
    struct job_desc desc = job_desc_of(packet->request);

    if (!entry) {
        return error_set(err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", job->scene);
    }
    desc.careful = packet->careful;
    desc.patience = packet->patience;
    job->encode = encode_params_of(packet->request);
    job->encode.limit_bytes = LIMIT_IMAGE_BYTES;
    job->drawing = job_create(entry->resident, &desc, err);
    if (!job->drawing) {
        return false;
    }
    open_stream(w, packet->request, job);
    job->revision = job_revision(job->drawing);
    job->newest = job->revision == resident_revision(entry->resident);
    return begin_encoding(w, job, err);
}

/* Somebody else's picture waits too. */
static bool has_company(const struct worker *w, const struct turn *turn)
{
    const struct worker_job *job = w->jobs;

    while (job && job->turn == turn) {
        job = job->next;
    }
    return job;
}

void worker_on_render(struct worker *w, const struct packet_render *packet,
                      const struct error *malformed)
{
    struct worker_job *job = memory_alloc(1, sizeof *job);
    struct worker_job **last = &w->jobs;
    struct error err = *malformed;

    job->number = packet->job;
    job->scene = memory_text(packet->scene);
    job->turn = turns_join(&w->turns, *packet->account ? packet->account : packet->scene);
    job->priority = packet->priority;
    job->received_us = job->told_us = now_us();
    if (err.kind != ERROR_NONE || !begin_job(w, packet, job, &err)) {
        worker_send_failed(w, job->number, &err, false);
        worker_drop_job(w, &job);
        return;
    }
    if (has_company(w, job->turn)) {
        w->shared_until_us = job->received_us + SHARED_US;
    }
    while (*last) {
        last = &(*last)->next;
    }
    *last = job;
}

/* It stays until the encoding thread gives it back. */
static void give_up(struct worker *w, struct worker_job *job)
{
    job->answered = true;
    job_destroy(job->drawing);
    job->drawing = NULL;
    if (!job->between) {
        encode_thread_end(w->encode_thread, job->encoding, false);
    }
}

void worker_on_cancel(struct worker *w, uint32_t number)
{
    for (struct worker_job *job = w->jobs; job; job = job->next) {
        if (job->number == number) {
            give_up(w, job);
            return;
        }
    }
}

static bool is_drawing(const struct worker_job *job)
{
    return job->drawing && !job->between;
}

/* In the middle of a tile; NULL: none. */
static struct worker_job *find_within_tile(const struct worker *w)
{
    struct worker_job *job = w->jobs;

    while (job && !(is_drawing(job) && job_is_within_tile(job->drawing))) {
        job = job->next;
    }
    return job;
}

/* Waits for neither a compiler nor the encoding thread. */
static bool can_go_on(const struct worker *w, const struct worker_job *job)
{
    return job_step_possible(job->drawing) &&
           !encode_thread_is_full(w->encode_thread, job->encoding);
}

static uint64_t pixels_of(const struct worker_job *job)
{
    return (uint64_t)job->width * (uint64_t)job->height;
}

/* That of the account whose turn it is. Who would need the textures that another's tile is in lets
 * that go on in its own turn, so the tile is as urgent as whatever waits for it. */
struct worker_job *worker_choose_job(struct worker *w)
{
    struct worker_job *within = find_within_tile(w);

    turns_begin(&w->turns);
    for (struct worker_job *job = w->jobs; job; job = job->next) {
        if (is_drawing(job) && (job == within || can_go_on(w, job))) {
            const struct turns_offer offer = {job->priority, pixels_of(job),
                                              within && job_is_sampled(job->drawing) ? within
                                                                                     : job};

            turns_offer(&w->turns, job->turn, &offer);
        }
    }
    return turns_choose(&w->turns);
}

static void hand_rows_over(struct worker *w, struct worker_job *job)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        const enum aov aov = (enum aov)i;

        if (job_image_info(job->drawing, aov).width > 0) {
            encode_thread_add(w->encode_thread, job->encoding, aov,
                              job_take_rows(job->drawing, aov));
        }
    }
}

/* Tiles of it are done. A row of them may take longer than the front waits. */
static void tell_progress(struct worker *w, struct worker_job *job)
{
    if (now_us() - job->told_us > PROGRESS_US) {
        job->told_us = now_us();
        worker_send(w, &(struct packet){.kind = TO_FRONT_PROGRESS, .job = {job->number}});
    }
}

static void take_times(struct worker_job *job)
{
    job->times = job_times(job->drawing);
    job->drawn_part = job_drawn_part(job->drawing);
    job->rounds = job_rounds(job->drawing);
    job->times.us[FRAME_QUEUE] = (uint32_t)(job->begun_us - job->received_us);
}

/* The next one begins when this one is encoded. */
static void finish_round(struct worker *w, struct worker_job *job)
{
    take_times(job);
    job->between = true;
    encode_thread_end(w->encode_thread, job->encoding, true);
}

static void finish_drawing(struct worker *w, struct worker_job *job)
{
    take_times(job);
    job_destroy(job->drawing);
    job->drawing = NULL;
    encode_thread_end(w->encode_thread, job->encoding, true);
}

/* What is drawn from here on, if anything: the front knows it should this be the end. */
static void tell_drawing(struct worker *w, const struct worker_job *job)
{
    const uint32_t number = job ? job->number : 0;

    if (number == w->told_job) {
        return;
    }
    w->told_job = number;
    worker_send_suspect(w, TO_FRONT_DRAWING,
                        &(struct packet_suspect){.scene = job ? job->scene : "", .job = number});
    if (job) {
        worker_flush_all(w);
    }
}

/* What its tiles have taken so far. */
static uint64_t drawn_us(const struct worker_job *job)
{
    const struct job_times times = job_times(job->drawing);
    uint64_t us = 0;

    for (int i = 0; i < FRAME_STAGES; i++) {
        us += times.us[i];
    }
    return us;
}

static enum job_state step(struct worker *w, struct worker_job *job)
{
    const uint64_t now = now_us(), before = drawn_us(job);
    const bool shared = now < w->shared_until_us;

    w->step_until_us = shared ? now + STEP_US : UINT64_MAX;
    renderer_share(w->renderer, shared);
    crash_thread(CRASH_DRAWING);
    const enum job_state state = job_step(job->drawing);
    crash_thread(CRASH_ANYWHERE);
    turns_charge(&w->turns, job->turn, job->priority, drawn_us(job) - before);
    return state;
}

bool worker_is_wanted(void *data)
{
    const struct worker *w = data;
    struct pollfd fds[2] = {{.fd = worker_documents_full(w) ? -1 : w->fd, .events = POLLIN},
                            {.fd = w->wake_fd, .events = POLLIN}};

    return poll(fds, 2, 0) > 0 || now_us() > w->step_until_us;
}

/* A step that draws, and those that take no time: a picture that is drawn is not kept waiting for
 * others' tiles. */
static enum job_state take_turn(struct worker *w, struct worker_job *job)
{
    enum job_state state = step(w, job);

    while (state == JOB_ROWS) {
        hand_rows_over(w, job);
        if (!job_is_drawn(job->drawing)) {
            break;
        }
        state = step(w, job);
    }
    return state;
}

static enum patient_drawing drawing_of(const struct worker *w, const struct worker_job *job)
{
    if (!job) {
        return PATIENT_FREE;
    }
    if (now_us() >= w->shared_until_us) {
        return PATIENT_ALONE;
    }
    return encode_is_urgent(job->priority, pixels_of(job)) ? PATIENT_URGENT : PATIENT_SHARED;
}

void worker_step(struct worker *w, struct worker_job *job)
{
    tell_drawing(w, job);
    patient_draws(drawing_of(w, job));
    if (!job) {
        return;
    }
    if (job->begun_us == 0) {
        job->begun_us = now_us();
    }
    const uint64_t tiles = renderer_counters(w->renderer).tiles;
    const enum job_state state = take_turn(w, job);

    if (renderer_counters(w->renderer).tiles > tiles) {
        tell_progress(w, job);
    }
    switch (state) {
    case JOB_WAITING:
    case JOB_RUNNING:
    case JOB_ROWS:
        break;
    case JOB_ROUND:
        finish_round(w, job);
        break;
    case JOB_DONE:
        finish_drawing(w, job);
        break;
    case JOB_FAILED:
        worker_send_failed(w, job->number, job_error(job->drawing), true);
        if (job_error(job->drawing)->kind == ERROR_UNAVAILABLE) {
            w->status = WORKER_DEVICE_LOST;
        }
        give_up(w, job);
        break;
    }
}

/* Of rounds a client keeps the last one alone. It could put no other together with what it has; the
 * next one is whole. */
static bool is_sent(const struct worker_job *job)
{
    return !job->between || job->encoding->packet.key;
}

/* True when there is more to come. */
static bool answer(struct worker *w, struct worker_job *job)
{
    struct error err = job->encoding->error;

    if (job->kept && job->encoding->ok) {
        kept_stream_end(job->kept, job->number, job->width, job->height);
    }
    if (job->answered) {
        return false;
    }
    job->times.us[FRAME_ENCODE] = job->encoding->encode_us;
    if (job->encoding->ok) {
        if (is_sent(job)) {
            worker_send_frame(w, job);
        }
        if (!job->between || begin_encoding(w, job, &err)) {
            return job->between;
        }
    }
    worker_send_failed(w, job->number, &err, false);
    return false;
}

void worker_collect_encodings(struct worker *w)
{
    struct encoding *encoding;
    uint64_t count;

    if (read(w->wake_fd, &count, sizeof count) < 0) {
        return;
    }
    while ((encoding = encode_thread_take(w->encode_thread))) {
        struct worker_job **at = &w->jobs;
        while (*at != encoding->data) {
            at = &(*at)->next;
        }
        if (answer(w, *at)) {
            (*at)->between = false;
        } else {
            worker_drop_job(w, at);
        }
        encoding_destroy(encoding);
    }
}
