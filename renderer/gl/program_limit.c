/* SPDX-License-Identifier: MIT */
/* How long compiling may take: time of the processors, against what as many shapes take without
 * code of users on this machine. Time on the wall counts only while a compiler is still. */
#include <math.h>
#include <time.h>
#include <unistd.h>

#include "program_internal.h"
#include "protocol/limits.h"

enum { LOOK_MS = 100 };
static const double PACE_MAX = 8; /* a machine slower than that is not believed */

static int64_t clock_in_ms(clockid_t clock)
{
    struct timespec t;

    clock_gettime(clock, &t);
    return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

static double pace_of(const struct program_cache *cache)
{
    double pace = 1; /* what comes from a cache of the driver says nothing */

    for (size_t i = 0; i < cache->pace_count && i < PROGRAM_PACES; i++) {
        pace = fmax(pace, cache->paces[i]);
    }
    return fmin(pace, PACE_MAX);
}

static void add_pace(struct program_cache *cache, double pace)
{
    cache->paces[cache->pace_count++ % PROGRAM_PACES] = pace;
}

double program_cache_pace(struct program_cache *cache)
{
    double pace;

    pthread_mutex_lock(&cache->lock);
    pace = pace_of(cache);
    pthread_mutex_unlock(&cache->lock);
    return pace;
}

void program_cache_set_pace(struct program_cache *cache, double pace)
{
    pthread_mutex_lock(&cache->lock);
    add_pace(cache, pace);
    pthread_mutex_unlock(&cache->lock);
}

static int64_t limit_ms(const struct program_cache *cache, const struct program *program)
{
    const double least = program->user_code ? cache->code_ms : LIMIT_COMPILE_MS;
    const double usual = LIMIT_COMPILE_FACTOR * (double)program_usual_ms(program) * pace_of(cache);

    return (int64_t)(fmax(least, usual) * program->patience);
}

void program_limit_begin(struct compiler *compiler)
{
    compiler->thread_id = gettid();
    compiler->begun_cpu_ms = clock_in_ms(CLOCK_THREAD_CPUTIME_ID);
    vigil_restart(&compiler->vigil);
}

void program_limit_end(struct program_cache *cache, struct program *program)
{
    const pid_t self = gettid();

    for (int i = 0; i < EGL_COMPILERS; i++) {
        if (cache->compilers[i].thread_id == self) {
            program->spent_ms +=
                clock_in_ms(CLOCK_THREAD_CPUTIME_ID) - cache->compilers[i].begun_cpu_ms;
        }
    }
    if (program->done + 1 == program->stages && !program->user_code &&
        program->error.kind == ERROR_NONE) {
        add_pace(cache, (double)program->spent_ms / (double)program_usual_ms(program));
    }
}

/* Of the compiler since it began with its stage. */
static int64_t stage_ms(const struct compiler *compiler)
{
    clockid_t clock;

    return pthread_getcpuclockid(compiler->thread, &clock) == 0
               ? clock_in_ms(clock) - compiler->begun_cpu_ms
               : 0;
}

/* By all compilers, for all stages so far. */
static int64_t program_ms(const struct program_cache *cache, const struct program *program)
{
    int64_t together = program->spent_ms;

    for (int i = 0; i < EGL_COMPILERS; i++) {
        const struct compiler *compiler = &cache->compilers[i];

        together += compiler->program == program ? stage_ms(compiler) : 0;
    }
    return together;
}

/* It waits for nothing that would come: nobody else is at work here who could bring it. */
static bool is_still(struct compiler *compiler, int64_t now_ms, bool others_run)
{
    const struct vigil_use use = {stage_ms(compiler), others_run};

    vigil_look(&compiler->vigil, now_ms, &use);
    return compiler->vigil.still_ms > LIMIT_COMPILE_STILL_MS;
}

static bool check(struct program_cache *cache, struct compiler *compiler, int64_t now_ms,
                  bool others_run, struct program_stuck *out)
{
    const struct program *program = compiler->program;
    const bool still = is_still(compiler, now_ms, others_run);
    const int64_t spent = program_ms(cache, program), most = limit_ms(cache, program);

    if (still || spent > most) {
        *out = (struct program_stuck){program->structure_hash, still, (int)spent, (int)most};
    }
    return still || spent > most;
}

bool program_cache_stuck(struct program_cache *cache, struct program_stuck *out)
{
    const int64_t now = clock_in_ms(CLOCK_MONOTONIC);
    struct vigil_use use = {0};
    bool stuck = false;

    if (now - cache->looked_ms < LOOK_MS) {
        return false;
    }
    cache->looked_ms = now;
    vigil_use_of(getpid(), gettid(), &use);
    pthread_mutex_lock(&cache->lock);
    for (int i = 0; i < EGL_COMPILERS && !stuck; i++) {
        struct compiler *compiler = &cache->compilers[i];

        stuck = compiler->program && check(cache, compiler, now, use.runnable, out);
    }
    pthread_mutex_unlock(&cache->lock);
    return stuck;
}

int64_t program_cache_cpu_us(const struct program_cache *cache)
{
    int64_t together = 0;

    for (int i = 0; i < EGL_COMPILERS && cache->has_threads; i++) {
        struct timespec t;
        clockid_t clock;

        if (pthread_getcpuclockid(cache->compilers[i].thread, &clock) == 0 &&
            clock_gettime(clock, &t) == 0) {
            together += (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
        }
    }
    return together;
}
