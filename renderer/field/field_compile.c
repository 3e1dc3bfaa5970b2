/* SPDX-License-Identifier: MIT */
/* From a scene to its field program. */
#include "field.h"

#include "field_emit.h"
#include "field_materials.h"
#include "protocol/memory.h"

static uint64_t hash_code(uint64_t state, const struct field_code *code)
{
    state = builder_hash(state, (uint32_t)code->hash);
    return builder_hash(state, (uint32_t)(code->hash >> 32));
}

/* Everything that the GLSL text is made of. */
static uint64_t shape_hash(const struct field *field)
{
    uint64_t state = BUILDER_HASH_START;
    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        state = builder_hash(state, (uint32_t)in->op);
        state = builder_hash(state, in->type ? (uint32_t)in->type->number : 0);
        state = builder_hash(state, (uint32_t)in->a << 16 | in->b);
        state = builder_hash(state, (uint32_t)in->point << 16 | in->out);
        state = builder_hash(state, in->choices);
        state = builder_hash(state, in->numbers);
    }
    for (size_t i = 0; i < field->code_count; i++) {
        state = hash_code(state, &field->codes[i]);
    }
    for (size_t i = 0; i < field->shader_count; i++) {
        state = hash_code(builder_hash(state, 1), &field->shaders[i]);
    }
    state = builder_hash(state, (uint32_t)field->material_stride);
    state = builder_hash(state, (uint32_t)field->material_base);
    return builder_hash(state, (uint32_t)field->vec4_count);
}

static const struct field_code *find_user_code(const struct field *field)
{
    if (field->code_count > 0) {
        return field->codes;
    }
    for (size_t i = 0; i < field->shader_count; i++) {
        if (!field->shaders[i].own) {
            return &field->shaders[i];
        }
    }
    return NULL;
}

/* The environment's endless ground, united with the scene if there is any, which is in slot 0. */
static void add_floor(struct builder *b, struct result *whole)
{
    const struct record *environment = &b->scene->environment;
    if (record_number(environment, "floor") == 0 || b->failed) {
        return;
    }
    struct frame frame = frame_create(0, 1, field_floor_slot(b->scene));
    struct node plane = {.type = node_type_find("plane")};
    record_init(&plane.params, &plane.type->record);
    struct value *offset = &plane.params.values[record_type_find(plane.params.type, "offset")];
    offset->number[0] = record_number(environment, "floor_height");
    struct result floor = field_emit_shape(b, &plane, &frame, whole->solid, ++b->index);
    record_finish(&plane.params);
    if (whole->solid) {
        builder_add_instruction(b, field_union_at(b, 0));
        floor.box = bounds_union(whole->box, floor.box);
    }
    field_join_clear(&floor, whole);
    *whole = floor;
}

struct field *field_compile(const struct scene *scene, struct error *err)
{
    struct field *field = memory_alloc(1, sizeof *field);
    field->references = 1;
    struct builder builder = {.field = field, .scene = scene};
    builder.union_type = node_type_find("union");
    builder.union_sdf = sdf_find(builder.union_type);
    struct frame frame = frame_create(0, 1, 0);
    struct result whole = field_emit(&builder, scene->root, &frame, 0, false);
    add_floor(&builder, &whole);
    field_add_materials(&builder);
    if (builder.failed) {
        if (err) {
            *err = builder.err;
        }
        field_unref(field);
        return NULL;
    }
    if (!whole.solid) {
        builder_add_instruction(&builder, (struct field_instruction){.op = FIELD_EMPTY});
        whole.box = bounds_empty();
    }
    field->bounds = whole.box;
    field->clear_bounds = whole.clear_box;
    field->clear = whole.clear;
    field->user_code = find_user_code(field);
    field->loop_trips = builder.trips > UINT32_MAX ? UINT32_MAX : (uint32_t)builder.trips;
    field->shape_hash = shape_hash(field);
    return field;
}
