/* SPDX-License-Identifier: MIT */
#include "shrink.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "half.h"
#include "protocol/memory.h"

/* Where one of `from` parts lies among `to` of them, which are no more: in `first`, with this
 * weight, and with the rest in the one after it. */
struct share {
    int first;
    float weight, rest;
};

static struct share share_of(int part, int from, int to)
{
    const long begin = (long)part * to, first = begin / from, border = (first + 1) * from;
    const long inside = border - begin < to ? border - begin : to;

    return (struct share){(int)first, (float)inside / (float)from,
                          (float)(to - inside) / (float)from};
}

static size_t floats_of_row(const struct shrink *shrink)
{
    return (size_t)3 * (size_t)shrink->out.width;
}

static void set_sum_rows(struct shrink *shrink, int rows)
{
    free(shrink->sums);
    shrink->sum_rows = rows;
    shrink->sums = memory_alloc((size_t)rows * floats_of_row(shrink), sizeof(float));
}

void shrink_init(struct shrink *shrink, int from_width, int from_height)
{
    *shrink = (struct shrink){.from_width = from_width, .from_height = from_height};
    shrink->out.width = from_width < DECODED_WIDTH ? from_width : DECODED_WIDTH;
    shrink->out.height = from_height < DECODED_HEIGHT ? from_height : DECODED_HEIGHT;
    shrink->out.rgba =
        memory_alloc((size_t)shrink->out.width * (size_t)shrink->out.height, DECODED_TEXEL_BYTES);
    shrink->line = memory_alloc(floats_of_row(shrink), sizeof(float));
    set_sum_rows(shrink, 2);
}

void shrink_in_any_order(struct shrink *shrink)
{
    set_sum_rows(shrink, shrink->out.height);
}

static void add_pixel(float *to, const float *rgb, float weight)
{
    for (int c = 0; c < 3; c++) {
        to[c] += rgb[c] * weight;
    }
}

static void fill_line(struct shrink *shrink, int x, int step, int count, const float *rgb)
{
    memset(shrink->line, 0, floats_of_row(shrink) * sizeof(float));
    for (int i = 0; i < count; i++) {
        const struct share share = share_of(x + i * step, shrink->from_width, shrink->out.width);
        float *to = shrink->line + 3 * (size_t)share.first;

        add_pixel(to, rgb + (size_t)3 * (size_t)i, share.weight);
        if (share.rest > 0) {
            add_pixel(to + 3, rgb + (size_t)3 * (size_t)i, share.rest);
        }
    }
}

static float *sums_of(const struct shrink *shrink, int row)
{
    return shrink->sums + (size_t)(row % shrink->sum_rows) * floats_of_row(shrink);
}

static void add_line(struct shrink *shrink, int row, float weight)
{
    float *to = sums_of(shrink, row);
    const size_t count = floats_of_row(shrink);

    for (size_t i = 0; i < count; i++) {
        to[i] += shrink->line[i] * weight;
    }
}

/* Its sums are free for another row. */
static void end_row(struct shrink *shrink)
{
    const int width = shrink->out.width;
    float *sums = sums_of(shrink, shrink->rows_whole);
    uint16_t *out = shrink->out.rgba + (size_t)4 * (size_t)width * (size_t)shrink->rows_whole;

    for (int x = 0; x < width; x++) {
        for (int c = 0; c < 3; c++) {
            out[4 * x + c] = half_of(sums[3 * x + c]);
        }
        out[4 * x + 3] = half_of(1);
    }
    memset(sums, 0, floats_of_row(shrink) * sizeof(float));
    shrink->rows_whole++;
}

void shrink_add(struct shrink *shrink, int y, int x, int step, int count, const float *rgb)
{
    const struct share share = share_of(y, shrink->from_height, shrink->out.height);

    if (shrink->between) {
        shrink->between();
    }
    while (shrink->sum_rows < shrink->out.height && shrink->rows_whole < share.first) {
        end_row(shrink);
    }
    fill_line(shrink, x, step, count, rgb);
    add_line(shrink, share.first, share.weight);
    if (share.rest > 0) {
        add_line(shrink, share.first + 1, share.rest);
    }
}

struct decoded shrink_take(struct shrink *shrink)
{
    const struct decoded out = shrink->out;

    while (shrink->rows_whole < shrink->out.height) {
        end_row(shrink);
    }
    shrink->out = (struct decoded){0};
    return out;
}

void shrink_finish(struct shrink *shrink)
{
    free(shrink->line);
    free(shrink->sums);
    decoded_finish(&shrink->out);
}
