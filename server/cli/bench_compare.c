/* SPDX-License-Identifier: MIT */
/* Pictures timed by stage, and two that should cost the same, or show the same, side by side. */
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"

enum {
    PATIENCE_MS = 50,
    STEPS = 1, /* of 255, by which two pictures may differ */
    PIXEL_BYTES = 4,
};

bool bench_draw(struct renderer *renderer, struct resident *resident, const struct job_desc *desc,
                struct job_times *out_times, struct error *err)
{
    struct job *job = job_create(resident, desc, err);
    enum job_state state = JOB_FAILED;

    if (!job) {
        return false;
    }
    while ((state = job_step(job)) != JOB_DONE && state != JOB_FAILED) {
        if (state == JOB_ROWS) {
            struct image rows = job_take_rows(job, AOV_COLOR);
            image_finish(&rows);
        }
        renderer_poll(renderer, state == JOB_WAITING ? PATIENCE_MS : 0);
    }
    if (state == JOB_DONE) {
        *out_times = job_times(job);
    } else {
        *err = *job_error(job);
    }
    job_destroy(job);
    renderer_forget(renderer);
    return state == JOB_DONE;
}

static void add_stages(cJSON *row, double *numbers, int rounds)
{
    cJSON *stages = cJSON_AddObjectToObject(row, "stages_ms");

    for (int stage = 0; stage < FRAME_STAGES; stage++) {
        const double ms = bench_quantile(numbers + (ptrdiff_t)stage * rounds, (size_t)rounds, 0.5);
        if (ms > 0) {
            bench_add(stages, stage_row((enum frame_stage)stage)->name, ms);
        }
    }
}

bool bench_medians(struct renderer *renderer, struct resident *resident,
                   const struct job_desc *desc, int rounds, cJSON *row, struct error *err)
{
    double *numbers = memory_alloc((size_t)rounds * (FRAME_STAGES + 1), sizeof *numbers);
    double *whole = numbers + (ptrdiff_t)FRAME_STAGES * rounds;
    bool ok = true;

    for (int i = -1; ok && i < rounds; i++) { /* the first one only warms up */
        struct job_times times = {0};
        const int64_t start = clock_us();
        ok = bench_draw(renderer, resident, desc, &times, err);
        for (int stage = 0; i >= 0 && stage < FRAME_STAGES; stage++) {
            numbers[stage * rounds + i] = times.us[stage] / 1000.0;
        }
        if (i >= 0) {
            whole[i] = bench_ms_since(start);
        }
    }
    if (ok) {
        bench_add(row, "ms", bench_quantile(whole, (size_t)rounds, 0.5));
        add_stages(row, numbers, rounds);
    }
    free(numbers);
    return ok;
}

/* Turn by turn, since machines are quicker now and then. */
static bool time_both(struct renderer *renderer, struct resident *const both[2],
                      const struct job_desc *desc, int rounds, double *ratios, struct error *err)
{
    for (int i = -1; i < rounds; i++) { /* the first one only warms up */
        double ms[2];
        for (int j = 0; j < 2; j++) {
            struct job_times times;
            const int64_t start = clock_us();
            if (!bench_draw(renderer, both[j], desc, &times, err)) {
                return false;
            }
            ms[j] = bench_ms_since(start);
        }
        ratios[i < 0 ? 0 : i] = ms[0] / ms[1];
    }
    return true;
}

/* Adds the median of the times of the first by those of the second; destroys both. */
static bool compare(struct renderer *renderer, struct resident *const both[2],
                    const struct job_desc *desc, int rounds, const char *name, cJSON *row,
                    struct error *err)
{
    double *ratios = memory_alloc((size_t)rounds, sizeof *ratios);
    const bool ok = both[0] && both[1] && time_both(renderer, both, desc, rounds, ratios, err);

    if (ok) {
        bench_add(row, name, bench_quantile(ratios, (size_t)rounds, 0.5));
    }
    resident_destroy(both[0]);
    resident_destroy(both[1]);
    free(ratios);
    return ok;
}

/* --- what computes pictures --- */

/* The part of the pixels that are not the same in both. */
static double different_part(const struct image *a, const struct image *b)
{
    const uint8_t *const pixels[] = {a->pixels, b->pixels};
    const size_t count = a->bytes / PIXEL_BYTES;
    size_t different = 0;

    for (size_t i = 0; i < count; i++) {
        bool same = true;
        for (size_t j = i * PIXEL_BYTES; j < (i + 1) * PIXEL_BYTES; j++) {
            same = same && abs(pixels[0][j] - pixels[1][j]) <= STEPS;
        }
        different += !same;
    }
    return (double)different / (double)count;
}

/* Adds that of two residents' pictures. */
static bool add_difference(struct resident *const both[2], const struct job_desc *desc,
                           const char *name, cJSON *row, struct error *err)
{
    struct image images[2] = {0};
    const bool ok = both[0] && both[1] && renderer_render(both[0], desc, &images[0], err) &&
                    renderer_render(both[1], desc, &images[1], err);

    if (ok) {
        cJSON_AddNumberToObject(row, name, different_part(&images[0], &images[1]));
    }
    image_finish(&images[0]);
    image_finish(&images[1]);
    return ok;
}

static bool compare_stages(struct renderer *renderer, const struct embedded *example,
                           const struct job_desc *desc, int rounds, enum render_stage other,
                           const char *const names[2], cJSON *row, struct error *err)
{
    const enum render_stage stages[] = {RENDER_COMPUTE, other};
    const enum render_stage before = renderer_info(renderer)->stage;
    struct resident *both[2];

    for (int i = 0; i < 2; i++) {
        renderer_use_stage(renderer, stages[i]);
        both[i] = bench_open(renderer, example, err);
    }
    renderer_use_stage(renderer, before);
    const bool drawn = add_difference(both, desc, names[1], row, err);
    return compare(renderer, both, desc, rounds, names[0], row, err) && drawn;
}

bool bench_compare_stages(struct renderer *renderer, const struct embedded *example,
                          const struct job_desc *desc, int rounds, cJSON *row, struct error *err)
{
    static const char *const fragment[] = {"fragment_ratio", "fragment_differs"};
    static const char *const engine[] = {"engine_ratio", "engine_differs"};

    if (!renderer_info(renderer)->compute) {
        return true;
    }
    return compare_stages(renderer, example, desc, rounds, RENDER_FRAGMENT, fragment, row, err) &&
           compare_stages(renderer, example, desc, rounds, RENDER_ENGINE, engine, row, err);
}

/* --- what effects cost where they are switched off --- */

static struct resident *open_text(struct renderer *renderer, const cJSON *json, struct error *err)
{
    char *text = json_print(json, false);
    struct scene *scene = scene_parse(text, strlen(text), err);

    free(text);
    return scene ? resident_create(renderer, scene, 1) : NULL;
}

/* All its materials matt, so that none asks for rays. */
static void make_matt(cJSON *json)
{
    cJSON *material;

    cJSON_ArrayForEach(material, cJSON_GetObjectItem(json, "materials"))
    {
        cJSON_DeleteItemFromObject(material, "properties");
        cJSON_DeleteItemFromObject(material, "shader");
        cJSON_AddStringToObject(material, "shader", "phong");
    }
}

static void switch_off(cJSON *json)
{
    cJSON *render = cJSON_GetObjectItem(json, "render");

    render = render ? render : cJSON_AddObjectToObject(json, "render");
    for (size_t i = 0; i < 2; i++) {
        static const char *const effects[] = {"reflections", "refractions"};
        cJSON_DeleteItemFromObject(render, effects[i]);
        cJSON_AddFalseToObject(render, effects[i]);
    }
}

bool bench_effects(struct renderer *renderer, const struct embedded *example,
                   const struct bench_effort *effort, cJSON *row, struct error *err)
{
    const struct job_desc desc = {.width = 640 / effort->scale_down,
                                  .height = 360 / effort->scale_down,
                                  .level = QUALITY_STILL,
                                  .samples = 1,
                                  .exact = true};
    cJSON *off = json_parse((const char *)example->bytes, example->length, err);
    cJSON *matt = cJSON_Duplicate(off, true);

    make_matt(matt);
    switch_off(off);
    struct resident *const both[] = {open_text(renderer, off, err), open_text(renderer, matt, err)};
    cJSON_Delete(off);
    cJSON_Delete(matt);
    return compare(renderer, both, &desc, effort->rounds, "effects_off_ratio", row, err);
}
