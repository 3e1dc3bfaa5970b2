/* SPDX-License-Identifier: MIT */
/* The pictures of an environment, in memory. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine_internal.h"
#include "protocol/memory.h"
#include "renderer/image/half.h"

enum {
    PLAIN_WIDTH = 128, /* of what is drawn where there is no picture; twice the height */
    SPECULAR_WIDTH = 128,
    IRRADIANCE_WIDTH = 32,
};

int engine_map_side(int side, int level)
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

/* `first`: the texels of the first level; NULL: they are to be made. */
static void begin(struct engine_map *map, int width, int height, int levels, uint16_t *first)
{
    *map = (struct engine_map){.width = width, .height = height, .levels = levels};
    for (int level = 0; level < levels; level++) {
        const size_t count =
            (size_t)engine_map_side(width, level) * (size_t)engine_map_side(height, level);
        const size_t bytes = 4 * sizeof *first * count;
        map->texels[level] = level == 0 && first ? first : memory_alloc(bytes, 1);
        map->bytes += bytes;
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

static float between(uint16_t first, uint16_t second, float part)
{
    const float value = half_value(first);

    return value + part * (half_value(second) - value);
}

static void shrink(struct engine_map *map, int level)
{
    const int from_width = engine_map_side(map->width, level - 1);
    const int from_height = engine_map_side(map->height, level - 1);
    const int width = engine_map_side(map->width, level);
    const int height = engine_map_side(map->height, level);
    const uint16_t *from = map->texels[level - 1];
    uint16_t *to = map->texels[level];

    for (int y = 0; y < height; y++) {
        const struct pair rows = pair_of(y, from_height, height);
        const uint16_t *const above = from + (size_t)4 * (size_t)rows.first * (size_t)from_width;
        const uint16_t *const below = from + (size_t)4 * (size_t)rows.second * (size_t)from_width;
        for (int x = 0; x < width; x++, to += 4) {
            const struct pair columns = pair_of(x, from_width, width);
            for (int k = 0; k < 4; k++) {
                const int a = 4 * columns.first + k, b = 4 * columns.second + k;
                const float left = between(above[a], below[a], rows.part);
                const float right = between(above[b], below[b], rows.part);
                to[k] = half_of(left + columns.part * (right - left));
            }
        }
    }
}

static void make(const struct frame_uniforms *frame, uint16_t *halves, int width, int height,
                 bool column, struct engine_map out[ENGINE_MAPS])
{
    const struct engine_width *lanes = engine_widest();

    if (!halves) {
        width = PLAIN_WIDTH;
        height = PLAIN_WIDTH / 2;
    }
    begin(&out[0], width, height, levels_of(width > height ? width : height), halves);
    begin(&out[1], SPECULAR_WIDTH, SPECULAR_WIDTH / 2, SPECULAR_LEVELS, NULL);
    begin(&out[2], IRRADIANCE_WIDTH, IRRADIANCE_WIDTH / 2, 1, NULL);
    out[1].column = out[2].column = column;
    if (!halves) {
        lanes->make_map(frame, out, 0, 0);
    }
    for (int level = 1; level < out[0].levels; level++) {
        shrink(&out[0], level);
    }
    for (int level = 0; level < SPECULAR_LEVELS; level++) {
        lanes->make_map(frame, out, 1, level);
    }
    lanes->make_map(frame, out, 2, 0);
}

void engine_maps_make(const struct frame_uniforms *frame, uint16_t *halves, int width, int height,
                      struct engine_map out[ENGINE_MAPS])
{
    make(frame, halves, width, height, false, out);
}

void engine_maps_make_columns(const struct frame_uniforms *frame,
                              struct engine_map out[ENGINE_MAPS])
{
    make(frame, NULL, 0, 0, true, out);
}

void engine_maps_finish(struct engine_map maps[ENGINE_MAPS])
{
    for (int i = 0; i < ENGINE_MAPS; i++) {
        for (int level = 0; level < maps[i].levels; level++) {
            free(maps[i].texels[level]);
        }
    }
}
