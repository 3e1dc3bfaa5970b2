/* SPDX-License-Identifier: MIT */
/* Tries out users' code, a few points at a time. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "field_code.h"
#include "protocol/memory.h"

#define BOX_HALF 2.0 /* of the box where a function has none of its own */

/* One code, with the numbers of its first shape or material. */
struct tried {
    const struct field_code *code;
    double numbers[4 * LIMIT_DECLARED];
    double half[3], lipschitz;
};

struct field_trial {
    struct field *field;
    struct tried *tried;
    size_t count, next;
    struct code_probe probe; /* of the one before `next` */
    struct error warning, error;
};

static struct tried *add(struct field_trial *trial, const struct field_code *code)
{
    struct tried *added = &trial->tried[trial->count++];
    added->code = code;
    return added;
}

static size_t numbers_of(const struct field_code *code)
{
    size_t count = 0;
    for (int i = 0; i < code->place_count; i++) {
        count += (size_t)code->places[i].count;
    }
    return count;
}

static void add_shapes(struct field_trial *trial)
{
    const struct field *field = trial->field;
    uint32_t next = 0; /* codes are numbered in the order of their first shapes */
    for (size_t i = 0; i < field->instruction_count && next < field->code_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        if (in->op != FIELD_SHAPE || in->sdf || in->choices != next) {
            continue;
        }
        const double *n = field->arguments + in->arguments + 12, *cut = n + FIELD_HEAD_NUMBERS;
        const struct field_code *code = &field->codes[next++];
        if (code->own) {
            continue;
        }
        struct tried *tried = add(trial, code);
        memcpy(tried->numbers, cut + FIELD_CUT_NUMBERS, numbers_of(tried->code) * sizeof *n);
        memcpy(tried->half, cut, sizeof tried->half);
        tried->lipschitz = cut[3] / n[0];
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
    trial->tried = memory_alloc(field->code_count + field->shader_count + 1, sizeof *trial->tried);
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

static void begin_next(struct field_trial *trial)
{
    const struct tried *tried = &trial->tried[trial->next++];
    double low[3], high[3];
    for (int i = 0; i < 3; i++) {
        high[i] = tried->half[i] < FIELD_UNCUT ? tried->half[i] : BOX_HALF;
        low[i] = -high[i];
    }
    code_probe_begin(&trial->probe, tried->code->code, tried->numbers, low, high, tried->lipschitz);
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
