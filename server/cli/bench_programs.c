/* SPDX-License-Identifier: MIT */
/* Pictures by compiled programs, by an interpreter and by the engine: how long the first one takes,
 * the next ones, and one after an edit of a shape's place. */
#include <stdlib.h>

#include "bench.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"

/* How a field is drawn. */
struct way {
    const char *name;
    enum render_stage stage;
    enum render_programs programs;
    bool is_for_large; /* scenes with more shapes than compilers take in a minute */
};
static const struct way ways[] = {
    {"compute_interpreted", RENDER_COMPUTE, PROGRAMS_INTERPRETED, true},
    {"compute", RENDER_COMPUTE, PROGRAMS_COMPILED, false},
    {"engine", RENDER_ENGINE, PROGRAMS_AUTO, true},
    {"fragment_interpreted", RENDER_FRAGMENT, PROGRAMS_INTERPRETED, true},
    {"fragment", RENDER_FRAGMENT, PROGRAMS_COMPILED, false},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static const char *const examples[] = {"first-steps", "snowman", "temple",
                                       "snail",       "frog",    "portrait"};
enum { EXAMPLES = sizeof examples / sizeof examples[0] };
static const int unions[] = {100, 500, 1000, 6000, 10000};
enum { UNIONS = sizeof unions / sizeof unions[0], COMPILED_UNION = 100 };

static const struct {
    const char *name;
    int width, height;
} sizes[] = {{"360p", 640, 360}, {"720p", 1280, 720}, {"1080p", 1920, 1080}};
enum { SIZES = sizeof sizes / sizeof sizes[0] };

static struct job_desc desc_of(size_t size, const struct bench_effort *effort)
{
    return (struct job_desc){.width = sizes[size].width / effort->scale_down,
                             .height = sizes[size].height / effort->scale_down,
                             .level = QUALITY_INTERACTIVE,
                             .transparent = -1,
                             .exact = true};
}

/* Of the whole picture in `ms`, the median. */
static bool time_pictures(struct renderer *renderer, struct resident *resident,
                          const struct job_desc *desc, int rounds, double *out_ms,
                          struct error *err)
{
    double *ms = memory_alloc((size_t)rounds, sizeof *ms);
    bool ok = true;

    for (int i = -1; ok && i < rounds; i++) { /* the first one only warms up */
        struct job_times times;
        const int64_t start = clock_us();
        ok = bench_draw(renderer, resident, desc, &times, err);
        ms[i < 0 ? 0 : i] = bench_ms_since(start);
    }
    *out_ms = bench_quantile(ms, (size_t)rounds, 0.5);
    free(ms);
    return ok;
}

/* Opens the scene, which it takes. */
static bool measure(struct renderer *renderer, struct resident *resident, int64_t start,
                    const struct bench_effort *effort, cJSON *out, struct error *err)
{
    bool ok = true;

    for (size_t i = 0; ok && i < SIZES; i++) {
        const struct job_desc desc = desc_of(i, effort);
        struct job_times times;
        double ms;
        if (i == 0) {
            ok = bench_draw(renderer, resident, &desc, &times, err);
            bench_add(out, "first", bench_ms_since(start));
        }
        ok = ok && time_pictures(renderer, resident, &desc, effort->rounds, &ms, err);
        if (ok) {
            bench_add(out, sizes[i].name, ms);
            fprintf(stderr, "%s %s: %.2f ms, first %.1f\n", out->string, sizes[i].name, ms,
                    bench_number(out, "first"));
        }
    }
    return ok;
}

/* The time from an edit of numbers to its picture, the median. */
static bool time_edits(struct renderer *renderer, struct resident *resident,
                       const struct bench_effort *effort, cJSON *out, struct error *err)
{
    const struct job_desc desc = desc_of(1, effort);
    double *ms = memory_alloc((size_t)effort->rounds, sizeof *ms);
    bool ok = true;

    for (int i = 0; ok && i < effort->rounds; i++) {
        struct job_times times;
        const int64_t start = clock_us();
        ok = bench_move_one(resident, i, err) && bench_draw(renderer, resident, &desc, &times, err);
        ms[i] = bench_ms_since(start);
    }
    bench_add(out, "edit_720p", bench_quantile(ms, (size_t)effort->rounds, 0.5));
    fprintf(stderr, "edit: %.2f ms\n", bench_number(out, "edit_720p"));
    free(ms);
    return ok;
}

static bool add_example(struct renderer *renderer, const char *name,
                        const struct bench_effort *effort, cJSON *rows, struct error *err)
{
    const int64_t start = clock_us();
    struct resident *resident = bench_open(renderer, examples_find(name), err);
    const bool ok = resident && measure(renderer, resident, start, effort,
                                        cJSON_AddObjectToObject(rows, name), err);

    resident_destroy(resident);
    return ok;
}

static bool add_union(struct renderer *renderer, int count, const struct bench_effort *effort,
                      cJSON *rows, struct error *err)
{
    struct scene *scene = bench_union(count, err);
    char name[32];

    snprintf(name, sizeof name, "union_%d", count);
    cJSON *row = cJSON_AddObjectToObject(rows, name);
    const int64_t start = clock_us();
    struct resident *resident = scene ? resident_create(renderer, scene, 1) : NULL;
    const bool ok = resident && measure(renderer, resident, start, effort, row, err) &&
                    time_edits(renderer, resident, effort, row, err);
    resident_destroy(resident);
    return ok;
}

/* null where the device has no such stage. */
static cJSON *rows_of(const struct renderer_params *params, const struct way *way,
                      const struct bench_effort *effort, struct error *err)
{
    struct renderer_params own = *params;

    own.stage = way->stage;
    own.programs = way->programs;
    struct renderer *renderer = renderer_create(&own, err);
    if (!renderer) {
        fprintf(stderr, "%s: %s\n", way->name, err->message);
        *err = (struct error){0};
        return cJSON_CreateNull();
    }
    cJSON *rows = cJSON_CreateObject();
    bool ok = true;
    for (int i = 0; ok && i < EXAMPLES; i++) {
        ok = add_example(renderer, examples[i], effort, rows, err);
    }
    for (int i = 0; ok && i < UNIONS; i++) {
        ok = (!way->is_for_large && unions[i] > COMPILED_UNION) ||
             add_union(renderer, unions[i], effort, rows, err);
    }
    renderer_destroy(renderer);
    if (!ok) {
        cJSON_Delete(rows);
        return NULL;
    }
    return rows;
}

cJSON *bench_programs(const struct renderer_params *params, const struct bench_effort *effort,
                      struct error *err)
{
    cJSON *result = cJSON_CreateObject();
    bool ok = true;

    for (int i = 0; ok && i < WAYS; i++) {
        cJSON *rows = rows_of(params, &ways[i], effort, err);
        ok = rows != NULL;
        cJSON_AddItemToObject(result, ways[i].name, rows);
    }
    if (!ok) {
        cJSON_Delete(result);
        return NULL;
    }
    return result;
}
