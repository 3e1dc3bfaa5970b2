/* SPDX-License-Identifier: MIT */
/* What the commands that draw have in common. */
#include "drawing.h"

#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "protocol/nearest.h"
#include "server/rest/embedded.h"

static void print_line(void *data, const char *line)
{
    (void)data;
    fprintf(stderr, "fieldcast: %s\n", line);
}

void drawing_params(const struct options *options, struct renderer_params *out)
{
    const char *cache = option_text(options, OPTION_CACHE);
    struct error err = {0};
    if (cache && !directory_make(cache, &err)) {
        fputs("fieldcast: no shader cache: ", stderr);
        error_print(&err, stderr);
        cache = NULL;
    }
    *out = (struct renderer_params){
        .device = (enum device_kind)option_int(options, OPTION_DEVICE),
        .device_index = option_int(options, OPTION_DEVICE_INDEX),
        .cache_dir = cache,
        .log = print_line,
    };
}

static struct scene *open_example(const char *name, const char *id, struct error *err)
{
    const struct embedded *example = examples_find(id);
    if (example) {
        return scene_parse((const char *)example->bytes, example->length, err);
    }
    struct nearest nearest = {.text = id};
    char hint[96];
    for (size_t i = 0; i < examples_count; i++) {
        nearest_consider(&nearest, examples_table[i].path);
    }
    error_set(err, ERROR_NOT_FOUND, name, "is no example%s",
              nearest_hint(&nearest, hint, sizeof hint));
    return NULL;
}

struct scene *scene_open(const char *name, struct error *err)
{
    if (strncmp(name, "example:", 8) == 0) {
        return open_example(name, name + 8, err);
    }
    size_t length;
    char *text = file_read(name, LIMIT_DOCUMENT_BYTES, &length, err);
    if (!text) {
        return NULL;
    }
    struct error inner = {0};
    struct scene *scene = scene_parse(text, length, &inner);
    free(text);
    if (scene) {
        return scene;
    }
    char place[sizeof inner.place];
    snprintf(place, sizeof place, "%s", inner.place);
    error_set(err, inner.kind, name, "%s%s%s", place, *place ? ": " : "", inner.message);
    return NULL;
}
