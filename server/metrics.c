/* SPDX-License-Identifier: MIT */
#include "metrics.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

struct row {
    const char *name, *type, *help;
};

static const struct row rows[METRIC_COUNT] = {
#define X(name, text, type, help) {"fieldcast_" text, type, help},
    METRICS(X)
#undef X
};

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
                rows[i].name, rows[i].type, rows[i].name,
                atomic_load_explicit(&metrics->value[i], memory_order_relaxed));
    }
    fclose(out);
    return text;
}
