/* SPDX-License-Identifier: MIT */
#include "drawing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "text_file.h"

struct renderer *drawing_renderer(void)
{
    const struct renderer_params params = {.device_index = -1,
                                           .cache_dir = getenv("FIELDCAST_CACHE")};
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

struct image drawing_of(struct resident *resident, const struct job_desc *desc, enum aov aov)
{
    struct job_desc one = *desc;
    struct error err = {0};
    struct image image = {0};

    one.exact = true;
    memset(one.aovs, 0, sizeof one.aovs);
    one.aovs[aov] = true;
    if (!renderer_render(resident, &one, &image, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    return image;
}
