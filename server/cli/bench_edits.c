/* SPDX-License-Identifier: MIT */
/* How long a numeric edit takes in the render process: from its JSON to the numbers that the next
 * picture is drawn with, but for what the device copies. */
#include <stdlib.h>

#include "bench.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"

enum { EDITS = 2000 };

/* Moves a node a little. */
static int write_edit(char *out, size_t size, const struct node *node, int i)
{
    const double *at = record_vector(&node->transform, "translation");

    return snprintf(out, size,
                    "[{\"op\":\"set\",\"at\":\"/nodes/%s/transform/translation\",\"value\":"
                    "[%.9g,%.9g,%.9g]}]",
                    node->id, at[0] + (i % 2 ? 0.001 : -0.001), at[1], at[2]);
}

static bool edit(struct resident *resident, const char *text, size_t length, struct error *err)
{
    cJSON *ops = json_parse(text, length, err);
    const bool ok = ops && resident_edit(resident, ops, resident_revision(resident) + 1, err);

    cJSON_Delete(ops);
    return ok;
}

bool bench_edits(struct resident *resident, cJSON *row, struct error *err)
{
    const struct node *root = resident_scene(resident)->root, *node = root;
    double *numbers = memory_alloc(EDITS, sizeof *numbers);
    bool ok = true;

    for (int i = 0; ok && i < EDITS; i++) {
        char text[256];
        const size_t length = (size_t)write_edit(text, sizeof text, node, i);
        const int64_t start = clock_us();
        ok = edit(resident, text, length, err);
        numbers[i] = (double)(clock_us() - start);
        node = node_next(node, root);
        node = node ? node : root;
    }
    bench_add(row, "edit_us", bench_quantile(numbers, EDITS, 0.5));
    bench_add(row, "edit_p95_us", bench_quantile(numbers, EDITS, 0.95));
    free(numbers);
    return ok;
}
