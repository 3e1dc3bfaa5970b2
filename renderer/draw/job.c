/* SPDX-License-Identifier: MIT */
/* One picture, tile by tile, handed out by rows of tiles. Holds a snapshot of the scene, so nothing
 * later reaches it. */
#include "context.h"

#include <math.h>
#include <stdlib.h>

#include "protocol/memory.h"

enum { ROUNDS_PIXELS_MAX = 1 << 22 };

struct job {
    struct renderer *renderer;
    struct snapshot *snapshot;
    struct camera camera;
    const struct draw_form *forms[AOV_COUNT]; /* NULL: not asked for */
    struct plan_wish wish;
    bool in_rounds;
    enum job_state state;
    int width, height; /* of the whole picture */
    struct job_region region;
    int tile_side, columns, tiles;
    int started, collected; /* tiles */
    bool begun;             /* `picture` is valid */
    struct draw_picture picture;
    uint8_t *rows[AOV_COUNT]; /* of the row of tiles that is collected; NULL: taken, or none yet */
    double depth_far;
    struct job_times times;
    struct error error;
};

/* --- what is asked --- */

static bool check_side(const char *name, int side, struct error *err)
{
    return (side >= 1 && side <= LIMIT_IMAGE_SIDE) ||
           error_set(err, ERROR_LIMIT, name, "%d is not in 1..%d", side, LIMIT_IMAGE_SIDE);
}

static bool check_region(const struct job_desc *desc, struct error *err)
{
    const struct job_region r = desc->region;

    return (r.width == 0 && r.height == 0) ||
           (r.x >= 0 && r.y >= 0 && r.width > 0 && r.height > 0 && r.width <= desc->width - r.x &&
            r.height <= desc->height - r.y) ||
           error_set(err, ERROR_LIMIT, "region", "%d,%d,%d,%d is not inside of %d x %d pixels", r.x,
                     r.y, r.width, r.height, desc->width, desc->height);
}

static bool check_desc(const struct job_desc *desc, struct error *err)
{
    if (!check_side("width", desc->width, err) || !check_side("height", desc->height, err) ||
        !check_region(desc, err)) {
        return false;
    }
    if ((long)desc->width * desc->height > LIMIT_IMAGE_PIXELS) {
        return error_set(err, ERROR_LIMIT, "height", "%d x %d pixels are above the maximum %d",
                         desc->width, desc->height, LIMIT_IMAGE_PIXELS);
    }
    if (desc->samples < 0 || desc->samples > 4) {
        return error_set(err, ERROR_LIMIT, "samples", "%d is not in 0..4", desc->samples);
    }
    if (desc->level >= QUALITY_COUNT) {
        return error_set(err, ERROR_INVALID, "level", "unknown");
    }
    return true;
}

static bool find_forms(struct job *job, const struct job_desc *desc, struct error *err)
{
    bool any = false;

    for (int i = 0; i < AOV_COUNT; i++) {
        any |= desc->aovs[i];
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        const enum aov aov = (enum aov)i;

        if (!desc->aovs[i] && (any || aov != AOV_COLOR)) {
            continue;
        }
        job->forms[i] = draw_form_find(aov, desc->as_floats);
        if (!job->forms[i]) {
            return error_set(err, ERROR_INVALID, "aov", "%s has raw values alone: format npy",
                             aov_name(aov));
        }
    }
    return true;
}

static double target_distance(const struct record *camera)
{
    const double *a = record_vector(camera, "position"), *b = record_vector(camera, "target");
    const double d = sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                          (a[2] - b[2]) * (a[2] - b[2]));

    return d > 1e-6 ? d : 1;
}

static void set_desc(struct job *job, const struct job_desc *desc)
{
    const struct record *camera = desc->camera ? desc->camera : &job->snapshot->camera;
    const struct job_region whole = {0, 0, desc->width, desc->height};

    job->width = desc->width;
    job->height = desc->height;
    job->region = desc->region.width > 0 ? desc->region : whole;
    job->camera = camera_from_record(camera, desc->width, desc->height);
    job->depth_far = 2 * target_distance(camera);
    job->in_rounds = desc->in_rounds;
    job->wish = (struct plan_wish){
        .level = desc->level,
        .samples = job->forms[AOV_COLOR] ? desc->samples : 1,
        .transparent = desc->transparent >= 0
                           ? desc->transparent
                           : record_number(&job->snapshot->render, "transparent") != 0,
        .from_camera = desc->from_camera,
    };
}

struct job *job_create(struct resident *resident, const struct job_desc *desc, struct error *err)
{
    struct snapshot *snapshot =
        desc->exact || !resident->drawable ? resident->newest : resident->drawable;
    struct job *job;

    if (!check_desc(desc, err)) {
        return NULL;
    }
    if (!snapshot) {
        if (err) {
            *err = resident->error;
        }
        return NULL;
    }
    job = memory_alloc(1, sizeof *job);
    if (!find_forms(job, desc, err)) {
        free(job);
        return NULL;
    }
    job->renderer = resident->renderer;
    job->snapshot = snapshot_ref(snapshot);
    job->state = JOB_WAITING;
    set_desc(job, desc);
    return job;
}

/* --- drawing --- */

static enum job_state fail(struct job *job)
{
    return job->state = JOB_FAILED;
}

/* What is kept between rounds takes memory. */
static bool may_have_rounds(const struct job *job)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (job->forms[i] && i != AOV_COLOR) {
            return false;
        }
    }
    return job->in_rounds && (long)job->region.width * job->region.height <= ROUNDS_PIXELS_MAX;
}

/* When its program is there, the picture's own buffers. */
static enum job_state begin(struct job *job)
{
    const struct snapshot *snapshot = job->snapshot;
    struct frame_block block = snapshot->frame;
    struct draw_plan plan;

    switch (program_state(snapshot->program)) {
    case PROGRAM_PENDING:
        return JOB_WAITING;
    case PROGRAM_FAILED:
        job->error = *program_error(snapshot->program);
        return fail(job);
    case PROGRAM_READY:
        break;
    }
    frame_set_camera(&block, &job->camera, job->width, job->height);
    plan_make(&plan, &block, &snapshot->render, &job->wish, &snapshot->extent);
    job->tile_side = draw_tile_side(job->renderer->draw, &plan);
    job->columns = (job->region.width + job->tile_side - 1) / job->tile_side;
    job->tiles = job->columns * ((job->region.height + job->tile_side - 1) / job->tile_side);
    if (!draw_begin(job->renderer->draw, &job->picture, &block, job->forms, &plan, &job->error)) {
        return fail(job);
    }
    job->begun = true;
    if (may_have_rounds(job)) {
        draw_in_rounds(
            job->renderer->draw, &job->picture,
            (struct tile){job->region.x, job->region.y, job->region.width, job->region.height});
    }
    job->times.us[FRAME_ENVIRONMENT] = job->snapshot->environment_us;
    job->snapshot->environment_us = 0; /* the first picture of it took that time */
    return job->state = JOB_RUNNING;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static struct tile tile_at(const struct job *job, int index)
{
    const int x = index % job->columns * job->tile_side;
    const int y = index / job->columns * job->tile_side;

    return (struct tile){job->region.x + x, job->region.y + y,
                         smaller(job->tile_side, job->region.width - x),
                         smaller(job->tile_side, job->region.height - y)};
}

/* The slot of the tile that was started last. */
static const struct draw_slot *last_slot(const struct job *job)
{
    return &job->picture.slots[(job->started + DRAW_SLOTS - 1) % DRAW_SLOTS];
}

bool job_is_within_tile(const struct job *job)
{
    return job->started > 0 && last_slot(job)->samples > 0;
}

/* The next tile, or the next sample of the one under way. */
static bool draw_next(struct job *job)
{
    struct draw *draw = job->renderer->draw;
    const struct draw_scene scene = {job->snapshot->program,
                                     snapshot_numbers(job->renderer, job->snapshot),
                                     job->snapshot->environment};

    if (job_is_within_tile(job)) {
        return draw_tile_more(draw, &job->picture, &scene, (job->started - 1) % DRAW_SLOTS,
                              &job->error);
    }
    if (!draw_tile(draw, &job->picture, &scene, tile_at(job, job->started),
                   job->started % DRAW_SLOTS, &job->error)) {
        return false;
    }
    job->started++;
    return true;
}

/* Room for the rows that begin with this tile. */
static void open_rows(struct job *job, const struct tile *tile)
{
    const size_t pixels = (size_t)job->region.width * (size_t)tile->height;

    for (int i = 0; i < AOV_COUNT; i++) {
        if (job->forms[i]) {
            job->rows[i] = memory_alloc(pixels, (size_t)job->forms[i]->read_bytes);
        }
    }
}

static bool collect(struct job *job)
{
    const int slot = job->collected % DRAW_SLOTS;
    const struct draw_slot *from = &job->picture.slots[slot];

    if (!draw_wait(job->renderer->draw, &job->picture, slot, &job->error)) {
        return false;
    }
    if (job->collected % job->columns == 0) {
        open_rows(job, &from->tile);
    }
    for (int i = 0; i < AOV_COUNT; i++) {
        const size_t bytes = job->forms[i] ? (size_t)job->forms[i]->read_bytes : 0;
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
    return true;
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

static enum job_state after_rows(struct job *job)
{
    if (!rows_are_taken(job)) {
        return JOB_ROWS;
    }
    if (job->collected < job->tiles) {
        return job->state = JOB_RUNNING;
    }
    if (draw_next_round(&job->picture)) {
        job->started = job->collected = 0;
        return job->state = JOB_ROUND;
    }
    job->renderer->counters.pictures++;
    return job->state = JOB_DONE;
}

bool job_step_possible(const struct job *job)
{
    return job->state != JOB_WAITING || program_state(job->snapshot->program) != PROGRAM_PENDING;
}

/* A tile is started before the one before it is waited for, across rows too. */
enum job_state job_step(struct job *job)
{
    if (job->state == JOB_WAITING) {
        return begin(job);
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
    if ((job_is_within_tile(job) ||
         (job->started < job->tiles && job->started - job->collected < DRAW_SLOTS)) &&
        !draw_next(job)) {
        return fail(job);
    }
    while (job->state == JOB_RUNNING && !job_is_within_tile(job) &&
           (job->started == job->tiles || job->started - job->collected == DRAW_SLOTS)) {
        if (!collect(job)) {
            return fail(job);
        }
        if (job->collected % job->columns == 0) {
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

uint64_t job_shape_with_code(const struct job *job)
{
    return snapshot_shape_with_code(job->snapshot);
}

struct job_times job_times(const struct job *job)
{
    return job->times;
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
    free(job);
}

/* --- rows --- */

static bool is_gray(const struct draw_form *form)
{
    return form->aov == AOV_DEPTH && !form->floats;
}

static struct image shape_of(const struct job *job, enum aov aov, int height)
{
    const struct draw_form *form = job->forms[aov];
    struct image image = {.width = job->region.width, .height = height, .channels = 1};
    size_t pixel_bytes = 2;

    if (!form) {
        return (struct image){0};
    }
    if (is_gray(form)) {
        image.format = PIXEL_GRAY16;
    } else {
        const bool bytes = form->read_type == GL_UNSIGNED_BYTE;

        image.format = bytes                         ? PIXEL_RGBA8
                       : form->read_type == GL_FLOAT ? PIXEL_FLOAT
                                                     : PIXEL_UINT32;
        image.channels = !bytes                                      ? form->read_bytes / 4
                         : aov == AOV_COLOR && job->wish.transparent ? 4
                                                                     : 3;
        pixel_bytes = (size_t)form->read_bytes;
    }
    image.bytes = (size_t)image.width * (size_t)height * pixel_bytes;
    return image;
}

struct image job_image_shape(const struct job *job, enum aov aov)
{
    return shape_of(job, aov, job->region.height);
}

/* Distances to 16 bits: 0 at the eye, 65535 at twice the distance of the camera's target, beyond,
 * and where nothing is. */
static void *depth_to_gray(const float *from, size_t count, double far)
{
    uint16_t *to = memory_alloc(count, sizeof *to);

    for (size_t i = 0; i < count; i++) {
        const double x = from[i] / far;
        to[i] = x < 1 ? (uint16_t)lround(x * 65535) : 65535;
    }
    return to;
}

struct image job_take_rows(struct job *job, enum aov aov)
{
    const int row = (job->collected - 1) / job->columns;
    struct image image = shape_of(job, aov, tile_at(job, row * job->columns).height);

    image.pixels = job->rows[aov];
    job->rows[aov] = NULL;
    if (job->forms[aov] && is_gray(job->forms[aov])) {
        void *raw = image.pixels;

        image.pixels = depth_to_gray(raw, image.bytes / 2, job->depth_far);
        free(raw);
    }
    return image;
}
