/* SPDX-License-Identifier: MIT */
/* The programs that draw a snapshot: compiled for its field alone, an interpreter, or the
 * engine's. */
#include <stdlib.h>

#include "renderer/field/shader.h"
#include "renderer/field/vocabulary.h"
#include "renderer_internal.h"
#include "snapshot_programs.h"

enum {
    PARAM_BUFFER_MIN = 64,
    FINEST_CUBES = 512, /* of an interpreter, in what is of interest in a scene */
};

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

/* A program of the field alone. source_finish() frees it. */
static struct program_source compiled_of(const struct field *field, const struct scene *scene,
                                         bool fragment)
{
    return (struct program_source){
        .map_text = shader_map(field),
        .surface_text = shader_surface(field),
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

/* A program of the field's vocabulary, which counts as a shape for each kind. */
static struct program_source interpreter_of(const struct field *field, const struct scene *scene,
                                            bool fragment)
{
    struct vocabulary vocabulary = vocabulary_of(field);
    struct program_source source = {
        .map_text = vocabulary_map(&vocabulary, field),
        .surface_text = vocabulary_surface(&vocabulary, field),
        .number_count = PARAM_BUFFER_MIN,
        .user_shaders = field->shader_count > 0,
        .user_code = field->user_code != NULL,
        .volumes = scene->volumes.count > 0,
        .fragment = fragment,
        .tapes = true,
        .shape_count = vocabulary.count,
        .code_size = field->code_size,
    };

    vocabulary_finish(&vocabulary);
    return source;
}

static void source_finish(struct program_source *source)
{
    free(source->map_text);
    free(source->surface_text);
}

/* Whether a program shall be compiled for this field alone. */
static bool is_compiled(const struct renderer *renderer, const struct field *field)
{
    return renderer->info.stage != RENDER_ENGINE && field_can_be_compiled(field) &&
           renderer->programs_wanted != PROGRAMS_INTERPRETED;
}

/* Whether shaders shall read the field, too. Users' code is compiled once, if at all. */
static bool is_interpreted(const struct renderer *renderer, const struct field *field)
{
    const enum render_programs programs = renderer->programs_wanted;

    return renderer->info.stage != RENDER_ENGINE && field_can_be_interpreted(field) &&
           (programs == PROGRAMS_INTERPRETED ||
            (programs == PROGRAMS_EITHER && (!field->user_code || !field_can_be_compiled(field))));
}

const char *renderer_pass_name(size_t pass)
{
    return pass < PROGRAM_STAGES ? program_stage_names[pass] : NULL;
}

char *renderer_shader(const struct scene *scene, size_t pass, enum render_programs programs,
                      struct error *err)
{
    struct field *field = field_compile(scene, err);

    if (!field) {
        return NULL;
    }
    const bool fragment = pass >= STAGE_STARTS;
    struct program_source source = programs == PROGRAMS_INTERPRETED
                                       ? interpreter_of(field, scene, fragment)
                                       : compiled_of(field, scene, fragment);
    char *text = program_text(&source, (enum program_stage)pass, err);
    source_finish(&source);
    field_unref(field);
    return text;
}

/* --- which there are --- */

static uint64_t key_of(const struct renderer *renderer, uint64_t hash, size_t numbers,
                       const struct scene *scene)
{
    const size_t kind =
        (scene->volumes.count > 0 ? 1 : 0) + (renderer->info.stage == RENDER_FRAGMENT ? 2 : 0);

    return hash ^ ((numbers + kind) * UINT64_C(0x9e3779b97f4a7c15));
}

static uint64_t compiled_key(const struct renderer *renderer, const struct field *field,
                             const struct scene *scene)
{
    return key_of(renderer, field->structure_hash, number_capacity(field), scene);
}

static uint64_t interpreter_key(const struct renderer *renderer, const struct field *field,
                                const struct scene *scene)
{
    struct vocabulary vocabulary = vocabulary_of(field);
    const uint64_t hash = vocabulary_hash(&vocabulary, field);

    vocabulary_finish(&vocabulary);
    return key_of(renderer, hash, 0, scene);
}

uint64_t snapshot_structure(const struct renderer *renderer, const struct field *field,
                            const struct scene *scene)
{
    return is_interpreted(renderer, field) && !is_compiled(renderer, field)
               ? interpreter_key(renderer, field, scene)
               : compiled_key(renderer, field, scene);
}

/* NULL: it ended another process. */
static struct program *get_program(struct renderer *renderer, const struct field *field,
                                   const struct scene *scene, bool interpreted)
{
    const bool fragment = renderer->info.stage == RENDER_FRAGMENT;
    const uint64_t key = interpreted ? interpreter_key(renderer, field, scene)
                                     : compiled_key(renderer, field, scene);
    const struct renderer_verdict *verdict = renderer_find_verdict(renderer, key, "");

    if (verdict && verdict->refused != ERROR_NONE) {
        return NULL;
    }
    struct program *program = program_cache_find(renderer->programs, key);
    if (program) {
        renderer->counters.cache_hits++;
        return program;
    }
    struct program_source source =
        interpreted ? interpreter_of(field, scene, fragment) : compiled_of(field, scene, fragment);
    source.structure_hash = key;
    source.patience = verdict ? verdict->times : 1;
    program = program_cache_add(renderer->programs, &source);
    source_finish(&source);
    return program;
}

static struct engine_program *make_engine(const struct renderer *renderer,
                                          const struct snapshot *snapshot)
{
    return engine_program_create(snapshot->geometry.field, renderer->params.lanes,
                                 renderer->params.threads);
}

static bool is_ready(const struct program *program)
{
    return program && program_state(program) == PROGRAM_READY;
}

/* The engine draws a field until a program is compiled, so that an edit is seen at once; and for
 * good where the driver refuses them. */
static void bridge(struct renderer *renderer, struct snapshot *snapshot,
                   const struct snapshot *before)
{
    if (!is_ready(snapshot->program) && !is_ready(snapshot->interpreter)) {
        snapshot->bridge = before && before->bridge ? engine_program_ref(before->bridge)
                                                    : make_engine(renderer, snapshot);
    }
}

/* What an interpreter's tapes are made of. */
static void read_tapes(struct renderer *renderer, struct snapshot *snapshot,
                       const struct snapshot *before)
{
    struct engine_program *made = before && before->tapes ? before->tapes : snapshot->bridge;

    snapshot->tapes = made ? engine_program_ref(made) : make_engine(renderer, snapshot);
}

/* Code that is new is tried out first: what is no number in C is none on the device. False and
 * `err` where that fails. */
static bool find_programs(struct renderer *renderer, struct snapshot *snapshot,
                          const struct scene *scene, const struct snapshot *before,
                          struct error *err)
{
    struct field *field = snapshot->geometry.field;
    struct program *known = program_cache_find(renderer->programs, snapshot->structure_hash);
    const bool ok = known || field_try(field, &snapshot->warning.error, err);

    program_unref(renderer->programs, known);
    if (!ok) {
        return false;
    }
    if (is_interpreted(renderer, field)) {
        snapshot->interpreter = get_program(renderer, field, scene, true);
    }
    if (is_compiled(renderer, field)) {
        snapshot->program = get_program(renderer, field, scene, false);
    }
    bridge(renderer, snapshot, before);
    if (snapshot->interpreter) {
        read_tapes(renderer, snapshot, before);
    }
    return true;
}

bool snapshot_find_back_end(struct renderer *renderer, struct snapshot *snapshot,
                            const struct scene *scene, const struct snapshot *before,
                            uint64_t *out_refused, struct error *err)
{
    const struct field *field = snapshot->geometry.field;
    const struct renderer_verdict *verdict =
        renderer_find_verdict(renderer, snapshot->structure_hash, "");

    if (verdict && verdict->refused != ERROR_NONE) {
        *out_refused = snapshot->structure_hash;
        refuse(field, scene, verdict, err);
        return false;
    }
    if (before && before->engine) {
        snapshot->engine = engine_program_ref(before->engine);
        snapshot->trial = trial_follow(&renderer->trials, before->trial, snapshot->geometry.field);
    } else if (is_compiled(renderer, field) || is_interpreted(renderer, field)) {
        return find_programs(renderer, snapshot, scene, before, err);
    } else {
        snapshot->engine = make_engine(renderer, snapshot);
        snapshot->trial = trial_begin(&renderer->trials, snapshot->geometry.field);
    }
    return snapshot->engine;
}

void snapshot_leave_back_end(struct renderer *renderer, struct snapshot *snapshot)
{
    trial_unref(&renderer->trials, snapshot->trial);
    engine_program_destroy(snapshot->engine);
    engine_program_destroy(snapshot->bridge);
    engine_program_destroy(snapshot->tapes);
    program_unref(renderer->programs, snapshot->program);
    program_unref(renderer->programs, snapshot->interpreter);
}

/* --- which one draws --- */

static bool is_pending(const struct program *program)
{
    return program && program_state(program) == PROGRAM_PENDING;
}

bool snapshot_is_compiling(const struct snapshot *snapshot)
{
    return !is_ready(snapshot->program) && !is_ready(snapshot->interpreter) &&
           (is_pending(snapshot->program) || is_pending(snapshot->interpreter));
}

/* Of pictures that are about as large. A compiled program is taken until it is known. */
static bool is_interpreter_faster(const struct program *program)
{
    const struct program_time compiled = program_time(program, PROGRAM_COMPILED);
    const struct program_time interpreted = program_time(program, PROGRAM_INTERPRETED);

    return compiled.pixels > 0 && compiled.pixels < 2 * interpreted.pixels &&
           interpreted.pixels < 2 * compiled.pixels && interpreted.us < compiled.us;
}

struct program *snapshot_program(const struct snapshot *snapshot)
{
    const bool compiled = is_ready(snapshot->program), reads = is_ready(snapshot->interpreter);

    return compiled && !(reads && is_interpreter_faster(snapshot->program)) ? snapshot->program
           : reads                                                          ? snapshot->interpreter
                                                                            : NULL;
}

void snapshot_learn(struct snapshot *snapshot, const struct program *program, uint64_t us,
                    int pixels)
{
    if (snapshot->program && snapshot->interpreter) {
        program_set_time(snapshot->program,
                         program == snapshot->program ? PROGRAM_COMPILED : PROGRAM_INTERPRETED,
                         (struct program_time){us, pixels});
    }
}

bool snapshot_is_bridged(const struct snapshot *snapshot)
{
    return snapshot->bridge && !snapshot->picture && snapshot->error.kind == ERROR_NONE &&
           snapshot_is_compiling(snapshot);
}

/* --- what it reads --- */

const struct param_buffer *snapshot_params(struct renderer *renderer, struct snapshot *snapshot,
                                           const struct program *program)
{
    const size_t capacity = number_capacity(snapshot->geometry.field);
    const bool in_texture =
        program_has_tapes(program) ||
        param_buffer_in_texture(&renderer->gl, renderer->info.software, capacity);

    return upload_params(snapshot->upload, &renderer->gl, in_texture, capacity);
}

/* All that rays of the document's camera reach, by cubes down to some of its pixels. */
static struct engine_extent extent_of(const struct snapshot *snapshot)
{
    const float scale = (float)snapshot->extent.scale;

    return (struct engine_extent){(float)record_number(&snapshot->render, "max_distance"), scale,
                                  scale / FINEST_CUBES};
}

GLuint snapshot_tapes(struct renderer *renderer, struct snapshot *snapshot,
                      const struct program *program)
{
    const struct engine_extent extent = extent_of(snapshot);

    return program_has_tapes(program)
               ? upload_tapes(snapshot->upload, &renderer->gl, snapshot->tapes, &extent)
               : 0;
}
