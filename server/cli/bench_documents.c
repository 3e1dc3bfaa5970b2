/* SPDX-License-Identifier: MIT */
/* How long scenes of very many nodes take to read, copy, print and edit, and what they weigh. */
#include <malloc.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "protocol/edit.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"

enum { GROUP = 100, EDITS = 1000, DRAWN_NODES = 10000 };

char *bench_document(size_t nodes, size_t *out_length)
{
    static const char *const types[] = {"sphere", "box", "torus", "capsule"};
    char *text = NULL;
    FILE *out = open_memstream(&text, out_length);

    if (!out) {
        abort();
    }
    fputs("{\"format\":\"fieldcast/1\",\"root\":{\"id\":\"root\",\"type\":\"union\",\"children\":[",
          out);
    for (size_t i = 1, inside = 0; i < nodes; i++) {
        if (inside == 0) {
            fprintf(out, "%s{\"id\":\"group-%zu\",\"type\":\"group\",\"children\":[",
                    i > 1 ? "]}," : "", i);
            inside = GROUP;
            continue;
        }
        fprintf(
            out,
            "%s{\"id\":\"node-%zu\",\"type\":\"%s\",\"transform\":{\"translation\":[%zu,%zu,0.5]}}",
            inside < GROUP ? "," : "", i, types[i % 4], i % 100, i / 100);
        inside--;
    }
    fputs(nodes > 1 ? "]}]}}" : "]}}", out);
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

static double ms_since(int64_t start)
{
    return (double)(clock_us() - start) / 1000;
}

/* Sets a number of one leaf after the other. */
static double edit_us(struct scene *scene)
{
    const int64_t start = clock_us();

    for (size_t i = 0; i < EDITS; i++) {
        char text[128];
        const size_t node = 2 + i * (scene->node_count - 2) / EDITS;
        const int length =
            snprintf(text, sizeof text,
                     "[{\"op\":\"set\",\"at\":\"/nodes/node-%zu/transform/translation\","
                     "\"value\":[%zu,0,0]}]",
                     node, i);
        cJSON *ops = json_parse(text, (size_t)length, NULL), *inverse = NULL;
        edit_apply(scene, ops, NULL, &inverse, NULL); /* every hundredth is a group: not found */
        cJSON_Delete(inverse);
        cJSON_Delete(ops);
    }
    return (double)(clock_us() - start) / EDITS;
}

static cJSON *measure(size_t nodes, struct error *err)
{
    size_t length;
    char *text = bench_document(nodes, &length);
    cJSON *row = cJSON_CreateObject();
    const size_t before = mallinfo2().uordblks;
    int64_t start = clock_us();
    struct scene *scene = scene_parse(text, length, err);

    if (!scene) {
        free(text);
        cJSON_Delete(row);
        return NULL;
    }
    cJSON_AddNumberToObject(row, "nodes", (double)scene->node_count);
    bench_add(row, "document_kib", (double)length / 1024);
    bench_add(row, "parse_ms", ms_since(start));
    bench_add(row, "memory_mib", (double)(mallinfo2().uordblks - before) / 1048576);
    start = clock_us();
    struct scene *copy = scene_copy(scene);
    bench_add(row, "copy_ms", ms_since(start));
    start = clock_us();
    char *printed = scene_print(scene, false);
    bench_add(row, "print_ms", ms_since(start));
    bench_add(row, "edit_us", edit_us(scene));
    start = clock_us();
    scene_destroy(copy);
    bench_add(row, "destroy_ms", ms_since(start));
    scene_destroy(scene);
    free(printed);
    free(text);
    return row;
}

/* The same document in the render process: adds bench_edits. Nothing is drawn, so no device is
 * opened. */
static bool measure_drawn(const struct renderer_params *params, cJSON *row, struct error *err)
{
    struct renderer_params engine = *params;
    size_t length;
    char *text = bench_document(DRAWN_NODES, &length);

    engine.device.kind = DEVICE_NONE;
    engine.stage = RENDER_ENGINE;
    struct renderer *renderer = renderer_create(&engine, err);
    struct scene *scene = renderer ? scene_parse(text, length, err) : NULL;
    struct resident *resident = scene ? resident_create(renderer, scene, 1) : NULL;
    const bool ok = resident && bench_edits(resident, cJSON_AddObjectToObject(row, "drawn"), err);
    resident_destroy(resident);
    renderer_destroy(renderer);
    free(text);
    return ok;
}

cJSON *bench_documents(const struct renderer_params *params, struct error *err)
{
    static const size_t sizes[] = {1000, 10000, 100000};
    cJSON *rows = cJSON_CreateArray();

    fprintf(stderr, "fieldcast: reading scenes of up to 100000 nodes\n");
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        cJSON *row = measure(sizes[i], err);
        if (!row || (sizes[i] == DRAWN_NODES && !measure_drawn(params, row, err))) {
            cJSON_Delete(row);
            cJSON_Delete(rows);
            return NULL;
        }
        cJSON_AddItemToArray(rows, row);
    }
    return rows;
}
