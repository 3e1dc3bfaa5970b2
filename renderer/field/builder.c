/* SPDX-License-Identifier: MIT */
/* The growing parts of a field program while it is compiled. */
#include "builder.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

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
    size_t first = field->vec4_count;
    field->vec4_count += count;
    field->numbers =
        reserve(field->numbers, &b->vec4_capacity, field->vec4_count + 1, 4 * sizeof(float));
    memset(field->numbers + 4 * first, 0, count * 4 * sizeof(float));
    return (uint32_t)first;
}

uint32_t builder_add_arguments(struct builder *b, size_t count)
{
    size_t first = b->argument_count;
    b->argument_count += count;
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
    field->instructions = reserve(field->instructions, &b->instruction_capacity,
                                  field->instruction_count + 1, sizeof instruction);
    field->instructions[field->instruction_count++] = instruction;
    max_slot(&field->distance_slots, instruction.a);
    max_slot(&field->distance_slots, instruction.b);
    max_slot(&field->point_slots, instruction.point);
    max_slot(&field->point_slots, instruction.out);
}

struct builder_mark builder_mark(const struct builder *b)
{
    return (struct builder_mark){b->field->instruction_count, b->field->vec4_count,
                                 b->argument_count, b->field->leaf_count, b->trips};
}

void builder_rewind(struct builder *b, struct builder_mark mark)
{
    b->field->instruction_count = mark.instructions;
    b->field->vec4_count = mark.vec4s;
    b->argument_count = mark.arguments;
    while (b->field->leaf_count > mark.leaves) {
        free(b->field->leaves[--b->field->leaf_count].id);
    }
    b->trips = mark.trips;
}

void builder_put(struct builder *b, uint32_t vec4, int component, uint32_t argument, int count,
                 const double *numbers)
{
    float *to = b->field->numbers + 4 * (size_t)vec4 + component;
    for (int i = 0; i < count; i++) {
        to[i] = (float)numbers[i];
        b->field->arguments[argument + (uint32_t)i] = to[i];
    }
}

void builder_put_params(struct builder *b, const struct node *node, const struct sdf *sdf,
                        double scale, uint32_t vec4, int used, uint32_t argument)
{
    struct field_place places[SDF_NUMBERS_MAX];
    field_layout(node->type, used, places);
    double numbers[SDF_NUMBERS_MAX];
    sdf_numbers(&node->params, numbers);
    const struct param *params = node->type->record.params;
    for (size_t i = 0, at = 0; params[i].name; i++) {
        for (int c = 0; places[i].vec4 >= 0 && c < param_components(params[i].type); c++) {
            numbers[at++] *= params[i].unit == UNIT_LENGTH ? scale : 1;
        }
    }
    if (sdf->prepare) {
        sdf->prepare(numbers);
    }
    const double *from = numbers;
    for (size_t i = 0; params[i].name; i++) {
        if (places[i].vec4 >= 0) {
            int count = param_components(params[i].type);
            builder_put(b, vec4 + (uint32_t)places[i].vec4, places[i].component, argument, count,
                        from);
            from += count;
            argument += (uint32_t)count;
        }
    }
}

void builder_add_leaf(struct builder *b, uint32_t number, const char *id)
{
    struct field *field = b->field;
    field->leaves =
        reserve(field->leaves, &b->leaf_capacity, field->leaf_count + 1, sizeof *field->leaves);
    field->leaves[field->leaf_count++] = (struct field_leaf){number, memory_text(id)};
}
