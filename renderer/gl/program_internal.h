/* SPDX-License-Identifier: MIT */
/* The inside of the program cache, for program.c and program_compile.c. One lock guards list,
 * queue, states and counters; the threads hold it only between compilations. */
#ifndef RENDERER_PROGRAM_INTERNAL_H
#define RENDERER_PROGRAM_INTERNAL_H

#include <pthread.h>

#include "program.h"
#include "renderer/vigil.h"

enum { PROGRAM_PACES = 8 };

struct program {
    struct program_cache *cache;
    struct program *next; /* in the cache's list */
    uint64_t structure_hash;
    char *map_text, *surface_text;
    size_t number_count, map_count, shape_count, code_size;
    bool user_shaders, user_code, volumes, fragment, tapes;
    enum program_stage first; /* of its stages, */
    int stages;               /* and how many there are */
    bool allowed;             /* of those with user_code */
    int patience;             /* times the usual bound on compiling */
    int64_t spent_ms;         /* of the processors, by finished stages */
    int refs;
    uint64_t last_use;
    enum program_state state;
    int64_t added_ms; /* CLOCK_MONOTONIC */
    int taken, done;  /* stages that a thread took, and those finished or given up */
    struct pass passes[PROGRAM_STAGES];
    struct error error;
    struct program_time times[PROGRAM_WAYS];
};

/* A thread and the program that it compiles. */
struct compiler {
    pthread_t thread;
    struct program_cache *cache;
    const struct program *program; /* NULL: nothing */
    pid_t thread_id;
    int64_t begun_cpu_ms;
    struct vigil vigil; /* of this stage */
};

struct program_cache {
    struct egl *egl;
    const struct gl *gl;
    const struct gl_sink *sink;
    bool has_threads;
    struct compiler compilers[EGL_COMPILERS];
    int started, running; /* threads */
    bool stop;
    pthread_mutex_t lock;
    pthread_cond_t work, done;
    struct program *first;
    uint64_t uses, compilations, finished, finished_seen;
    struct error start_error;
    int code_ms;                 /* that code of users may take at least */
    double paces[PROGRAM_PACES]; /* a ring: time that was needed, against the usual */
    size_t pace_count;           /* ever */
    int64_t looked_ms;           /* when program_cache_stuck last looked */
};

/* program_order.c, under the lock: the stage to compile next, with a reference to its program, or
 * NULL. At most two threads compile one program, so that one is left for others. Programs without a
 * thread go first, ordered by the time of their addition plus their expected duration. Only one
 * program with users' code is compiled at a time, so that there is one suspect. */
struct program *program_order_take(struct program_cache *cache, enum program_stage *out_stage);
/* Processor time of all its stages: a rough number, for llvmpipe without a cache; program_limit.c
 * measures how this machine stands to it. */
int64_t program_usual_ms(const struct program *program);

/* program_limit.c: on the compiler's thread, under the lock, before and after a stage. */
void program_limit_begin(struct compiler *compiler);
void program_limit_end(struct program_cache *cache, struct program *program);

/* Its first error, which is told to the log. Under the lock, or before it is anybody's else. */
void program_refuse(struct program *program, const struct error *err);
/* The life of a compiling thread; `data` is its struct compiler. */
void *program_compile_main(void *data);

#endif
