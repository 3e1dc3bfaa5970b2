/* SPDX-License-Identifier: MIT */
/* The pictures that the render process draws: tile by tile, then encoded by another thread. */
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "protocol/messages.h"
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
        .zipped = json_member_bool(packet, "zipped", false),
        .limit_bytes = LIMIT_IMAGE_BYTES,
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

/* The member's value in the packet: a region of so many whole numbers. */
static bool read_region(const cJSON *packet, struct job_region *out, struct error *err)
{
    const cJSON *region = cJSON_GetObjectItemCaseSensitive(packet, "region");
    int numbers[4] = {0};

    for (int i = 0; region && i < 4; i++) {
        const cJSON *number = cJSON_GetArrayItem(region, i);

        if (!cJSON_IsNumber(number)) {
            return error_set(err, ERROR_INVALID, "region", "is not x, y, width, height");
        }
        numbers[i] = number->valueint;
    }
    *out = (struct job_region){numbers[0], numbers[1], numbers[2], numbers[3]};
    return true;
}

static bool read_level(const cJSON *packet, int *out, struct error *err)
{
    const char *name = json_member_text(packet, "level", NULL);

    *out = name ? quality_find(name) : -1;
    return !name || *out >= 0 || error_set(err, ERROR_INVALID, "level", "\"%s\" is unknown", name);
}

/* All but the camera. */
static bool read_desc(const cJSON *packet, bool as_floats, struct job_desc *out, struct error *err)
{
    *out = (struct job_desc){
        .width = worker_read_int(packet, "width", 0),
        .height = worker_read_int(packet, "height", 0),
        .samples = worker_read_int(packet, "samples", 0),
        .transparent = json_member_bool(packet, "transparent", false),
        .exact = json_member_bool(packet, "exact", false),
        .in_rounds = json_member_bool(packet, "in_rounds", false),
        .careful = json_member_bool(packet, "careful", false),
        .patience = worker_read_int(packet, "patience", 1),
        .as_floats = as_floats,
    };
    if (!cJSON_HasObjectItem(packet, "transparent")) {
        out->transparent = -1;
    }
    return aovs_read(json_member_text(packet, "aov", "color"), out->aovs, "aov", err) &&
           read_level(packet, &out->level, err) && read_region(packet, &out->region, err);
}

/* The ids are borrowed from the packet. */
static bool read_isolated(const cJSON *packet, const char *out_ids[LIMIT_ISOLATED],
                          struct job_desc *desc, struct error *err)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(packet, "isolate"), *id;

    desc->isolated = out_ids;
    cJSON_ArrayForEach(id, list)
    {
        if (!cJSON_IsString(id) || desc->isolated_count == LIMIT_ISOLATED) {
            return error_set(err, ERROR_INVALID, "isolate", "is not a list of at most %d ids",
                             LIMIT_ISOLATED);
        }
        out_ids[desc->isolated_count++] = id->valuestring;
    }
    return true;
}

static struct job *make_job(struct resident *resident, const cJSON *packet, bool as_floats,
                            struct error *err)
{
    struct record camera;
    struct job_desc desc;
    const char *isolated[LIMIT_ISOLATED];
    struct job *job = NULL;
    bool given;

    record_init(&camera, &camera_type);
    if (worker_read_camera(packet, &camera, &given, err) &&
        read_desc(packet, as_floats, &desc, err) && read_isolated(packet, isolated, &desc, err)) {
        desc.camera = given ? &camera : NULL;
        job = job_create(resident, &desc, err);
    }
    record_finish(&camera);
    return job;
}

static bool begin_encoding(struct worker *w, struct task *task, struct error *err)
{
    struct image shapes[AOV_COUNT];

    for (int i = 0; i < AOV_COUNT; i++) {
        shapes[i] = job_image_shape(task->job, (enum aov)i);
        task->width = shapes[i].width ? shapes[i].width : task->width;
        task->height = shapes[i].width ? shapes[i].height : task->height;
    }
    task->encoding = encoder_begin(w->encoder, shapes, &task->encode, task->priority, task, err);
    return task->encoding;
}

/* The picture's job and its encoding. */
static bool begin_task(struct worker *w, const cJSON *packet, struct task *task, struct error *err)
{
    const struct held *held = *worker_find_scene(w, task->scene);

    if (!held) {
        return error_set(err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", task->scene);
    }
    if (!read_format(packet, &task->encode, err)) {
        return false;
    }
    task->job = make_job(held->resident, packet, task->encode.format == IMAGE_NPY, err);
    if (!task->job) {
        return false;
    }
    task->revision = job_revision(task->job);
    task->newest = task->revision == resident_revision(held->resident);
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

void worker_on_render(struct worker *w, const cJSON *packet)
{
    struct task *task = memory_alloc(1, sizeof *task);
    struct task **last = &w->tasks;
    struct error err = {0};

    task->number = (uint64_t)json_member_number(packet, "job", 0);
    task->scene = memory_text(json_member_text(packet, "scene", ""));
    task->turn = turns_join(&w->turns, json_member_text(packet, "account", task->scene));
    task->priority = (int)json_member_number(packet, "priority", 0);
    task->received_us = task->told_us = now_us();
    if (!begin_task(w, packet, task, &err)) {
        worker_send_failed(w, task->number, &err);
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

void worker_on_cancel(struct worker *w, const cJSON *packet)
{
    const uint64_t number = (uint64_t)json_member_number(packet, "job", 0);

    for (struct task *task = w->tasks; task; task = task->next) {
        if (task->number == number) {
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
        worker_send_progress(w, task);
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
    const uint64_t job = task ? task->number : 0;

    if (job == w->told_job) {
        return;
    }
    w->told_job = job;
    worker_send_drawing(w, task);
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
        worker_send_undrawn(w, task->number, job_error(task->job));
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
    worker_send_failed(w, task->number, &err);
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
