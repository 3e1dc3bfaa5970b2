/* SPDX-License-Identifier: MIT */
/* A driver that hangs, crashes or eats memory over some shaders: loaded into the daemon in front of
 * the real one (LD_PRELOAD), so that the program under test is the one that users run. What it does
 * is chosen by numbers in the shader's text. */
#include <EGL/egl.h>
#include <GL/glcorearb.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum act { NOTHING, HANG, CRASH, EAT, CRASH_LATER };

static const struct {
    const char *number;
    enum act act;
} acts[] = {{"31337.5", HANG}, {"31338.5", CRASH}, {"31339.5", EAT}, {"31340.5", CRASH_LATER}};

enum { OBJECTS = 4096, EAT_BYTES = 1 << 20 };

static PFNGLSHADERSOURCEPROC real_source;
static PFNGLATTACHSHADERPROC real_attach;
static PFNGLUSEPROGRAMPROC real_use;
static pthread_t later[OBJECTS]; /* by shader or program: who may use it */
static char is_later[OBJECTS];

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
    switch (act_of(count, strings)) {
    case HANG:
        for (volatile int i = 0;; i++) {
        }
    case CRASH:
        abort();
    case EAT:
        for (;;) {
            char *block = malloc(EAT_BYTES);
            if (!block) {
                abort();
            }
            memset(block, 1, EAT_BYTES);
        }
    case CRASH_LATER:
        is_later[shader % OBJECTS] = 1;
        later[shader % OBJECTS] = pthread_self();
        break;
    case NOTHING:
        is_later[shader % OBJECTS] = 0;
        break;
    }
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
    if (is_later[program % OBJECTS] && !pthread_equal(later[program % OBJECTS], pthread_self())) {
        abort();
    }
    real_use(program);
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
    return real(name);
}
