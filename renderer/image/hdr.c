/* SPDX-License-Identifier: MIT */
/* Radiance HDR (Ward: Real pixels, Graphics Gems II, 1991): linear light, without coverage. The
 * exponent is that of a pixel's brightest channel, so the error of each channel is at most 1/256 of
 * that one. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "encode.h"
#include "protocol/memory.h"
#include "rgbe.h"

enum { RUN_LEAST = 4, RUN_MOST = 127, OTHERS_MOST = 128 };

struct hdr_writer {
    FILE *out;
    uint8_t *row; /* one component after the other */
};

static void *begin(const struct image *shape, const struct encode_params *params, FILE *out,
                   struct error *err)
{
    struct hdr_writer *w;

    (void)params;
    if (shape->format != PIXEL_FLOAT || shape->channels != 4) {
        error_set(err, ERROR_INVALID, "format", "HDR holds the light of color; npy does others");
        return NULL;
    }
    w = memory_alloc(1, sizeof *w);
    w->out = out;
    w->row = memory_alloc((size_t)shape->width, 4);
    fprintf(out, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", shape->height,
            shape->width);
    return w;
}

/* Finite, 0 and above; what has no mantissas is black. */
static float clean(float light)
{
    return light > 0x1p-127f ? fminf(light, 0x1.fep126f) : 0;
}

/* To `out` and each `step` behind it. */
static void pack(const float *color, uint8_t *out, size_t step)
{
    const float rgb[] = {clean(color[0]), clean(color[1]), clean(color[2])};
    const float most = fmaxf(rgb[0], fmaxf(rgb[1], rgb[2]));
    int exponent = 0;

    if (most > 0) {
        frexpf(most * (1 + 0x1p-8f), &exponent); /* so that no mantissa is rounded to 256 */
        exponent += RGBE_BIAS - 8;
    }
    for (size_t i = 0; i < 3; i++) {
        out[i * step] = (uint8_t)(ldexpf(rgb[i], RGBE_BIAS - exponent) + 0.5f);
    }
    out[3 * step] = (uint8_t)exponent;
}

static int run_length(const uint8_t *bytes, int count)
{
    int length = 1;

    while (length < count && length < RUN_MOST && bytes[length] == bytes[0]) {
        length++;
    }
    return length;
}

/* Equal bytes as 128 + their number and one of them, others as their number and them. */
static void write_component(const struct hdr_writer *w, const uint8_t *bytes, int count)
{
    while (count > 0) {
        const int run = run_length(bytes, count);
        int others = 0;

        while (others < count && others < OTHERS_MOST &&
               run_length(bytes + others, count - others) < RUN_LEAST) {
            others++;
        }
        if (run >= RUN_LEAST) {
            fputc(128 + run, w->out);
            fputc(*bytes, w->out);
        } else {
            fputc(others, w->out);
            fwrite(bytes, 1, (size_t)others, w->out);
        }
        bytes += run >= RUN_LEAST ? run : others;
        count -= run >= RUN_LEAST ? run : others;
    }
}

static void write_row(const struct hdr_writer *w, const float *pixels, int width)
{
    const bool in_runs = width >= RGBE_RUNS_LEAST && width <= RGBE_RUNS_MOST;
    const size_t step = in_runs ? (size_t)width : 1;

    for (int x = 0; x < width; x++) {
        pack(pixels + 4 * x, w->row + (in_runs ? x : 4 * x), step);
    }
    if (!in_runs) {
        fwrite(w->row, 4, (size_t)width, w->out);
        return;
    }
    fwrite((uint8_t[]){2, 2, (uint8_t)(width >> 8), (uint8_t)width}, 1, 4, w->out);
    for (int i = 0; i < 4; i++) {
        write_component(w, w->row + (size_t)i * step, width);
    }
}

static bool add(void *state, const struct image *rows, struct error *err)
{
    const float *pixels = rows->pixels;

    (void)err;
    for (int y = 0; y < rows->height; y++) {
        write_row(state, pixels + (size_t)4 * (size_t)y * (size_t)rows->width, rows->width);
    }
    return true;
}

static bool end(void *state, struct error *err)
{
    (void)state;
    (void)err;
    return true;
}

static void destroy(void *state)
{
    struct hdr_writer *w = state;

    free(w->row);
    free(w);
}

const struct encoder_class hdr_class = {begin, add, end, destroy};
