/* SPDX-License-Identifier: MIT */
/* fieldcast bench: measures this machine, prints JSON. */
#include <math.h>
#include <stdlib.h>

#include "bench.h"
#include "command.h"
#include "protocol/json.h"
#include "server/clock.h"
#include "server/embedded.h"

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

double bench_quantile(double *numbers, size_t count, double quantile)
{
    qsort(numbers, count, sizeof *numbers, by_value);
    return numbers[(size_t)((double)(count - 1) * quantile + 0.5)];
}

void bench_add(cJSON *object, const char *name, double value)
{
    cJSON_AddNumberToObject(object, name, round(value * 1000) / 1000);
}

double bench_number(const cJSON *object, const char *name)
{
    return cJSON_GetNumberValue(cJSON_GetObjectItem(object, name));
}

double bench_ms_since(int64_t start_us)
{
    return (double)(clock_us() - start_us) / 1000;
}

const char *bench_part_name(size_t part)
{
    static const char *const names[] = {"all",    "drawing",  "growth",    "changes",
                                        "stages", "programs", "documents", "edits"};

    return part < sizeof names / sizeof names[0] ? names[part] : NULL;
}

/* Takes `item`; false where the measurement failed. */
static bool add(cJSON *result, const char *name, cJSON *item)
{
    if (item) {
        cJSON_AddItemToObject(result, name, item);
    }
    return item;
}

static cJSON *measure(const struct options *options, enum bench_part part, struct error *err)
{
    const struct bench_effort effort = {.rounds = option_int(options, OPTION_ROUNDS),
                                        .scale_down = option_int(options, OPTION_SCALE_DOWN)};
    struct renderer_params params;

    local_render_params(options, &params);
    switch (part) {
    case BENCH_DRAWING:
        return bench_drawing(&params, option_text(options, OPTION_ONLY), &effort, err);
    case BENCH_GROWTH:
        return bench_growth(&params, &effort, err);
    case BENCH_CHANGES:
        return bench_changes(&params, &effort, err);
    case BENCH_STAGES:
        return bench_stages(&params, option_text(options, OPTION_ONLY), &effort, err);
    case BENCH_PROGRAMS:
        return bench_programs(&params, &effort, err);
    case BENCH_DOCUMENTS:
        return bench_documents(&params, err);
    case BENCH_EDITS:
        return bench_store(option_text(options, OPTION_DATA), err);
    default:
        return bench_renderer(&params, err);
    }
}

int command_bench(const struct options *options)
{
    const char *only = option_text(options, OPTION_ONLY);
    const enum bench_part asked = (enum bench_part)option_int(options, OPTION_PART);
    struct error err = {0};

    if (only && !examples_find(only)) {
        fprintf(stderr, "fieldcast: --only: %s is no example\n", only);
        return EXIT_USAGE;
    }
    cJSON *result = cJSON_CreateObject();
    cJSON_AddStringToObject(result, "fieldcast", FIELDCAST_VERSION);
    cJSON_AddNumberToObject(result, "rounds", option_int(options, OPTION_ROUNDS));
    bool ok = add(result, "renderer", measure(options, BENCH_ALL, &err));
    for (enum bench_part part = BENCH_DRAWING; ok && bench_part_name(part); part++) {
        const bool of_examples = part != BENCH_GROWTH && part != BENCH_CHANGES;
        /* Drawing has stages; interpreters are for GPUs. */
        const bool of_all =
            part != BENCH_STAGES && part != BENCH_PROGRAMS && (!only || of_examples);
        if (asked == part || (asked == BENCH_ALL && of_all)) {
            ok = add(result, bench_part_name(part), measure(options, part, &err));
        }
    }
    if (ok) {
        char *text = json_print(result, true);
        puts(text);
        free(text);
    } else {
        fputs("fieldcast: ", stderr);
        error_print(&err, stderr);
    }
    cJSON_Delete(result);
    return ok ? EXIT_OK : EXIT_FAILED;
}
