/* SPDX-License-Identifier: MIT */
#include "oracle.h"

#include <math.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "compiled.h"
#include "drawing.h"
#include "eye.h"
#include "protocol/memory.h"

enum { THREADS = 2, STEPS_MAX = 20000 };

struct oracle {
    struct oracle_params params;
    struct field *field;
    struct eye eye;
    double reach;
    struct oracle_found *found;
    atomic_int row; /* the next to be taken */
};

/* --- rays --- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Through the centre of the place's pixel. */
static void ray_of(const struct oracle *oracle, int place, double origin[3], double direction[3])
{
    const struct oracle_params *p = &oracle->params;

    eye_ray(&oracle->eye, p->every * p->width, p->every * p->height, p->every * (place % p->width),
            p->every * (place / p->width), origin, direction);
}

static double footprint(const struct oracle *oracle, double t)
{
    return eye_footprint(&oracle->eye, oracle->params.every * oracle->params.height, t);
}

/* --- what the evaluator says --- */

/* Sphere tracing (Hart 1996). */
static double march(const struct oracle *oracle, const double origin[3], const double direction[3],
                    double p[3])
{
    double t = 0;

    for (int step = 0; step < STEPS_MAX && t < oracle->reach; step++) {
        for (int i = 0; i < 3; i++) {
            p[i] = origin[i] + t * direction[i];
        }
        const double d = field_distance(oracle->field, p);
        if (d < oracle->params.tolerance) {
            return t;
        }
        t += d;
    }
    return -1;
}

static void march_place(struct oracle *oracle, int place)
{
    const double gradient = oracle->params.gradient;
    struct oracle_found *found = &oracle->found[place];
    double origin[3], direction[3], p[3];

    ray_of(oracle, place, origin, direction);
    found->t = march(oracle, origin, direction, p);
    if (found->t >= 0) {
        field_normal(oracle->field, p, gradient > 0 ? gradient : footprint(oracle, found->t) / 2,
                     found->normal);
        found->slant = fabs(dot(found->normal, direction));
        found->id = field_surface(oracle->field, p, NULL).number;
    }
}

static void *march_rows(void *data)
{
    struct oracle *oracle = data;
    const int width = oracle->params.width;

    for (int row; (row = atomic_fetch_add(&oracle->row, 1)) < oracle->params.height;) {
        for (int x = 0; x < width; x++) {
            march_place(oracle, row * width + x);
        }
    }
    return NULL;
}

struct oracle *oracle_create(const struct scene *scene, const struct oracle_params *params)
{
    struct oracle *oracle = memory_alloc(1, sizeof *oracle);
    pthread_t threads[THREADS];

    oracle->params = *params;
    oracle->found =
        memory_alloc((size_t)params->width * (size_t)params->height, sizeof *oracle->found);
    oracle->field = compile_field(scene);
    oracle->eye = eye_of(&scene->camera);
    oracle->reach = record_number(&scene->render, "max_distance");
    for (int i = 0; i < THREADS; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, march_rows, oracle), 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(threads[i], NULL);
    }
    return oracle;
}

void oracle_destroy(struct oracle *oracle)
{
    field_unref(oracle->field);
    free(oracle->found);
    free(oracle);
}

/* --- comparison --- */

static bool is_inner(const struct oracle *oracle, int place)
{
    const int width = oracle->params.width, height = oracle->params.height;

    for (int i = 0; i < 9; i++) {
        const int x = place % width + i % 3 - 1, y = place / width + i / 3 - 1;
        if (x >= 0 && x < width && y >= 0 && y < height &&
            oracle->found[y * width + x].id != oracle->found[place].id) {
            return false;
        }
    }
    return oracle->found[place].id > 0;
}

static void compare(struct oracle_tally *tally, const struct oracle *oracle, int place, float depth,
                    const float normal[3], uint32_t id)
{
    const struct oracle_params *params = &oracle->params;
    const struct oracle_found *found = &oracle->found[place];
    const bool hit = found->t >= 0, drawn = depth < INFINITY, inner = is_inner(oracle, place);
    const double n[3] = {normal[0], normal[1], normal[2]};
    const double far = params->end_of_sight * oracle->reach;

    if (found->t > far || (drawn && depth > far)) {
        return;
    }
    tally->either += hit || drawn;
    tally->both += hit && drawn;
    if (params->inner_only ? inner : hit && drawn) {
        tally->judged++;
        tally->depths += !params->is_near(found, depth, footprint(oracle, found->t));
        tally->normals += !(dot(n, found->normal) >= cos(params->degrees * M_PI / 180));
    }
    if (inner) {
        tally->inner++;
        tally->ids += id != found->id;
    }
}

struct oracle_tally oracle_judge(const struct oracle *oracle, struct renderer *renderer,
                                 struct resident *resident)
{
    const int width = oracle->params.width, height = oracle->params.height;
    const int every = oracle->params.every;
    struct job_desc desc = drawing_desc(every * width, every * height);

    desc.as_floats = true;
    desc.aovs[AOV_DEPTH] = desc.aovs[AOV_NORMAL] = desc.aovs[AOV_ID] = true;
    struct drawing drawing = drawing_outputs(renderer, resident, &desc);
    const float *depths = drawing.of[AOV_DEPTH].pixels, *normals = drawing.of[AOV_NORMAL].pixels;
    const uint32_t *ids = drawing.of[AOV_ID].pixels;
    struct oracle_tally tally = {0};

    for (int i = 0; i < width * height; i++) {
        const int pixel = every * (i / width * every * width + i % width);
        compare(&tally, oracle, i, depths[pixel], normals + 3L * pixel, ids[pixel]);
    }
    drawing_finish(&drawing);
    return tally;
}

static double part(int some, int all)
{
    return some / fmax(all, 1);
}

bool oracle_agrees(const char *name, const struct oracle_tally *tally,
                   const struct oracle_bounds *bounds, bool wordy)
{
    const double overlap = part(tally->both, tally->either);
    const double depths = part(tally->depths, tally->judged);
    const double normals = part(tally->normals, tally->judged);
    const double ids = part(tally->ids, tally->inner);
    const bool good = overlap >= bounds->overlap && depths <= bounds->depths &&
                      normals <= bounds->normals && ids <= bounds->ids;

    if (!good || wordy) {
        print_message("# %-43s overlap %.4f, off of %5d: depth %6.2f %%, normal %6.2f %%; of %5d: "
                      "id %5.2f %%%s\n",
                      name, overlap, tally->judged, 100 * depths, 100 * normals, tally->inner,
                      100 * ids, good ? "" : " BAD");
    }
    return good;
}
