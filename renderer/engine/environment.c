/* SPDX-License-Identifier: MIT */
/* The pictures of an environment, in memory. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lanes_parts.h"
#include "protocol/memory.h"

enum {
    PLAIN_WIDTH = 128, /* of what is drawn where there is no picture; twice the height */
    MIRROR_WIDTH = 128,
    MATT_WIDTH = 32,
};

int engine_sky_side(int side, int level)
{
    return side >> level > 1 ? side >> level : 1;
}

static int levels_of(int width)
{
    int levels = 1;
    for (int side = width; side > 1; side /= 2) {
        levels++;
    }
    return levels;
}

static void begin(struct engine_sky *sky, int width, int height, int levels)
{
    size_t count = 0;
    *sky = (struct engine_sky){.width = width, .height = height, .levels = levels};
    for (int level = 0; level < levels; level++) {
        sky->starts[level] = count;
        count += (size_t)engine_sky_side(width, level) * (size_t)engine_sky_side(height, level);
    }
    sky->texels = memory_alloc(count, 4 * sizeof *sky->texels);
    sky->bytes = count * 4 * sizeof *sky->texels;
}

/* Of a half that is finite, 0 or above: exponents count from -15 there, from -127 here. */
static float float_of(uint16_t half)
{
    const uint32_t bits = (uint32_t)half << 13;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value * 0x1p112f;
}

static void copy(struct engine_sky *sky, const uint16_t *halves)
{
    const size_t count = 4 * (size_t)sky->width * (size_t)sky->height;
    for (size_t i = 0; i < count; i++) {
        sky->texels[i] = float_of(halves[i]);
    }
}

/* Two neighbours of the level above at `place`, in its texels, and the part of the second. */
struct pair {
    int first, second;
    float part;
};

static struct pair pair_of(int at, int from, int to)
{
    const float place = ((float)at + 0.5f) * (float)from / (float)to - 0.5f;
    const int first = (int)floorf(place);
    return (struct pair){first > 0 ? first : 0, first + 1 < from ? first + 1 : from - 1,
                         place - (float)first};
}

static void shrink(struct engine_sky *sky, int level)
{
    const int from_width = engine_sky_side(sky->width, level - 1);
    const int from_height = engine_sky_side(sky->height, level - 1);
    const int width = engine_sky_side(sky->width, level);
    const int height = engine_sky_side(sky->height, level);
    const float *from = sky->texels + 4 * sky->starts[level - 1];
    float *to = sky->texels + 4 * sky->starts[level];
    for (int y = 0; y < height; y++) {
        const struct pair rows = pair_of(y, from_height, height);
        const float *const above = from + (size_t)4 * (size_t)rows.first * (size_t)from_width;
        const float *const below = from + (size_t)4 * (size_t)rows.second * (size_t)from_width;
        for (int x = 0; x < width; x++, to += 4) {
            const struct pair columns = pair_of(x, from_width, width);
            for (int k = 0; k < 4; k++) {
                const int a = 4 * columns.first + k, b = 4 * columns.second + k;
                const float left = above[a] + rows.part * (below[a] - above[a]);
                const float right = above[b] + rows.part * (below[b] - above[b]);
                to[k] = left + columns.part * (right - left);
            }
        }
    }
}

void engine_skies_make(const struct frame_block *frame, const uint16_t *halves, int width,
                       int height, struct engine_sky out[ENGINE_SKIES])
{
    const struct engine_width *lanes = engine_widest();
    if (!halves) {
        width = PLAIN_WIDTH;
        height = PLAIN_WIDTH / 2;
    }
    begin(&out[0], width, height, levels_of(width > height ? width : height));
    begin(&out[1], MIRROR_WIDTH, MIRROR_WIDTH / 2, MIRROR_LEVELS);
    begin(&out[2], MATT_WIDTH, MATT_WIDTH / 2, 1);
    if (halves) {
        copy(&out[0], halves);
    } else {
        lanes->make_sky(frame, out, 0, 0);
    }
    for (int level = 1; level < out[0].levels; level++) {
        shrink(&out[0], level);
    }
    for (int level = 0; level < MIRROR_LEVELS; level++) {
        lanes->make_sky(frame, out, 1, level);
    }
    lanes->make_sky(frame, out, 2, 0);
}

void engine_skies_finish(struct engine_sky skies[ENGINE_SKIES])
{
    for (int i = 0; i < ENGINE_SKIES; i++) {
        free(skies[i].texels);
    }
}
