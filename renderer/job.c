/* SPDX-License-Identifier: MIT */
/* One picture, tile by tile, handed out by rows of tiles. Holds a snapshot of the scene, so nothing
 * later reaches it. */
#include <math.h>
#include <stdlib.h>
#include <time.h>

#include "job_internal.h"
#include "protocol/memory.h"

enum {
    PACE_WRONG_US = 1600000, /* so slow a tile is begun anew, with its row, in smaller ones */
    ROW_BYTES = 4 << 20,     /* a row of tiles takes no more while others wait, */
    ROW_HALVED = 128,        /* if it is at least so high */
};

static int larger(int a, int b)
{
    return a > b ? a : b;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

/* --- drawing --- */

static enum job_state fail(struct job *job)
{
    return job->state = JOB_FAILED;
}

static bool wants_rounds(const struct job *job)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (job->formats[i] && i != AOV_COLOR) {
            return false;
        }
    }
    return job->in_rounds;
}

static enum pace_company company_of(const struct job *job)
{
    return !job->renderer->shared               ? PACE_ALONE
           : draw_picture_pauses(&job->picture) ? PACE_SHARED_PAUSING
                                                : PACE_SHARED;
}

/* Of a length that is cut into equal parts of at most `side`: whole work groups where possible. */
static int part_of(int length, int side)
{
    const int count = (length + side - 1) / side;
    const int part = count > 0 ? (length + count - 1) / count : side;
    const int whole = (part + PACE_MIN - 1) / PACE_MIN * PACE_MIN;

    return whole < side ? whole : side;
}

/* Of a row of tiles: `side`, or less where that takes much memory, which the kernel has to clear
 * while others wait. */
static int height_of(const struct job *job, int side)
{
    size_t bytes = 0;

    for (int i = 0; i < AOV_COUNT; i++) {
        bytes += job->formats[i] ? (size_t)job->formats[i]->read_bytes : 0;
    }
    bytes *= (size_t)job->region.width;
    while (company_of(job) == PACE_SHARED_PAUSING && side >= ROW_HALVED &&
           (size_t)side * bytes > ROW_BYTES) {
        side /= 2;
    }
    return side;
}

static void begin_row(struct job *job, int y)
{
    const struct draw *draw = job->renderer->draw;
    const int left = larger(job->region.width, job->region.height - y);
    struct pace_row pace = pace_begin(job->pace, company_of(job), job->level);
    int side = draw_tile_side(draw, &job->picture, pace.doublings);

    /* A side beyond the largest, or beyond what is left, makes no other tile: were it halved, that
     * would help nobody. */
    while (pace.doublings > 0) {
        const int half = draw_tile_side(draw, &job->picture, pace.doublings - 1);
        if (half < side && half < left) {
            break;
        }
        pace.doublings--;
        side = half;
    }
    job->row = (struct row){.y = y,
                            .side = side,
                            .height = part_of(job->region.height - y, height_of(job, side)),
                            .width = part_of(job->region.width, side),
                            .pace = pace};
}

/* The next tiles of the row. */
static void choose_width(struct job *job)
{
    const enum pace_company company = company_of(job);
    const struct pace_row now = pace_begin(job->pace, company, job->level);
    const int side = draw_tile_side(job->renderer->draw, &job->picture, now.doublings);
    const int most = pace_width(&job->row.pace, company, job->row.side, side);

    job->row.width = smaller(job->row.width, most);
}

/* Of a snapshot that is ready, or bridged. */
static struct draw_scene scene_of(const struct job *job)
{
    struct snapshot *snapshot = job->snapshot;
    struct program *program = job->program;

    return (struct draw_scene){
        .program = program,
        .params = program ? snapshot_params(job->renderer, snapshot, program) : NULL,
        .tapes = program ? snapshot_tapes(job->renderer, snapshot, program) : 0,
        .environment = snapshot->environment,
        .values = snapshot->geometry.field->params,
        .engine = program            ? NULL
                  : snapshot->bridge ? snapshot->bridge
                                     : snapshot->engine,
    };
}

static bool may_begin_bridged(const struct job *job)
{
    return !job->exact && snapshot_is_bridged(job->snapshot);
}

/* When its program and environment are there, the picture's own buffers. */
static enum job_state begin(struct job *job)
{
    const struct snapshot *snapshot = job->snapshot;
    struct frame_uniforms block = snapshot->frame;
    struct render_settings settings;

    const bool bridged = may_begin_bridged(job);
    switch (bridged ? PROGRAM_READY : snapshot_state(snapshot)) {
    case PROGRAM_PENDING:
        return job->state;
    case PROGRAM_FAILED:
        job->error = *snapshot_error(snapshot);
        return fail(job);
    case PROGRAM_READY:
        break;
    }
    job->program = bridged ? NULL : snapshot_program(snapshot);
    const struct draw_scene scene = scene_of(job);
    frame_uniforms_set_camera(&block, &job->camera, job->width, job->height);
    render_settings_make(&settings, &block, &snapshot->render, &job->request, &snapshot->extent);
    if (!draw_begin(job->renderer->draw, &job->picture, &block, job->formats, &settings, &scene,
                    &job->error)) {
        return fail(job);
    }
    job->begun = true;
    if (job->careful) {
        pace_be_careful(job->pace, job->level);
    }
    begin_row(job, 0);
    if (wants_rounds(job)) {
        draw_in_rounds(
            job->renderer->draw, &job->picture,
            (struct tile){job->region.x, job->region.y, job->region.width, job->region.height});
    }
    job->times.us[FRAME_ENVIRONMENT] = job->snapshot->environment_us;
    job->snapshot->environment_us = 0; /* the first picture of it took that time */
    return job->state = JOB_RUNNING;
}

static struct tile next_tile(const struct job *job)
{
    const struct row *row = &job->row;

    return (struct tile){job->region.x + row->x, job->region.y + row->y,
                         smaller(row->width, job->region.width - row->x),
                         smaller(row->height, job->region.height - row->y)};
}

static bool all_started(const struct job *job)
{
    return job->row.y >= job->region.height;
}

/* What the row took decides how large the tiles of the next one are. */
static void end_tile_start(struct job *job)
{
    struct row *row = &job->row;

    row->x += row->width;
    if (row->x < job->region.width) {
        return;
    }
    pace_end(job->pace, job->level, &row->pace);
    begin_row(job, row->y + row->height);
}

/* The slot of the tile that was started last. */
static const struct tile_in_flight *last_slot(const struct job *job)
{
    return &job->picture.slots[(job->started + TILES_IN_FLIGHT - 1) % TILES_IN_FLIGHT];
}

bool job_is_within_tile(const struct job *job)
{
    return job->started > 0 && last_slot(job)->samples > 0;
}

/* The same, or the engine has drawn some of it. */
static bool is_unfinished(const struct job *job)
{
    return job_is_within_tile(job) || (job->started > 0 && last_slot(job)->paused);
}

bool job_is_sampled(const struct job *job)
{
    return job->begun && draw_is_sampled(&job->picture);
}

/* --- how long it takes --- */

static int64_t clock_in_us(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static struct watch look_at_clocks(const struct job *job)
{
    return (struct watch){clock_in_us(CLOCK_MONOTONIC),
                          clock_in_us(CLOCK_PROCESS_CPUTIME_ID) -
                              program_cache_cpu_us(job->renderer->programs) -
                              pictures_cpu_us(job->renderer->pictures)};
}

/* False: even the smallest tile takes too long. At the ends of a picture tiles are cut off: what
 * counts is how long a whole one would take. */
static bool learn(struct job *job, const struct tile *tile, int64_t took_us, int64_t cpu_us)
{
    struct row *row = &job->row;
    const int64_t whole = (int64_t)row->side * row->side;

    pace_learn(job->pace, job->level, &row->pace,
               took_us * whole / ((int64_t)tile->width * tile->height));
    return row->pace.doublings > 0 || cpu_us <= job->limit_us ||
           error_set_slow(&job->error, "", "the smallest part of the picture took",
                          (int)(cpu_us / 1000), (int)(job->limit_us / 1000));
}

/* Gives up the tile that was started last. False: the device is lost. */
static bool drop_last_tile(struct job *job)
{
    const int index = (job->started - 1) % TILES_IN_FLIGHT;
    struct tile_in_flight *slot = &job->picture.slots[index];

    if (slot->fence && !draw_wait(job->renderer->draw, &job->picture, index, &job->error)) {
        return false;
    }
    for (int i = 0; draw_picture_pauses(&job->picture) && i < FRAME_STAGES; i++) {
        job->times.us[i] += (uint32_t)slot->stage_us[i]; /* it was spent all the same */
    }
    slot->samples = 0;
    job->started--;
    return true;
}

/* Nothing of the row was handed out yet. The last tile of the row before it may still be on its
 * way. */
static bool begin_row_anew(struct job *job)
{
    const int top = job->region.y + job->row.y;

    while (job->started > job->collected && last_slot(job)->tile.y == top) {
        if (!drop_last_tile(job)) {
            return false;
        }
    }
    for (int i = 0; i < AOV_COUNT && job->started == job->collected; i++) {
        free(job->rows[i]);
        job->rows[i] = NULL;
    }
    begin_row(job, job->row.y);
    return true;
}

/* --- a sample of a tile --- */

static bool draw_sample(struct job *job, const struct draw_scene *scene)
{
    struct draw *draw = job->renderer->draw;

    if (is_unfinished(job)) {
        job->steps[(job->started - 1) % TILES_IN_FLIGHT] += job_is_within_tile(job);
        return draw_tile_more(draw, &job->picture, scene, (job->started - 1) % TILES_IN_FLIGHT,
                              &job->error);
    }
    job->steps[job->started % TILES_IN_FLIGHT] = 1;
    choose_width(job);
    return draw_tile(draw, &job->picture, scene, next_tile(job), job->started++ % TILES_IN_FLIGHT,
                     &job->error);
}

/* What it took decides on the tiles that follow. */
static bool end_sample(struct job *job)
{
    const struct watch took = job->sample;
    const int64_t took_us = took.wall_us < took.cpu_us ? took.wall_us : took.cpu_us;

    job->sample = (struct watch){0};
    if (job->renderer->info.software && !learn(job, &last_slot(job)->tile, took_us, took.cpu_us)) {
        return false;
    }
    if (took_us > PACE_WRONG_US && job->row.pace.doublings > 0 && job->picture.from == 0) {
        return begin_row_anew(job);
    }
    if (!job_is_within_tile(job)) {
        end_tile_start(job);
    }
    return true;
}

/* The next tile, or what comes next of the one under way. */
static bool draw_next(struct job *job)
{
    const struct draw_scene scene = scene_of(job);
    const struct watch before = look_at_clocks(job);

    if (!draw_sample(job, &scene)) {
        return false;
    }
    const struct watch after = look_at_clocks(job);
    job->sample.wall_us += after.wall_us - before.wall_us;
    job->sample.cpu_us += after.cpu_us - before.cpu_us;
    return last_slot(job)->paused || end_sample(job);
}

/* Room for the rows that begin with this tile. */
static void open_rows(struct job *job, const struct tile *tile)
{
    const size_t pixels = (size_t)job->region.width * (size_t)tile->height;

    for (int i = 0; i < AOV_COUNT; i++) {
        if (job->formats[i]) {
            job->rows[i] = memory_resize(NULL, pixels, (size_t)job->formats[i]->read_bytes);
        }
    }
}

/* What a GPU took is known only here. */
static bool learn_from_device(struct job *job, const struct tile_in_flight *slot, int steps)
{
    int64_t together = 0;

    for (int i = 0; i < FRAME_STAGES; i++) {
        together += i == FRAME_READ ? 0 : (int64_t)slot->stage_us[i];
    }
    return learn(job, &slot->tile, together / steps, together / steps);
}

static bool collect(struct job *job, bool *out_row_ends)
{
    const int slot = job->collected % TILES_IN_FLIGHT;
    const struct tile_in_flight *from = &job->picture.slots[slot];

    if (!draw_wait(job->renderer->draw, &job->picture, slot, &job->error)) {
        return false;
    }
    if (from->tile.x == job->region.x) {
        open_rows(job, &from->tile);
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        const size_t bytes = job->formats[i] ? (size_t)job->formats[i]->read_bytes : 0;
        uint8_t *to = job->rows[i] + (size_t)(from->tile.x - job->region.x) * bytes;

        if (bytes > 0 && !draw_collect(job->renderer->draw, &job->picture, slot, (enum aov)i, to,
                                       (size_t)job->region.width * bytes, &job->error)) {
            return false;
        }
    }
    for (int i = 0; i < FRAME_STAGES; i++) {
        job->times.us[i] += (uint32_t)from->stage_us[i];
    }
    job->collected++;
    job->renderer->counters.tiles++;
    job->rows_height = from->tile.height;
    *out_row_ends = from->tile.x + from->tile.width == job->region.x + job->region.width;
    return job->renderer->info.software || learn_from_device(job, from, job->steps[slot]);
}

static bool rows_are_taken(const struct job *job)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (job->rows[i]) {
            return false;
        }
    }
    return true;
}

/* From the pictures of moving views alone, so that like is compared with like. */
static void learn_program(const struct job *job)
{
    uint64_t us = 0;

    for (int i = FRAME_MARCH; i <= FRAME_RESOLVE; i++) {
        us += job->times.us[i];
    }
    if (job->program && job->level == QUALITY_INTERACTIVE) {
        snapshot_learn(job->snapshot, job->program, us, job->region.width * job->region.height);
    }
}

static enum job_state after_rows(struct job *job)
{
    if (!rows_are_taken(job)) {
        return JOB_ROWS;
    }
    if (job->collected < job->started || !all_started(job)) {
        return job->state = JOB_RUNNING;
    }
    if (draw_next_round(&job->picture)) {
        job->started = job->collected = 0;
        begin_row(job, 0);
        return job->state = JOB_ROUND;
    }
    job->renderer->counters.pictures++;
    learn_program(job);
    return job->state = JOB_DONE;
}

bool job_step_possible(const struct job *job)
{
    return job->state != JOB_WAITING || may_begin_bridged(job) ||
           snapshot_state(job->snapshot) != PROGRAM_PENDING;
}

bool job_is_drawn(const struct job *job)
{
    return job->begun && all_started(job) && job->collected == job->started;
}

/* A tile is started before the one before it is waited for, across rows too. */
enum job_state job_step(struct job *job)
{
    if (job->state == JOB_WAITING && begin(job) != JOB_RUNNING) {
        return job->state;
    }
    if (job->state == JOB_ROUND) {
        job->state = JOB_RUNNING;
    }
    if (job->state == JOB_ROWS) {
        after_rows(job);
    }
    if (job->state != JOB_RUNNING) {
        return job->state;
    }
    if ((is_unfinished(job) ||
         (!all_started(job) && job->started - job->collected < TILES_IN_FLIGHT)) &&
        !draw_next(job)) {
        return fail(job);
    }
    while (job->state == JOB_RUNNING && !is_unfinished(job) &&
           (all_started(job) || job->started - job->collected == TILES_IN_FLIGHT)) {
        bool row_ends;

        if (!collect(job, &row_ends)) {
            return fail(job);
        }
        if (row_ends) {
            job->state = JOB_ROWS;
        }
    }
    return job->state;
}

/* --- what came of it --- */

const struct error *job_error(const struct job *job)
{
    return &job->error;
}

uint64_t job_revision(const struct job *job)
{
    return job->snapshot->revision;
}

struct field *job_field(const struct job *job)
{
    return job->snapshot->geometry.field;
}

uint64_t job_structure_with_code(const struct job *job)
{
    return snapshot_structure_with_code(job->snapshot);
}

struct picture_rounds job_rounds(const struct job *job)
{
    return job->begun ? draw_rounds(&job->picture) : (struct picture_rounds){0, 1};
}

double job_drawn_part(const struct job *job)
{
    const double pixels = (double)job->region.width * job->region.height;

    /* A row that was begun again may have been copied twice. */
    return 1 - fmin((double)job->picture.copied, pixels) / pixels;
}

struct job_times job_times(const struct job *job)
{
    struct job_times times = job->times;

    /* The engine's tiles are drawn when they are started; those of a device when they are there. */
    for (int i = job->collected; draw_picture_pauses(&job->picture) && i < job->started; i++) {
        const struct tile_in_flight *slot = &job->picture.slots[i % TILES_IN_FLIGHT];
        for (int k = 0; k < FRAME_STAGES; k++) {
            times.us[k] += (uint32_t)slot->stage_us[k];
        }
    }
    return times;
}

void job_destroy(struct job *job)
{
    if (!job) {
        return;
    }
    if (job->begun) {
        draw_end(job->renderer->draw, &job->picture);
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        free(job->rows[i]);
    }
    snapshot_unref(job->renderer, job->snapshot);
    pace_unref(job->pace);
    free(job);
}
