/* SPDX-License-Identifier: MIT */
/* Linked GL programs, one for each stage and structure of a field, kept by structure hash.
 *
 * Threads with contexts of their own compile, link and run one work group, because drivers do most
 * of their work at the first use. The drawing thread never waits for them. */
#ifndef RENDERER_PROGRAM_H
#define RENDERER_PROGRAM_H

#include <stdint.h>

#include "egl.h"
#include "pass.h"

enum { PROGRAMS_KEPT = 64 }; /* without a user, the least recently used go beyond this */

enum program_state { PROGRAM_PENDING, PROGRAM_READY, PROGRAM_FAILED };

/* What is compiled for each structure: glsl/NAME_pass.glsl. */
enum program_stage {
    STAGE_MARCH,
    STAGE_MATERIAL,
    STAGE_SHADOW,
    STAGE_VOLUME, /* only where there are volumes */
    STAGE_COUNT,  /* of compute shaders; those of fragment shaders: */
    STAGE_STARTS = STAGE_COUNT,
    STAGE_SAMPLE,
    PROGRAM_STAGES
};

/* "march", of march_pass.glsl. */
extern const char *const program_stage_names[PROGRAM_STAGES];

struct program; /* reference counted */
struct program_cache;

struct program_source {
    uint64_t structure_hash;
    char *map_text, *surface_text; /* of shader.h or vocabulary.h; copied */
    size_t number_count;           /* vec4s in the buffer; at least 1 */
    bool user_shaders;             /* USER_SHADERS is defined */
    bool user_code;                /* it waits for program_cache_allow */
    bool volumes;                  /* there may be some */
    bool fragment;                 /* fragment shaders are wanted, not compute shaders */
    bool tapes;                    /* an interpreter: numbers come from a texture */
    size_t shape_count;
    size_t code_size; /* of users' code, as field.h has it */
    size_t map_count; /* the first so many are those that the map reads */
    int patience;     /* times the usual bound on compiling; 0: once */
};

/* The GLSL of a stage as a GPU gets it, with all that it includes. Caller frees; NULL and `err`
 * where a file is missing. No GL. */
char *program_text(const struct program_source *source, enum program_stage stage,
                   struct error *err);

/* The compile contexts of `egl` belong to the cache until program_cache_destroy. */
struct program_cache *program_cache_create(struct egl *egl, const struct gl *gl,
                                           const struct gl_sink *sink, int code_ms);
/* Starts the threads that compile, where they do not run yet; the first program does it too, and
 * fails where this fails. The drawing thread's. */
bool program_cache_start(struct program_cache *cache, struct error *err);
void program_cache_destroy(struct program_cache *cache);

/* A new reference, or NULL where the structure is not known yet. */
struct program *program_cache_find(struct program_cache *cache, uint64_t structure_hash);
/* Starts compiling. A new reference. */
struct program *program_cache_add(struct program_cache *cache, const struct program_source *source);
/* The program with code of users that is to be compiled next: one at a time, beside those without.
 * NULL: none, or one is at work (`*out_busy`). Borrowed. */
struct program *program_cache_next(struct program_cache *cache, bool *out_busy);
/* Lets the compilers have it. */
void program_cache_allow(struct program_cache *cache, struct program *program);

/* A program whose compiler may never end. */
struct program_stuck {
    uint64_t structure_hash;
    bool still;                /* a deadlock; else it took too much */
    int measured_ms, limit_ms; /* of the processors, by all compilers together */
};
/* Whether there is one: it took more processor time than LIMIT_COMPILE_MS, with code of users than
 * `code_ms` of program_cache_create; and more than LIMIT_COMPILE_FACTOR times what its shapes
 * usually take on this machine; all that times its patience. Or it has been still for
 * LIMIT_COMPILE_STILL_MS (vigil.h). */
bool program_cache_stuck(struct program_cache *cache, struct program_stuck *out);
/* How slow this machine compiles, against the usual one; at least 1. Measured with programs without
 * code of users; `set`: as another process measured it. The drawing thread's. */
double program_cache_pace(struct program_cache *cache);
void program_cache_set_pace(struct program_cache *cache, double pace);
/* Processor time that the compilers have ever taken. */
int64_t program_cache_cpu_us(const struct program_cache *cache);
struct program *program_ref(struct program *program);
void program_unref(struct program_cache *cache, struct program *program);

uint64_t program_structure_hash(const struct program *program);
bool program_has_tapes(const struct program *program);
bool program_is_fragment(const struct program *program);
bool program_has_user_code(const struct program *program);
enum program_state program_state(const struct program *program);
/* Valid when failed. */
const struct error *program_error(const struct program *program);
/* Valid when ready. */
const struct pass *program_pass(const struct program *program, enum program_stage stage);

/* How long a picture takes by a program, and by the interpreter that could draw it instead. */
enum program_way { PROGRAM_COMPILED, PROGRAM_INTERPRETED, PROGRAM_WAYS };
struct program_time {
    uint64_t us;
    int pixels; /* of the picture; 0: nothing is known */
};
void program_set_time(struct program *program, enum program_way way, struct program_time time);
/* The drawing thread's, like the above. */
struct program_time program_time(const struct program *program, enum program_way way);

/* True when some program became ready or failed since the last call; waits at most that long for
 * it while there is something to wait for. */
bool program_cache_wait(struct program_cache *cache, int wait_ms);
uint64_t program_cache_compilations(struct program_cache *cache);

#endif
