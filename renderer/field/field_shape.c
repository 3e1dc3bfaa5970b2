/* SPDX-License-Identifier: MIT */
/* Blocks of numbers and instructions of single shapes. */
#include "field_shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "field_code.h"
#include "field_materials.h"
#include "field_parametric.h"
#include "protocol/memory.h"
#include "renderer/code/equation_expand.h"
#include "renderer/sdf/patches.h"
#include "renderer/sdf/polynomial.h"

uint32_t field_choices(const struct record *params)
{
    uint32_t all = 0;

    for (int i = 0; params->type->params[i].name; i++) {
        if (params->type->params[i].type == PARAM_ENUM) {
            all = all << 8 | (uint32_t)params->values[i].number[0];
        }
    }
    return all;
}

static int prepared_numbers(const struct node *node, const struct sdf *sdf,
                            double out[SDF_NUMBERS_MAX])
{
    const int count = sdf_numbers(node->params.type->params, node->params.values, out);

    if (sdf->prepare) {
        sdf->prepare(out);
    }
    return count;
}

/* Anything inside an instance is its leaf; the floor, which is no node, is none. */
static void add_leaf(struct builder *b, uint32_t number, const struct node *node)
{
    const struct field *field = b->field;

    b->field->shape_count++;
    const char *id = b->instance ? b->instance_node->id : node->id;
    if (id && (field->leaf_count == 0 || field->leaves[field->leaf_count - 1].number != number)) {
        builder_add_leaf(b, number, id);
    }
}

/* What is common to all shapes, in front of their parameters. */
static void fill_head(const struct builder *b, const struct node_frame *frame, double slope,
                      uint32_t number, double out_head[FIELD_HEAD_NUMBERS])
{
    const bool transmissive = field_material_transmissive(b, frame->material);
    const double cuts = b->cuts_transmissive ? FIELD_CUTS_TRANSMISSIVE : FIELD_CUTS_OPAQUE;

    out_head[FIELD_SCALE] = frame->scale / slope;
    out_head[FIELD_LEAF] = number;
    out_head[FIELD_SLOT] = (double)frame->material + (b->cutting ? cuts : 0);
    out_head[FIELD_TRANSMISSIVE] = b->cutting ? 0 : transmissive ? 1 : -1;
    out_head[FIELD_AWAY] = 0;
}

static void emit_shape(struct builder *b, const struct node *node, const struct sdf *sdf,
                       const struct node_frame *frame, uint16_t slot, uint32_t number)
{
    struct param_slot places[SDF_PARAMS_MAX];
    double numbers[SDF_NUMBERS_MAX];
    const int vec4s = field_layout(node->params.type->params, FIELD_HEAD_NUMBERS, places);
    const int count = prepared_numbers(node, sdf, numbers);
    const uint32_t block = builder_add_vec4s(b, FIELD_MATRIX_VEC4S + (size_t)vec4s);
    uint32_t arguments = builder_add_arguments(b, 12 + FIELD_HEAD_NUMBERS + (size_t)count);
    const double slope = sdf->lipschitz ? sdf->lipschitz(numbers) : node->type->lipschitz;
    double head[FIELD_HEAD_NUMBERS];

    fill_head(b, frame, slope, number, head);
    builder_put(b, block, 0, arguments, 12, frame->matrix);
    builder_put(b, block + FIELD_MATRIX_VEC4S, 0, arguments + 12, FIELD_HEAD_NUMBERS, head);
    builder_put_params(b, node->params.type->params, node->params.values, sdf, 1,
                       block + FIELD_MATRIX_VEC4S, FIELD_HEAD_NUMBERS,
                       arguments + 12 + FIELD_HEAD_NUMBERS);
    builder_add_trips(b, sdf->trips ? (uint64_t)sdf->trips(numbers) : 0);
    add_leaf(b, number, node);
    builder_add_instruction(b, (struct field_instruction){.op = FIELD_SHAPE,
                                                          .type = node->type,
                                                          .sdf = sdf,
                                                          .a = slot,
                                                          .point = frame->point,
                                                          .choices = field_choices(&node->params),
                                                          .params = block,
                                                          .arguments = arguments});
}

static struct bounds shape_box(const struct node *node, const struct sdf *sdf)
{
    double numbers[SDF_NUMBERS_MAX];

    prepared_numbers(node, sdf, numbers);
    return sdf->box(numbers);
}

/* Equations cut themselves. Returns the box around it. */
static struct bounds fill_cut(const struct field_call *call, double scale,
                              double out_cut[FIELD_CUT_NUMBERS])
{
    struct bounds box = bounds_infinite();

    for (int i = 0; i < 3; i++) {
        const bool ends = call->size[i] > 0;
        box.high[i] = ends ? call->size[i] / 2 : INFINITY;
        box.low[i] = -box.high[i];
        out_cut[i] = ends && !call->is_equation ? box.high[i] : FIELD_UNCUT;
    }
    out_cut[3] = scale;
    out_cut[FIELD_UNSTEADY] = equation_unsteady(call->extent) * scale;
    out_cut[FIELD_LOOSE] = 0;
    out_cut[FIELD_JUMP] = 2 * out_cut[FIELD_UNSTEADY];
    return box;
}

/* The head of its numbers. `thickness`: in parts of the extent; -1: solid. */
static void fill_form(const struct field_call *call, const double *numbers, double thickness,
                      int degree, int count, double out[4 * POLYNOMIAL_HEAD])
{
    const double head[4 * POLYNOMIAL_HEAD] = {call->size[0] / 2,
                                              call->size[1] / 2,
                                              call->size[2] / 2,
                                              call->extent,
                                              call->form.ball ? numbers[3] : 0,
                                              thickness,
                                              degree,
                                              polynomial_rest_rows(degree),
                                              POLYNOMIAL_ESTIMATE,
                                              EQUATION_REACH,
                                              fmax(thickness / 16, 0),
                                              count};

    memcpy(out, head, sizeof head);
}

/* A shape whose numbers are no parameters, but made of them: `sdf` reads them. */
static void emit_numbers(struct builder *b, const struct node *node, const struct node_frame *frame,
                         uint16_t slot, uint32_t number, const struct sdf *sdf, uint32_t choices,
                         const double cut[FIELD_CUT_NUMBERS], const double *numbers, size_t rows)
{
    const size_t heads = FIELD_MATRIX_VEC4S + FIELD_HEAD_VEC4S;
    const int count = 4 * (int)rows;
    double head[FIELD_HEAD_NUMBERS];

    fill_head(b, frame, 1, number, head);
    const uint32_t block = builder_add_vec4s(b, heads + FIELD_CUT_VEC4S + rows);
    const uint32_t arguments =
        builder_add_arguments(b, 12 + FIELD_HEAD_NUMBERS + FIELD_CUT_NUMBERS + (size_t)count);
    builder_put(b, block, 0, arguments, 12, frame->matrix);
    builder_put(b, block + FIELD_MATRIX_VEC4S, 0, arguments + 12, FIELD_HEAD_NUMBERS, head);
    builder_put(b, block + (uint32_t)heads, 0, arguments + 12 + FIELD_HEAD_NUMBERS,
                FIELD_CUT_NUMBERS, cut);
    builder_put(b, block + (uint32_t)heads + FIELD_CUT_VEC4S, 0,
                arguments + 12 + FIELD_HEAD_NUMBERS + FIELD_CUT_NUMBERS, count, numbers);
    add_leaf(b, number, node);
    builder_add_instruction(b, (struct field_instruction){.op = FIELD_SHAPE,
                                                          .type = node->type,
                                                          .sdf = sdf,
                                                          .a = slot,
                                                          .point = frame->point,
                                                          .choices = choices,
                                                          .params = block,
                                                          .arguments = arguments});
}

/* An equation that is a polynomial: its coefficients are numbers of the field. */
static struct result emit_polynomial(struct builder *b, const struct node *node,
                                     const struct node_frame *frame, uint16_t slot, uint32_t number,
                                     const struct field_call *call, struct equation *equation)
{
    const bool is_square = !call->form.sheet && equation_take_root(equation);
    const int degree = equation_degree(equation);
    const size_t rows = POLYNOMIAL_HEAD + polynomial_rows(degree);
    double declared[SDF_NUMBERS_MAX], cut[FIELD_CUT_NUMBERS];
    double c[POLYNOMIAL_COEFFICIENTS_MAX], *numbers = memory_alloc(4 * rows, sizeof *numbers);
    const struct bounds box = fill_cut(call, frame->scale, cut);

    cut[FIELD_JUMP] = POLYNOMIAL_ESTIMATE * call->extent * frame->scale;
    cut[FIELD_UNSTEADY] = hypot(POLYNOMIAL_ESTIMATE, EQUATION_REACH) * call->extent * frame->scale;
    sdf_numbers(call->params, call->values, declared);
    const double thickness = call->form.sheet ? declared[4] / call->extent
                             : is_square      ? POLYNOMIAL_THIN
                                              : -1;
    equation_expand(equation, declared + EQUATION_FORM_NUMBERS, call->extent, degree, c);
    const int count = polynomial_write(degree, c, numbers + (size_t)(4 * POLYNOMIAL_HEAD));
    fill_form(call, declared, thickness, degree, count, numbers);
    builder_add_trips(b, (uint64_t)polynomial_trips(degree, count));
    emit_numbers(b, node, frame, slot, number, &sdf_polynomial, FIELD_POLYNOMIAL, cut, numbers,
                 rows);
    free(numbers);
    return (struct result){.solid = true, .shown = true, .box = box};
}

/* A parametric surface: its patches are. */
static struct result emit_surface(struct builder *b, const struct node *node,
                                  const struct node_frame *frame, uint16_t slot, uint32_t number)
{
    double cut[FIELD_CUT_NUMBERS] = {FIELD_UNCUT, FIELD_UNCUT, FIELD_UNCUT, frame->scale};
    struct result result = {0};
    struct parametric_numbers *surface = parametric_numbers_of(b, node);

    if (!surface) {
        return result;
    }
    const double loose = patches_loose(surface->numbers);
    cut[FIELD_LOOSE] = loose * frame->scale;
    builder_add_trips(b, (uint64_t)patches_trips());
    emit_numbers(b, node, frame, slot, number, &sdf_patches, FIELD_PATCHES, cut, surface->numbers,
                 surface->rows);
    result = (struct result){.solid = true,
                             .shown = true,
                             .box = b->measured ? bounds_grow(surface->box, loose) : surface->box};
    parametric_release(surface);
    return result;
}

/* Another equation: what its code reads are numbers of the field. */
static struct result emit_equation(struct builder *b, const struct node *node,
                                   const struct node_frame *frame, uint16_t slot, uint32_t number,
                                   const struct field_call *call, const struct equation *equation)
{
    double declared[SDF_NUMBERS_MAX], numbers[4 * EQUATION_VECTORS], cut[FIELD_CUT_NUMBERS];
    const struct equation_form form = {call->form.sheet, call->form.ball, .even = b->measured};

    sdf_numbers(call->params, call->values, declared);
    const int vectors =
        equation_code_numbers(equation, declared, declared + EQUATION_FORM_NUMBERS, numbers);
    const int index = field_equation_add(b, equation, form, vectors, call->place);
    if (index < 0) {
        return (struct result){0};
    }
    const struct bounds box = fill_cut(call, frame->scale, cut);
    builder_add_trips(b, (uint64_t)code_trips(b->field->codes[index].code));
    emit_numbers(b, node, frame, slot, number, NULL, (uint32_t)index, cut, numbers,
                 (size_t)vectors);
    return (struct result){.solid = true, .shown = true, .box = box};
}

/* A shape of a user's code: like another, but cut by a box and with its parameters apart. */
static struct result emit_code(struct builder *b, const struct node *node,
                               const struct node_frame *frame, uint16_t slot, uint32_t number,
                               const struct field_call *call)
{
    const int index = field_code_add(b, CODE_DISTANCE, call->text, call->params, call->place);

    if (index < 0) {
        return (struct result){0};
    }
    const struct field_code *code = &b->field->codes[index];
    double numbers[SDF_NUMBERS_MAX], cut[FIELD_CUT_NUMBERS], head[FIELD_HEAD_NUMBERS];
    const struct bounds box = fill_cut(call, frame->scale, cut);
    fill_head(b, frame, call->lipschitz, number, head);
    const int count = sdf_numbers(call->params, call->values, numbers);
    const size_t heads = FIELD_MATRIX_VEC4S + FIELD_HEAD_VEC4S;
    const uint32_t block = builder_add_vec4s(b, heads + FIELD_CUT_VEC4S + (size_t)code->vec4s);
    uint32_t arguments =
        builder_add_arguments(b, 12 + FIELD_HEAD_NUMBERS + FIELD_CUT_NUMBERS + (size_t)count);
    builder_put(b, block, 0, arguments, 12, frame->matrix);
    builder_put(b, block + FIELD_MATRIX_VEC4S, 0, arguments + 12, FIELD_HEAD_NUMBERS, head);
    builder_put(b, block + (uint32_t)heads, 0, arguments + 12 + FIELD_HEAD_NUMBERS,
                FIELD_CUT_NUMBERS, cut);
    builder_put_params(b, call->params, call->values, NULL, 1,
                       block + (uint32_t)heads + FIELD_CUT_VEC4S, 0,
                       arguments + 12 + FIELD_HEAD_NUMBERS + FIELD_CUT_NUMBERS);
    builder_add_trips(b, (uint64_t)code_trips(code->code));
    add_leaf(b, number, node);
    builder_add_instruction(b, (struct field_instruction){.op = FIELD_SHAPE,
                                                          .type = node->type,
                                                          .a = slot,
                                                          .point = frame->point,
                                                          .choices = (uint32_t)index,
                                                          .params = block,
                                                          .arguments = arguments});
    return (struct result){.solid = true, .shown = true, .box = box};
}

static struct result emit_called(struct builder *b, const struct node *node,
                                 const struct node_frame *frame, uint16_t slot, uint32_t number)
{
    struct field_call call;
    struct result result = {0};

    if (!field_call_of(b->scene, node, &call)) {
        return result;
    }
    if (!call.is_equation) {
        return emit_code(b, node, frame, slot, number, &call);
    }
    struct equation *equation = field_read_equation(b, call.text, call.place);
    if (equation && equation_degree(equation) >= 0) {
        result = emit_polynomial(b, node, frame, slot, number, &call, equation);
    } else if (equation) {
        result = emit_equation(b, node, frame, slot, number, &call, equation);
    }
    free(equation);
    return result;
}

struct result field_emit_shape(struct builder *b, const struct node *node,
                               const struct node_frame *frame, uint16_t slot, uint32_t number)
{
    struct result result = {.solid = true, .shown = true};

    if (node->type->kind == KIND_CODE || node->type->kind == KIND_EQUATION) {
        result = emit_called(b, node, frame, slot, number);
    } else if (node->type->kind == KIND_SURFACE) {
        result = emit_surface(b, node, frame, slot, number);
    } else {
        const struct sdf *sdf = sdf_find(node->type);
        emit_shape(b, node, sdf, frame, slot, number);
        result.box = shape_box(node, sdf);
    }
    result.transmissive =
        result.solid && !b->cutting && field_material_transmissive(b, frame->material);
    result.transmissive_box = result.box;
    return result;
}

void field_join(struct result *to, const struct result *from)
{
    field_join_transmissive(to, from);
    if (from->shown) {
        to->box = to->shown ? bounds_union(to->box, from->box) : from->box;
    } else if (!to->solid) {
        to->box = from->box;
    }
    to->solid = to->solid || from->solid;
    to->shown = to->shown || from->shown;
}

void field_join_transmissive(struct result *to, const struct result *from)
{
    if (from->transmissive) {
        to->transmissive_box = to->transmissive
                                   ? bounds_union(to->transmissive_box, from->transmissive_box)
                                   : from->transmissive_box;
        to->transmissive = true;
    }
}
