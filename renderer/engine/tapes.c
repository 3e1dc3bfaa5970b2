/* SPDX-License-Identifier: MIT */
#include "tapes.h"

#include <stdlib.h>
#include <string.h>

#include "changes.h"
#include "explored.h"
#include "protocol/memory.h"

enum {
    TEXEL_NUMBERS = 4,
    OPERATION_TEXELS = 2,
    ROOM_PART = 4,        /* of cubes and of words, there is so much room for more */
    TOLD_ROWS = 64,       /* at once */
    FREE_WORDS = 1 << 21, /* with more, and half of all, all is made anew */
};

/* Rows of the texture, in their order. */
struct rows {
    size_t first, count;
};

struct engine_tapes {
    struct engine_program *program; /* counted */
    struct engine_extent extent;
    float *params;                         /* that the cubes are of */
    uint32_t (*operations)[TEXEL_NUMBERS]; /* whole rows */
    struct explored spaces[ENGINE_SPACES];
    int space_count;
    /* Where things are: the head is in the first row. */
    struct rows operation_rows, cube_rows[ENGINE_SPACES], word_rows[ENGINE_SPACES];
    size_t rows;
    bool head_changed, all_changed;
};

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

static void make_operations(struct engine_tapes *t, const struct vocabulary *vocabulary)
{
    const struct engine_program *program = t->program;
    const size_t rows = (OPERATION_TEXELS * program->count + TAPES_ROW - 1) / TAPES_ROW;
    uint32_t *kinds = number_kinds(program, vocabulary);

    t->operation_rows = (struct rows){1, rows};
    t->operations = memory_alloc(rows * TAPES_ROW, sizeof *t->operations);
    for (size_t i = 0; i < program->count; i++) {
        put_operation(&t->operations[OPERATION_TEXELS * i], &program->operations[i], kinds);
    }
    free(kinds);
}

/* --- rows --- */

/* The same, and a part more, so that an edit seldom needs another texture. */
static size_t roomy(size_t count, size_t in_row)
{
    return (count + count / ROOM_PART) / in_row + 1;
}

static bool fits(const struct engine_tapes *t)
{
    bool ok = true;

    for (int i = 0; i < t->space_count; i++) {
        const struct cells *cells = &t->spaces[i].cells;
        ok = ok && cells->count <= CUBES_IN_ROW * t->cube_rows[i].count &&
             cells->used <= WORDS_IN_ROW * t->word_rows[i].count;
    }
    return ok;
}

static struct rows rows_at(size_t *at, size_t count)
{
    const struct rows rows = {*at, count};

    *at += count;
    return rows;
}

static void lay_out(struct engine_tapes *t)
{
    t->rows = t->operation_rows.first + t->operation_rows.count;
    for (int i = 0; i < t->space_count; i++) {
        const struct cells *cells = &t->spaces[i].cells;
        t->cube_rows[i] = rows_at(&t->rows, roomy(cells->count, CUBES_IN_ROW));
        t->word_rows[i] = rows_at(&t->rows, roomy(cells->used, WORDS_IN_ROW));
    }
    t->all_changed = true;
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

static void write_space(const struct engine_tapes *t, int space, uint32_t (*to)[TEXEL_NUMBERS])
{
    const struct cells *cells = &t->spaces[space].cells;
    const struct cell *start = start_of(cells);

    to[0][0] = (uint32_t)(t->cube_rows[space].first * TAPES_ROW);
    to[0][1] = (uint32_t)(start - cells->at);
    to[0][2] = start->bits;
    for (int i = 0; i < 3; i++) {
        to[1][i] = (uint32_t)start->corner[i];
    }
}

/* Words are counted from the first texel on. Scenes without transmissive shapes have one space,
 * whatever is asked for. */
static void write_head(const struct engine_tapes *t, uint32_t (*to)[TEXEL_NUMBERS])
{
    to[0][0] = (uint32_t)(t->operation_rows.first * TAPES_ROW);
    to[0][2] = (uint32_t)t->program->scene.material_base;
    to[0][3] = (uint32_t)t->program->scene.material_stride;
    to[1][0] = bits_of(1 / t->spaces[0].cells.grid);
    for (int i = 0; i < ENGINE_SPACES; i++) {
        write_space(t, i < t->space_count ? i : 0, to + TAPE_SPACES + TAPE_SPACE_TEXELS * i);
    }
}

static void write_cubes(const struct engine_tapes *t, int space, size_t row,
                        uint32_t (*to)[TEXEL_NUMBERS])
{
    const struct cells *cells = &t->spaces[space].cells;
    const uint32_t words = (uint32_t)(t->word_rows[space].first * WORDS_IN_ROW);

    for (size_t i = row * CUBES_IN_ROW; i < (row + 1) * CUBES_IN_ROW && i < cells->count; i++) {
        const struct cell *cell = &cells->at[i];
        (*to)[0] = (uint32_t)cell->children;
        (*to)[1] = words + cell->tape;
        (*to)[2] = cell->count;
        (*to++)[3] = bits_of(cell->distance);
    }
}

static void write_words(const struct engine_tapes *t, int space, size_t row, void *to)
{
    const struct cells *cells = &t->spaces[space].cells;
    const size_t first = row * WORDS_IN_ROW;

    if (first < cells->used) {
        const size_t left = cells->used - first;
        memcpy(to, cells->tapes + first,
               (left < WORDS_IN_ROW ? left : WORDS_IN_ROW) * sizeof *cells->tapes);
    }
}

static bool is_in(struct rows rows, size_t row)
{
    return row >= rows.first && row - rows.first < rows.count;
}

static void write_row(const struct engine_tapes *t, size_t row, uint32_t (*to)[TEXEL_NUMBERS])
{
    memset(to, 0, TAPES_ROW * sizeof *to);
    if (row == 0) {
        write_head(t, to);
    } else if (is_in(t->operation_rows, row)) {
        memcpy(to, t->operations + (row - t->operation_rows.first) * TAPES_ROW,
               TAPES_ROW * sizeof *to);
    }
    for (int i = 0; i < t->space_count; i++) {
        if (is_in(t->cube_rows[i], row)) {
            write_cubes(t, i, row - t->cube_rows[i].first, to);
        } else if (is_in(t->word_rows[i], row)) {
            write_words(t, i, row - t->word_rows[i].first, to);
        }
    }
}

/* --- what has changed --- */

static bool is_marked(const struct row_marks *marks, struct rows rows, size_t row)
{
    return is_in(rows, row) && row - rows.first < marks->count && marks->of[row - rows.first];
}

static bool has_news(const struct engine_tapes *t, size_t row)
{
    bool changed = t->all_changed || (row == 0 && t->head_changed);

    for (int i = 0; i < t->space_count && !changed; i++) {
        changed = is_marked(&t->spaces[i].cubes, t->cube_rows[i], row) ||
                  is_marked(&t->spaces[i].words, t->word_rows[i], row);
    }
    return changed;
}

static void forget_marks(struct row_marks *marks)
{
    if (marks->count > 0) {
        memset(marks->of, 0, marks->count);
    }
}

static void forget_news(struct engine_tapes *t)
{
    for (int i = 0; i < t->space_count; i++) {
        forget_marks(&t->spaces[i].cubes);
        forget_marks(&t->spaces[i].words);
    }
    t->head_changed = t->all_changed = false;
}

size_t engine_tapes_rows(const struct engine_tapes *tapes)
{
    return tapes->rows;
}

void engine_tapes_tell(struct engine_tapes *tapes, engine_tapes_hear *hear, void *data)
{
    uint32_t(*texels)[TEXEL_NUMBERS] = memory_alloc((size_t)TOLD_ROWS * TAPES_ROW, sizeof *texels);
    size_t count = 0;

    for (size_t row = 0; row < tapes->rows; row++) {
        const bool news = has_news(tapes, row);
        if (news) {
            write_row(tapes, row, texels + count++ * TAPES_ROW);
        }
        if (count > 0 && (!news || count == TOLD_ROWS || row + 1 == tapes->rows)) {
            hear(data, row + news - count, count, (const uint32_t(*)[TEXEL_NUMBERS])texels);
            count = 0;
        }
    }
    free(texels);
    forget_news(tapes);
}

/* --- making and renewing --- */

/* Of what the spaces show (field_mask). */
static const float masks[ENGINE_SPACES] = {0, (float)FIELD_FAR, -(float)FIELD_FAR};

static size_t numbers_bytes(const struct engine_program *program)
{
    return 4 * program->field->vec4_count * sizeof(float);
}

struct engine_tapes *engine_tapes_create(struct engine_program *program, const float *params,
                                         const struct engine_extent *extent,
                                         const struct vocabulary *vocabulary)
{
    struct engine_tapes *tapes = memory_alloc(1, sizeof *tapes);

    tapes->program = engine_program_ref(program);
    tapes->extent = *extent;
    tapes->params = memory_alloc(numbers_bytes(program), 1);
    memcpy(tapes->params, params, numbers_bytes(program));
    tapes->space_count = program->field->transmissive ? ENGINE_SPACES : 1;
    for (int i = 0; i < tapes->space_count; i++) {
        program->width->explore(program, params, extent, masks[i], &tapes->spaces[i]);
    }
    make_operations(tapes, vocabulary);
    lay_out(tapes);
    return tapes;
}

void engine_tapes_destroy(struct engine_tapes *tapes)
{
    if (!tapes) {
        return;
    }
    for (int i = 0; i < tapes->space_count; i++) {
        explored_finish(&tapes->spaces[i]);
    }
    engine_program_destroy(tapes->program);
    free(tapes->params);
    free(tapes->operations);
    free(tapes);
}

/* Whether other numbers are worth what is here. */
static bool is_worth_renewing(const struct engine_tapes *t)
{
    bool worth = true;

    for (int i = 0; i < t->space_count; i++) {
        const struct explored *space = &t->spaces[i];
        worth = worth && !space->limited && space->free_words < space->cells.used / 2 + FREE_WORDS;
    }
    return worth;
}

static bool explore_spaces_again(struct engine_tapes *t, const float *params,
                                 const uint8_t *changed)
{
    bool ok = true;

    for (int i = 0; i < t->space_count; i++) {
        t->program->width->explore_again(t->program, params, &t->extent, masks[i], changed,
                                         &t->spaces[i]);
        ok = ok && !t->spaces[i].limited;
    }
    t->head_changed = true;
    if (!fits(t)) {
        lay_out(t);
    }
    return ok;
}

bool engine_tapes_renew(struct engine_tapes *tapes, const struct engine_program *program,
                        const float *params, const struct engine_extent *extent)
{
    if (tapes->program != program || memcmp(&tapes->extent, extent, sizeof *extent) != 0 ||
        !is_worth_renewing(tapes)) {
        return false;
    }
    uint8_t *changed = changes_of_operations(program, tapes->params, params);
    const size_t count = changed ? changes_count(program, changed) : 0;
    const bool ok = changed && !changes_are_many(program, count) &&
                    (count == 0 || explore_spaces_again(tapes, params, changed));
    free(changed);
    if (ok) {
        memcpy(tapes->params, params, numbers_bytes(program));
    }
    return ok;
}

/* --- for tests --- */

struct engine_tapes_size engine_tapes_size(const struct engine_tapes *tapes)
{
    struct engine_tapes_size size = {0, 0};

    for (int i = 0; i < tapes->space_count; i++) {
        size.cubes += tapes->spaces[i].cells.count;
        size.words += tapes->spaces[i].cells.used;
    }
    return size;
}
