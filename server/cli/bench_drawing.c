/* SPDX-License-Identifier: MIT */
/* How long drawing takes: from a scene never seen to its first picture, then by size and stage, and
 * what the encoders make of it. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "files.h"
#include "local_render.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"
#include "server/embedded.h"

enum { FIRST_SIDE = 64, STAGES_WIDTH = 96, STAGES_HEIGHT = 54 };

static const struct {
    int width, height;
} sizes[] = {{640, 360}, {1280, 720}};

static const struct {
    const char *name;
    struct encode_params params;
} codecs[] = {
    {"jpeg moving", {.format = CODEC_JPEG, .quality = 75, .chroma_halved = true, .fast = true}},
    {"jpeg still", {.format = CODEC_JPEG, .quality = 90}},
    {"png live", {.format = CODEC_PNG, .fast = true}},
    {"png file", {.format = CODEC_PNG}},
};

enum { SIZE_COUNT = sizeof sizes / sizeof *sizes };

/* --- a process of its own for each measurement --- */

/* Drivers keep compiled shaders in their process, and a renderer's end does not empty them. */
struct task {
    const struct renderer_params *params;
    const struct embedded *example;
    struct bench_effort effort;
};

typedef cJSON *measurement(const struct task *task, struct error *err);

static void answer(FILE *out, measurement *measure, const struct task *task)
{
    struct error err = {0};
    cJSON *result = measure(task, &err);

    if (!result) {
        result = cJSON_CreateObject();
        cJSON_AddStringToObject(result, "place", err.place);
        cJSON_AddStringToObject(result, "failed", err.message);
    }
    char *text = json_print(result, false);
    fputs(text, out);
    fclose(out);
}

static cJSON *read_answer(FILE *in, struct error *err)
{
    char *text = NULL;
    size_t size = 0;
    const ssize_t length = getdelim(&text, &size, '\0', in);
    cJSON *result = length > 0 ? json_parse(text, (size_t)length, err) : NULL;

    free(text);
    if (length <= 0) {
        error_set(err, ERROR_INTERNAL, "", "the process that measures died");
    }
    const cJSON *failed = cJSON_GetObjectItem(result, "failed");
    if (failed) {
        error_set(err, ERROR_INTERNAL, cJSON_GetObjectItem(result, "place")->valuestring, "%s",
                  failed->valuestring);
        cJSON_Delete(result);
        return NULL;
    }
    return result;
}

static cJSON *in_child(measurement *measure, const struct task *task, struct error *err)
{
    int ends[2];

    fflush(NULL);
    const pid_t child = pipe(ends) == 0 ? fork() : -1;
    if (child < 0) {
        error_set(err, ERROR_INTERNAL, "", "no process: %s", strerror(errno));
        return NULL;
    }
    if (child == 0) {
        close(ends[0]);
        answer(fdopen(ends[1], "w"), measure, task);
        _exit(0);
    }
    close(ends[1]);
    FILE *in = fdopen(ends[0], "r");
    cJSON *result = read_answer(in, err);
    fclose(in);
    waitpid(child, NULL, 0);
    return result;
}

/* --- the first picture --- */

static cJSON *describe(const struct task *task, struct error *err)
{
    struct renderer *renderer = renderer_create(task->params, err);

    if (!renderer) {
        return NULL;
    }
    const struct renderer_info *info = renderer_info(renderer);
    cJSON *row = cJSON_CreateObject();
    cJSON_AddStringToObject(row, "name", info->name);
    cJSON_AddStringToObject(row, "version", info->version);
    cJSON_AddBoolToObject(row, "software", info->software);
    renderer_destroy(renderer);
    return row;
}

struct resident *bench_open(struct renderer *renderer, const struct embedded *example,
                            struct error *err)
{
    struct scene *scene = scene_parse((const char *)example->bytes, example->length, err);

    if (scene) {
        local_render_give_example_file(renderer, scene);
    }
    return scene ? resident_create(renderer, scene, 1) : NULL;
}

/* From the document to its first small picture, in a renderer that has drawn another scene before:
 * so its own programs are there and only the scene's is measured. */
static cJSON *measure_first(const struct task *task, struct error *err)
{
    const struct job_desc desc = {
        .width = FIRST_SIDE, .height = FIRST_SIDE, .level = QUALITY_INTERACTIVE, .exact = true};
    struct job_times times;
    struct resident *other = NULL, *resident = NULL;
    cJSON *row = NULL;
    struct renderer *renderer = renderer_create(task->params, err);

    if (renderer) {
        other = resident_create(renderer, scene_create_empty(), 1);
    }
    if (other && bench_draw(renderer, other, &desc, &times, err)) {
        const int64_t start = clock_us();
        resident = bench_open(renderer, task->example, err);
        if (resident && bench_draw(renderer, resident, &desc, &times, err)) {
            row = cJSON_CreateObject();
            bench_add(row, "ms", bench_ms_since(start));
        }
    }
    resident_destroy(resident);
    resident_destroy(other);
    renderer_destroy(renderer);
    return row;
}

/* With an empty shader cache, then with what that left in it. */
static cJSON *measure_compiling(const struct task *task, struct error *err)
{
    const char *directory = getenv("TMPDIR");
    char *cache = NULL;

    if (asprintf(&cache, "%s/fieldcast-bench-XXXXXX", directory ? directory : "/tmp") < 0) {
        abort();
    }
    if (!mkdtemp(cache)) {
        error_set(err, ERROR_INTERNAL, cache, "cannot be made");
        free(cache);
        return NULL;
    }
    struct renderer_params fresh = *task->params;
    struct task in_fresh = *task;
    in_fresh.params = &fresh;
    fresh.device.cache_dir = cache;
    cJSON *cold = in_child(measure_first, &in_fresh, err);
    cJSON *warm = cold ? in_child(measure_first, &in_fresh, err) : NULL;
    cJSON *row = NULL;
    if (warm) {
        row = cJSON_CreateObject();
        bench_add(row, "cold_ms", bench_number(cold, "ms"));
        bench_add(row, "warm_ms", bench_number(warm, "ms"));
    }
    cJSON_Delete(cold);
    cJSON_Delete(warm);
    directory_remove(cache);
    free(cache);
    return row;
}

/* --- pictures --- */

static cJSON *measure_size(struct renderer *renderer, struct resident *resident,
                           const struct job_desc *desc, const struct task *task, struct error *err)
{
    cJSON *row = cJSON_CreateObject();

    cJSON_AddNumberToObject(row, "width", desc->width);
    cJSON_AddNumberToObject(row, "height", desc->height);
    const int rounds = task->effort.rounds;
    if (!bench_medians(renderer, resident, desc, rounds, row, err) ||
        !bench_compare_stages(renderer, task->example, desc, rounds, row, err)) {
        cJSON_Delete(row);
        return NULL;
    }
    return row;
}

static cJSON *measure_encoders(const struct image *image, int rounds, struct error *err)
{
    cJSON *rows = cJSON_CreateArray();
    double *numbers = memory_alloc((size_t)rounds, sizeof *numbers);

    for (size_t c = 0; c < sizeof codecs / sizeof *codecs; c++) {
        size_t length = 0;
        for (int i = 0; i < rounds; i++) {
            uint8_t *bytes = NULL;
            const int64_t start = clock_us();
            if (!image_encode(image, &codecs[c].params, &bytes, &length, err)) {
                cJSON_Delete(rows);
                free(numbers);
                return NULL;
            }
            numbers[i] = bench_ms_since(start);
            free(bytes);
        }
        cJSON *row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "codec", codecs[c].name);
        cJSON_AddNumberToObject(row, "width", image->width);
        cJSON_AddNumberToObject(row, "height", image->height);
        bench_add(row, "ms", bench_quantile(numbers, (size_t)rounds, 0.5));
        cJSON_AddNumberToObject(row, "bytes", (double)length);
        cJSON_AddItemToArray(rows, row);
    }
    free(numbers);
    return rows;
}

static bool add_pictures(struct renderer *renderer, struct resident *resident,
                         const struct task *task, cJSON *row, struct error *err)
{
    struct job_desc desc = {.level = QUALITY_INTERACTIVE, .exact = true};
    struct image image = {0};
    cJSON *pictures = cJSON_AddArrayToObject(row, "pictures"), *encoders = NULL;

    for (size_t i = 0; i < SIZE_COUNT; i++) {
        desc.width = sizes[i].width / task->effort.scale_down;
        desc.height = sizes[i].height / task->effort.scale_down;
        cJSON *item = measure_size(renderer, resident, &desc, task, err);
        if (!item) {
            return false;
        }
        cJSON_AddItemToArray(pictures, item);
    }
    if (renderer_render(resident, &desc, &image, err)) {
        encoders = measure_encoders(&image, task->effort.rounds, err);
        cJSON_AddItemToObject(row, "encoders", encoders);
    }
    image_finish(&image);
    return encoders;
}

static cJSON *measure_pictures(const struct task *task, struct error *err)
{
    cJSON *row = cJSON_CreateObject();
    struct renderer *renderer = renderer_create(task->params, err);
    struct resident *resident = renderer ? bench_open(renderer, task->example, err) : NULL;
    bool ok = resident;

    if (ok) {
        cJSON_AddStringToObject(row, "example", task->example->path);
        cJSON_AddNumberToObject(row, "nodes", (double)resident_scene(resident)->node_count);
        ok = add_pictures(renderer, resident, task, row, err) &&
             bench_effects(renderer, task->example, &task->effort, row, err) &&
             bench_edits(resident, row, err);
    }
    resident_destroy(resident);
    renderer_destroy(renderer);
    if (!ok) {
        cJSON_Delete(row);
        return NULL;
    }
    return row;
}

/* `relative`: an example's time by the quickest one's at the same size, a figure that means the
 * same on every machine. */
static void add_ratios(cJSON *rows)
{
    for (int size = 0; size < SIZE_COUNT; size++) {
        double quickest = 0;
        cJSON *row;
        cJSON_ArrayForEach(row, rows)
        {
            cJSON *picture = cJSON_GetArrayItem(cJSON_GetObjectItem(row, "pictures"), size);
            const double ms = bench_number(picture, "ms");
            quickest = quickest == 0 || ms < quickest ? ms : quickest;
        }
        cJSON_ArrayForEach(row, rows)
        {
            cJSON *picture = cJSON_GetArrayItem(cJSON_GetObjectItem(row, "pictures"), size);
            bench_add(picture, "relative", bench_number(picture, "ms") / quickest);
        }
    }
}

cJSON *bench_renderer(const struct renderer_params *params, struct error *err)
{
    return in_child(describe, &(struct task){.params = params}, err);
}

/* A row of each example that is asked for, each measured by `measure`. */
static cJSON *for_examples(const struct task *like, const char *only, measurement *measure,
                           struct error *err)
{
    cJSON *rows = cJSON_CreateArray();

    for (size_t i = 0; i < examples_count; i++) {
        struct task task = *like;
        task.example = &examples_table[i];
        if (only && strcmp(only, task.example->path) != 0) {
            continue;
        }
        fprintf(stderr, "fieldcast: drawing %s\n", task.example->path);
        cJSON *row = measure(&task, err);
        if (!row) {
            cJSON_Delete(rows);
            return NULL;
        }
        cJSON_AddItemToArray(rows, row);
    }
    return rows;
}

static cJSON *measure_example(const struct task *task, struct error *err)
{
    cJSON *row = in_child(measure_pictures, task, err);
    cJSON *first = row ? measure_compiling(task, err) : NULL;

    if (!first) {
        cJSON_Delete(row);
        return NULL;
    }
    cJSON_AddItemToObject(row, "first_picture", first);
    return row;
}

cJSON *bench_drawing(const struct renderer_params *params, const char *only,
                     const struct bench_effort *effort, struct error *err)
{
    const struct task task = {.params = params, .effort = *effort};
    cJSON *rows = for_examples(&task, only, measure_example, err);

    add_ratios(rows);
    return rows;
}

/* --- what computes pictures --- */

static cJSON *measure_stages(const struct task *task, struct error *err)
{
    const struct job_desc desc = {.width = STAGES_WIDTH,
                                  .height = STAGES_HEIGHT,
                                  .level = QUALITY_INTERACTIVE,
                                  .exact = true};
    struct renderer *renderer = renderer_create(task->params, err);
    cJSON *row = cJSON_CreateObject();

    cJSON_AddStringToObject(row, "example", task->example->path);
    const bool ok = renderer && bench_compare_stages(renderer, task->example, &desc,
                                                     task->effort.rounds, row, err);
    renderer_destroy(renderer);
    if (!ok) {
        cJSON_Delete(row);
        return NULL;
    }
    return row;
}

static cJSON *compare_example(const struct task *task, struct error *err)
{
    return in_child(measure_stages, task, err);
}

cJSON *bench_stages(const struct renderer_params *params, const char *only,
                    const struct bench_effort *effort, struct error *err)
{
    const struct task task = {.params = params, .effort = *effort};

    return for_examples(&task, only, compare_example, err);
}
