/* SPDX-License-Identifier: MIT */
/* One picture, tile by tile. Holds a snapshot of the scene, so nothing later reaches it. */
#include "context.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct job {
    struct renderer *renderer;
    struct snapshot *snapshot;
    struct camera camera;
    const struct draw_form *form;
    enum job_state state;
    int samples;
    int tile_width, tile_height, columns, tiles;
    int started, collected; /* tiles */
    bool begun;             /* `picture` is valid */
    struct draw_picture picture;
    double depth_far;
    uint8_t *raw; /* pixels as read */
    int width, height;
    struct job_times times;
    struct error error;
};

static bool check_desc(const struct job_desc *desc, struct error *err)
{
    if (desc->width < 1 || desc->width > LIMIT_IMAGE_SIDE) {
        return error_set(err, ERROR_LIMIT, "width", "%d is not in 1..%d", desc->width,
                         LIMIT_IMAGE_SIDE);
    }
    if (desc->height < 1 || desc->height > LIMIT_IMAGE_SIDE) {
        return error_set(err, ERROR_LIMIT, "height", "%d is not in 1..%d", desc->height,
                         LIMIT_IMAGE_SIDE);
    }
    if ((long)desc->width * desc->height > LIMIT_IMAGE_PIXELS) {
        return error_set(err, ERROR_LIMIT, "height", "%d x %d pixels are above the maximum %d",
                         desc->width, desc->height, LIMIT_IMAGE_PIXELS);
    }
    if (desc->samples < 0 || desc->samples > 4) {
        return error_set(err, ERROR_LIMIT, "samples", "%d is not in 0..4", desc->samples);
    }
    if ((int)desc->aov < 0 || desc->aov >= AOV_COUNT ||
        !draw_form_find(desc->aov, desc->as_floats)) {
        return error_set(err, ERROR_INVALID, "aov", "unknown");
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

struct job *job_create(struct resident *resident, const struct job_desc *desc, struct error *err)
{
    struct snapshot *snapshot =
        desc->exact || !resident->drawable ? resident->newest : resident->drawable;
    const struct record *camera;
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
    job->renderer = resident->renderer;
    job->snapshot = snapshot_ref(snapshot);
    job->form = draw_form_find(desc->aov, desc->as_floats);
    job->width = desc->width;
    job->height = desc->height;
    job->samples = desc->aov != AOV_COLOR ? 1 : desc->samples ? desc->samples : snapshot->samples;
    camera = desc->camera ? desc->camera : &snapshot->camera;
    job->camera = camera_from_record(camera, desc->width, desc->height);
    job->depth_far = 2 * target_distance(camera);
    draw_tile_size(job->renderer->draw, job->samples, &job->tile_width, &job->tile_height);
    job->columns = (job->width + job->tile_width - 1) / job->tile_width;
    job->tiles = job->columns * ((job->height + job->tile_height - 1) / job->tile_height);
    job->state = JOB_WAITING;
    return job;
}

static enum job_state fail(struct job *job)
{
    return job->state = JOB_FAILED;
}

/* When its program is there, the picture's own buffers. */
static enum job_state begin(struct job *job)
{
    const struct program *program = job->snapshot->program;
    struct frame_block block = job->snapshot->frame;

    switch (program_state(program)) {
    case PROGRAM_PENDING:
        return JOB_WAITING;
    case PROGRAM_FAILED:
        job->error = *program_error(program);
        return fail(job);
    case PROGRAM_READY:
        break;
    }
    frame_set_camera(&block, &job->camera, job->width, job->height, job->samples);
    if (!draw_begin(job->renderer->draw, &job->picture, &block, job->form, &job->error)) {
        return fail(job);
    }
    job->begun = true;
    job->raw =
        memory_alloc((size_t)job->width * (size_t)job->height, (size_t)job->form->read_bytes);
    return job->state = JOB_RUNNING;
}

static struct tile tile_at(const struct job *job, int index)
{
    struct tile tile = {index % job->columns * job->tile_width,
                        index / job->columns * job->tile_height, job->tile_width, job->tile_height};

    if (tile.x + tile.width > job->width) {
        tile.width = job->width - tile.x;
    }
    if (tile.y + tile.height > job->height) {
        tile.height = job->height - tile.y;
    }
    return tile;
}

static bool collect(struct job *job)
{
    const int slot = job->collected % DRAW_SLOTS;
    const struct draw_slot *from = &job->picture.slots[slot];
    const size_t stride = (size_t)job->width * (size_t)job->form->read_bytes;
    uint8_t *to = job->raw + (size_t)from->tile.y * stride +
                  (size_t)from->tile.x * (size_t)job->form->read_bytes;

    if (!draw_collect(job->renderer->draw, &job->picture, slot, to, stride, &job->error)) {
        return false;
    }
    job->times.march_us += from->times.march_us;
    job->times.light_us += from->times.light_us;
    job->times.read_us += from->times.read_us;
    job->collected++;
    job->renderer->counters.tiles++;
    return true;
}

bool job_step_possible(const struct job *job)
{
    return job->state != JOB_WAITING || program_state(job->snapshot->program) != PROGRAM_PENDING;
}

enum job_state job_step(struct job *job)
{
    if (job->state == JOB_WAITING) {
        return begin(job);
    }
    if (job->state != JOB_RUNNING) {
        return job->state;
    }
    if (job->started < job->tiles) {
        if (!draw_tile(job->renderer->draw, &job->picture, job->snapshot->program,
                       snapshot_numbers(job->renderer, job->snapshot), tile_at(job, job->started),
                       job->started % DRAW_SLOTS, &job->error)) {
            return fail(job);
        }
        job->started++;
    }
    while (job->collected < job->started &&
           (job->started == job->tiles || job->started - job->collected == DRAW_SLOTS)) {
        if (!collect(job)) {
            return fail(job);
        }
    }
    if (job->collected == job->tiles) {
        job->state = JOB_DONE;
        job->renderer->counters.pictures++;
    }
    return job->state;
}

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
    snapshot_unref(job->renderer, job->snapshot);
    free(job->raw);
    free(job);
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

struct image job_take_image(struct job *job)
{
    const struct draw_form *form = job->form;
    const size_t count = (size_t)job->width * (size_t)job->height;
    struct image image = {.width = job->width, .height = job->height, .pixels = job->raw};

    image.bytes = count * (size_t)form->read_bytes;
    image.format = form->read_type == GL_UNSIGNED_BYTE ? PIXEL_RGBA8
                   : form->read_type == GL_FLOAT       ? PIXEL_FLOAT
                                                       : PIXEL_UINT32;
    image.channels = form->read_bytes / (form->read_type == GL_UNSIGNED_BYTE ? 1 : 4);
    if (form->aov == AOV_DEPTH && !form->floats) {
        image.format = PIXEL_GRAY16;
        image.bytes = count * 2;
        image.pixels = depth_to_gray((const float *)(const void *)job->raw, count, job->depth_far);
        free(job->raw);
    }
    job->raw = NULL;
    return image;
}
