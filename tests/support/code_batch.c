/* SPDX-License-Identifier: MIT */
/* Comparing C and GLSL. */
#include "code_batch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "code_engine.h"
#include "protocol/limits.h"
#include "random_scene.h"

#define SIZE 2.5       /* half side of the cube of points */
#define TOLERANCE 2e-4 /* of floats, relative to what is greater than 1 */
#define NEARBY 2e-6    /* where a value jumps, that of a point so near will do */

static float points[CODE_GPU_POINTS][4];
static float answers[CODE_BATCH_MAX * CODE_GPU_POINTS][4];

void code_batch_add(struct code_batch *batch, const char *text, enum code_use use,
                    const struct param *params)
{
    struct error err = {0};
    const struct code_source source = {use, text, params, batch->ours};
    struct code *code = code_compile(&source, &err);

    if (!code) {
        fail_msg("%d:%d: %s\n%s", err.line, err.column, err.message, text);
    }
    assert_true(batch->count < CODE_BATCH_MAX);
    batch->texts[batch->count] = strdup(text);
    batch->jobs[batch->count++] = (struct code_gpu_job){code, use, params};
}

static void run_in_c(const struct code_gpu_job *job, const double *numbers, const double p[3],
                     double out[4])
{
    if (job->use == CODE_SHADE) {
        const struct code_shading at = code_gpu_shading(p);
        if (code_gives_surface(job->code)) {
            struct code_surface surface;
            code_surface(job->code, &at, numbers, &surface, NULL);
            code_gpu_digest(&surface, out);
            return;
        }
        code_shade(job->code, &at, numbers, out, NULL);
    } else {
        out[0] = out[1] = out[2] = out[3] = code_distance(job->code, p, numbers, NULL);
    }
}

/* Whether the values lie among those of the point and of those around it. */
static bool agrees(const struct code_gpu_job *job, const double *numbers, const float point[3],
                   const float got[4])
{
    double low[4], high[4];

    for (int corner = -1; corner < 8; corner++) {
        double p[3], value[4];
        for (int i = 0; i < 3; i++) {
            p[i] = point[i] + (corner < 0 ? 0 : (corner >> i & 1) ? NEARBY : -NEARBY);
        }
        run_in_c(job, numbers, p, value);
        bool all = true;
        for (int i = 0; i < 4; i++) {
            low[i] = corner < 0 ? value[i] : fmin(low[i], value[i]);
            high[i] = corner < 0 ? value[i] : fmax(high[i], value[i]);
            const double room = TOLERANCE * fmax(1, fmax(fabs(low[i]), fabs(high[i])));
            all = all && got[i] >= low[i] - room && got[i] <= high[i] + room;
        }
        if (all) {
            return true;
        }
    }
    return false;
}

static void print_difference(const struct code_batch *batch, size_t job, size_t point)
{
    const double p[3] = {points[point][0], points[point][1], points[point][2]};
    const float *got = answers[job * CODE_GPU_POINTS + point];
    double want[4];

    run_in_c(&batch->jobs[job], batch->numbers, p, want);
    fprintf(stderr, /* print_error would cut it */
            "%s\nat (%.9g, %.9g, %.9g): drawn %.9g %.9g %.9g, C %.9g %.9g %.9g\n",
            batch->texts[job], p[0], p[1], p[2], got[0], got[1], got[2], want[0], want[1], want[2]);
}

static bool is_wrong(const struct code_batch *batch, size_t job, size_t allowed)
{
    size_t wrong = 0, last = 0;

    for (size_t i = 0; i < CODE_GPU_POINTS; i++) {
        const float *got = answers[job * CODE_GPU_POINTS + i];
        if (!agrees(&batch->jobs[job], batch->numbers, points[i], got)) {
            wrong++;
            last = i;
        }
    }
    if (wrong > allowed) {
        print_difference(batch, job, last);
        fprintf(stderr, "%zu points of %d\n", wrong, CODE_GPU_POINTS);
    }
    return wrong > allowed;
}

/* The same for every batch. */
static void make_points(void)
{
    struct random random = {.state = 99};

    for (size_t i = 0; i < CODE_GPU_POINTS; i++) {
        for (int j = 0; j < 3; j++) {
            points[i][j] = (float)random_between(&random, -SIZE, SIZE);
        }
    }
}

/* The answers of the engine, in the place of the device's. */
static bool engine_is_wrong(const struct code_batch *batch, size_t job, size_t allowed)
{
    static float places[CODE_GPU_POINTS][3], got[CODE_GPU_POINTS];

    if (batch->ours || batch->jobs[job].use != CODE_DISTANCE || batch->jobs[job].params->name) {
        return false;
    }
    for (size_t i = 0; i < CODE_GPU_POINTS; i++) {
        memcpy(places[i], points[i], sizeof places[i]);
    }
    code_engine_run(batch->texts[job], (const float(*)[3])places, CODE_GPU_POINTS, got);
    for (size_t i = 0; i < CODE_GPU_POINTS; i++) {
        float *to = answers[job * CODE_GPU_POINTS + i];
        to[0] = to[1] = to[2] = to[3] = got[i];
    }
    return is_wrong(batch, job, allowed);
}

void code_batch_run(struct code_batch *batch, size_t allowed)
{
    struct error err = {0};
    float floats[4 * LIMIT_DECLARED];
    size_t wrong = 0;

    make_points();
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; i++) {
        floats[i] = (float)batch->numbers[i];
    }
    if (batch->count > 0 && !code_gpu_run(batch->gpu, batch->jobs, batch->count,
                                          (const float(*)[4])points, floats, answers, &err)) {
        fail_msg("%s", err.message);
    }
    for (size_t i = 0; i < batch->count; i++) {
        wrong += is_wrong(batch, i, allowed) || engine_is_wrong(batch, i, allowed);
    }
    for (size_t i = 0; i < batch->count; i++) {
        code_destroy((struct code *)batch->jobs[i].code);
        free(batch->texts[i]);
    }
    batch->count = 0;
    assert_int_equal(wrong, 0);
}
