/* SPDX-License-Identifier: MIT */
#include "explored.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

enum { SIZE_BITS = 3, LEAST_SHIFT = 2 }; /* sizes: eight from one power of two to the next */

/* --- places --- */

static void push(struct places *places, uint32_t at)
{
    if (places->count == places->room) {
        places->room = 2 * places->room + 16;
        places->at = memory_resize(places->at, places->room, sizeof *places->at);
    }
    places->at[places->count++] = at;
}

static void mark(struct row_marks *marks, size_t first, size_t end, size_t in_row)
{
    const size_t rows = (end + in_row - 1) / in_row;

    if (rows > marks->count) {
        marks->of = memory_resize(marks->of, 2 * rows, sizeof *marks->of);
        memset(marks->of + marks->count, 0, 2 * rows - marks->count);
        marks->count = 2 * rows;
    }
    for (size_t row = first / in_row; row < rows; row++) {
        marks->of[row] = 1;
    }
}

void explored_mark_cube(struct explored *explored, size_t at)
{
    mark(&explored->cubes, at, at + 1, CUBES_IN_ROW);
}

void explored_mark_words(struct explored *explored, uint32_t tape, uint32_t count)
{
    mark(&explored->words, tape, (size_t)tape + count, WORDS_IN_ROW);
}

/* --- tapes --- */

uint32_t explored_size(uint32_t count, int *out_number)
{
    int shift = LEAST_SHIFT;

    while (count >> shift >= 2 << SIZE_BITS) {
        shift++;
    }
    uint32_t units = (count + (1u << shift) - 1) >> shift;
    if (units == 2 << SIZE_BITS) {
        units /= 2;
        shift++;
    }
    *out_number = (shift << (SIZE_BITS + 1)) + (int)units;
    return units << shift;
}

bool explored_take_place(struct explored *explored, uint32_t count, uint32_t *out_tape)
{
    int number;
    const uint32_t size = explored_size(count, &number);
    struct places *places = &explored->tapes[number];

    if (places->count == 0) {
        return false;
    }
    *out_tape = places->at[--places->count];
    explored->free_words -= size;
    return true;
}

void explored_free_tape(struct explored *explored, uint32_t tape, uint32_t count)
{
    int number;

    explored->free_words += explored_size(count, &number);
    push(&explored->tapes[number], tape);
}

/* --- cubes --- */

void explored_put_children(struct explored *explored, struct cell *parent)
{
    struct cells *cells = &explored->cells;
    struct places *places = &explored->children;

    if (places->count > 0) {
        const uint32_t at = places->at[--places->count];
        memcpy(cells->at + at, cells->at + parent->children, CUBE_CHILDREN * sizeof *cells->at);
        cells->count -= CUBE_CHILDREN;
        parent->children = (int32_t)at;
    }
}

void explored_free_children(struct explored *explored, struct cell *parent)
{
    push(&explored->children, (uint32_t)parent->children);
    parent->children = 0;
}

void explored_finish(struct explored *explored)
{
    struct cells spaces[ENGINE_SPACES] = {explored->cells};

    cells_finish(spaces);
    for (int i = 0; i < TAPE_SIZES; i++) {
        free(explored->tapes[i].at);
    }
    free(explored->children.at);
    free(explored->cubes.of);
    free(explored->words.of);
    *explored = (struct explored){0};
}
