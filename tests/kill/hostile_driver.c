/* SPDX-License-Identifier: MIT */
/* A driver that hangs, crashes, eats memory or takes long over some shaders, a libpng that does so
 * over some pictures, and a cJSON that does so over some documents: loaded into the daemon in front
 * of the real ones (LD_PRELOAD), so that the program under test is the one that users run. What it
 * does is chosen by numbers in the shader's text. It takes time of the processor, so that a busy
 * machine changes nothing; while it hangs, the processor clock of its thread runs HANG_RATE times
 * as fast, so that little of it is burnt.
 *
 * HANG_ONCE and the like hang in the first so many processes that come so far: they write their
 * numbers into the file HOSTILE_COUNT. */
#include <EGL/egl.h>
#include <GL/glcorearb.h>
#include <cjson/cJSON.h>
#include <dlfcn.h>
#include <png.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum act {
    NOTHING,
    HANG,
    CRASH,
    EAT,
    CRASH_LATER,
    HANG_ONCE,
    HANG_TWICE,
    SLEEP,
    DRAW_SLOWLY,
    DRAW_HARDLY,
    DRAW_HARDLY_LATE,
    DRAW_AT_LENGTH,
    SLEEP_LATER
};

static const struct {
    const char *number;
    enum act act;
} acts[] = {{"31337.5", HANG},
            {"31338.5", CRASH},
            {"31339.5", EAT},
            {"31340.5", CRASH_LATER},
            {"31341.5", HANG_ONCE},
            {"31342.5", HANG_TWICE},
            {"31343.5", SLEEP},
            {"31344.5", DRAW_SLOWLY},
            {"31345.5", DRAW_HARDLY},
            {"31346.5", SLEEP_LATER},
            {"31347.5", DRAW_HARDLY_LATE},
            {"31348.5", DRAW_AT_LENGTH}};

/* What 8 x 8 pixels take in each pass. */
static const int group_times_ms[] = {[DRAW_SLOWLY] = 10,
                                     [DRAW_HARDLY] = 250,
                                     [DRAW_HARDLY_LATE] = 250,
                                     [DRAW_AT_LENGTH] = 500,
                                     [SLEEP_LATER] = 0};

/* Pictures of environments, by their width. */
static const struct {
    png_uint_32 width;
    enum act act;
} pictures[] = {{33, CRASH}, {35, HANG_ONCE}};

enum {
    OBJECTS = 4096,
    EAT_BYTES = 1 << 20,
    LATE_MS = 1000, /* of compiling */
    HANG_RATE = 10,
    NS = 1000000000
};

static PFNGLSHADERSOURCEPROC real_source;
static PFNGLATTACHSHADERPROC real_attach;
static PFNGLUSEPROGRAMPROC real_use;
static PFNGLDISPATCHCOMPUTEPROC real_dispatch;
static pthread_t later[OBJECTS];   /* by shader or program: who may use it */
static char is_later[OBJECTS];     /* enum act */
static _Thread_local int group_ms; /* of the program in use */

/* Of the first thread that hangs. */
static struct {
    clockid_t clock;
    int64_t begun_ns;
} hung;
static atomic_flag one_hangs = ATOMIC_FLAG_INIT;
static atomic_bool is_hung;

static int64_t ns_of(const struct timespec *t)
{
    return (int64_t)t->tv_sec * NS + t->tv_nsec;
}

static int real_gettime(clockid_t clock, struct timespec *out)
{
    static int (*real)(clockid_t, struct timespec *);

    if (!real) {
        real = (int (*)(clockid_t, struct timespec *))dlsym(RTLD_NEXT, "clock_gettime");
    }
    return real(clock, out);
}

int clock_gettime(clockid_t clock, struct timespec *out)
{
    const int result = real_gettime(clock, out);

    if (result == 0 && atomic_load(&is_hung) && clock == hung.clock) {
        const int64_t ns = hung.begun_ns + HANG_RATE * (ns_of(out) - hung.begun_ns);

        *out = (struct timespec){ns / NS, ns % NS};
    }
    return result;
}

static void hang(void)
{
    struct timespec now;

    if (!atomic_flag_test_and_set(&one_hangs)) {
        pthread_getcpuclockid(pthread_self(), &hung.clock);
        real_gettime(hung.clock, &now);
        hung.begun_ns = ns_of(&now);
        atomic_store(&is_hung, true);
    }
    for (volatile int i = 0;; i++) {
    }
}

/* Not by malloc: that of the sanitizers takes seconds to say that there is no more. */
static void eat(void)
{
    for (;;) {
        void *block =
            mmap(NULL, EAT_BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (block == MAP_FAILED) {
            abort();
        }
        memset(block, 1, EAT_BYTES);
    }
}

/* How many processes have been here before this one. Threads that compile at the same time are one
 * process. */
static int processes_before(void)
{
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    const char *path = getenv("HOSTILE_COUNT");
    int count = 0, pid = 0;

    pthread_mutex_lock(&one_at_a_time);
    FILE *file = path ? fopen(path, "a+") : NULL;
    if (!file) {
        abort();
    }
    rewind(file);
    while (fscanf(file, "%d", &pid) == 1 && pid != getpid()) {
        count++;
    }
    if (pid != getpid()) {
        fprintf(file, "%d\n", (int)getpid());
    }
    fclose(file);
    pthread_mutex_unlock(&one_at_a_time);
    return count;
}

static void spend(int ms)
{
    struct timespec begun, now;

    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begun);
    do {
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    } while ((now.tv_sec - begun.tv_sec) * 1000 + (now.tv_nsec - begun.tv_nsec) / 1000000 < ms);
}

static enum act act_of(GLsizei count, const GLchar *const *strings)
{
    for (GLsizei i = 0; i < count; i++) {
        for (size_t k = 0; k < sizeof acts / sizeof acts[0]; k++) {
            if (strstr(strings[i], acts[k].number)) {
                return acts[k].act;
            }
        }
    }
    return NOTHING;
}

static void APIENTRY source(GLuint shader, GLsizei count, const GLchar *const *strings,
                            const GLint *lengths)
{
    const enum act act = act_of(count, strings);

    switch (act) {
    case HANG:
        hang();
        break;
    case HANG_ONCE:
        if (processes_before() < 1) {
            hang();
        }
        break;
    case HANG_TWICE:
        if (processes_before() < 2) {
            hang();
        }
        break;
    case SLEEP:
        pause();
        break;
    case DRAW_HARDLY_LATE:
        spend(LATE_MS);
        break;
    case CRASH:
        __builtin_trap();
    case EAT:
        eat();
        break;
    case CRASH_LATER:
    case DRAW_SLOWLY:
    case DRAW_HARDLY:
    case DRAW_AT_LENGTH:
    case SLEEP_LATER:
    case NOTHING:
        break;
    }
    is_later[shader % OBJECTS] = (char)act;
    later[shader % OBJECTS] = pthread_self();
    real_source(shader, count, strings, lengths);
}

static void APIENTRY attach(GLuint program, GLuint shader)
{
    is_later[program % OBJECTS] = is_later[shader % OBJECTS];
    later[program % OBJECTS] = later[shader % OBJECTS];
    real_attach(program, shader);
}

/* The thread that compiled it may warm it up; drawing is another thread's. */
static void APIENTRY use(GLuint program)
{
    const bool elsewhere = !pthread_equal(later[program % OBJECTS], pthread_self());

    if (is_later[program % OBJECTS] == CRASH_LATER && elsewhere) {
        __builtin_trap();
    }
    if (is_later[program % OBJECTS] == SLEEP_LATER && elsewhere) {
        pause();
    }
    group_ms = elsewhere ? group_times_ms[(int)is_later[program % OBJECTS]] : 0;
    real_use(program);
}

static void APIENTRY dispatch(GLuint x, GLuint y, GLuint z)
{
    if (group_ms > 0) {
        spend(group_ms * (int)(x * y * z));
    }
    real_dispatch(x, y, z);
}

void png_read_info(png_structrp png, png_inforp info)
{
    void (*real)(png_structrp, png_inforp) = dlsym(RTLD_NEXT, "png_read_info");

    real(png, info);
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; i++) {
        if (png_get_image_width(png, info) != pictures[i].width) {
            continue;
        }
        if (pictures[i].act == CRASH) {
            __builtin_trap();
        }
        if (processes_before() < 1) {
            hang();
        }
    }
}

static bool holds(const char *text, size_t length, const char *word)
{
    return memmem(text, length, word, strlen(word));
}

/* The render process alone reads documents with it. */
cJSON *cJSON_ParseWithLength(const char *text, size_t length)
{
    cJSON *(*real)(const char *, size_t) =
        (cJSON * (*)(const char *, size_t)) dlsym(RTLD_NEXT, "cJSON_ParseWithLength");

    if (holds(text, length, "crash-while-read")) {
        __builtin_trap();
    }
    if (holds(text, length, "hang-while-read")) {
        hang();
    }
    return real(text, length);
}

typedef __eglMustCastToProperFunctionPointerType function;

__eglMustCastToProperFunctionPointerType EGLAPIENTRY eglGetProcAddress(const char *name)
{
    static function (*real)(const char *);

    if (!real) {
        real = (function(*)(const char *))dlsym(RTLD_NEXT, "eglGetProcAddress");
    }
    if (strcmp(name, "glShaderSource") == 0) {
        real_source = (PFNGLSHADERSOURCEPROC)real(name);
        return (function)source;
    }
    if (strcmp(name, "glAttachShader") == 0) {
        real_attach = (PFNGLATTACHSHADERPROC)real(name);
        return (function)attach;
    }
    if (strcmp(name, "glUseProgram") == 0) {
        real_use = (PFNGLUSEPROGRAMPROC)real(name);
        return (function)use;
    }
    if (strcmp(name, "glDispatchCompute") == 0) {
        real_dispatch = (PFNGLDISPATCHCOMPUTEPROC)real(name);
        return (function)dispatch;
    }
    return real(name);
}
