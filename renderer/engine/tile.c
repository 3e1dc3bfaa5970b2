/* SPDX-License-Identifier: MIT */
/* Pixels of a tile, LANES at a time, and the threads that take tiles. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "lanes_parts.h"
#include "protocol/memory.h"

enum {
    TILE = 64,  /* pixels to a side */
    MARGIN = 1, /* around it, by which edges are found */
    SIDE = 72,  /* a multiple of lanes' pixels */
    ACROSS = 4, /* pixels of a vector: neighbours, because lanes wait for the slowest */
    THREADS_MAX = 64,
};

struct region {
    const struct engine_picture *picture;
    int x, y, width, height, across, count;
    uint8_t *out;
    size_t stride;
    atomic_int next;
};

/* A thread's own. */
struct hand {
    struct lanes lanes;
    struct dispatch_block dispatch;
    struct scene_block scene;
    float geometry[SIDE * SIDE * 4], pixels[SIDE * SIDE * 4], counted[SIDE * SIDE];
    int listed[SIDE * SIDE], listed_count;
};

static vi count_up(void)
{
    vi lane = vi_zero;
    for (int i = 0; i < LANES; i++) {
        lane[i] = i;
    }
    return lane;
}

/* One more sample of LANES pixels of the tile, at x, y of it. */
static void add_sample(struct hand *hand, const struct engine_picture *picture, vb m, vi x, vi y,
                       int index)
{
    struct lanes *c = &hand->lanes;
    const vf pixel[2] = {(vf)(x + hand->dispatch.origin[0]), (vf)(y + hand->dispatch.origin[1])};
    vf total[4] = {0}, geometry[4] = {0}, light[3];
    spmd_trace(c, m, pixel, index, picture->rays, total, geometry);
    spmd_shown(c, m, total, light);
    const vi at = y * SIDE + x;
    for (int i = 0; i < LANES; i++) {
        if (!m[i]) {
            continue;
        }
        float *sum = hand->pixels + 4 * at[i];
        for (int k = 0; k < 4; k++) {
            sum[k] += k < 3 ? light[k][i] : total[3][i];
        }
        for (int k = 0; k < 4 && index == 0; k++) {
            hand->geometry[4 * at[i] + k] = geometry[k][i];
        }
        hand->counted[at[i]] += 1;
    }
}

static void add_to_all(struct hand *hand, const struct engine_picture *picture, int width,
                       int height, int index)
{
    const vi lane = count_up();
    for (int y = 0; y < height; y += LANES / ACROSS) {
        for (int x = 0; x < width; x += ACROSS) {
            const vi left = x + lane % ACROSS, top = y + lane / ACROSS;
            add_sample(hand, picture, (left < width) & (top < height), left, top, index);
        }
    }
}

static void add_to_listed(struct hand *hand, const struct engine_picture *picture, int index)
{
    const vi lane = count_up();
    for (int i = 0; i < hand->listed_count; i += LANES) {
        vi at = vi_zero;
        for (int k = 0; k < LANES && i + k < hand->listed_count; k++) {
            at[k] = hand->listed[i + k];
        }
        add_sample(hand, picture, i + lane < hand->listed_count, at % SIDE, at / SIDE, index);
    }
}

static void list_edges(struct hand *hand, int width, int height)
{
    const vi lane = count_up();
    hand->listed_count = 0;
    for (int y = 1; y < height - 1; y++) {
        for (int x = 1; x < width - 1; x += LANES) {
            const vi left = x + lane;
            const vb m = left < width - 1;
            const vf here[2] = {(vf)vi_select(m, left, vi_all(1)), (vf)vi_all(y)};
            const vb edge = m & spmd_is_edge(&hand->lanes, m, here);
            for (int i = 0; i < LANES; i++) {
                if (edge[i]) {
                    hand->listed[hand->listed_count++] = y * SIDE + left[i];
                }
            }
        }
    }
}

static void resolve(struct hand *hand, const struct region *region, int left, int top, int width,
                    int height, int margin)
{
    const vi lane = count_up();
    const bool blend = region->picture->smoothing == ENGINE_BLEND;
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x += LANES) {
            const vb m = x + lane < width;
            const vi column = vi_select(m, x + lane, vi_zero);
            const vf here[2] = {(vf)(column + margin), (vf)vi_all(y + margin)};
            const vf pixel[2] = {(vf)(column + left), (vf)vi_all(y + top)};
            vf light[4], color[4];
            spmd_pixel_light(&hand->lanes, m, here, blend, light);
            spmd_pixel_color(&hand->lanes, m, light, pixel, color);
            uint8_t *to = region->out + (size_t)(y + top - region->y) * region->stride +
                          4 * (size_t)(x + left - region->x);
            for (int k = 0; k < 4; k++) {
                const vi bytes = vi_of_f(vf_clamp(color[k], vf_zero, vf_all(1.0f)) * 255.0f + 0.5f);
                for (int i = 0; i < LANES && x + i < width; i++) {
                    to[4 * i + k] = (uint8_t)bytes[i];
                }
            }
        }
    }
}

static void draw_tile(struct hand *hand, const struct region *region, int index)
{
    const struct engine_picture *picture = region->picture;
    const bool looks = picture->smoothing == ENGINE_BLEND || picture->smoothing == ENGINE_ADAPTIVE;
    const int margin = looks ? MARGIN : 0;
    const int left = region->x + index % region->across * TILE;
    const int top = region->y + index / region->across * TILE;
    const int right = region->x + region->width, bottom = region->y + region->height;
    const int width = left + TILE < right ? TILE : right - left;
    const int height = top + TILE < bottom ? TILE : bottom - top;

    hand->dispatch.origin[0] = left - margin;
    hand->dispatch.origin[1] = top - margin;
    memset(hand->pixels, 0, sizeof hand->pixels);
    memset(hand->counted, 0, sizeof hand->counted);
    add_to_all(hand, picture, width + 2 * margin, height + 2 * margin, 0);
    if (picture->smoothing == ENGINE_ADAPTIVE) {
        list_edges(hand, width + 2 * margin, height + 2 * margin);
    }
    for (int i = 1; i < picture->samples; i++) {
        if (picture->smoothing == ENGINE_ADAPTIVE) {
            add_to_listed(hand, picture, i);
        } else {
            add_to_all(hand, picture, width + 2 * margin, height + 2 * margin, i);
        }
    }
    resolve(hand, region, left, top, width, height, margin);
}

static void *work(void *argument)
{
    struct region *region = argument;
    struct hand *hand = aligned_alloc(64, (sizeof *hand + 63) / 64 * 64);
    if (!hand) {
        abort();
    }
    memset(hand, 0, sizeof *hand);
    hand->scene.material_base = region->picture->program->scene.material_base;
    hand->scene.material_stride = region->picture->program->scene.material_stride;
    struct lanes *c = &hand->lanes;
    c->program = region->picture->program;
    c->frame = region->picture->frame;
    c->dispatch = &hand->dispatch;
    c->scene = &hand->scene;
    c->skies = region->picture->skies;
    c->numbers = region->picture->numbers;
    c->tile = (struct lanes_tile){SIDE, hand->geometry, hand->pixels, hand->counted};
    cells_begin(c);
    for (int i = atomic_fetch_add(&region->next, 1); i < region->count;
         i = atomic_fetch_add(&region->next, 1)) {
        draw_tile(hand, region, i);
    }
    cells_end(&c->cells);
    free(hand);
    return NULL;
}

static void draw(const struct engine_picture *picture, int x, int y, int width, int height,
                 uint8_t *out, size_t stride)
{
    struct region region = {.picture = picture,
                            .x = x,
                            .y = y,
                            .width = width,
                            .height = height,
                            .out = out,
                            .stride = stride};
    pthread_t threads[THREADS_MAX];
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    region.across = (width + TILE - 1) / TILE;
    region.count = region.across * ((height + TILE - 1) / TILE);
    atomic_init(&region.next, 0);
    while (started + 1 < cores && started + 1 < region.count && started < THREADS_MAX &&
           pthread_create(&threads[started], NULL, work, &region) == 0) {
        started++;
    }
    work(&region);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
}
