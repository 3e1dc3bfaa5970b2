/* SPDX-License-Identifier: MIT */
#include "changes.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

/* They are many, if more than so many, and a part of all, have changed. */
enum { MANY_LEAST = 16, MANY_PART = 4 };

/* --- where the numbers of operations lie --- */

static int ascending(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;

    return (x > y) - (x < y);
}

/* Where blocks of numbers begin, ascending, the materials' last. */
static uint32_t *find_starts(const struct field *field, size_t *out_count)
{
    uint32_t *starts = memory_alloc(2 * field->instruction_count + 1, sizeof *starts);
    size_t count = 0;

    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        starts[count++] = in->params;
        if (in->seen) {
            starts[count++] = in->seen / 4;
        }
    }
    starts[count++] = (uint32_t)field->material_base;
    qsort(starts, count, sizeof *starts, ascending);
    *out_count = count;
    return starts;
}

/* The first start behind this one. */
static uint32_t next_start(const uint32_t *starts, size_t count, uint32_t start)
{
    size_t low = 0, high = count - 1;

    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (starts[middle] > start) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return starts[low];
}

/* Operations and changes of distances have the numbers of their rows, and many have none. */
static bool has_row(uint8_t op)
{
    return op == FIELD_COMBINE || op == FIELD_DISTANCE;
}

static struct extent find_extent(const struct operation *in, const struct node_type *type,
                                 const uint32_t *starts, size_t count)
{
    struct param_slot places[SDF_PARAMS_MAX];

    if (in->op == FIELD_EMPTY) {
        return (struct extent){0, 0};
    }
    if (has_row(in->op)) {
        const int vec4s = field_layout(type->record.params, 0, places);
        return (struct extent){in->params, in->params + (uint32_t)vec4s};
    }
    return (struct extent){in->params, next_start(starts, count, in->params)};
}

void changes_find_extents(struct engine_program *program)
{
    size_t count;
    uint32_t *starts = find_starts(program->field, &count);

    program->extents = memory_alloc(program->count, sizeof *program->extents);
    for (size_t i = 0; i < program->count; i++) {
        const struct operation *in = &program->operations[i];
        program->extents[i] = find_extent(in, program->kinds[in->kind].type, starts, count);
    }
    free(starts);
}

/* --- which have changed --- */

/* Of vec4s, how many before each have changed. */
static uint32_t *count_changes(const struct field *field, const float *before, const float *after)
{
    uint32_t *counts = memory_alloc(field->vec4_count + 1, sizeof *counts);

    for (size_t i = 0; i < field->vec4_count; i++) {
        const bool same = memcmp(before + 4 * i, after + 4 * i, 4 * sizeof *before) == 0;
        counts[i + 1] = counts[i] + !same;
    }
    return counts;
}

struct points_list changes_points_of(const struct engine_program *program, size_t index,
                                     const float *params)
{
    const struct operation *in = &program->operations[index];
    const struct node_type *type = program->kinds[in->kind].type;
    struct param_slot places[SDF_PARAMS_MAX];

    if (in->op != FIELD_SHAPE || !type) {
        return (struct points_list){0};
    }
    field_layout(type->record.params, FIELD_HEAD_NUMBERS, places);
    for (int i = 0; type->record.params[i].name; i++) {
        if (type->record.params[i].type == PARAM_POINTS) {
            const size_t vec4 = (size_t)in->params + FIELD_MATRIX_VEC4S + (size_t)places[i].vec4;
            const size_t place = 4 * vec4 + (size_t)places[i].component;
            const uint32_t first = (uint32_t)params[place], count = (uint32_t)params[place + 1];
            return (struct points_list){place, {first, first + (count + 1) / 2}};
        }
    }
    return (struct points_list){0};
}

static uint32_t count_within(const uint32_t *counts, struct extent extent)
{
    return counts[extent.end] - counts[extent.first];
}

uint8_t *changes_of_operations(const struct engine_program *program, const float *before,
                               const float *after)
{
    const struct field *field = program->field;
    const size_t materials = (field->material_count + 2) * field->material_stride;
    const size_t behind = field->material_base + materials;
    uint32_t *counts = count_changes(field, before, after), points = 0;
    uint8_t *changed = memory_alloc(program->count, sizeof *changed);

    for (size_t i = 0; i < program->count; i++) {
        const struct operation *in = &program->operations[i];
        const struct extent seen = {in->seen / 4, in->seen / 4 + (in->seen > 0)};
        const uint32_t own = count_within(counts, changes_points_of(program, i, after).extent);
        points += own;
        changed[i] =
            own + count_within(counts, program->extents[i]) + count_within(counts, seen) > 0;
    }
    const bool known = points == counts[field->vec4_count] - counts[behind];
    free(counts);
    if (!known) {
        free(changed);
        return NULL;
    }
    return changed;
}

size_t changes_count(const struct engine_program *program, const uint8_t *changed)
{
    size_t count = 0;

    for (size_t i = 0; i < program->count; i++) {
        count += changed[i];
    }
    return count;
}

bool changes_are_many(const struct engine_program *program, size_t count)
{
    return count > MANY_LEAST + program->count / MANY_PART;
}

static bool has_same_shaders(const struct field *a, const struct field *b)
{
    bool same = a->shader_count == b->shader_count;

    for (size_t i = 0; i < a->shader_count && same; i++) {
        same = a->shaders[i].hash == b->shaders[i].hash;
    }
    return same;
}

bool changes_of_materials(const struct field *field, const float *before, const struct field *other,
                          const float *after, struct material_set *out)
{
    const size_t stride = 4 * field->material_stride;

    if (field->material_stride != other->material_stride ||
        field->material_count != other->material_count || !has_same_shaders(field, other)) {
        return false;
    }
    before += 4 * field->material_base;
    after += 4 * other->material_base;
    for (size_t slot = 0; slot < field->material_count + 2; slot++) {
        if (memcmp(before + slot * stride, after + slot * stride, stride * sizeof *before) != 0) {
            material_set_add(out, (unsigned)slot);
        }
    }
    return true;
}
