/* SPDX-License-Identifier: MIT */
/* What a picture is asked to be. */
#include <math.h>
#include <stdlib.h>

#include "job_internal.h"
#include "protocol/memory.h"

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
        job->formats[i] =
            output_format_find(aov, desc->as_floats || (desc->raw_depth && aov == AOV_DEPTH));
        if (!job->formats[i]) {
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

static enum quality_level level_of(const struct job *job, const struct job_desc *desc)
{
    return (enum quality_level)(
        desc->level >= 0 ? desc->level : (int)record_number(&job->snapshot->render, "level"));
}

static void set_desc(struct job *job, const struct job_desc *desc)
{
    const int wanted_ms = job->renderer->params.tile_ms;
    const int tile_ms = wanted_ms > 0 ? wanted_ms : LIMIT_TILE_MS;
    const struct record *camera = desc->camera ? desc->camera : &job->snapshot->camera;
    const struct job_region whole = {0, 0, desc->width, desc->height};

    job->width = desc->width;
    job->height = desc->height;
    job->region = desc->region.width > 0 ? desc->region : whole;
    job->camera = camera_from_record(camera, desc->width, desc->height);
    job->depth_far = 2 * target_distance(camera);
    job->in_rounds = desc->in_rounds;
    job->careful = desc->careful;
    job->exact = desc->exact;
    job->limit_us = (int64_t)tile_ms * 1000 * (desc->patience > 0 ? desc->patience : 1);
    job->level = level_of(job, desc);
    job->request = (struct settings_request){
        .level = desc->level,
        .samples = job->formats[AOV_COLOR] ? desc->samples : 1,
        .transparent = desc->transparent >= 0
                           ? desc->transparent
                           : record_number(&job->snapshot->render, "transparent") != 0,
        .sparse = desc->sparse,
        .section = section_from_record(desc->section),
    };
}

struct job *job_create(struct resident *resident, const struct job_desc *desc, struct error *err)
{
    struct snapshot *snapshot;
    struct job *job;

    if (!check_desc(desc, err)) {
        return NULL;
    }
    snapshot = resident_snapshot(resident, desc, err);
    if (!snapshot) {
        return NULL;
    }
    job = memory_alloc(1, sizeof *job);
    if (!find_forms(job, desc, err)) {
        free(job);
        return NULL;
    }
    job->renderer = resident->renderer;
    job->snapshot = snapshot_ref(snapshot);
    job->pace = pace_ref(resident->pace);
    job->state = JOB_WAITING;
    set_desc(job, desc);
    return job;
}
