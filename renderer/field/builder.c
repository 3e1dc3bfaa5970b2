/* SPDX-License-Identifier: MIT */
/* The growing parts of a field program while it is compiled. */
#include "builder.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "field_sites.h"
#include "protocol/memory.h"

/* The block, moved where it has to grow. */
static void *reserve(void *block, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity) {
        return block;
    }
    *capacity = needed * 2 + 64;
    return memory_resize(block, *capacity, size);
}

uint32_t builder_add_vec4s(struct builder *b, size_t count)
{
    struct field *field = b->field;
    const size_t first = field->vec4_count;

    field->vec4_count += count;
    if (b->again) {
        return (uint32_t)sites_touch(b, SITES_PARAMS, first, count);
    }
    field->params =
        reserve(field->params, &b->vec4_capacity, field->vec4_count + 1, 4 * sizeof(float));
    memset(field->params + 4 * first, 0, count * 4 * sizeof(float));
    return (uint32_t)first;
}

uint32_t builder_add_arguments(struct builder *b, size_t count)
{
    const size_t first = b->argument_count;

    b->argument_count += count;
    if (b->again) {
        return (uint32_t)sites_touch(b, SITES_ARGUMENTS, first, count);
    }
    b->field->arguments =
        reserve(b->field->arguments, &b->argument_capacity, b->argument_count + 1, sizeof(double));
    return (uint32_t)first;
}

static void max_slot(int *slots, int slot)
{
    assert(slot < FIELD_SLOTS_MAX);
    *slots = slot + 1 > *slots ? slot + 1 : *slots;
}

void builder_add_instruction(struct builder *b, struct field_instruction instruction)
{
    struct field *field = b->field;

    if (b->again) {
        sites_compare(b, field->instruction_count++, &instruction);
        return;
    }
    field->instructions = reserve(field->instructions, &b->instruction_capacity,
                                  field->instruction_count + 1, sizeof instruction);
    field->instructions[field->instruction_count++] = instruction;
    max_slot(&field->distance_slots, instruction.a);
    max_slot(&field->distance_slots, instruction.b);
    max_slot(&field->point_slots, instruction.point);
    max_slot(&field->point_slots, instruction.out);
}

void builder_insert_instruction(struct builder *b, size_t position,
                                struct field_instruction instruction)
{
    if (b->again) {
        sites_compare(b, position, &instruction);
        return;
    }
    builder_add_instruction(b, instruction);
    sites_shift(b);
    struct field_instruction *at = b->field->instructions + position;
    memmove(at + 1, at, (b->field->instruction_count - 1 - position) * sizeof *at);
    *at = instruction;
}

struct builder_mark builder_mark(const struct builder *b)
{
    const struct field *field = b->field;

    return (struct builder_mark){.instructions = field->instruction_count,
                                 .vec4s = field->vec4_count,
                                 .arguments = b->argument_count,
                                 .leaves = field->leaf_count,
                                 .points = b->points_count,
                                 .shapes = field->shape_count,
                                 .members = field->member_count,
                                 .loops = b->loops,
                                 .surface_rows = b->surface_rows,
                                 .trips = b->trips};
}

void builder_add_trips(struct builder *b, uint64_t trips)
{
    b->trips += trips;
    b->loops += trips > 0;
}

void builder_rewind(struct builder *b, struct builder_mark mark)
{
    b->field->instruction_count = mark.instructions;
    b->field->vec4_count = mark.vec4s;
    b->argument_count = mark.arguments;
    while (b->field->leaf_count > mark.leaves) {
        free(b->field->leaves[--b->field->leaf_count].id);
    }
    b->points_count = mark.points;
    b->field->shape_count = mark.shapes;
    b->field->member_count = mark.members;
    b->loops = mark.loops;
    b->surface_rows = mark.surface_rows;
    b->trips = mark.trips;
}

static void hide_shape(struct field *field, const struct field_instruction *in)
{
    float *head = field->params + 4 * ((size_t)in->params + FIELD_MATRIX_VEC4S);

    head[FIELD_LEAF] = head[FIELD_SLOT] = 0;
    head[FIELD_AWAY] = (float)FIELD_FAR;
}

/* A box that no point is nearer to than anything is. */
static void hide_guard(struct field *field, const struct field_instruction *in)
{
    static const float nowhere[8] = {
        0, 0, 0, 2, (float)-FIELD_FAR, (float)-FIELD_FAR, (float)-FIELD_FAR};

    memcpy(field->params + 4 * (size_t)in->params, nowhere, sizeof nowhere);
}

void builder_hide(struct builder *b, struct builder_mark mark)
{
    struct field *field = b->field;

    b->loops = mark.loops;
    for (size_t i = mark.instructions; i < field->instruction_count; i++) {
        struct field_instruction *in = &field->instructions[i];
        if (!b->again) {
            if (in->hidden) {
                continue;
            }
            in->hidden = true;
        }
        if (in->op == FIELD_SHAPE) {
            hide_shape(field, in);
        } else if (in->op == FIELD_GUARD) {
            hide_guard(field, in);
        } else if (in->op == FIELD_AFTER) {
            field->params[in->seen] = (float)FIELD_FAR;
        }
    }
}

void builder_put(struct builder *b, uint32_t vec4, int component, uint32_t argument, int count,
                 const double *numbers)
{
    float *to = b->field->params + 4 * (size_t)vec4 + component;

    for (int i = 0; i < count; i++) {
        to[i] = (float)numbers[i];
        b->field->arguments[argument + (uint32_t)i] = to[i];
    }
}

/* Multiplies lengths. */
static void scale_numbers(const struct param *params, double scale, double *numbers)
{
    for (size_t i = 0, at = 0; params[i].name; i++) {
        const int components = param_components(params[i].type);
        for (int c = 0; c < components; c++) {
            numbers[at++] *= params[i].unit == UNIT_LENGTH ? scale : 1;
        }
        if (params[i].type == PARAM_POINTS) {
            for (int rest = 2 * (int)numbers[at++]; rest > 0; rest--) {
                numbers[at++] *= scale;
            }
        }
    }
}

/* `numbers`: their count, then x, y of each. */
static void put_points(float *to, const double *numbers)
{
    for (size_t i = 0; i < 2 * (size_t)numbers[0]; i++) {
        to[i] = (float)numbers[1 + i];
    }
}

/* A list of points goes behind everything else, once that is known. */
static void defer_points(struct builder *b, uint32_t vec4, int component, const double *numbers)
{
    b->points = reserve(b->points, &b->points_capacity, b->points_count + 1, sizeof *b->points);
    b->points[b->points_count++] =
        (struct builder_points){.vec4 = vec4,
                                .component = component,
                                .argument = (uint32_t)(numbers - b->field->arguments)};
}

/* As many points as there were stand where they stood. */
static void place_again(struct builder *b, uint32_t vec4, int component, const double *numbers)
{
    const float *place = b->field->params + 4 * (size_t)vec4 + component;
    const size_t first = (size_t)place[0], count = (size_t)place[1];

    put_points(b->field->params + 4 * first, numbers);
    sites_touch(b, SITES_PARAMS, first, (count + 1) / 2);
}

/* Whether a list of points, of which there is one at most, is as long as it was. */
static bool has_room(const struct builder *b, const struct param *params,
                     const struct value *values, const struct param_slot *places, uint32_t vec4)
{
    for (size_t i = 0; b->again && params[i].name; i++) {
        if (params[i].type == PARAM_POINTS) {
            const size_t at = 4 * ((size_t)vec4 + (size_t)places[i].vec4);
            const float *place = b->field->params + at + places[i].component;
            return (double)place[1] == values[i].number[0];
        }
    }
    return true;
}

static void place_points(struct builder *b, uint32_t vec4, int component, const double *numbers)
{
    if (b->again) {
        place_again(b, vec4, component, numbers);
    } else {
        defer_points(b, vec4, component, numbers);
    }
}

void builder_place_points(struct builder *b)
{
    for (size_t i = 0; i < b->points_count; i++) {
        const struct builder_points *points = &b->points[i];
        const size_t count = (size_t)b->field->arguments[points->argument];
        const uint32_t first = builder_add_vec4s(b, (count + 1) / 2);
        float *place = b->field->params + 4 * (size_t)points->vec4 + points->component;
        place[0] = (float)first;
        place[1] = (float)count;
        put_points(b->field->params + 4 * (size_t)first, b->field->arguments + points->argument);
    }
    free(b->points);
    b->points = NULL;
}

void builder_put_params(struct builder *b, const struct param *params, const struct value *values,
                        const struct sdf *sdf, double scale, uint32_t vec4, int used,
                        uint32_t argument)
{
    struct param_slot places[SDF_PARAMS_MAX];
    double numbers[SDF_NUMBERS_MAX], *from = numbers;

    field_layout(params, used, places);
    if (!has_room(b, params, values, places, vec4)) {
        b->failed = true;
        return;
    }
    const int count = sdf_numbers(params, values, numbers);
    if (sdf && sdf->scale) {
        sdf->scale(numbers, scale);
    } else {
        scale_numbers(params, scale, numbers);
    }
    if (sdf && sdf->prepare) {
        sdf->prepare(numbers);
    }
    double *arguments = b->field->arguments + argument;
    for (int i = 0; i < count; i++) {
        arguments[i] = (float)numbers[i];
    }
    for (size_t i = 0; params[i].name; i++) {
        const enum param_type type = params[i].type;
        const uint32_t at = vec4 + (uint32_t)places[i].vec4;
        if (type == PARAM_POINTS) {
            place_points(b, at, places[i].component, arguments + (from - numbers));
            from += 1 + 2 * (int)*from;
            continue;
        }
        float *to = b->field->params + 4 * (size_t)at + places[i].component;
        for (int c = 0; c < places[i].count; c++) {
            to[c] = (float)from[c];
        }
        from += param_components(type);
    }
}

void builder_add_leaf(struct builder *b, uint32_t number, const char *id)
{
    struct field *field = b->field;

    if (b->again) {
        return;
    }
    field->leaves =
        reserve(field->leaves, &b->leaf_capacity, field->leaf_count + 1, sizeof *field->leaves);
    field->leaves[field->leaf_count++] = (struct field_leaf){number, memory_text(id)};
}

void builder_add_member(struct builder *b, uint64_t hash)
{
    struct field *field = b->field;

    if (b->again) {
        return;
    }
    field->members = reserve(field->members, &b->member_capacity, field->member_count + 1,
                             sizeof *field->members);
    field->members[field->member_count++] = hash;
}

uint64_t builder_hash(uint64_t state, uint32_t word)
{
    for (int i = 0; i < 4; i++) {
        state = (state ^ (word >> (8 * i) & 0xff)) * UINT64_C(0x100000001b3);
    }
    return state;
}

void builder_fail(struct builder *b, const struct error *err, const char *place)
{
    if (!b->failed) {
        b->failed = true;
        b->err = *err;
        snprintf(b->err.place, sizeof b->err.place, "%s", place);
    }
}
