/* SPDX-License-Identifier: MIT */
/* How the processor's time of a picture grows with the number of shapes: families of scenes that
 * look alike at every size, drawn by the engine, in turns. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "protocol/memory.h"
#include "server/clock.h"

/* Of the last size, models written out are nearly as many nodes as a scene may have. */
enum { SIZES = 5, OF_A_MODEL = 10, OF_A_UNION = 1000 };
static const int sizes[SIZES] = {10, 100, 1000, 10000, 80000};

struct family {
    const char *name;
    double radius; /* of a shape, by half of the mean distance to the next; 0: a quarter of all */
    bool nested;   /* in groups of ten of groups of ten */
    bool modelled; /* instances of one model of ten shapes */
};

static const struct family families[] = {
    {"flat_union", 0.6, false, false},  {"deep_tree", 0.6, true, false},
    {"overlapping", 4.0, false, false}, {"all_overlapping", 0, false, false},
    {"instances", 0.6, false, true},
};
enum { FAMILIES = sizeof families / sizeof families[0] };

/* --- scenes --- */

/* The same numbers everywhere (Steele, Lea, Flood: Fast splittable pseudorandom number generators,
 * 2014). */
static double next_place(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);

    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53 * 2 - 1;
}

static void write_place(FILE *out, uint64_t *state)
{
    const double x = next_place(state), y = next_place(state), z = next_place(state);

    fprintf(out, "\"transform\":{\"translation\":[%.6f,%.6f,%.6f]}", x, y, z);
}

static void write_shape(FILE *out, uint64_t *state, double radius, int index)
{
    if (index % 2 == 0) {
        fprintf(out, "{\"type\":\"sphere\",\"params\":{\"radius\":%.6f},", radius);
    } else {
        fprintf(out, "{\"type\":\"box\",\"params\":{\"size\":[%.6f,%.6f,%.6f]},", 1.6 * radius,
                1.6 * radius, 1.6 * radius);
    }
    write_place(out, state);
    fputc('}', out);
}

/* Flat ones are one union of the field, whose nodes are not more than a node may have. */
static void write_shapes(FILE *out, uint64_t *state, double radius, int count, bool nested)
{
    const int part = nested && count > 10 ? count / 10 : count > 10 * OF_A_UNION ? OF_A_UNION : 1;

    fputs("{\"type\":\"union\",\"children\":[", out);
    for (int i = 0; i < count; i += part) {
        fputs(i > 0 ? "," : "", out);
        if (part > 1) {
            write_shapes(out, state, radius, part, nested);
        } else {
            write_shape(out, state, radius, i);
        }
    }
    fputs("]}", out);
}

static void write_instances(FILE *out, uint64_t *state, double radius, int count)
{
    const int instances = count / OF_A_MODEL;
    const double scale = 1 / cbrt(instances);

    fprintf(out, "{\"type\":\"union\",\"children\":[");
    for (int i = 0; i < instances; i++) {
        fprintf(out, "%s{\"type\":\"model\",\"params\":{\"model\":\"m\"},\"transform\":{",
                i ? "," : "");
        fprintf(out, "\"translation\":[%.6f,%.6f,", next_place(state), next_place(state));
        fprintf(out, "%.6f],\"scale\":[%.6f,%.6f,%.6f]}}", next_place(state), scale, scale, scale);
    }
    fprintf(out, "]},\"models\":{\"m\":");
    write_shapes(out, state, radius / scale, OF_A_MODEL, false);
    fputc('}', out);
}

/* All shapes lie in a cube of side 2 and get smaller as they get more. */
static struct scene *make_scene(const struct family *family, int count, const char *beside,
                                struct error *err)
{
    char *text = NULL;
    size_t length;
    uint64_t state = 1;
    const double radius = family->radius > 0 ? family->radius / cbrt(count) : 0.5;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    fprintf(out,
            "{\"format\":\"fieldcast/1\",\"camera\":{\"position\":[2.5,2,4]},%s\"root\":", beside);
    if (family->modelled) {
        write_instances(out, &state, radius, count);
    } else {
        write_shapes(out, &state, radius, count, family->nested);
    }
    fputc('}', out);
    fclose(out);
    struct scene *scene = scene_parse(text, length, err);
    free(text);
    return scene;
}

struct scene *bench_union(int count, struct error *err)
{
    return make_scene(&families[0], count,
                      "\"lights\":[{\"type\":\"directional\",\"direction\":[-0.5,-1,-0.3]}],", err);
}

/* --- measuring --- */

/* The slope of log(time) over log(size), over the second to the fourth. */
static double exponent(const double ms[SIZES])
{
    return log(ms[3] / ms[1]) / log((double)sizes[3] / sizes[1]);
}

/* One of each size in turns; `ms`: medians. */
static bool time_sizes(struct renderer *renderer, struct resident *const scenes[SIZES],
                       const struct bench_effort *effort, double ms[SIZES], struct error *err)
{
    const struct job_desc desc = {.width = 640 / effort->scale_down,
                                  .height = 360 / effort->scale_down,
                                  .level = QUALITY_DRAFT,
                                  .samples = 1,
                                  .exact = true};
    const int rounds = effort->rounds;
    double *times = memory_alloc((size_t)rounds * SIZES, sizeof *times);
    bool ok = true;

    for (int i = -1; ok && i < rounds; i++) { /* the first one only warms up */
        for (int k = 0; ok && k < SIZES; k++) {
            struct job_times stages;
            const int64_t start = clock_process_us();
            ok = bench_draw(renderer, scenes[k], &desc, &stages, err);
            times[k * rounds + (i < 0 ? 0 : i)] = (double)(clock_process_us() - start) / 1000;
        }
    }
    for (int k = 0; ok && k < SIZES; k++) {
        ms[k] = bench_quantile(times + (ptrdiff_t)k * rounds, (size_t)rounds, 0.5);
    }
    free(times);
    return ok;
}

static cJSON *row_of(const struct family *family, const double ms[SIZES])
{
    cJSON *row = cJSON_CreateObject(), *of = cJSON_AddObjectToObject(row, "cpu_ms");
    cJSON *ratios = cJSON_AddObjectToObject(row, "ratio");

    cJSON_AddStringToObject(row, "family", family->name);
    for (int i = 0; i < SIZES; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d", sizes[i]);
        bench_add(of, name, ms[i]);
        bench_add(ratios, name, ms[i] / ms[0]);
    }
    bench_add(row, "exponent", exponent(ms));
    return row;
}

static cJSON *grow(struct renderer *renderer, const struct family *family,
                   const struct bench_effort *effort, struct error *err)
{
    struct resident *scenes[SIZES] = {NULL};
    double ms[SIZES];
    bool ok = true;

    for (int i = 0; ok && i < SIZES; i++) {
        struct scene *scene = make_scene(family, sizes[i], "", err);
        scenes[i] = scene ? resident_create(renderer, scene, 1) : NULL;
        ok = scenes[i] != NULL;
    }
    ok = ok && time_sizes(renderer, scenes, effort, ms, err);
    for (int i = 0; i < SIZES; i++) {
        resident_destroy(scenes[i]);
    }
    return ok ? row_of(family, ms) : NULL;
}

cJSON *bench_growth(const struct renderer_params *params, const struct bench_effort *effort,
                    struct error *err)
{
    struct renderer_params own = *params;

    own.stage = RENDER_ENGINE;
    struct renderer *renderer = renderer_create(&own, err);
    cJSON *rows = cJSON_CreateArray();
    bool ok = renderer != NULL;
    for (int i = 0; ok && i < FAMILIES; i++) {
        cJSON *row = grow(renderer, &families[i], effort, err);
        ok = row != NULL;
        cJSON_AddItemToArray(rows, row);
    }
    renderer_destroy(renderer);
    if (!ok) {
        cJSON_Delete(rows);
        return NULL;
    }
    return rows;
}
