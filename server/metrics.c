/* SPDX-License-Identifier: MIT */
#include "metrics.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#define STAGES "fieldcast_stage_seconds_total"

struct row {
    const char *name, *type, *help;
};

static const struct row rows[METRIC_COUNT] = {
#define X(name, text, type, help) {"fieldcast_" text, type, help},
    METRICS(X)
#undef X
};

static int64_t read_value(const _Atomic int64_t *value)
{
    return atomic_load_explicit(value, memory_order_relaxed);
}

char *metrics_print(const struct metrics *metrics)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    for (int i = 0; i < METRIC_COUNT; i++) {
        fprintf(out, "# HELP %s %s.\n# TYPE %s %s\n%s %" PRId64 "\n", rows[i].name, rows[i].help,
                rows[i].name, rows[i].type, rows[i].name, read_value(&metrics->value[i]));
    }
    fprintf(out, "# HELP %s Time of pictures.\n# TYPE %s counter\n", STAGES, STAGES);
    for (int i = 0; i < FRAME_STAGES; i++) {
        fprintf(out, "%s{stage=\"%s\"} %.6f\n", STAGES, stage_row((enum frame_stage)i)->name,
                (double)read_value(&metrics->stage_us[i]) * 1e-6);
    }
    fclose(out);
    return text;
}
