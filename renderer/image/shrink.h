/* SPDX-License-Identifier: MIT */
/* Scales a picture down to the size of an environment map, row by row. Each pixel is the mean of
 * the file's pixels, weighted by area. A picture that is small enough is unchanged, bit for bit. */
#ifndef RENDERER_SHRINK_H
#define RENDERER_SHRINK_H

#include "decode.h"

struct shrink {
    int from_width, from_height; /* of the file */
    struct decoded out;
    float *line;           /* one row of the file, as wide as `out` */
    float *sums;           /* of rows of `out` that are not whole yet: row y is at y % sum_rows */
    int sum_rows;          /* two; all of them where rows come in any order */
    int rows_whole;        /* of `out` */
    void (*between)(void); /* called before each row of the file; NULL: nothing is */
};

void shrink_init(struct shrink *shrink, int from_width, int from_height);
/* Before the first row: rows may come in any order, each pixel once. Takes twice the memory. */
void shrink_in_any_order(struct shrink *shrink);
/* Some pixels of row `y` of the file: x, x + step and so on, `count` of them; three floats each,
 * finite, 0 and above. */
void shrink_add(struct shrink *shrink, int y, int x, int step, int count, const float *rgb);
/* When all rows were added; the caller's. */
struct decoded shrink_take(struct shrink *shrink);
void shrink_finish(struct shrink *shrink);

#endif
