/* SPDX-License-Identifier: MIT */
/* A renderer's life, its counters, and the whole way of one picture. */
#include "renderer_internal.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "renderer/field/field_check.h"
#include "stage_trial.h"

enum { POLL_MS = 100 };

void renderer_log(const struct renderer *renderer, const char *format, ...)
{
    char line[512];
    va_list arguments;

    if (!renderer->params.log) {
        return;
    }
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    renderer->params.log(renderer->params.log_data, line);
}

static void read_info(struct renderer *renderer)
{
    const struct gl *gl = &renderer->gl;
    struct renderer_info *info = &renderer->info;
    const char *name = (const char *)gl->GetString(GL_RENDERER);
    const char *version = (const char *)gl->GetString(GL_VERSION);

    snprintf(info->name, sizeof info->name, "%s", name ? name : "");
    snprintf(info->version, sizeof info->version, "%s", version ? version : "");
    snprintf(info->device, sizeof info->device, "%s", renderer->egl.device);
    info->software = renderer->egl.software;
    info->compute = gl->has_compute;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &info->max_texture);
}

const char *const render_program_names[RENDER_PROGRAMS] = {
    [PROGRAMS_AUTO] = "auto",
    [PROGRAMS_COMPILED] = "compiled",
    [PROGRAMS_INTERPRETED] = "interpreted",
    [PROGRAMS_EITHER] = "either",
};

const char *const render_stage_names[RENDER_STAGES] = {
    [RENDER_AUTO] = "auto",
    [RENDER_COMPUTE] = "compute",
    [RENDER_FRAGMENT] = "fragment",
    [RENDER_ENGINE] = "engine",
};

static void go_without(struct renderer *renderer)
{
    struct renderer_info *info = &renderer->info;

    egl_finish(&renderer->egl);
    snprintf(info->name, sizeof info->name, "no graphics device");
    info->none = info->software = true;
}

enum render_stage renderer_best_stage(const struct renderer_info *info)
{
    return info->software ? RENDER_ENGINE : info->compute ? RENDER_COMPUTE : RENDER_FRAGMENT;
}

static bool has_stage(const struct renderer *renderer, enum render_stage stage, struct error *err)
{
    const struct renderer_info *info = &renderer->info;

    return stage != RENDER_COMPUTE || info->compute ||
           error_set(err, ERROR_UNAVAILABLE, "",
                     "compute shaders need OpenGL 4.3; %s has %s, enough for fragment shaders",
                     info->name, info->version);
}

/* The one that is asked for; or none, where none is, or where the engine may draw in any case. */
static bool open_device(struct renderer *renderer, struct error *err)
{
    const struct renderer_params *params = &renderer->params;
    const bool shades = params->stage == RENDER_COMPUTE || params->stage == RENDER_FRAGMENT;
    struct error why = {0};

    if (params->device.kind == DEVICE_NONE && shades) {
        return error_set(err, ERROR_INVALID, "", "shaders need a device, and none is to be opened");
    }
    if (params->device.kind == DEVICE_NONE) {
        go_without(renderer);
        return true;
    }
    if (egl_init(&renderer->egl, &params->device, &why) && gl_load(&renderer->gl, &why)) {
        gl_debug(&renderer->gl, &renderer->sink);
        read_info(renderer);
        return true;
    }
    if (shades || params->device.kind != DEVICE_AUTO || params->device.index >= 0) {
        if (err) {
            *err = why;
        }
        return false;
    }
    renderer_log(renderer, "no device, so the engine draws: %s", why.message);
    go_without(renderer);
    return true;
}

/* Before the process is confined, where it is going to compile. Where nothing is asked for, the
 * engine draws instead of shaders that a driver refuses. */
static bool prepare(struct renderer *renderer, struct error *err)
{
    const struct renderer_params *params = &renderer->params;
    const enum shader_kind kind =
        renderer->info.stage == RENDER_FRAGMENT ? SHADER_FRAGMENT : SHADER_COMPUTE;
    struct error why = {0};

    if (renderer->info.stage == RENDER_ENGINE || (draw_prepare(renderer->draw, kind, &why) &&
                                                  program_cache_start(renderer->programs, &why))) {
        return true;
    }
    if (params->stage != RENDER_AUTO || params->device.kind != DEVICE_AUTO) {
        if (err) {
            *err = why;
        }
        return false;
    }
    renderer_log(renderer, "the device refuses shaders, so the engine draws: %s", why.message);
    renderer->best = renderer->info.stage = RENDER_ENGINE;
    return true;
}

struct renderer *renderer_create(const struct renderer_params *params, struct error *err)
{
    struct renderer *renderer = memory_alloc(1, sizeof *renderer);

    renderer->params = *params;
    renderer->bin = scene_bin_create();
    renderer->sink = (struct gl_sink){params->log, params->log_data};
    if (!open_device(renderer, err) || !has_stage(renderer, params->stage, err)) {
        goto fail;
    }
    renderer->best = renderer_best_stage(&renderer->info);
    renderer_use_stage(renderer, params->stage);
    renderer_use_programs(renderer, params->programs);
    renderer->draw = draw_create(&renderer->gl, renderer->info.software, params->tile_side);
    draw_set_pause(renderer->draw, &(struct engine_pause){.wanted = params->is_wanted,
                                                          .data = params->is_wanted_data});
    renderer->environments = environments_create(&renderer->gl);
    renderer->pictures = pictures_create();
    renderer->programs =
        program_cache_create(&renderer->egl, &renderer->gl, &renderer->sink, params->code_ms);
    if (!prepare(renderer, err)) {
        goto fail;
    }
    if (params->stage == RENDER_AUTO && renderer->best == RENDER_COMPUTE) {
        renderer->best = stage_trial(renderer);
        renderer_use_stage(renderer, RENDER_AUTO);
    }
    return renderer;
fail:
    renderer_destroy(renderer);
    return NULL;
}

void renderer_destroy(struct renderer *renderer)
{
    if (!renderer) {
        return;
    }
    while (renderer->residents) {
        resident_destroy(renderer->residents);
    }
    scene_bin_destroy(renderer->bin);
    program_cache_destroy(renderer->programs);
    environments_destroy(renderer->environments);
    pictures_destroy(renderer->pictures);
    assets_finish(&renderer->assets);
    draw_destroy(renderer->draw);
    egl_finish(&renderer->egl);
    free(renderer->verdicts);
    free(renderer);
}

void renderer_use_programs(struct renderer *renderer, enum render_programs programs)
{
    renderer->programs_wanted = programs != PROGRAMS_AUTO ? programs
                                : renderer->info.software ? PROGRAMS_COMPILED
                                                          : PROGRAMS_EITHER;
}

void renderer_use_stage(struct renderer *renderer, enum render_stage stage)
{
    const bool automatic = stage == RENDER_AUTO || renderer->info.none;

    renderer->info.stage = automatic ? renderer->best : stage;
}

const struct renderer_info *renderer_info(const struct renderer *renderer)
{
    return &renderer->info;
}

size_t renderer_devices(const struct device_params *params, struct device_report *out, size_t max)
{
    return egl_report(params, out, max);
}

struct renderer_counters renderer_counters(const struct renderer *renderer)
{
    struct renderer_counters counters = renderer->counters;

    counters.compilations =
        program_cache_compilations(renderer->programs) + draw_compilations(renderer->draw);
    counters.rays = draw_rays(renderer->draw);
    counters.pixels = draw_pixels(renderer->draw);
    return counters;
}

void renderer_forget(struct renderer *renderer)
{
    draw_forget(renderer->draw);
}

struct renderer_verdict *renderer_find_verdict(const struct renderer *renderer,
                                               uint64_t structure_hash, const char *image)
{
    for (size_t i = 0; i < renderer->verdict_count; i++) {
        struct renderer_verdict *verdict = &renderer->verdicts[i];

        if (verdict->structure_hash == structure_hash && strcmp(verdict->image, image) == 0) {
            return verdict;
        }
    }
    return NULL;
}

static bool is_named_by(const struct resident *resident, const char *id)
{
    return strcmp(record_text(&resident->scene->environment, "image"), id) == 0;
}

void renderer_judge(struct renderer *renderer, const struct renderer_verdict *verdict)
{
    struct renderer_verdict *known =
        renderer_find_verdict(renderer, verdict->structure_hash, verdict->image);

    if (!known) {
        renderer->verdicts = memory_one_more(renderer->verdicts, renderer->verdict_count,
                                             sizeof *renderer->verdicts);
        known = &renderer->verdicts[renderer->verdict_count++];
    }
    *known = *verdict;
    for (struct resident *resident = renderer->residents; resident; resident = resident->next) {
        if (*verdict->image ? is_named_by(resident, verdict->image)
                            : resident->refused_structure == verdict->structure_hash) {
            resident_renew(resident);
        }
    }
}

double renderer_pace(const struct renderer *renderer)
{
    return program_cache_pace(renderer->programs);
}

void renderer_share(struct renderer *renderer, bool shared)
{
    renderer->shared = shared;
}

void renderer_set_pace(struct renderer *renderer, double pace)
{
    program_cache_set_pace(renderer->programs, pace);
}

static bool is_wanted(void *data, const char *id)
{
    const struct renderer *renderer = data;
    const struct resident *resident = renderer->residents;

    while (resident && !is_named_by(resident, id)) {
        resident = resident->next;
    }
    return resident || renderer->holds_assets;
}

void renderer_hold_assets(struct renderer *renderer, bool hold)
{
    renderer->holds_assets = hold;
}

void renderer_asset(struct renderer *renderer, const char *id, const void *bytes, size_t length)
{
    if (!assets_add(&renderer->assets, id, bytes, length, is_wanted, renderer)) {
        return;
    }
    for (struct resident *resident = renderer->residents; resident; resident = resident->next) {
        if (is_named_by(resident, id)) {
            resident_renew(resident);
        }
    }
}

bool renderer_is_reading(const struct renderer *renderer)
{
    struct picture *reading;

    return pictures_next(renderer->pictures, &reading) || reading;
}

bool renderer_stuck(const struct renderer *renderer, struct renderer_stuck *out)
{
    struct program_stuck stuck;

    struct pictures_stuck picture;

    if (program_cache_stuck(renderer->programs, &stuck)) {
        *out = (struct renderer_stuck){stuck.structure_hash, "", stuck.still, stuck.measured_ms,
                                       stuck.limit_ms};
        return true;
    }
    if (pictures_stuck(renderer->pictures, &picture)) {
        *out = (struct renderer_stuck){0, picture.id, false, picture.measured_ms, picture.limit_ms};
        return true;
    }
    return false;
}

/* Rows below those that are there. */
static void append(struct image *whole, struct image *rows, size_t *filled)
{
    memcpy((uint8_t *)whole->pixels + *filled, rows->pixels, rows->bytes);
    *filled += rows->bytes;
    image_finish(rows);
}

static enum aov first_output(const struct job_desc *desc)
{
    for (int i = 0; i < AOV_COUNT; i++) {
        if (desc->aovs[i]) {
            return (enum aov)i;
        }
    }
    return AOV_COLOR;
}

bool renderer_render(struct resident *resident, const struct job_desc *desc,
                     struct image *out_image, struct error *err)
{
    const enum aov aov = first_output(desc);
    struct job *job = job_create(resident, desc, err);
    enum job_state state = JOB_FAILED;
    struct image whole;
    size_t filled = 0;

    if (!job) {
        return false;
    }
    whole = job_image_info(job, aov);
    whole.pixels = memory_alloc(1, whole.bytes);
    while ((state = job_step(job)) != JOB_DONE && state != JOB_FAILED) {
        if (state == JOB_ROWS) {
            struct image rows = job_take_rows(job, aov);
            append(&whole, &rows, &filled);
        }
        renderer_poll(resident->renderer, state == JOB_WAITING ? POLL_MS : 0);
    }
    if (state == JOB_DONE) {
        *out_image = whole;
    } else {
        if (err) {
            *err = *job_error(job);
        }
        image_finish(&whole);
    }
    job_destroy(job);
    return state == JOB_DONE;
}

bool renderer_check(const struct scene *scene, struct error *out_warning, struct error *err)
{
    struct field *field = field_compile(scene, err);
    const bool ok = field && field_check_code(scene, err) && field_try(field, out_warning, err);

    field_unref(field);
    return ok;
}
