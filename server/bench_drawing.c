/* SPDX-License-Identifier: MIT */
/* How long drawing takes: from a scene never seen to its first picture, then by size and pass, and
 * what the encoders make of it. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "assets.h"
#include "bench.h"
#include "clock.h"
#include "files.h"
#include "protocol/memory.h"

enum { PATIENCE_MS = 50, FIRST_SIDE = 64 };

static const struct {
    int width, height;
} sizes[] = {{640, 360}, {1280, 720}};

static const struct {
    const char *name;
    struct encode_params params;
} codecs[] = {
    {"jpeg moving", {.format = IMAGE_JPEG, .quality = 75, .chroma_halved = true, .fast = true}},
    {"jpeg still", {.format = IMAGE_JPEG, .quality = 90}},
    {"png live", {.format = IMAGE_PNG, .fast = true}},
    {"png file", {.format = IMAGE_PNG}},
};

static double ms_since(int64_t start_us)
{
    return (double)(clock_us() - start_us) / 1000;
}

/* renderer_render with the times of the passes kept. */
static bool draw(struct renderer *renderer, struct resident *resident, const struct job_desc *desc,
                 struct image *out_image, struct job_times *out_times, struct error *err)
{
    struct job *job = job_create(resident, desc, err);
    enum job_state state = JOB_FAILED;
    if (!job) {
        return false;
    }
    while ((state = job_step(job)) != JOB_DONE && state != JOB_FAILED) {
        renderer_poll(renderer, state == JOB_WAITING ? PATIENCE_MS : 0);
    }
    if (state == JOB_DONE) {
        *out_times = job_times(job);
        *out_image = job_take_image(job);
    } else {
        *err = *job_error(job);
    }
    job_destroy(job);
    return state == JOB_DONE;
}

/* From the document to its first small picture, in a renderer of its own that has drawn another
 * scene before: so its own programs are there and only the scene's is measured. */
static bool first_picture(const struct renderer_params *params, const struct scene *scene,
                          double *out_ms, struct error *err)
{
    struct job_desc desc = {.width = FIRST_SIDE, .height = FIRST_SIDE, .samples = 1, .exact = true};
    struct job_times times;
    struct image image = {0};
    struct resident *other = NULL, *resident = NULL;
    struct renderer *renderer = renderer_create(params, err);
    bool ok = renderer;
    if (ok) {
        other = resident_create(renderer, scene_create_empty(), 1);
        ok = draw(renderer, other, &desc, &image, &times, err);
        image_finish(&image);
    }
    if (ok) {
        int64_t start = clock_us();
        resident = resident_create(renderer, scene_copy(scene), 1);
        ok = draw(renderer, resident, &desc, &image, &times, err);
        *out_ms = ms_since(start);
    }
    if (ok) {
        image_finish(&image);
    }
    resident_destroy(resident);
    resident_destroy(other);
    renderer_destroy(renderer);
    return ok;
}

/* With an empty shader cache, then with what that left in it. */
static cJSON *measure_compiling(const struct renderer_params *params, const struct scene *scene,
                                struct error *err)
{
    const char *directory = getenv("TMPDIR");
    char *cache = NULL;
    double cold, warm;
    if (asprintf(&cache, "%s/fieldcast-bench-XXXXXX", directory ? directory : "/tmp") < 0) {
        abort();
    }
    if (!mkdtemp(cache)) {
        error_set(err, ERROR_INTERNAL, cache, "cannot be made");
        free(cache);
        return NULL;
    }
    struct renderer_params fresh = *params;
    fresh.cache_dir = cache;
    bool ok = first_picture(&fresh, scene, &cold, err) && first_picture(&fresh, scene, &warm, err);
    directory_remove(cache);
    free(cache);
    if (!ok) {
        return NULL;
    }
    cJSON *row = cJSON_CreateObject();
    bench_add(row, "cold_ms", cold);
    bench_add(row, "warm_ms", warm);
    return row;
}

/* The picture of the last round is left in `out_image`. */
static cJSON *measure_size(struct renderer *renderer, struct resident *resident,
                           const struct job_desc *desc, int rounds, struct image *out_image,
                           struct error *err)
{
    enum { WHOLE, MARCH, LIGHT, READ, KINDS };
    static const char *const names[] = {"ms", "march_ms", "light_ms", "read_ms"};
    double *numbers = memory_alloc((size_t)rounds * KINDS, sizeof *numbers);
    bool ok = true;
    for (int i = -1; ok && i < rounds; i++) { /* the first one only warms up */
        struct job_times times = {0};
        int64_t start = clock_us();
        image_finish(out_image);
        *out_image = (struct image){0};
        ok = draw(renderer, resident, desc, out_image, &times, err);
        if (i < 0) {
            continue;
        }
        numbers[WHOLE * rounds + i] = ms_since(start);
        numbers[MARCH * rounds + i] = times.march_us / 1000.0;
        numbers[LIGHT * rounds + i] = times.light_us / 1000.0;
        numbers[READ * rounds + i] = times.read_us / 1000.0;
    }
    cJSON *row = ok ? cJSON_CreateObject() : NULL;
    if (ok) {
        cJSON_AddNumberToObject(row, "width", desc->width);
        cJSON_AddNumberToObject(row, "height", desc->height);
        for (int kind = 0; kind < KINDS; kind++) {
            double *of_kind = numbers + (ptrdiff_t)kind * rounds;
            bench_add(row, names[kind], bench_quantile(of_kind, (size_t)rounds, 0.5));
        }
    }
    free(numbers);
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
            int64_t start = clock_us();
            if (!image_encode(image, &codecs[c].params, &bytes, &length, err)) {
                cJSON_Delete(rows);
                free(numbers);
                return NULL;
            }
            numbers[i] = ms_since(start);
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

/* Adds `pictures` and `encoders` to the row. */
static bool measure_pictures(struct renderer *renderer, struct resident *resident, int rounds,
                             cJSON *row, struct error *err)
{
    struct image image = {0};
    cJSON *pictures = cJSON_AddArrayToObject(row, "pictures");
    cJSON *item = NULL;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        struct job_desc desc = {
            .width = sizes[i].width, .height = sizes[i].height, .samples = 1, .exact = true};
        item = measure_size(renderer, resident, &desc, rounds, &image, err);
        if (!item) {
            break;
        }
        cJSON_AddItemToArray(pictures, item);
    }
    cJSON *encoders = item ? measure_encoders(&image, rounds, err) : NULL;
    if (encoders) {
        cJSON_AddItemToObject(row, "encoders", encoders);
    }
    image_finish(&image);
    return encoders;
}

/* One renderer at a time: they share EGL's display. */
static cJSON *measure_example(const struct renderer_params *params, const struct asset *example,
                              int rounds, struct error *err)
{
    struct scene *scene = scene_parse((const char *)example->bytes, example->length, err);
    cJSON *row = NULL;
    if (!scene) {
        return NULL;
    }
    size_t nodes = scene->node_count;
    cJSON *compiling = measure_compiling(params, scene, err);
    struct renderer *renderer = compiling ? renderer_create(params, err) : NULL;
    if (renderer) {
        struct resident *resident = resident_create(renderer, scene, 1);
        scene = NULL;
        row = cJSON_CreateObject();
        cJSON_AddStringToObject(row, "example", example->path);
        cJSON_AddNumberToObject(row, "nodes", (double)nodes);
        cJSON_AddItemToObject(row, "first_picture", compiling);
        compiling = NULL;
        if (!measure_pictures(renderer, resident, rounds, row, err)) {
            cJSON_Delete(row);
            row = NULL;
        }
        resident_destroy(resident);
    }
    renderer_destroy(renderer);
    cJSON_Delete(compiling);
    scene_destroy(scene);
    return row;
}

/* `relative`: an example's time by the quickest one's at the same size, a figure that means the
 * same on every machine. */
static void add_ratios(cJSON *rows)
{
    for (int size = 0; size < (int)(sizeof sizes / sizeof *sizes); size++) {
        double quickest = 0;
        cJSON *row;
        cJSON_ArrayForEach(row, rows)
        {
            cJSON *picture = cJSON_GetArrayItem(cJSON_GetObjectItem(row, "pictures"), size);
            double ms = cJSON_GetNumberValue(cJSON_GetObjectItem(picture, "ms"));
            quickest = quickest == 0 || ms < quickest ? ms : quickest;
        }
        cJSON_ArrayForEach(row, rows)
        {
            cJSON *picture = cJSON_GetArrayItem(cJSON_GetObjectItem(row, "pictures"), size);
            bench_add(picture, "relative",
                      cJSON_GetNumberValue(cJSON_GetObjectItem(picture, "ms")) / quickest);
        }
    }
}

cJSON *bench_drawing(const struct renderer_params *params, const char *only, int rounds,
                     struct error *err)
{
    cJSON *rows = cJSON_CreateArray();
    for (size_t i = 0; i < examples_count; i++) {
        const struct asset *example = &examples_table[i];
        if (only && strcmp(only, example->path) != 0) {
            continue;
        }
        fprintf(stderr, "fieldcast: drawing %s\n", example->path);
        cJSON *row = measure_example(params, example, rounds, err);
        if (!row) {
            cJSON_Delete(rows);
            return NULL;
        }
        cJSON_AddItemToArray(rows, row);
    }
    add_ratios(rows);
    return rows;
}
