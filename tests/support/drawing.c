/* SPDX-License-Identifier: MIT */
#include "drawing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "text_file.h"

struct renderer *drawing_renderer(int tile_side)
{
    const struct renderer_params params = {
        .device_index = -1, .tile_side = tile_side, .cache_dir = getenv("FIELDCAST_CACHE")};
    struct error err = {0};
    struct renderer *renderer = renderer_create(&params, &err);

    if (!renderer) {
        fail_msg("%s", err.message);
    }
    return renderer;
}

struct scene *drawing_parse(const char *text)
{
    struct error err = {0};
    struct scene *scene = scene_parse(text, strlen(text), &err);

    if (!scene) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return scene;
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

bool drawing_is_same(const struct image *a, const struct image *b)
{
    return a->bytes == b->bytes && memcmp(a->pixels, b->pixels, a->bytes) == 0;
}
