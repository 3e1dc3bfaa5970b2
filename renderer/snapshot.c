/* SPDX-License-Identifier: MIT */
/* From a scene to what a picture needs of it. */
#include "renderer_internal.h"

#include <math.h>
#include <stdlib.h>

#include "protocol/memory.h"
#include "renderer/field/shader.h"

enum { PARAM_BUFFER_MIN = 64 };

/* The size of the number buffer as programs declare it: a power of two, so that a material more or
 * less does not ask for another program. */
static size_t number_capacity(const struct field *field)
{
    size_t capacity = PARAM_BUFFER_MIN;

    while (capacity < field->vec4_count) {
        capacity *= 2;
    }
    return capacity;
}

/* Because of what it did to another process. */
static bool refuse(const struct field *field, const struct scene *scene,
                   const struct renderer_verdict *verdict, struct error *err)
{
    const bool code = field->user_code != NULL;
    char place[32 + LIMIT_ID_BYTES];

    snprintf(place, sizeof place, "/nodes/%s", scene->root->id);
    if (verdict->refused == ERROR_TOO_SLOW) {
        return error_set_slow(err, code ? field->user_code->place : place,
                              code ? "compiling this code takes" : "compiling this scene takes",
                              verdict->measured_ms, verdict->limit_ms);
    }
    return error_set(err, verdict->refused, code ? field->user_code->place : place,
                     "compiling this %s ended the render process", code ? "code" : "scene");
}

/* `map` and `surface`: texts of the field. */
static struct program_source source_of(const struct field *field, const struct scene *scene,
                                       bool fragment, const char *map, const char *surface)
{
    return (struct program_source){
        .map_text = map,
        .surface_text = surface,
        .number_count = number_capacity(field),
        .user_shaders = field->shader_count > 0,
        .user_code = field->user_code != NULL,
        .volumes = scene->volumes.count > 0,
        .fragment = fragment,
        .shape_count = field->shape_count,
        .code_size = field->code_size,
        .map_count = field->material_base,
    };
}

const char *renderer_pass_name(size_t pass)
{
    return pass < PROGRAM_STAGES ? program_stage_names[pass] : NULL;
}

char *renderer_shader(const struct scene *scene, size_t pass, struct error *err)
{
    struct field *field = field_compile(scene, err);

    if (!field) {
        return NULL;
    }
    char *map = shader_map(field), *surface = shader_surface(field);
    const struct program_source source =
        source_of(field, scene, pass >= STAGE_STARTS, map, surface);
    char *text = program_text(&source, (enum program_stage)pass, err);
    free(map);
    free(surface);
    field_unref(field);
    return text;
}

/* Of the program that the device has for it. */
static uint64_t structure_of(const struct field *field, const struct scene *scene, bool fragment)
{
    const size_t kind = (scene->volumes.count > 0 ? 1 : 0) + (fragment ? 2 : 0);

    return field->structure_hash ^ ((number_capacity(field) + kind) * UINT64_C(0x9e3779b97f4a7c15));
}

/* Code that is new is tried out first: what is no number in C is none on the device. NULL and `err`
 * where that fails. */
static struct program *get_program(struct renderer *renderer, struct field *field,
                                   const struct scene *scene, uint64_t key,
                                   struct error *out_warning, struct error *err)
{
    const struct renderer_verdict *verdict = renderer_find_verdict(renderer, key, "");
    struct program *program = program_cache_find(renderer->programs, key);
    char *map, *surface;

    if (program) {
        renderer->counters.cache_hits++;
        return program;
    }
    if (!field_try(field, out_warning, err)) {
        return NULL;
    }
    map = shader_map(field);
    surface = shader_surface(field);
    struct program_source source =
        source_of(field, scene, renderer->info.stage == RENDER_FRAGMENT, map, surface);
    source.structure_hash = key;
    source.patience = verdict ? verdict->times : 1;
    program = program_cache_add(renderer->programs, &source);
    free(map);
    free(surface);
    return program;
}

/* How far the document's camera is from what it looks at: the size of what is of interest. */
static double scene_scale(const struct record *camera)
{
    const double *a = record_vector(camera, "position"), *b = record_vector(camera, "target");
    const double scale = sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                              (a[2] - b[2]) * (a[2] - b[2]));

    return scale > 1e-6 ? scale : 1;
}

struct field *snapshot_field(const struct scene *scene, const struct field_options *options,
                             struct error *err)
{
    struct field *field = field_compile_as(scene, options, err);
    struct field_options less = *options;

    if (!field && options->drawn) {
        less.drawn = NULL;
        field = field_compile_as(scene, &less, err);
    }
    return field;
}

/* Whether any material asks for rays. */
static bool is_reflective(const struct field *field)
{
    const size_t slots = field->material_count + 2; /* with the default and the floor's */

    for (size_t i = 0; i < slots; i++) {
        const float *material =
            field->params + 4 * (field->material_base + i * field->material_stride);
        if (material[FIELD_REFLECTIVITY] > 0 || material[FIELD_TRANSMISSION] > 0) {
            return true;
        }
    }
    return false;
}

static bool has_estimates(const struct field *field)
{
    for (size_t i = 0; i < field->instruction_count; i++) {
        const struct field_instruction *in = &field->instructions[i];
        if (in->op == FIELD_SHAPE && in->choices == FIELD_POLYNOMIAL) {
            return true;
        }
    }
    return false;
}

/* `limit_loops`: the driver ends long ones. */
struct scene_bounds snapshot_bounds(const struct geometry *geometry, const struct record *camera,
                                    bool limit_loops)
{
    const struct field *field = geometry->field;
    const struct bounds bounds = geometry_bounds(geometry);
    struct scene_bounds extent = {.scale = scene_scale(camera),
                                  .transmissive = field->transmissive,
                                  .reflective = is_reflective(field),
                                  .estimates = has_estimates(field),
                                  .loop_trips = (int)field->loop_trips,
                                  .limit_loops = limit_loops};

    for (int i = 0; i < 3; i++) {
        extent.min[i] = bounds.low[i];
        extent.max[i] = bounds.high[i];
        extent.transmissive_min[i] = field->transmissive_bounds.low[i];
        extent.transmissive_max[i] = field->transmissive_bounds.high[i];
    }
    return extent;
}

static bool has_fewer_steps(const struct snapshot *snapshot)
{
    struct frame_uniforms block = snapshot->frame;
    struct render_settings settings;

    return render_settings_make(&settings, &block, &snapshot->render,
                                &(struct settings_request){.level = -1}, &snapshot->extent);
}

/* Why a picture that a scene names is not read; false: it may be. */
static bool is_unreadable(const struct renderer *renderer, const char *id, struct error *out)
{
    static const char place[] = "/environment/image";
    const struct asset *image = assets_find(renderer->assets, id);
    const struct renderer_verdict *verdict = renderer_find_verdict(renderer, 0, id);

    if (verdict && verdict->refused == ERROR_TOO_SLOW) {
        error_set_slow(out, place, "reading this picture takes", verdict->measured_ms,
                       verdict->limit_ms);
    } else if (verdict && verdict->refused != ERROR_NONE) {
        error_set(out, verdict->refused, place, "reading this picture ended the render process");
    } else if (!image) {
        error_set(out, ERROR_NOT_FOUND, place, "no such file is known here");
    } else {
        *out = image->problem;
    }
    return out->kind != ERROR_NONE;
}

/* `problem`: why it has no picture; ERROR_NONE: there is none that it wants and has not. */
static void surround(struct renderer *renderer, struct snapshot *snapshot, const char *image,
                     struct engine_map *maps, const struct error *problem)
{
    if (problem->kind != ERROR_NONE) {
        environment_leave_out(&snapshot->frame);
    }
    if (snapshot->warning.error.kind == ERROR_NONE) {
        snapshot->warning = (struct warning){WARNING_ASSET, *problem};
    }
    snapshot->environment = environments_get(renderer->environments, &snapshot->frame, image, maps,
                                             &snapshot->environment_us);
}

/* What does not depend on the program. A picture is waited for. */
static void look_around(struct renderer *renderer, struct snapshot *snapshot,
                        const struct scene *scene)
{
    const char *image = record_text(&scene->environment, "image");
    struct error problem = {0};

    frame_uniforms_set_scene(&snapshot->frame, scene, &snapshot->extent);
    snapshot->fewer_steps = has_fewer_steps(snapshot);
    if (snapshot->frame.sky_kind != SKY_IMAGE ||
        environments_have(renderer->environments, &snapshot->frame, image) ||
        is_unreadable(renderer, image, &problem)) {
        surround(renderer, snapshot, image, NULL, &problem);
        return;
    }
    snapshot->picture = pictures_want(renderer->pictures, assets_find(renderer->assets, image));
    snapshot->next = renderer->waiting;
    renderer->waiting = snapshot;
}

/* It waits for its picture no longer. */
static void leave_waiting(struct renderer *renderer, struct snapshot *snapshot)
{
    struct snapshot **at = &renderer->waiting;

    if (!snapshot->picture) {
        return;
    }
    while (*at != snapshot) {
        at = &(*at)->next;
    }
    *at = snapshot->next;
    picture_unref(renderer->pictures, snapshot->picture);
    snapshot->picture = NULL;
}

void snapshots_settle(struct renderer *renderer)
{
    for (struct snapshot *snapshot = renderer->waiting, *next; snapshot; snapshot = next) {
        struct picture *picture = snapshot->picture;

        next = snapshot->next;
        if (!picture_is_done(picture)) {
            continue;
        }
        const bool made = picture_maps(picture) != NULL;
        surround(renderer, snapshot, picture_id(picture), picture_maps(picture),
                 picture_problem(picture));
        if (made) {
            snapshot->environment_us += picture_us(picture);
        }
        leave_waiting(renderer, snapshot);
    }
}

/* The engine draws a field until its program is compiled, so that an edit is seen at once; and for
 * good where the driver refuses the program. */
static void bridge(struct renderer *renderer, struct snapshot *snapshot,
                   const struct snapshot *before)
{
    if (program_state(snapshot->program) != PROGRAM_READY) {
        snapshot->bridge =
            before && before->bridge
                ? engine_program_ref(before->bridge)
                : engine_program_create(snapshot->geometry.field, renderer->params.lanes,
                                        renderer->params.threads);
    }
}

/* A program for the device or for the engine, which draws what is too much for the device's
 * compiler, too. What is made of instructions alone is shared with a snapshot of the same ones
 * (`before`; NULL: none). */
static bool find_back_end(struct renderer *renderer, struct snapshot *snapshot,
                          const struct scene *scene, const struct snapshot *before,
                          uint64_t *out_refused, struct error *err)
{
    const struct renderer_verdict *verdict =
        renderer_find_verdict(renderer, snapshot->structure_hash, "");
    const bool compiles =
        renderer->info.stage != RENDER_ENGINE && field_can_be_compiled(snapshot->geometry.field);

    if (verdict && verdict->refused != ERROR_NONE) {
        *out_refused = snapshot->structure_hash;
        refuse(snapshot->geometry.field, scene, verdict, err);
        return false;
    }
    if (before && before->engine) {
        snapshot->engine = engine_program_ref(before->engine);
        snapshot->trial = trial_follow(&renderer->trials, before->trial, snapshot->geometry.field);
    } else if (compiles) {
        snapshot->program = get_program(renderer, snapshot->geometry.field, scene,
                                        snapshot->structure_hash, &snapshot->warning.error, err);
        if (snapshot->program) {
            bridge(renderer, snapshot, before);
        }
    } else {
        snapshot->engine = engine_program_create(snapshot->geometry.field, renderer->params.lanes,
                                                 renderer->params.threads);
        snapshot->trial = trial_begin(&renderer->trials, snapshot->geometry.field);
    }
    return snapshot->engine || snapshot->program;
}

struct snapshot *snapshot_create(struct renderer *renderer, const struct scene *scene,
                                 uint64_t revision, const struct snapshot *before,
                                 struct upload *upload, uint64_t *out_refused, struct error *err)
{
    struct field *field = upload->field;
    struct snapshot *snapshot;

    snapshot = memory_alloc(1, sizeof *snapshot);
    snapshot->references = 1;
    snapshot->revision = revision;
    snapshot->upload = upload;
    snapshot->geometry = (struct geometry){.field = field};
    snapshot->structure_hash = structure_of(field, scene, renderer->info.stage == RENDER_FRAGMENT);
    if (!find_back_end(renderer, snapshot, scene, before, out_refused, err)) {
        snapshot_unref(renderer, snapshot);
        return NULL;
    }
    record_copy(&snapshot->camera, &scene->camera);
    record_copy(&snapshot->render, &scene->render);
    snapshot->extent = snapshot_bounds(&snapshot->geometry, &scene->camera,
                                       renderer->info.software && !snapshot->engine);
    look_around(renderer, snapshot, scene);
    return snapshot;
}

uint64_t snapshot_structure_with_code(const struct snapshot *snapshot)
{
    return snapshot->geometry.field->user_code ? snapshot->structure_hash : 0;
}

const struct error *snapshot_error(const struct snapshot *snapshot)
{
    return snapshot->error.kind != ERROR_NONE ? &snapshot->error : trial_error(snapshot->trial);
}

static bool is_compiling(const struct snapshot *snapshot)
{
    return snapshot->program && program_state(snapshot->program) == PROGRAM_PENDING;
}

enum program_state snapshot_state(const struct snapshot *snapshot)
{
    const bool waits =
        is_compiling(snapshot) || snapshot->picture || !trial_is_over(snapshot->trial);

    return snapshot_error(snapshot)->kind != ERROR_NONE ? PROGRAM_FAILED
           : waits                                      ? PROGRAM_PENDING
                                                        : PROGRAM_READY;
}

struct program *snapshot_program(const struct snapshot *snapshot)
{
    return snapshot->program && program_state(snapshot->program) == PROGRAM_READY
               ? snapshot->program
               : NULL;
}

bool snapshot_is_bridged(const struct snapshot *snapshot)
{
    return snapshot->bridge && !snapshot->picture && snapshot->error.kind == ERROR_NONE &&
           is_compiling(snapshot);
}

struct warning snapshot_warning(const struct snapshot *snapshot)
{
    const struct error *warning = trial_warning(snapshot->trial);

    return warning->kind != ERROR_NONE ? (struct warning){WARNING_LIPSCHITZ, *warning}
                                       : snapshot->warning;
}

struct snapshot *snapshot_ref(struct snapshot *snapshot)
{
    snapshot->references++;
    return snapshot;
}

void snapshot_unref(struct renderer *renderer, struct snapshot *snapshot)
{
    if (!snapshot || --snapshot->references > 0) {
        return;
    }
    leave_waiting(renderer, snapshot);
    trial_unref(&renderer->trials, snapshot->trial);
    engine_program_destroy(snapshot->engine);
    engine_program_destroy(snapshot->bridge);
    if (snapshot->program) {
        program_unref(renderer->programs, snapshot->program);
    }
    upload_unref(snapshot->upload, &renderer->gl);
    environment_unref(renderer->environments, snapshot->environment);
    record_finish(&snapshot->camera);
    record_finish(&snapshot->render);
    free(snapshot);
}

const struct param_buffer *snapshot_params(struct renderer *renderer, struct snapshot *snapshot)
{
    return upload_params(snapshot->upload, &renderer->gl, renderer->info.software,
                         number_capacity(snapshot->geometry.field));
}
