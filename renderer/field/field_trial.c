/* SPDX-License-Identifier: MIT */
/* Tries out users' code, a few points at a time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "field_code.h"
#include "protocol/memory.h"

#define BOX_HALF 2.0  /* of the box where a function has none of its own, */
#define FAR_HALF 32.0 /* and of the one in which only its slope is looked at */
enum { SHAPES_MAX = 8 /* with different numbers, of one code */ };

/* One code, with the numbers of a shape or material. */
struct tried {
    const struct field_code *code;
    double numbers[4 * LIMIT_DECLARED];
    double half[3], lipschitz;
    bool slopes_only;
};

struct field_trial {
    struct field *field;
    struct tried *tried;
    size_t count, capacity, next;
    struct code_probe probe; /* of the one before `next` */
    struct error warning, error;
};

static struct tried *add(struct field_trial *trial, const struct field_code *code)
{
    if (trial->count == trial->capacity) {
        trial->capacity = 2 * trial->capacity + 4;
        trial->tried = memory_resize(trial->tried, trial->capacity, sizeof *trial->tried);
    }
    struct tried *added = &trial->tried[trial->count++];
    *added = (struct tried){.code = code};
    return added;
}

static bool is_same(const struct tried *a, const struct tried *b)
{
    return a->code->hash == b->code->hash && a->slopes_only == b->slopes_only &&
           memcmp(a->numbers, b->numbers, sizeof a->numbers) == 0 &&
           memcmp(a->half, b->half, sizeof a->half) == 0 && a->lipschitz == b->lipschitz;
}

static size_t numbers_of(const struct field_code *code)
{
    size_t count = 0;

    for (int i = 0; i < code->place_count; i++) {
        count += (size_t)code->places[i].count;
    }
    return count;
}

static struct tried shape_at(const struct field *field, const struct field_instruction *in)
{
    const double *n = field->arguments + in->arguments + 12, *cut = n + FIELD_HEAD_NUMBERS;
    struct tried tried = {.code = &field->codes[in->choices], .lipschitz = cut[3] / n[0]};

    memcpy(tried.numbers, cut + FIELD_CUT_NUMBERS, numbers_of(tried.code) * sizeof *n);
    memcpy(tried.half, cut, sizeof tried.half);
    return tried;
}

/* Its box, and a large one where it has none of its own. */
static void add_shape(struct field_trial *trial, const struct tried *shape)
{
    const bool endless = shape->half[0] >= FIELD_UNCUT;

    *add(trial, shape->code) = *shape;
    if (endless) {
        struct tried *far = add(trial, shape->code);
        *far = *shape;
        far->slopes_only = true;
    }
}

static void add_shapes(struct field_trial *trial)
{
    const struct field *field = trial->field;

    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        if (in->op != FIELD_SHAPE || in->sdf || field->codes[in->choices].own) {
            continue;
        }
        const struct tried shape = shape_at(field, in);
        int known = 0;
        bool again = false;
        for (size_t k = 0; k < trial->count && !again && known < SHAPES_MAX; k++) {
            known += trial->tried[k].code == shape.code && !trial->tried[k].slopes_only;
            again = is_same(&trial->tried[k], &shape);
        }
        if (!again && known < SHAPES_MAX) {
            add_shape(trial, &shape);
        }
    }
}

static void add_shaders(struct field_trial *trial)
{
    const struct field *field = trial->field;
    int next = 0; /* shaders are numbered in the order of materials */

    for (size_t slot = 1; slot <= field->material_count; slot++) {
        double n[4 * LIMIT_DECLARED];
        if (field_shader_numbers(field, slot, n) != next) {
            continue;
        }
        const struct field_code *shader = &field->shaders[next++];
        if (shader->own) {
            continue;
        }
        struct tried *tried = add(trial, shader);
        memcpy(tried->numbers, n, sizeof n);
        tried->half[0] = tried->half[1] = tried->half[2] = BOX_HALF;
        tried->lipschitz = INFINITY;
    }
}

struct field_trial *field_trial_create(struct field *field)
{
    struct field_trial *trial = memory_alloc(1, sizeof *trial);

    trial->field = field_ref(field);
    add_shapes(trial);
    add_shaders(trial);
    return trial;
}

void field_trial_destroy(struct field_trial *trial)
{
    if (trial) {
        field_unref(trial->field);
        free(trial->tried);
        free(trial);
    }
}

bool field_trial_is_same(const struct field_trial *a, const struct field_trial *b)
{
    bool same = a->count == b->count;

    for (size_t i = 0; i < a->count && same; i++) {
        same = is_same(&a->tried[i], &b->tried[i]);
    }
    return same;
}

static void begin_next(struct field_trial *trial)
{
    const struct tried *tried = &trial->tried[trial->next++];
    double low[3], high[3];

    for (int i = 0; i < 3; i++) {
        const double endless = tried->slopes_only ? FAR_HALF : BOX_HALF;
        high[i] = tried->half[i] < FIELD_UNCUT ? tried->half[i] : endless;
        low[i] = -high[i];
    }
    code_probe_begin(&trial->probe, tried->code->code, tried->numbers, low, high, tried->lipschitz);
    trial->probe.slopes_only = tried->slopes_only;
}

/* A wrong slope is told, and drawn. */
static void take_fault(struct field_trial *trial, struct error *found)
{
    snprintf(found->place, sizeof found->place, "%s", trial->tried[trial->next - 1].code->place);
    *(found->line == 0 ? &trial->warning : &trial->error) = *found;
}

static int64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

bool field_trial_is_over(const struct field_trial *trial)
{
    return trial->error.kind != ERROR_NONE ||
           (trial->next == trial->count && trial->probe.asked == trial->probe.points);
}

void field_trial_go_on(struct field_trial *trial, int64_t us)
{
    const int64_t end = us == FIELD_TRIAL_ALL ? FIELD_TRIAL_ALL : now_us() + us;

    while (!field_trial_is_over(trial)) {
        struct error found = {0};
        if (trial->probe.asked == trial->probe.points) {
            begin_next(trial);
        }
        if (!code_probe_ask(&trial->probe, &found)) {
            take_fault(trial, &found);
        }
        if (now_us() >= end) {
            return;
        }
    }
}

const struct error *field_trial_warning(const struct field_trial *trial)
{
    return &trial->warning;
}

const struct error *field_trial_error(const struct field_trial *trial)
{
    return &trial->error;
}

bool field_try(struct field *field, struct error *out_warning, struct error *err)
{
    struct field_trial *trial = field_trial_create(field);

    field_trial_go_on(trial, FIELD_TRIAL_ALL);
    const bool ok = trial->error.kind == ERROR_NONE;
    *out_warning = trial->warning;
    if (!ok && err) {
        *err = trial->error;
    }
    field_trial_destroy(trial);
    return ok;
}
