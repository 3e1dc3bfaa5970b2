/* SPDX-License-Identifier: MIT */
/* The cache, and the threads that fill it. One lock guards list, queue, states and counters; the
 * threads hold it only between compilations. */
#include "program.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/memory.h"
#include "renderer/draw/frame.h"
#include "renderer/field/shader.h"
#include "targets.h"

enum { PRELOAD_MAX = 4096 }; /* vec4s */

struct program {
    struct program_cache *cache;
    struct program *next; /* in the cache's list */
    uint64_t shape_hash;
    char *map_text, *surface_text;
    size_t number_count, map_count;
    bool user_shaders;
    int refs;
    uint64_t last_use;
    enum program_state state;
    int taken, done; /* stages that a thread took, and those finished or given up */
    struct pass passes[STAGE_COUNT];
    struct error error;
};

struct program_cache {
    const struct egl *egl;
    const struct gl *gl;
    const struct gl_sink *sink;
    pthread_t threads[EGL_COMPILERS];
    int started, running; /* threads */
    bool stop;
    pthread_mutex_t lock;
    pthread_cond_t work, done;
    struct program *first;
    uint64_t uses, compilations, finished, finished_seen;
    struct error start_error;
};

bool numbers_in_texture(const struct gl *gl, bool software, size_t number_count)
{
    GLint bytes = 0;

    gl->GetIntegerv(GL_MAX_UNIFORM_BLOCK_SIZE, &bytes);
    return software || number_count * 16 > (size_t)bytes;
}

/* --- the compiling thread --- */

/* What glsl/numbers.glsl wants to know. */
static char *make_defines(const struct program *program, bool preload, bool in_texture)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);

    if (!out) {
        abort();
    }
    fprintf(out, "#define NUMBERS_COUNT %zu\n%s%s", program->number_count,
            in_texture ? "#define NUMBERS_IN_TEXTURE\n" : "",
            program->user_shaders ? "#define USER_SHADERS\n" : "");
    if (preload && program->map_count > 0 && program->map_count <= PRELOAD_MAX) {
        fprintf(out, "#define NUMBERS_PRELOADED %zu\n#define NUMBERS_PRELOAD(X)",
                program->map_count);
        for (size_t i = 0; i < program->map_count; i++) {
            fprintf(out, " X(%zu)", i);
        }
        fputc('\n', out);
    }
    if (fclose(out) != 0) {
        abort();
    }
    return text;
}

static bool link_stage(const struct gl *gl, const struct program *program, bool software,
                       enum program_stage stage, struct pass *out_pass, struct error *err)
{
    static const char *const files[STAGE_COUNT][24] = {
        {"group.glsl", "numbers.glsl", "frame.glsl", FIELD_GLSL_FILES, "map", "camera.glsl",
         "march.glsl", NULL},
        {"group.glsl", "numbers.glsl", "frame.glsl", "surface.glsl", FIELD_GLSL_FILES, "surface",
         "camera.glsl", "gbuffer.glsl", "matter.glsl", NULL},
        {"group.glsl", "numbers.glsl", "frame.glsl", "surface.glsl", FIELD_GLSL_FILES, "map",
         "camera.glsl", "gbuffer.glsl", "sky.glsl", "light.glsl", NULL},
    };
    char *defines =
        make_defines(program, software, numbers_in_texture(gl, software, program->number_count));
    bool ok = pass_init(out_pass, gl,
                        &(struct pass_source){true, defines, files[stage], program->map_text,
                                              program->surface_text},
                        err);
    free(defines);
    return ok;
}

/* One work group, with nothing in the buffers: the driver finishes its work. */
static void warm_up(const struct program_cache *cache, const struct targets *targets,
                    const struct program *program, const struct pass *pass)
{
    const struct gl *gl = cache->gl;
    const size_t bytes = 16 * program->number_count;
    const bool texture = numbers_in_texture(gl, cache->egl->software, program->number_count);
    float *zeros = memory_alloc(1, bytes);
    const struct frame_block block = {.size = {1, 1, 1, 1}, .bounds_max = {1, 1, 1, 1}};
    GLuint buffers[2], view = 0;

    gl->GenBuffers(2, buffers);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_FRAME, buffers[0]);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STATIC_DRAW);
    if (texture) {
        gl->BindBuffer(GL_TEXTURE_BUFFER, buffers[1]);
        gl->BufferData(GL_TEXTURE_BUFFER, (GLsizeiptr)bytes, zeros, GL_STATIC_DRAW);
        gl->GenTextures(1, &view);
        gl->ActiveTexture(GL_TEXTURE0 + UNIT_NUMBERS);
        gl->BindTexture(GL_TEXTURE_BUFFER, view);
        gl->TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffers[1]);
    } else {
        gl->BindBufferBase(GL_UNIFORM_BUFFER, BINDING_NUMBERS, buffers[1]);
        gl->BufferData(GL_UNIFORM_BUFFER, (GLsizeiptr)bytes, zeros, GL_STATIC_DRAW);
    }
    pass_compute(pass, gl, 0, 0, targets->width, targets->height);
    gl->Finish();
    gl->DeleteBuffers(2, buffers);
    if (view) {
        gl->DeleteTextures(1, &view);
    }
    free(zeros);
}

/* The state follows from the stages once none is left. */
static void finish_stage(struct program_cache *cache, struct program *program,
                         const struct error *err)
{
    if (err->kind != ERROR_NONE && program->error.kind == ERROR_NONE) {
        program->error = *err;
    }
    cache->compilations++;
    if (++program->done == STAGE_COUNT) {
        program->state = program->error.kind == ERROR_NONE ? PROGRAM_READY : PROGRAM_FAILED;
        cache->finished++;
        pthread_cond_broadcast(&cache->done);
    }
}

static void compile_stage(struct program_cache *cache, const struct targets *targets,
                          struct program *program, enum program_stage stage)
{
    const struct gl *gl = cache->gl;
    struct pass pass = {0};
    struct error err = {0};

    if (link_stage(gl, program, cache->egl->software, stage, &pass, &err)) {
        warm_up(cache, targets, program, &pass);
    }
    gl->Finish();
    pthread_mutex_lock(&cache->lock);
    program->passes[stage] = pass;
    finish_stage(cache, program, &err);
    program->refs--;
    pthread_mutex_unlock(&cache->lock);
}

static bool is_waiting(const struct program *program)
{
    return program->taken < STAGE_COUNT && program->refs > 0;
}

/* A stage of the newest program that somebody still wants: what was asked for before it is out of
 * date. One that has been begun is finished, since another thread is at it. */
static struct program *take_work(struct program_cache *cache, enum program_stage *out_stage)
{
    struct program *best = NULL;

    for (struct program *p = cache->first; p; p = p->next) {
        int begun = best ? (p->taken > 0) - (best->taken > 0) : 1;
        if (is_waiting(p) && (begun > 0 || (begun == 0 && p->last_use > best->last_use))) {
            best = p;
        }
    }
    if (best) {
        *out_stage = (enum program_stage)best->taken++;
        best->refs++;
    }
    return best;
}

static void work(struct program_cache *cache, const struct targets *targets)
{
    pthread_mutex_lock(&cache->lock);
    while (!cache->stop) {
        enum program_stage stage = STAGE_MARCH;
        struct program *program = take_work(cache, &stage);
        if (!program) {
            pthread_cond_wait(&cache->work, &cache->lock);
            continue;
        }
        pthread_mutex_unlock(&cache->lock);
        compile_stage(cache, targets, program, stage);
        pthread_mutex_lock(&cache->lock);
    }
    pthread_mutex_unlock(&cache->lock);
}

static void *thread_main(void *data)
{
    struct program_cache *cache = data;
    const struct gl *gl = cache->gl;
    struct targets targets = {0};
    struct error err = {0};

    pthread_mutex_lock(&cache->lock);
    EGLContext context = cache->egl->compile[cache->started++];
    pthread_mutex_unlock(&cache->lock);
    const bool ok = egl_bind(cache->egl, context, &err) &&
                    targets_init(&targets, gl, GROUP_SIDE, GROUP_SIDE, &err);
    pthread_mutex_lock(&cache->lock);
    cache->running += ok;
    cache->stop = cache->stop || !ok;
    cache->start_error = ok ? cache->start_error : err;
    pthread_cond_broadcast(&cache->done);
    pthread_mutex_unlock(&cache->lock);
    if (ok) {
        gl_debug(gl, cache->sink);
        targets_bind(&targets, gl);
        work(cache, &targets);
        targets_finish(&targets, gl);
    }
    egl_bind(cache->egl, EGL_NO_CONTEXT, NULL);
    return NULL;
}

/* --- the cache --- */

struct program_cache *program_cache_create(const struct egl *egl, const struct gl *gl,
                                           const struct gl_sink *sink, struct error *err)
{
    struct program_cache *cache = memory_alloc(1, sizeof *cache);
    pthread_condattr_t clock;

    cache->egl = egl;
    cache->gl = gl;
    cache->sink = sink;
    pthread_mutex_init(&cache->lock, NULL);
    pthread_cond_init(&cache->work, NULL);
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&cache->done, &clock);
    pthread_condattr_destroy(&clock);
    for (int i = 0; i < EGL_COMPILERS; i++) {
        if (pthread_create(&cache->threads[i], NULL, thread_main, cache) != 0) {
            abort(); /* as where there is no memory */
        }
    }
    pthread_mutex_lock(&cache->lock);
    while (cache->running < EGL_COMPILERS && !cache->stop) {
        pthread_cond_wait(&cache->done, &cache->lock);
    }
    const bool ok = !cache->stop;
    pthread_mutex_unlock(&cache->lock);
    if (!ok) {
        if (err) {
            *err = cache->start_error;
        }
        program_cache_destroy(cache);
        return NULL;
    }
    return cache;
}

static void destroy_program(const struct gl *gl, struct program *program)
{
    for (int i = 0; i < STAGE_COUNT; i++) {
        pass_finish(&program->passes[i], gl);
    }
    free(program->map_text);
    free(program->surface_text);
    free(program);
}

void program_cache_destroy(struct program_cache *cache)
{
    if (!cache) {
        return;
    }
    pthread_mutex_lock(&cache->lock);
    cache->stop = true;
    pthread_cond_broadcast(&cache->work);
    pthread_mutex_unlock(&cache->lock);
    for (int i = 0; i < EGL_COMPILERS; i++) {
        pthread_join(cache->threads[i], NULL);
    }
    while (cache->first) {
        struct program *program = cache->first;
        cache->first = program->next;
        destroy_program(cache->gl, program);
    }
    pthread_cond_destroy(&cache->work);
    pthread_cond_destroy(&cache->done);
    pthread_mutex_destroy(&cache->lock);
    free(cache);
}

/* Of the programs nobody uses, removes the least recently used while there are too many. Those
 * that failed, or that were never begun, are of no use to anybody. */
static void evict(struct program_cache *cache)
{
    for (;;) {
        struct program **victim = NULL;
        size_t unused = 0;

        for (struct program **at = &cache->first; *at; at = &(*at)->next) {
            const struct program *p = *at;
            if (p->refs > 0) {
                continue;
            }
            unused++;
            if (p->taken < STAGE_COUNT || p->state == PROGRAM_FAILED) {
                victim = at;
                unused = PROGRAMS_KEPT + 1;
                break;
            }
            if (!victim || p->last_use < (*victim)->last_use) {
                victim = at;
            }
        }
        if (unused <= PROGRAMS_KEPT) {
            return;
        }
        struct program *gone = *victim;
        *victim = gone->next;
        destroy_program(cache->gl, gone);
    }
}

struct program *program_cache_find(struct program_cache *cache, uint64_t shape_hash)
{
    struct program *found = NULL;

    pthread_mutex_lock(&cache->lock);
    for (struct program *p = cache->first; p && !found; p = p->next) {
        if (p->shape_hash == shape_hash) {
            found = p;
        }
    }
    if (found) {
        found->refs++;
        found->last_use = ++cache->uses;
        pthread_cond_broadcast(&cache->work); /* it may have been given up while queued */
    }
    pthread_mutex_unlock(&cache->lock);
    return found;
}

struct program *program_cache_add(struct program_cache *cache, const struct program_source *source)
{
    struct program *program = memory_alloc(1, sizeof *program);

    program->cache = cache;
    program->shape_hash = source->shape_hash;
    program->map_text = memory_text(source->map_text);
    program->surface_text = memory_text(source->surface_text);
    program->number_count = source->number_count;
    program->map_count = source->map_count;
    program->user_shaders = source->user_shaders;
    program->refs = 1;
    pthread_mutex_lock(&cache->lock);
    program->last_use = ++cache->uses;
    program->next = cache->first;
    cache->first = program;
    pthread_cond_broadcast(&cache->work);
    pthread_mutex_unlock(&cache->lock);
    return program;
}

struct program *program_ref(struct program *program)
{
    pthread_mutex_lock(&program->cache->lock);
    program->refs++;
    pthread_mutex_unlock(&program->cache->lock);
    return program;
}

void program_unref(struct program_cache *cache, struct program *program)
{
    if (!program) {
        return;
    }
    pthread_mutex_lock(&cache->lock);
    if (--program->refs == 0) {
        evict(cache);
    }
    pthread_mutex_unlock(&cache->lock);
}

enum program_state program_state(const struct program *program)
{
    enum program_state state;

    pthread_mutex_lock(&program->cache->lock);
    state = program->state;
    pthread_mutex_unlock(&program->cache->lock);
    return state;
}

const struct error *program_error(const struct program *program)
{
    return &program->error;
}

const struct pass *program_pass(const struct program *program, enum program_stage stage)
{
    return &program->passes[stage];
}

static bool is_pending(const struct program_cache *cache)
{
    for (const struct program *p = cache->first; p; p = p->next) {
        if (p->state == PROGRAM_PENDING && p->refs > 0) {
            return true;
        }
    }
    return false;
}

bool program_cache_wait(struct program_cache *cache, int wait_ms)
{
    struct timespec until;
    bool news;

    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_sec += wait_ms / 1000;
    until.tv_nsec += (long)(wait_ms % 1000) * 1000000;
    if (until.tv_nsec >= 1000000000) {
        until.tv_sec++;
        until.tv_nsec -= 1000000000;
    }
    pthread_mutex_lock(&cache->lock);
    while (wait_ms > 0 && cache->finished == cache->finished_seen && is_pending(cache) &&
           pthread_cond_timedwait(&cache->done, &cache->lock, &until) == 0) {
    }
    news = cache->finished != cache->finished_seen;
    cache->finished_seen = cache->finished;
    pthread_mutex_unlock(&cache->lock);
    return news;
}

uint64_t program_cache_compilations(struct program_cache *cache)
{
    uint64_t count;

    pthread_mutex_lock(&cache->lock);
    count = cache->compilations;
    pthread_mutex_unlock(&cache->lock);
    return count;
}
