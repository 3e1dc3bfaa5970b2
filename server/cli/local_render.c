/* SPDX-License-Identifier: MIT */
/* What the commands that draw have in common. */
#include "local_render.h"

#include <stdlib.h>
#include <string.h>

#include "files.h"
#include "protocol/asset.h"
#include "protocol/memory.h"
#include "protocol/suggest.h"
#include "server/digest.h"
#include "server/embedded.h"

static void print_line(void *data, const char *line)
{
    (void)data;
    fprintf(stderr, "fieldcast: %s\n", line);
}

void local_render_params(const struct options *options, struct renderer_params *out)
{
    const char *cache = option_text(options, OPTION_CACHE);
    struct error err = {0};

    if (cache && !directory_make(cache, &err)) {
        fputs("fieldcast: no shader cache: ", stderr);
        error_print(&err, stderr);
        cache = NULL;
    }
    *out = (struct renderer_params){
        .device = {.kind = (enum device_kind)option_int(options, OPTION_DEVICE),
                   .index = option_int(options, OPTION_DEVICE_INDEX),
                   .cache_dir = cache,
                   .debug = true},
        .stage = (enum render_stage)option_int(options, OPTION_STAGE),
        .programs = (enum render_programs)option_int(options, OPTION_PROGRAMS),
        .log = print_line,
    };
}

void local_render_give_example_file(struct renderer *renderer, const struct scene *scene)
{
    const char *id = record_text(&scene->environment, "image");
    const struct embedded *file = example_files_find(id);

    if (file) {
        renderer_asset(renderer, id, file->bytes, file->length);
    }
}

/* Nothing is given that the scene does not name. */
static bool give_file(struct renderer *renderer, const struct scene *scene, const char *path,
                      struct error *err)
{
    struct asset_info info;
    struct error inner = {0};
    size_t length;
    char id[ASSET_ID_CHARACTERS + 1];
    char *bytes = file_read(path, LIMIT_ASSET_BYTES, &length, err);

    if (!bytes) {
        return false;
    }
    const bool ok = asset_inspect((const uint8_t *)bytes, length, &info, &inner) ||
                    error_set(err, inner.kind, path, "%s", inner.message);
    if (ok) {
        digest_text(bytes, length, id);
    }
    if (ok && strcmp(id, record_text(&scene->environment, "image")) == 0) {
        renderer_asset(renderer, id, bytes, length);
    }
    free(bytes);
    return ok;
}

bool local_render_give_files(struct renderer *renderer, const struct scene *scene,
                             const struct options *options, struct error *err)
{
    const char *paths = option_text(options, OPTION_ASSET);
    char *copy = memory_text(paths ? paths : ""), *rest = copy, *path;
    bool ok = true;

    local_render_give_example_file(renderer, scene);
    while (ok && (path = strsep(&rest, "\n")) && *path) {
        ok = give_file(renderer, scene, path, err);
    }
    free(copy);
    return ok;
}

static struct scene *open_example(const char *name, const char *id, struct error *err)
{
    const struct embedded *example = examples_find(id);

    if (example) {
        return scene_parse((const char *)example->bytes, example->length, err);
    }
    struct suggestion suggestion = {.text = id};
    char hint[96];
    for (size_t i = 0; i < examples_count; i++) {
        suggest_consider(&suggestion, examples_table[i].path);
    }
    error_set(err, ERROR_NOT_FOUND, name, "is no example%s",
              suggest_hint(&suggestion, hint, sizeof hint));
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
