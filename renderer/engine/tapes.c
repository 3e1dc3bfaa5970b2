/* SPDX-License-Identifier: MIT */
#include "tapes.h"

#include <stdlib.h>
#include <string.h>

#include "engine_internal.h"
#include "protocol/memory.h"

enum { TEXEL_NUMBERS = 4, OPERATION_TEXELS = 2 };

/* --- texels --- */

static uint32_t add(struct engine_tapes *t, size_t *room, size_t count)
{
    const size_t at = t->count;

    if (*room - at < count) {
        *room = 2 * *room + count;
        t->texels = memory_resize(t->texels, *room, sizeof *t->texels);
    }
    memset(t->texels + at, 0, count * sizeof *t->texels);
    t->count += count;
    return (uint32_t)at;
}

static uint32_t bits_of(float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* --- operations --- */

static uint32_t op_of(uint8_t op)
{
    static const uint8_t rows[] = {
        [FIELD_EMPTY] = TAPE_OP_EMPTY,         [FIELD_SHAPE] = TAPE_OP_SHAPE,
        [FIELD_COMBINE] = TAPE_OP_COMBINE,     [FIELD_DISTANCE] = TAPE_OP_DISTANCE,
        [FIELD_TRANSFORM] = TAPE_OP_TRANSFORM, [FIELD_WARP] = TAPE_OP_WARP,
        [FIELD_AFTER] = TAPE_OP_AFTER,         [FIELD_LOOP] = TAPE_OP_LOOP,
        [FIELD_LOOP_END] = TAPE_OP_LOOP_END,
    };

    return rows[op];
}

/* The numbers of the program's kinds in the vocabulary; the caller frees them. */
static uint32_t *number_kinds(const struct engine_program *program,
                              const struct vocabulary *vocabulary)
{
    uint32_t *numbers = memory_alloc(program->kind_count, sizeof *numbers);

    for (size_t i = 0; i < program->kind_count; i++) {
        const struct operation_kind *kind = &program->kinds[i];
        const struct vocabulary_kind row = {(enum field_op)kind->op, kind->type, kind->choices,
                                            kind->code != NULL};
        numbers[i] = (uint32_t)vocabulary_find(vocabulary, &row);
    }
    return numbers;
}

/* The end of a loop makes the point of the next cell, as its beginning does. */
static void put_operation(uint32_t to[OPERATION_TEXELS][TEXEL_NUMBERS], const struct operation *in,
                          const uint32_t *kinds)
{
    const struct operation *calls = in->op == FIELD_LOOP_END ? in - in->length : in;
    const uint32_t flags = (in->seen ? TAPE_SEEN : 0) | (in->mixes ? TAPE_MIXES : 0);

    to[0][0] = op_of(in->op) | flags | kinds[calls->kind] << 16;
    to[0][1] = in->a | (uint32_t)in->b << 16;
    to[0][2] = calls->point | (uint32_t)calls->out << 16;
    to[0][3] = calls->params;
    to[1][0] = in->seen;
    to[1][1] = in->length;
}

static uint32_t put_operations(struct engine_tapes *t, size_t *room,
                               const struct engine_program *program,
                               const struct vocabulary *vocabulary)
{
    uint32_t *kinds = number_kinds(program, vocabulary);
    const uint32_t first = add(t, room, OPERATION_TEXELS * program->count);

    for (size_t i = 0; i < program->count; i++) {
        put_operation(&t->texels[first + OPERATION_TEXELS * i], &program->operations[i], kinds);
    }
    free(kinds);
    return first;
}

/* --- cubes --- */

/* The smallest cube around all that have children, but for those that it is in itself. */
static const struct cell *start_of(const struct cells *cells)
{
    const struct cell *at = cells->at;

    for (;;) {
        const struct cell *only = NULL;
        for (int k = 0; k < CUBE_CHILDREN && at->children; k++) {
            const struct cell *child = &cells->at[at->children + k];
            if (child->children && only) {
                return at;
            }
            only = child->children ? child : only;
        }
        if (!only) {
            return at;
        }
        at = only;
    }
}

/* `before`: words of other spaces. */
static uint32_t put_cubes(struct engine_tapes *t, size_t *room, const struct cells *cells,
                          size_t before)
{
    const uint32_t first = add(t, room, cells->count);

    for (size_t i = 0; i < cells->count; i++) {
        const struct cell *cell = &cells->at[i];
        uint32_t *to = t->texels[first + i];
        to[0] = (uint32_t)cell->children;
        to[1] = (uint32_t)before + cell->tape;
        to[2] = cell->count;
        to[3] = bits_of(cell->distance);
    }
    t->cubes += cells->count;
    return first;
}

static void put_space(struct engine_tapes *t, size_t *room, const struct cells *cells, int space)
{
    const uint32_t first = put_cubes(t, room, cells, t->words);
    const struct cell *start = start_of(cells);
    uint32_t *to = t->texels[TAPE_SPACES + TAPE_SPACE_TEXELS * space];

    to[0] = first;
    to[1] = (uint32_t)(start - cells->at);
    to[2] = start->bits;
    for (int i = 0; i < 3; i++) {
        to[TEXEL_NUMBERS + i] = (uint32_t)start->corner[i];
    }
    t->words += cells->used;
}

static uint32_t put_words(struct engine_tapes *t, size_t *room, const struct cells *spaces,
                          int count)
{
    const uint32_t first = add(t, room, (t->words + TEXEL_NUMBERS - 1) / TEXEL_NUMBERS);
    uint32_t *to = t->texels[first];

    for (int i = 0; i < count; i++) {
        memcpy(to, spaces[i].tapes, spaces[i].used * sizeof *to);
        to += spaces[i].used;
    }
    return first;
}

/* Scenes without transmissive shapes have one space, whatever is asked for. */
static int explore(const struct engine_program *program, const float *params,
                   const struct engine_extent *extent, struct cells spaces[ENGINE_SPACES])
{
    static const float masks[ENGINE_SPACES] = {0, (float)FIELD_FAR, -(float)FIELD_FAR};
    const int count = program->field->transmissive ? ENGINE_SPACES : 1;

    for (int i = 0; i < count; i++) {
        program->width->explore(program, params, extent, masks[i], &spaces[i]);
    }
    return count;
}

void engine_tapes_make(const struct engine_program *program, const float *params,
                       const struct engine_extent *extent, const struct vocabulary *vocabulary,
                       struct engine_tapes *out)
{
    struct cells spaces[ENGINE_SPACES] = {{0}};
    const int count = explore(program, params, extent, spaces);
    size_t room = 0;

    *out = (struct engine_tapes){0};
    add(out, &room, TAPE_SPACES + TAPE_SPACE_TEXELS * ENGINE_SPACES);
    for (int i = 0; i < count; i++) {
        put_space(out, &room, &spaces[i], i);
    }
    for (int i = count; i < ENGINE_SPACES; i++) {
        memcpy(&out->texels[TAPE_SPACES + TAPE_SPACE_TEXELS * i], &out->texels[TAPE_SPACES],
               TAPE_SPACE_TEXELS * sizeof out->texels[0]);
    }
    const uint32_t operations = put_operations(out, &room, program, vocabulary);
    const uint32_t words = put_words(out, &room, spaces, count);
    const uint32_t head[] = {operations, words, (uint32_t)program->scene.material_base,
                             (uint32_t)program->scene.material_stride};
    memcpy(out->texels[0], head, sizeof head);
    out->texels[1][0] = bits_of(1 / spaces[0].grid);
    add(out, &room, (TAPES_ROW - out->count % TAPES_ROW) % TAPES_ROW);
    cells_finish(spaces);
}

void engine_tapes_finish(struct engine_tapes *tapes)
{
    free(tapes->texels);
    *tapes = (struct engine_tapes){0};
}
