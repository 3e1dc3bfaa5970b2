/* SPDX-License-Identifier: MIT */
/* Which program is compiled next. */
#include "program_internal.h"
#include "protocol/limits.h"

enum {
    AT_ONE_MOST = EGL_COMPILERS - 1,
    /* All stages of one structure, and what LIMIT_COMPILED_SHAPES of them take more: measured with
     * llvmpipe without a cache. It grows with their square. */
    ONE_SHAPE_MS = 900,
    ALL_SHAPES_MS = 29000,
    ONE_CODE_MS = 450, /* of LIMIT_CODE_SIZE; as much again times how often that is there */
    /* A whole sample has march and material twice, the second time for light through transmissive
     * objects. One structure: 3.2 s, where compute shaders take 0.9 s. */
    FRAGMENT_TIMES = 4,
};

int64_t program_usual_ms(const struct program *program)
{
    const int64_t most = LIMIT_COMPILED_SHAPES, shapes = (int64_t)program->shape_count;
    const int64_t counted = shapes < most ? shapes : most;

    const int64_t whole = LIMIT_CODE_SIZE, code = (int64_t)program->code_size;

    return (program->fragment ? FRAGMENT_TIMES : 1) *
           (ONE_SHAPE_MS + ALL_SHAPES_MS * counted * counted / (most * most) +
            ONE_CODE_MS * code * (whole + code) / (whole * whole));
}

static bool is_waiting(const struct program *program)
{
    return program->taken < program->stages && program->refs > 0;
}

static int threads_at(const struct program *program)
{
    return program->taken - program->done;
}

static int64_t due_ms(const struct program *program)
{
    return program->added_ms + program_usual_ms(program);
}

static bool is_before(const struct program *a, const struct program *b)
{
    return threads_at(a) != threads_at(b) ? threads_at(a) < threads_at(b) : due_ms(a) < due_ms(b);
}

struct program *program_order_take(struct program_cache *cache, enum program_stage *out_stage)
{
    struct program *best = NULL;

    for (struct program *p = cache->first; p; p = p->next) {
        if (is_waiting(p) && (p->allowed || !p->user_code) && threads_at(p) < AT_ONE_MOST &&
            (!best || is_before(p, best))) {
            best = p;
        }
    }
    if (best) {
        *out_stage = (enum program_stage)((int)best->first + best->taken++);
        best->refs++;
    }
    return best;
}

/* With code of users, begun or to be begun. */
static bool is_under_way(const struct program *program)
{
    return program->allowed && (threads_at(program) > 0 || is_waiting(program));
}

static struct program *next_with_code(const struct program_cache *cache, bool *out_busy)
{
    struct program *best = NULL;

    for (struct program *p = cache->first; p; p = p->next) {
        if (is_under_way(p)) {
            *out_busy = true;
            return NULL;
        }
        if (p->user_code && !p->allowed && is_waiting(p) && (!best || is_before(p, best))) {
            best = p;
        }
    }
    *out_busy = false;
    return best;
}

struct program *program_cache_next(struct program_cache *cache, bool *out_busy)
{
    struct program *next;

    pthread_mutex_lock(&cache->lock);
    next = next_with_code(cache, out_busy);
    pthread_mutex_unlock(&cache->lock);
    return next;
}
