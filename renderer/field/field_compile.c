/* SPDX-License-Identifier: MIT */
/* From a scene to its field program. */
#include "field.h"

#include <stdlib.h>

#include "field_emit.h"
#include "field_isolate.h"
#include "field_materials.h"
#include "field_sites.h"
#include "protocol/memory.h"

static uint64_t hash_code(uint64_t state, const struct field_code *code)
{
    state = builder_hash(state, (uint32_t)code->hash);
    return builder_hash(state, (uint32_t)(code->hash >> 32));
}

/* Everything that the GLSL text is made of. */
static uint64_t structure_hash(const struct field *field)
{
    uint64_t state = BUILDER_HASH_START;

    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        state = builder_hash(state, (uint32_t)in->op);
        state = builder_hash(state, in->type ? (uint32_t)in->type->number : 0);
        state = builder_hash(state, (uint32_t)in->a << 16 | in->b);
        state = builder_hash(state, (uint32_t)in->point << 16 | in->out);
        state = builder_hash(state, in->choices);
        state = builder_hash(state, in->params);
        state = builder_hash(state, in->seen);
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
    for (size_t i = 0; i < field->code_count; i++) {
        if (!field->codes[i].own) {
            return &field->codes[i];
        }
    }
    for (size_t i = 0; i < field->shader_count; i++) {
        if (!field->shaders[i].own) {
            return &field->shaders[i];
        }
    }
    return NULL;
}

/* Compilers write out each call. */
static size_t sum_code(const struct field *field)
{
    size_t size = 0;

    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        if (in->op == FIELD_SHAPE && !in->sdf) {
            size += (size_t)code_size(field->codes[in->choices].code);
        }
    }
    for (size_t i = 0; i < field->shader_count; i++) {
        size += field->shaders[i].own ? 0 : (size_t)code_size(field->shaders[i].code);
    }
    return size;
}

/* The environment's endless ground, united with the scene if there is any, which is in slot 0. */
static void add_floor(struct builder *b, struct result *whole)
{
    const struct record *environment = &b->scene->environment;

    if (record_number(environment, "floor") == 0 || b->ended || b->failed) {
        return;
    }
    struct node_frame frame = node_frame_create(0, 1, field_floor_slot(b->scene));
    struct node plane = {.type = node_type_find("plane")};
    record_init(&plane.params, &plane.type->record);
    struct value *offset = &plane.params.values[record_type_find(plane.params.type, "offset")];
    offset->number[0] = record_number(environment, "floor_height");
    struct result floor = field_emit_shape(b, &plane, &frame, whole->solid, ++b->index);
    record_finish(&plane.params);
    if (whole->solid) {
        builder_add_instruction(b, field_union_at(b, 0));
    }
    field_join(whole, &floor);
}

static int compare_members(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;

    return (x > y) - (x < y);
}

static void sort_members(struct field *field)
{
    if (field->member_count > 0) {
        qsort(field->members, field->member_count, sizeof *field->members, compare_members);
    }
}

bool field_has_member(const struct field *field, uint64_t hash)
{
    return field->member_count > 0 && bsearch(&hash, field->members, field->member_count,
                                              sizeof *field->members, compare_members);
}

struct field *field_compile(const struct scene *scene, struct error *err)
{
    return field_compile_as(scene, &(struct field_options){.drawn = NULL}, err);
}

/* What is the same for a program that is made and for one that is made again. */
static struct result emit_scene(struct builder *b)
{
    b->union_type = node_type_find("union");
    b->union_sdf = sdf_find(b->union_type);
    b->site = b->position = SITES_NONE;
    struct node_frame frame = node_frame_create(0, 1, 0);
    struct result whole = field_emit(b, b->scene->root, &frame, 0, FIELD_NOTHING);
    add_floor(b, &whole);
    if (!whole.solid) {
        builder_add_instruction(b, (struct field_instruction){.op = FIELD_EMPTY});
    }
    return whole;
}

static void set_extent(struct field *field, const struct builder *b, const struct result *whole)
{
    field->bounds = whole->shown ? whole->box : bounds_empty();
    field->transmissive_bounds = whole->transmissive_box;
    field->transmissive = whole->transmissive;
    field->loop_trips = b->trips > UINT32_MAX ? UINT32_MAX : (uint32_t)b->trips;
}

/* Takes the sites and the material shaders over, or frees them. */
static void keep_sites(struct builder *b)
{
    struct field_sites *sites = b->sites;

    if (!sites || b->failed) {
        sites_destroy(sites);
        free(b->material_shaders);
        return;
    }
    sites->slot_count = b->scene->materials.count + 1;
    sites->material_shaders = b->material_shaders;
    sites->transmissive = memory_alloc(sites->slot_count, sizeof *sites->transmissive);
    sites->repaint = memory_alloc(sites->slot_count, sizeof *sites->repaint);
    for (size_t slot = 0; slot < sites->slot_count; slot++) {
        sites->transmissive[slot] = field_material_transmissive(b, slot);
    }
    b->field->sites = sites;
}

struct field *field_compile_as(const struct scene *scene, const struct field_options *options,
                               struct error *err)
{
    struct field *field = memory_alloc(1, sizeof *field);

    field->references = 1;
    struct isolation *isolation =
        isolation_create(scene, options->isolated, options->isolated_count);
    const bool patchable = options->patchable && !isolation;
    struct builder builder = {.field = field,
                              .scene = scene,
                              .drawn = options->drawn,
                              .isolation = isolation,
                              .ended = options->ended,
                              .sites = patchable ? sites_create() : NULL};
    field_add_material_shaders(&builder);
    const struct result whole = emit_scene(&builder);
    isolation_destroy(isolation);
    if (builder.sites) {
        builder.sites->material_arguments = builder.argument_count;
    }
    field_add_materials(&builder);
    keep_sites(&builder);
    if (builder.failed) {
        if (err) {
            *err = builder.err;
        }
        field_unref(field);
        return NULL;
    }
    sort_members(field);
    set_extent(field, &builder, &whole);
    field->argument_count = builder.argument_count;
    field->user_code = find_user_code(field);
    field->code_size = sum_code(field);
    field->structure_hash = structure_hash(field);
    return field;
}

/* Materials whose numbers have changed; false: one that is transmissive is no more, or the other
 * way. */
static bool repaint(struct builder *b, const struct field *field)
{
    struct field_sites *sites = b->sites;
    const size_t base = field->material_base, stride = field->material_stride;

    if (sites->floor_changed) {
        field_put_floor(b);
        sites_touch(b, SITES_PARAMS, base + sites->slot_count * stride, stride);
    }
    for (size_t slot = 1; slot < sites->slot_count; slot++) {
        if (!sites->repaint[slot]) {
            continue;
        }
        if (field_material_transmissive(b, slot) != sites->transmissive[slot]) {
            return false;
        }
        b->argument_count = sites->material_arguments + field_material_arguments(b, slot);
        field_put_material(b, slot);
        sites_touch(b, SITES_PARAMS, base + slot * stride, stride);
        sites->repaint[slot] = false;
    }
    sites->floor_changed = false;
    return !b->failed;
}

bool field_run_again(struct field *field, struct field_sites *sites, const struct scene *scene)
{
    struct field places = *field;
    struct builder builder = {.field = &places,
                              .scene = scene,
                              .material_shaders = sites->material_shaders,
                              .sites = sites,
                              .again = true};

    places.instruction_count = places.vec4_count = 0;
    const struct result whole = emit_scene(&builder);
    if (builder.failed || places.instruction_count != field->instruction_count ||
        places.vec4_count != field->material_base ||
        builder.argument_count != sites->material_arguments || !repaint(&builder, field)) {
        return false;
    }
    set_extent(field, &builder, &whole);
    return true;
}

/* Compilers need about the square of the shapes, and of the code: half a minute for as many as are
 * allowed, on a CPU. */
bool field_can_be_compiled(const struct field *field)
{
    return field->shape_count <= LIMIT_COMPILED_SHAPES && field->code_size <= LIMIT_COMPILED_CODE;
}

bool field_can_be_interpreted(const struct field *field)
{
    return field->shape_count <= LIMIT_INTERPRETED_SHAPES &&
           field->code_size <= LIMIT_COMPILED_CODE;
}
