/* SPDX-License-Identifier: MIT */
#include "drawing.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "json_text.h"
#include "text_file.h"

struct renderer *drawing_renderer(int tile_side)
{
    const struct renderer_params params = {
        .device = {.index = -1, .cache_dir = getenv("FIELDCAST_CACHE")}, .tile_side = tile_side};
    struct error err = {0};
    struct renderer *renderer = renderer_create(&params, &err);

    if (!renderer) {
        fail_msg("%s", err.message);
    }
    return renderer;
}

struct scene *drawing_parse(const char *text)
{
    return json_text_valid_scene(text);
}

struct scene *drawing_read(const char *path)
{
    size_t length;
    char *text = text_file_read(path, &length);
    struct scene *scene = drawing_parse(text);

    free(text);
    return scene;
}

struct resident *drawing_resident(struct renderer *renderer, const char *path)
{
    return resident_create(renderer, drawing_read(path), 1);
}

struct job_desc drawing_desc(int width, int height)
{
    return (struct job_desc){
        .width = width, .height = height, .level = -1, .transparent = -1, .exact = true};
}

struct image drawing_of(struct resident *resident, const struct job_desc *desc, enum aov aov)
{
    struct job_desc one = *desc;
    struct error err = {0};
    struct image image = {0};

    memset(one.aovs, 0, sizeof one.aovs);
    one.aovs[aov] = true;
    if (!renderer_render(resident, &one, &image, &err)) {
        fail_msg("%s: %s: %s", aov_name(aov), err.place, err.message);
    }
    return image;
}

struct drawing drawing_outputs(struct renderer *renderer, struct resident *resident,
                               const struct job_desc *desc)
{
    struct drawing drawing = {0};
    size_t filled[AOV_COUNT] = {0};
    struct job *job = job_create(resident, desc, NULL);

    assert_non_null(job);
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        drawing.of[aov] = job_image_info(job, (enum aov)aov);
        drawing.of[aov].pixels = calloc(1, drawing.of[aov].bytes);
    }
    for (enum job_state state; (state = job_step(job)) != JOB_DONE;) {
        assert_int_not_equal(state, JOB_FAILED);
        renderer_poll(renderer, state == JOB_WAITING ? 100 : 0);
        for (int aov = 0; state == JOB_ROWS && aov < AOV_COUNT; aov++) {
            if (desc->aovs[aov]) {
                struct image rows = job_take_rows(job, (enum aov)aov);
                assert_true(filled[aov] + rows.bytes <= drawing.of[aov].bytes);
                memcpy((uint8_t *)drawing.of[aov].pixels + filled[aov], rows.pixels, rows.bytes);
                filled[aov] += rows.bytes;
                image_finish(&rows);
            }
        }
    }
    drawing.drawn_part = job_drawn_part(job);
    job_destroy(job);
    return drawing;
}

void drawing_finish(struct drawing *drawing)
{
    for (int aov = 0; aov < AOV_COUNT; aov++) {
        image_finish(&drawing->of[aov]);
    }
}

bool drawing_is_same(const struct image *a, const struct image *b)
{
    return a->bytes == b->bytes && memcmp(a->pixels, b->pixels, a->bytes) == 0;
}

struct light_difference drawing_compare_light(const struct image *light, const struct image *wanted,
                                              double much)
{
    const double seen = 0.03;
    const float *values = light->pixels, *others = wanted->pixels;
    struct light_difference result = {0};

    for (int i = 0; i < wanted->width * wanted->height; i++) {
        const float value = values[light->channels * i], other = others[wanted->channels * i];
        result.off += fabs(value - other) > much;
        result.dark += other < 1 - seen;
    }
    return result;
}
