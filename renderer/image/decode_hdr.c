/* SPDX-License-Identifier: MIT */
/* Radiance HDR (Ward: Real pixels, Graphics Gems II, 1991): three mantissas and one exponent for
 * each pixel; rows flat, with runs of whole pixels, or with runs of each component. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "rgbe.h"
#include "shrink.h"

struct reader {
    const uint8_t *bytes;
    size_t length, at;
};

/* The next `count` bytes; NULL where the file is shorter. */
static const uint8_t *take(struct reader *r, size_t count)
{
    const uint8_t *bytes = r->bytes + r->at;

    if (r->length - r->at < count) {
        return NULL;
    }
    r->at += count;
    return bytes;
}

/* One component of a row: a count above 128 says how often the next byte comes, any other how many
 * bytes follow. */
static bool read_component(struct reader *r, uint8_t *pixels, int component, int width)
{
    for (int x = 0; x < width;) {
        const uint8_t *count = take(r, 1);
        const bool same = count && *count > 128;
        const int n = !count ? 0 : same ? *count - 128 : *count;
        const uint8_t *values = n > 0 && n <= width - x ? take(r, same ? 1 : (size_t)n) : NULL;

        if (!values) {
            return false;
        }
        for (int i = 0; i < n; i++) {
            pixels[4 * (x + i) + component] = values[same ? 0 : i];
        }
        x += n;
    }
    return true;
}

/* Pixels; 1, 1, 1, n repeats the last one n times, and more such make a longer number. */
static bool read_flat(struct reader *r, uint8_t *pixels, int width)
{
    int shift = 0;

    for (int x = 0; x < width;) {
        const uint8_t *pixel = take(r, 4);

        if (!pixel) {
            return false;
        }
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            memcpy(pixels + 4 * x++, pixel, 4);
            shift = 0;
            continue;
        }
        const int n = shift <= 8 ? pixel[3] << shift : width;
        if (x == 0 || n > width - x) {
            return false;
        }
        for (int i = 0; i < n; i++, x++) {
            memcpy(pixels + 4 * x, pixels + 4 * (x - 1), 4);
        }
        shift += 8;
    }
    return true;
}

static bool read_row(struct reader *r, uint8_t *pixels, int width)
{
    const uint8_t *head = r->bytes + r->at;

    if (width < RGBE_RUNS_LEAST || width > RGBE_RUNS_MOST || r->length - r->at < 4 ||
        head[0] != 2 || head[1] != 2 || head[2] > 127) {
        return read_flat(r, pixels, width);
    }
    if ((head[2] << 8 | head[3]) != width) {
        return false;
    }
    r->at += 4;
    for (int component = 0; component < 4; component++) {
        if (!read_component(r, pixels, component, width)) {
            return false;
        }
    }
    return true;
}

static void to_linear(const uint8_t *pixels, int width, float *out)
{
    for (int x = 0; x < width; x++) {
        const uint8_t *p = pixels + 4 * x;
        const float unit = p[3] ? ldexpf(1, p[3] - RGBE_BIAS) : 0;

        for (int i = 0; i < 3; i++) {
            out[3 * x + i] = (float)p[i] * unit;
        }
    }
}

bool hdr_decode(const uint8_t *bytes, size_t length, struct shrink *out, struct error *err)
{
    const int width = out->from_width, height = out->from_height;
    struct reader r = {bytes, length, 0};
    uint8_t *pixels = memory_alloc((size_t)width, 4);
    float *rgb = memory_alloc((size_t)width, 3 * sizeof(float));
    int y = 0;

    for (; y < height && read_row(&r, pixels, width); y++) {
        to_linear(pixels, width, rgb);
        shrink_add(out, y, 0, 1, width, rgb);
    }
    free(pixels);
    free(rgb);
    return y == height ||
           error_set(err, ERROR_INVALID, "", "row %d of %d of the Radiance file is %s", y + 1,
                     height, r.at == r.length ? "cut off" : "damaged");
}
