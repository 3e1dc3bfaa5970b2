/* SPDX-License-Identifier: MIT */
/* The inside of the program cache, for program.c and program_compile.c. One lock guards list,
 * queue, states and counters; the threads hold it only between compilations. */
#ifndef RENDERER_PROGRAM_PARTS_H
#define RENDERER_PROGRAM_PARTS_H

#include <pthread.h>

#include "program.h"

struct program {
    struct program_cache *cache;
    struct program *next; /* in the cache's list */
    uint64_t shape_hash;
    char *map_text, *surface_text;
    size_t number_count, map_count, shape_count;
    bool user_shaders, user_code;
    int stages;   /* how many there are */
    bool allowed; /* of those with user_code */
    int refs;
    uint64_t last_use;
    enum program_state state;
    int taken, done; /* stages that a thread took, and those finished or given up */
    struct pass passes[STAGE_COUNT];
    struct pass from_camera; /* belongs to the drawing thread */
    struct error error;
};

/* A thread and what it is at. */
struct compiler {
    pthread_t thread;
    struct program_cache *cache;
    const struct program *program; /* NULL: nothing */
    int64_t begun_ms, begun_cpu_ms;
};

struct program_cache {
    const struct egl *egl;
    const struct gl *gl;
    const struct gl_sink *sink;
    struct compiler compilers[EGL_COMPILERS];
    int started, running; /* threads */
    bool stop;
    pthread_mutex_t lock;
    pthread_cond_t work, done;
    struct program *first;
    uint64_t uses, compilations, finished, finished_seen;
    struct error start_error;
};

/* The life of a compiling thread; `data` is its struct compiler. */
void *program_compile_main(void *data);

#endif
