/* SPDX-License-Identifier: MIT */
/* The cache; the threads that fill it are in program_compile.c. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "program_internal.h"
#include "protocol/limits.h"
#include "protocol/memory.h"

static int64_t now_ms(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

struct program_cache *program_cache_create(struct egl *egl, const struct gl *gl,
                                           const struct gl_sink *sink, int code_ms)
{
    struct program_cache *cache = memory_alloc(1, sizeof *cache);
    pthread_condattr_t clock;

    cache->egl = egl;
    cache->gl = gl;
    cache->sink = sink;
    cache->code_ms = code_ms > 0 ? code_ms : LIMIT_COMPILE_CODE_MS;
    pthread_mutex_init(&cache->lock, NULL);
    pthread_cond_init(&cache->work, NULL);
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_cond_init(&cache->done, &clock);
    pthread_condattr_destroy(&clock);
    return cache;
}

static void start_threads(struct program_cache *cache)
{
    for (int i = 0; i < EGL_COMPILERS; i++) {
        struct compiler *compiler = &cache->compilers[i];
        compiler->cache = cache;
        if (pthread_create(&compiler->thread, NULL, program_compile_main, compiler) != 0) {
            abort(); /* as where there is no memory */
        }
    }
    cache->has_threads = true;
}

bool program_cache_start(struct program_cache *cache, struct error *err)
{
    if (!cache->has_threads) {
        if (!egl_make_compilers(cache->egl, err)) {
            return false;
        }
        start_threads(cache);
    }
    pthread_mutex_lock(&cache->lock);
    while (cache->running < EGL_COMPILERS && !cache->stop) {
        pthread_cond_wait(&cache->done, &cache->lock);
    }
    const bool ok = !cache->stop;
    pthread_mutex_unlock(&cache->lock);
    if (!ok && err) {
        *err = cache->start_error;
    }
    return ok;
}

static void destroy_program(const struct gl *gl, struct program *program)
{
    for (int i = 0; i < PROGRAM_STAGES; i++) {
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
    for (int i = 0; i < EGL_COMPILERS && cache->has_threads; i++) {
        pthread_join(cache->compilers[i].thread, NULL);
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
            if (p->taken < p->stages || p->state == PROGRAM_FAILED) {
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

struct program *program_cache_find(struct program_cache *cache, uint64_t structure_hash)
{
    struct program *found = NULL;

    pthread_mutex_lock(&cache->lock);
    for (struct program *p = cache->first; p && !found; p = p->next) {
        if (p->structure_hash == structure_hash) {
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
    struct error err = {0};

    program->cache = cache;
    program->structure_hash = source->structure_hash;
    program->map_text = memory_text(source->map_text);
    program->surface_text = memory_text(source->surface_text);
    program->number_count = source->number_count;
    program->map_count = source->map_count;
    program->shape_count = source->shape_count;
    program->code_size = source->code_size;
    program->patience = source->patience > 0 ? source->patience : 1;
    program->user_shaders = source->user_shaders;
    program->user_code = source->user_code;
    program->volumes = source->volumes;
    program->fragment = source->fragment;
    program->tapes = source->tapes;
    program->first = source->fragment ? STAGE_STARTS : STAGE_MARCH;
    program->stages = source->fragment  ? PROGRAM_STAGES - STAGE_STARTS
                      : source->volumes ? STAGE_COUNT
                                        : STAGE_VOLUME;
    program->refs = 1;
    program->added_ms = now_ms();
    if (!program_cache_start(cache, &err)) {
        program_refuse(program, &err);
        program->state = PROGRAM_FAILED;
        program->taken = program->done = program->stages;
    }
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
        pthread_cond_broadcast(&cache->work); /* it may have been alone at work */
    }
    pthread_mutex_unlock(&cache->lock);
}

uint64_t program_structure_hash(const struct program *program)
{
    return program->structure_hash;
}

bool program_has_tapes(const struct program *program)
{
    return program->tapes;
}

bool program_is_fragment(const struct program *program)
{
    return program->fragment;
}

void program_set_time(struct program *program, enum program_way way, struct program_time time)
{
    program->times[way] = time;
}

struct program_time program_time(const struct program *program, enum program_way way)
{
    return program->times[way];
}

bool program_has_user_code(const struct program *program)
{
    return program->user_code;
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
