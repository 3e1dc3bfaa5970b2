/* SPDX-License-Identifier: MIT */
#include "stage_trial.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "protocol/scene.h"
#include "renderer_internal.h"

enum { WIDTH = 1280, HEIGHT = 720, SOFTWARE_PART = 8, ROUNDS = 3, KEPT_BYTES = 512 };

/* What scenes have: a blend, a cut, copies, a mirror, soft shadows. */
static const char probe[] =
    "{\"format\":\"fieldcast/1\",\"camera\":{\"position\":[3,3,6],\"target\":[0,0,0]},"
    "\"lights\":[{\"type\":\"directional\",\"shadow\":\"soft\"},{\"type\":\"point\"}],"
    "\"materials\":{\"metal\":{\"shader\":\"standard\",\"properties\":{\"metallic\":1}}},"
    "\"root\":{\"type\":\"union\",\"children\":[{\"type\":\"plane\",\"params\":{\"offset\":-1}},"
    "{\"type\":\"smooth_union\",\"children\":[{\"type\":\"sphere\"},{\"type\":\"torus\"}]},"
    "{\"type\":\"difference\",\"material\":\"metal\",\"transform\":{\"translation\":[2,0,0]},"
    "\"children\":[{\"type\":\"box\"},{\"type\":\"cylinder\"}]},"
    "{\"type\":\"repeat\",\"params\":{\"spacing\":[1,1,1],\"count\":[5,0,5]},"
    "\"children\":[{\"type\":\"sphere\",\"params\":{\"radius\":0.2}}]}]}}";

/* --- what is kept: the device and its driver on a line, the stage on the next --- */

static const char *kept_path(const struct renderer *renderer)
{
    static char path[PATH_MAX];

    snprintf(path, sizeof path, "%s/stage", renderer->params.device.cache_dir);
    return path;
}

static void describe(const struct renderer *renderer, enum render_stage stage, char out[KEPT_BYTES])
{
    snprintf(out, KEPT_BYTES, "%s, %s\n%s\n", renderer->info.name, renderer->info.version,
             render_stage_names[stage]);
}

/* RENDER_AUTO: nothing of this device. */
static enum render_stage read_kept(const struct renderer *renderer)
{
    static const enum render_stage stages[] = {RENDER_COMPUTE, RENDER_FRAGMENT};
    char text[KEPT_BYTES] = "", wanted[KEPT_BYTES];
    FILE *file = fopen(kept_path(renderer), "r");

    if (file) {
        text[fread(text, 1, sizeof text - 1, file)] = '\0';
        fclose(file);
    }
    for (size_t i = 0; i < sizeof stages / sizeof stages[0]; i++) {
        describe(renderer, stages[i], wanted);
        if (strcmp(text, wanted) == 0) {
            return stages[i];
        }
    }
    return RENDER_AUTO;
}

/* Whole or not at all. */
static void keep(const struct renderer *renderer, enum render_stage stage)
{
    char path[PATH_MAX + 16], text[KEPT_BYTES];

    snprintf(path, sizeof path, "%s.%ld", kept_path(renderer), (long)getpid());
    describe(renderer, stage, text);
    FILE *file = fopen(path, "w");
    const bool written = file && fputs(text, file) >= 0;
    if (file && (fclose(file) != 0 || !written || rename(path, kept_path(renderer)) != 0)) {
        unlink(path);
    }
}

/* --- the trial --- */

static int64_t now_us(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

/* Of one picture of a moving view, the fastest of a few; -1 and `err` where it cannot be drawn. */
static int64_t time_stage(struct renderer *renderer, enum render_stage stage, struct error *err)
{
    const int part = renderer->info.software ? SOFTWARE_PART : 1; /* in tests alone */
    const struct job_desc desc = {.width = WIDTH / part,
                                  .height = HEIGHT / part,
                                  .level = QUALITY_INTERACTIVE,
                                  .transparent = -1,
                                  .exact = true};
    int64_t least = -1;

    renderer_use_stage(renderer, stage);
    struct scene *scene = scene_parse(probe, sizeof probe - 1, err);
    struct resident *resident = scene ? resident_create(renderer, scene, 1) : NULL;
    for (int i = 0; resident && i <= ROUNDS; i++) {
        const int64_t start = now_us();
        struct image image;
        if (!renderer_render(resident, &desc, &image, err)) {
            least = -1;
            break;
        }
        image_finish(&image);
        const int64_t took = now_us() - start;
        /* The first one waits for the compiler. */
        least = i == 1 || (i > 1 && took < least) ? took : least;
    }
    if (resident) {
        resident_destroy(resident);
    }
    return least;
}

static enum render_stage try_both(struct renderer *renderer)
{
    const enum render_stage before = renderer->info.stage;
    struct error err = {0};
    const int64_t compute = time_stage(renderer, RENDER_COMPUTE, &err);
    const int64_t fragment = time_stage(renderer, RENDER_FRAGMENT, &err);

    renderer_use_stage(renderer, before);
    if (compute < 0 || fragment < 0) {
        renderer_log(renderer, "trying shaders: %s", err.message);
        return fragment < 0 ? RENDER_COMPUTE : RENDER_FRAGMENT;
    }
    renderer_log(renderer,
                 "a small scene takes %.1f ms by compute shaders, %.1f ms by fragment "
                 "shaders",
                 (double)compute / 1000, (double)fragment / 1000);
    return compute < fragment ? RENDER_COMPUTE : RENDER_FRAGMENT;
}

enum render_stage stage_trial(struct renderer *renderer)
{
    enum render_stage stage;

    if (!renderer->params.device.cache_dir) {
        return RENDER_COMPUTE;
    }
    stage = read_kept(renderer);
    if (stage == RENDER_AUTO) {
        keep(renderer, RENDER_COMPUTE); /* for the next start, should this one not end */
        stage = try_both(renderer);
        keep(renderer, stage);
    }
    return stage;
}
