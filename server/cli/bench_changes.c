/* SPDX-License-Identifier: MIT */
/* What a picture costs after an edit of one shape's place, by the number of shapes, drawn by the
 * engine: the processor's time of each kind of picture, in turns. */
#include <stdlib.h>

#include "bench.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "server/clock.h"

enum { SIZES = 4 };
static const int sizes[SIZES] = {10, 100, 1000, 10000};

enum kind {
    FIRST,   /* nothing is known of the scene */
    IN_PART, /* after an edit, from the same place as before */
    VIEW,    /* of the same numbers, from elsewhere */
    EDITED,  /* after an edit, from elsewhere */
    KINDS
};
static const char *const names[KINDS] = {"first", "in_part", "view", "edited"};

struct measured {
    struct renderer *renderer;
    struct resident *resident;
    struct job_desc desc;
    struct record camera;
    int turns;
    uint64_t pixels; /* drawn by the last picture */
};

/* Some others on its way. */
static void look_from_elsewhere(struct measured *m)
{
    struct value *place = &m->camera.values[record_type_find(m->camera.type, "position")];

    place->number[2] = 4 + 0.01 * ++m->turns;
}

bool bench_move_one(struct resident *resident, int turn, struct error *err)
{
    const struct node *root = resident_scene(resident)->root;
    const struct node *node = root->children[(size_t)turn * 37 % root->child_count];

    while (node->child_count > 0) {
        node = node->children[0];
    }
    const double *at = record_vector(&node->transform, "translation");
    char text[256];
    const int length =
        snprintf(text, sizeof text,
                 "[{\"op\":\"set\",\"at\":\"/nodes/%s/transform/translation\",\"value\":"
                 "[%.9g,%.9g,%.9g]}]",
                 node->id, at[0] * 0.95, at[1] * 0.95, at[2] * 0.95);
    cJSON *ops = json_parse(text, (size_t)length, err);
    const bool ok = ops && resident_edit(resident, ops, resident_revision(resident) + 1, err);

    cJSON_Delete(ops);
    return ok;
}

/* Draws it and keeps what it was made of; `*out_ms` of the processors. */
static bool draw(struct measured *m, double *out_ms, struct error *err)
{
    struct image image = {0};
    const uint64_t before = renderer_counters(m->renderer).pixels;
    const int64_t start = clock_process_us();
    const bool ok = renderer_render(m->resident, &m->desc, &image, err);

    *out_ms = (double)(clock_process_us() - start) / 1000;
    m->pixels = renderer_counters(m->renderer).pixels - before;
    image_finish(&image);
    return ok;
}

static bool time_kind(struct measured *m, enum kind kind, double *out_ms, struct error *err)
{
    if (kind == FIRST) {
        renderer_forget(m->renderer);
    }
    if (kind == VIEW || kind == EDITED) {
        look_from_elsewhere(m);
    }
    return ((kind != IN_PART && kind != EDITED) || bench_move_one(m->resident, m->turns++, err)) &&
           draw(m, out_ms, err);
}

static cJSON *row_of(int size, const double ms[KINDS], double drawn)
{
    cJSON *row = cJSON_CreateObject(), *of, *ratios;

    cJSON_AddNumberToObject(row, "shapes", size);
    of = cJSON_AddObjectToObject(row, "cpu_ms");
    ratios = cJSON_AddObjectToObject(row, "ratio");
    for (int i = 0; i < KINDS; i++) {
        bench_add(of, names[i], ms[i]);
        bench_add(ratios, names[i], ms[i] / ms[0]);
    }
    bench_add(row, "drawn_part", drawn);
    return row;
}

/* Medians of all kinds, in turns. */
static cJSON *measure(struct measured *m, int size, int rounds, struct error *err)
{
    double *times = memory_alloc((size_t)rounds * (KINDS + 1), sizeof *times), ms[KINDS];
    bool ok = true;

    for (int i = -1; ok && i < rounds; i++) { /* the first one only warms up */
        const int at = i < 0 ? 0 : i;
        for (int k = 0; ok && k < KINDS; k++) {
            ok = time_kind(m, (enum kind)k, &times[k * rounds + at], err);
            if (k == IN_PART) {
                times[KINDS * rounds + at] = (double)m->pixels / (m->desc.width * m->desc.height);
            }
        }
    }
    for (int k = 0; k < KINDS; k++) {
        ms[k] = bench_quantile(times + (ptrdiff_t)k * rounds, (size_t)rounds, 0.5);
    }
    const double drawn = bench_quantile(times + (ptrdiff_t)KINDS * rounds, (size_t)rounds, 0.5);
    free(times);
    return ok ? row_of(size, ms, drawn) : NULL;
}

static cJSON *change(struct renderer *renderer, int size, const struct bench_effort *effort,
                     struct error *err)
{
    struct scene *scene = bench_union(size, err);
    cJSON *row = NULL;

    if (!scene) {
        return NULL;
    }
    struct measured m = {.renderer = renderer, .resident = resident_create(renderer, scene, 1)};
    record_copy(&m.camera, &scene->camera);
    m.desc = (struct job_desc){.width = 640 / effort->scale_down,
                               .height = 360 / effort->scale_down,
                               .camera = &m.camera,
                               .level = QUALITY_INTERACTIVE,
                               .transparent = -1,
                               .exact = true};
    row = measure(&m, size, effort->rounds, err);
    record_finish(&m.camera);
    resident_destroy(m.resident);
    return row;
}

cJSON *bench_changes(const struct renderer_params *params, const struct bench_effort *effort,
                     struct error *err)
{
    struct renderer_params own = *params;

    own.stage = RENDER_ENGINE;
    struct renderer *renderer = renderer_create(&own, err);
    cJSON *rows = cJSON_CreateArray();
    bool ok = renderer != NULL;
    for (int i = 0; ok && i < SIZES; i++) {
        cJSON *row = change(renderer, sizes[i], effort, err);
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
