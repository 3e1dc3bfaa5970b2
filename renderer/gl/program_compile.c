/* SPDX-License-Identifier: MIT */
/* The threads that compile programs, and what they take next. */
#include <stdlib.h>

#include "param_buffer.h"
#include "program_internal.h"
#include "protocol/memory.h"
#include "renderer/crash.h"
#include "warm_targets.h"

enum {
    PRELOAD_MAX = 4096, /* vec4s */
    SHARED_MAX = 2048,  /* vec4s in the 32 KiB that OpenGL 4.3 promises to each work group */
};

const char *const program_stage_names[PROGRAM_STAGES] = {
    [STAGE_MARCH] = "march",   [STAGE_MATERIAL] = "material", [STAGE_SHADOW] = "shadow",
    [STAGE_VOLUME] = "volume", [STAGE_STARTS] = "starts",     [STAGE_SAMPLE] = "sample"};

enum { FILE_NAME_BYTES = 32 };

static void write_file_name(enum program_stage stage, char out[FILE_NAME_BYTES])
{
    snprintf(out, FILE_NAME_BYTES, "%s_pass.glsl", program_stage_names[stage]);
}

/* --- one stage --- */

static const char *define_users(bool shaders)
{
    return shaders ? "#define USER_SHADERS\n" : "";
}

static const char *define_volumes(bool volumes)
{
    return volumes ? "#define VOLUMES\n" : "";
}

static bool has_numbers_in_texture(const struct gl *gl, const struct program *program,
                                   bool software)
{
    return program->tapes || param_buffer_in_texture(gl, software, program->number_count);
}

static const char *define_texture(bool in_texture)
{
    return in_texture ? "#define PARAMS_IN_TEXTURE\n" : "";
}

/* What glsl/params.glsl wants to know, and what there is. */
static char *make_defines(const struct gl *gl, const struct program *program, bool software)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    fprintf(out, "#define PARAMS_COUNT %zu\n%s%s%s", program->number_count,
            define_texture(has_numbers_in_texture(gl, program, software)),
            define_users(program->user_shaders), define_volumes(program->volumes));
    if (software && !program->tapes && program->map_count > 0 &&
        program->map_count <= PRELOAD_MAX) {
        fprintf(out, "#define PARAMS_PRELOADED %zu\n#define PARAMS_PRELOAD(X)", program->map_count);
        for (size_t i = 0; i < program->map_count; i++) {
            fprintf(out, " X(%zu)", i);
        }
        fputc('\n', out);
        if (!program->fragment) {
            fprintf(out, "#define PARAMS_SHARED %zu\n",
                    program->map_count < SHARED_MAX ? program->map_count : SHARED_MAX);
        }
    }
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

static bool link_source(const struct gl *gl, const struct program *program, bool software,
                        const char *file, struct pass *out_pass, struct error *err)
{
    const struct glsl_file own[] = {{"field_map.glsl", program->map_text},
                                    {"field_surface.glsl", program->surface_text},
                                    {NULL, NULL}};
    char *defines = make_defines(gl, program, software);
    const bool ok =
        pass_init(out_pass, gl, &(struct pass_source){!program->fragment, defines, file, own}, err);

    free(defines);
    return ok;
}

char *program_text(const struct program_source *source, enum program_stage stage, struct error *err)
{
    const struct glsl_file own[] = {{"field_map.glsl", source->map_text},
                                    {"field_surface.glsl", source->surface_text},
                                    {NULL, NULL}};
    struct shader_text text;
    char file[FILE_NAME_BYTES], head[192];

    write_file_name(stage, file);
    snprintf(head, sizeof head,
             "#version 430 core\n#define PRECISE precise\n#define PARAMS_COUNT %zu\n%s%s%s",
             source->number_count, define_texture(source->tapes),
             define_users(source->user_shaders), define_volumes(source->volumes));
    return include_resolve(&text, head, file, own, err) ? text.text : NULL;
}

/* With nothing in the buffers: the driver finishes its work. */
static void warm_up(const struct program_cache *cache, const struct warm_targets *targets,
                    const struct program *program, enum program_stage stage,
                    const struct pass *pass)
{
    const struct gl *gl = cache->gl;
    const struct frame_uniforms block = {
        .camera.size = {1, 1}, .max_steps = 1, .bounds_max = {1, 1, 1}, .max_distance = 1};
    struct param_buffer params;
    GLuint frame = 0;

    gl->GenBuffers(1, &frame);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, frame);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STATIC_DRAW);
    param_buffer_init(&params, gl, has_numbers_in_texture(gl, program, cache->egl->software), NULL,
                      0, program->number_count);
    param_buffer_bind(&params, gl);
    if (program->tapes) {
        tape_texture_bind(targets->tapes, gl);
    }
    warm_targets_run(targets, gl, stage, pass);
    gl->Finish();
    param_buffer_finish(&params, gl);
    gl->DeleteBuffers(1, &frame);
}

void program_refuse(struct program *program, const struct error *err)
{
    const struct gl_sink *sink = program->cache->sink;
    char line[sizeof *err + 64];

    program->error = *err;
    if (sink->log) {
        snprintf(line, sizeof line, "the driver refuses a program, so the engine draws: %s%s%s",
                 err->place, *err->place ? ": " : "", err->message);
        sink->log(sink->data, line);
    }
}

/* The state follows from the stages once none is left. */
static void finish_stage(struct program_cache *cache, struct program *program,
                         const struct error *err)
{
    if (err->kind != ERROR_NONE && program->error.kind == ERROR_NONE) {
        program_refuse(program, err);
    }
    cache->compilations++;
    if (++program->done == program->stages) {
        program->state = program->error.kind == ERROR_NONE ? PROGRAM_READY : PROGRAM_FAILED;
        cache->finished++;
        pthread_cond_broadcast(&cache->done);
    }
}

/* Under the lock. */
static void begin(struct compiler *compiler, const struct program *program)
{
    compiler->program = program;
    program_limit_begin(compiler);
}

static void compile_stage(struct program_cache *cache, struct warm_targets *targets,
                          struct program *program, enum program_stage stage)
{
    const struct gl *gl = cache->gl;
    struct pass pass = {0};
    struct error err = {0};
    char file[FILE_NAME_BYTES];

    write_file_name(stage, file);
    if (warm_targets_prepare(targets, gl, program->fragment, &err) &&
        link_source(gl, program, cache->egl->software, file, &pass, &err)) {
        warm_up(cache, targets, program, stage, &pass);
    }
    gl->Finish();
    pthread_mutex_lock(&cache->lock);
    program->passes[stage] = pass;
    program_limit_end(cache, program);
    finish_stage(cache, program, &err);
    program->refs--;
    pthread_mutex_unlock(&cache->lock);
}

/* --- the threads --- */

static void work(struct compiler *compiler, struct warm_targets *targets)
{
    struct program_cache *cache = compiler->cache;

    pthread_mutex_lock(&cache->lock);
    while (!cache->stop) {
        enum program_stage stage = STAGE_MARCH;
        struct program *program = program_order_take(cache, &stage);
        if (!program) {
            pthread_cond_wait(&cache->work, &cache->lock);
            continue;
        }
        begin(compiler, program);
        pthread_mutex_unlock(&cache->lock);
        crash_thread(program->user_code ? CRASH_COMPILING : CRASH_ANYWHERE);
        compile_stage(cache, targets, program, stage);
        crash_thread(CRASH_ANYWHERE);
        pthread_mutex_lock(&cache->lock);
        compiler->program = NULL;
        pthread_cond_broadcast(&cache->work); /* another may be at this program now */
    }
    pthread_mutex_unlock(&cache->lock);
}

void *program_compile_main(void *data)
{
    struct compiler *compiler = data;
    struct program_cache *cache = compiler->cache;
    const struct gl *gl = cache->gl;
    struct warm_targets targets = {0};
    struct error err = {0};

    pthread_mutex_lock(&cache->lock);
    EGLContext context = cache->egl->compile[cache->started++];
    pthread_mutex_unlock(&cache->lock);
    const bool ok = egl_bind(cache->egl, context, &err);
    pthread_mutex_lock(&cache->lock);
    cache->running += ok;
    cache->stop = cache->stop || !ok;
    cache->start_error = ok ? cache->start_error : err;
    pthread_cond_broadcast(&cache->done);
    pthread_mutex_unlock(&cache->lock);
    if (ok) {
        gl_debug(gl, cache->sink);
        work(compiler, &targets);
        warm_targets_finish(&targets, gl);
    }
    egl_bind(cache->egl, EGL_NO_CONTEXT, NULL);
    return NULL;
}

/* --- for the drawing thread --- */

void program_cache_allow(struct program_cache *cache, struct program *program)
{
    pthread_mutex_lock(&cache->lock);
    program->allowed = true;
    pthread_cond_broadcast(&cache->work);
    pthread_mutex_unlock(&cache->lock);
}
