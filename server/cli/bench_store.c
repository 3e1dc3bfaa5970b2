/* SPDX-License-Identifier: MIT */
/* How fast edits become durable: one at a time, each waiting for its commit, and in a stream, where
 * many share one; in a scene of one node and in one of very many. Each is checked, applied and
 * printed as in a room. */
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "files.h"
#include "protocol/edit.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"
#include "server/store/store.h"

enum { ALONE = 200, STREAM = 5000, MANY = 10000 };

struct bench_edits {
    struct scene *scene;
    struct store *store;
    uint64_t revision;
};

static struct store_write *new_write(const struct bench_edits *edits, enum store_kind kind,
                                     char *text)
{
    struct store_write *write = memory_alloc(1, sizeof *write);

    write->kind = kind;
    snprintf(write->scene, sizeof write->scene, "bench-%zu", edits->scene->node_count);
    strcpy(write->author, "benchmark");
    write->revision = edits->revision;
    write->edit = (int64_t)edits->revision;
    write->text = text;
    write->name = memory_text("Bench");
    write->nodes = edits->scene->node_count;
    return write;
}

static void push_edit(struct bench_edits *edits)
{
    char text[96];
    cJSON *applied = NULL;
    struct error err = {0};

    edits->revision++;
    int length =
        snprintf(text, sizeof text, "[{\"op\":\"set\",\"at\":\"/camera/fov\",\"value\":%d}]",
                 20 + (int)(edits->revision % 60));
    cJSON *ops = json_parse(text, (size_t)length, &err);
    if (!edit_apply(edits->scene, ops, &applied, NULL, &err)) {
        abort();
    }
    store_push(edits->store, new_write(edits, STORE_EDIT, json_print(applied, false)));
    cJSON_Delete(ops);
    cJSON_Delete(applied);
}

static cJSON *measure(struct bench_edits *edits)
{
    cJSON *row = cJSON_CreateObject();

    cJSON_AddNumberToObject(row, "nodes", (double)edits->scene->node_count);
    static double numbers[ALONE];
    store_push(edits->store, new_write(edits, STORE_CREATE, scene_print(edits->scene, false)));
    store_flush(edits->store);
    int64_t start = clock_us();
    for (int i = 0; i < ALONE; i++) {
        const int64_t pushed = clock_us();
        push_edit(edits);
        store_flush(edits->store);
        numbers[i] = (double)(clock_us() - pushed) / 1000;
    }
    bench_add(row, "alone_per_second", ALONE * 1e6 / (double)(clock_us() - start));
    bench_add(row, "alone_p50_ms", bench_quantile(numbers, ALONE, 0.5));
    bench_add(row, "alone_p95_ms", bench_quantile(numbers, ALONE, 0.95));
    start = clock_us();
    for (int i = 0; i < STREAM; i++) {
        push_edit(edits);
    }
    store_flush(edits->store);
    bench_add(row, "stream_per_second", STREAM * 1e6 / (double)(clock_us() - start));
    return row;
}

/* A scene of so many nodes, on its own in the store. */
static cJSON *measure_scene(struct store *store, size_t nodes)
{
    size_t length;
    char *text = bench_document(nodes, &length);
    struct bench_edits edits = {
        .scene = scene_parse(text, length, NULL), .store = store, .revision = 1};
    cJSON *row = measure(&edits);

    scene_destroy(edits.scene);
    free(text);
    return row;
}

cJSON *bench_store(const char *directory, struct error *err)
{
    static struct metrics metrics;
    char *path = NULL;
    cJSON *rows = NULL;

    if (!directory_make(directory, err)) {
        return NULL;
    }
    if (asprintf(&path, "%s/bench-XXXXXX", directory) < 0) {
        abort();
    }
    if (!mkdtemp(path)) {
        error_set(err, ERROR_INTERNAL, path, "cannot be made");
        free(path);
        return NULL;
    }
    fprintf(stderr, "fieldcast: storing in %s\n", path);
    struct store *store = store_open(path, &metrics, err);
    if (store) {
        rows = cJSON_CreateArray();
        cJSON_AddItemToArray(rows, measure_scene(store, 1));
        cJSON_AddItemToArray(rows, measure_scene(store, MANY));
    }
    store_close(store);
    directory_remove(path);
    free(path);
    return rows;
}
