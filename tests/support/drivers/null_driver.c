/* SPDX-License-Identifier: MIT */
/* A driver that compiles nothing and draws a slope of colours in no time: loaded into a program in
 * front of EGL (LD_PRELOAD), so that the program under test is the one that users run. For tests of
 * the server that look at no pixels.
 *
 * NULL_DRIVER_TILE_MS: so long takes each tile, asleep. What has no function of its own here does
 * nothing and answers 0, whatever its arguments: that is good on every ABI that Debian has. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BUFFERS = 4096, MAX_TEXTURE = 16384, MAX_BLOCK = 65536 };

typedef __eglMustCastToProperFunctionPointerType function;

/* Only buffers for pixels that are read back have bytes. */
static struct {
    unsigned char *bytes;
    size_t size;
} buffers[BUFFERS];
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static _Thread_local GLuint packed; /* the buffer for pixels that is bound */
static atomic_uint last_name;

/* --- EGL: one device --- */

EGLAPI const char *EGLAPIENTRY eglQueryString(EGLDisplay display, EGLint name)
{
    (void)name;
    return display == EGL_NO_DISPLAY ? "EGL_EXT_platform_device"
                                     : "EGL_KHR_surfaceless_context EGL_KHR_no_config_context";
}

static EGLBoolean EGLAPIENTRY query_devices(EGLint max, EGLDeviceEXT *devices, EGLint *count)
{
    static int device;

    if (max > 0) {
        devices[0] = &device;
    }
    *count = 1;
    return EGL_TRUE;
}

static const char *EGLAPIENTRY query_device(EGLDeviceEXT device, EGLint name)
{
    (void)device;
    (void)name;
    return "EGL_MESA_device_software";
}

EGLAPI EGLDisplay EGLAPIENTRY eglGetPlatformDisplay(EGLenum platform, void *device,
                                                    const EGLAttrib *attributes)
{
    (void)platform;
    (void)attributes;
    return device;
}

EGLAPI EGLBoolean EGLAPIENTRY eglInitialize(EGLDisplay display, EGLint *major, EGLint *minor)
{
    (void)display;
    (void)major;
    (void)minor;
    return EGL_TRUE;
}

EGLAPI EGLBoolean EGLAPIENTRY eglBindAPI(EGLenum api)
{
    (void)api;
    return EGL_TRUE;
}

EGLAPI EGLContext EGLAPIENTRY eglCreateContext(EGLDisplay display, EGLConfig config,
                                               EGLContext share, const EGLint *attributes)
{
    (void)config;
    (void)share;
    (void)attributes;
    return display;
}

EGLAPI EGLBoolean EGLAPIENTRY eglDestroyContext(EGLDisplay display, EGLContext context)
{
    (void)display;
    (void)context;
    return EGL_TRUE;
}

EGLAPI EGLBoolean EGLAPIENTRY eglMakeCurrent(EGLDisplay display, EGLSurface draw, EGLSurface read,
                                             EGLContext context)
{
    (void)display;
    (void)draw;
    (void)read;
    (void)context;
    return EGL_TRUE;
}

EGLAPI EGLint EGLAPIENTRY eglGetError(void)
{
    return EGL_SUCCESS;
}

/* --- OpenGL --- */

static GLenum APIENTRY nothing(void)
{
    return 0;
}

static const GLubyte *APIENTRY get_string(GLenum name)
{
    return (const GLubyte *)(name == GL_RENDERER ? "llvmpipe (draws nothing, for tests)"
                                                 : "4.5 (Core Profile) null");
}

static void APIENTRY get_integer(GLenum name, GLint *out)
{
    *out = name == GL_MAX_TEXTURE_SIZE ? MAX_TEXTURE : MAX_BLOCK;
}

static void APIENTRY is_well(GLuint object, GLenum name, GLint *out)
{
    (void)object;
    (void)name;
    *out = GL_TRUE;
}

static GLuint APIENTRY create(void)
{
    return ++last_name;
}

static GLuint APIENTRY create_shader(GLenum stage)
{
    (void)stage;
    return ++last_name;
}

static void APIENTRY generate(GLsizei count, GLuint *out)
{
    for (GLsizei i = 0; i < count; i++) {
        out[i] = ++last_name;
    }
}

static void APIENTRY bind_buffer(GLenum target, GLuint buffer)
{
    if (target == GL_PIXEL_PACK_BUFFER) {
        packed = buffer;
    }
}

static void resize(GLuint buffer, size_t size)
{
    pthread_mutex_lock(&lock);
    free(buffers[buffer % BUFFERS].bytes);
    buffers[buffer % BUFFERS].bytes = size > 0 ? calloc(1, size) : NULL;
    buffers[buffer % BUFFERS].size = size;
    pthread_mutex_unlock(&lock);
}

static void APIENTRY buffer_data(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
    (void)data;
    (void)usage;
    if (target == GL_PIXEL_PACK_BUFFER) {
        resize(packed, (size_t)size);
    }
}

static void APIENTRY delete_buffers(GLsizei count, const GLuint *names)
{
    for (GLsizei i = 0; i < count; i++) {
        if (names[i] > 0 && buffers[names[i] % BUFFERS].bytes) {
            resize(names[i], 0);
        }
    }
}

/* Brighter to the right; the same for all sizes of pixels. */
static void APIENTRY read_pixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum format,
                                 GLenum type, void *at)
{
    const size_t size = buffers[packed % BUFFERS].size;

    (void)x;
    (void)y;
    (void)width;
    (void)height;
    (void)format;
    (void)at;
    if (type == GL_UNSIGNED_BYTE) {
        for (size_t i = 0; i < size; i++) {
            buffers[packed % BUFFERS].bytes[i] = i % 4 == 3 ? 255 : (unsigned char)(i / 4);
        }
    }
}

static void *APIENTRY map_buffer(GLenum target, GLintptr offset, GLsizeiptr length,
                                 GLbitfield access)
{
    (void)target;
    (void)length;
    (void)access;
    return buffers[packed % BUFFERS].bytes + offset;
}

static GLboolean APIENTRY unmap_buffer(GLenum target)
{
    (void)target;
    return GL_TRUE;
}

static void APIENTRY get_buffer(GLenum target, GLintptr offset, GLsizeiptr size, void *out)
{
    (void)target;
    (void)offset;
    memset(out, 0, (size_t)size);
}

static GLenum APIENTRY framebuffer_status(GLenum target)
{
    (void)target;
    return GL_FRAMEBUFFER_COMPLETE;
}

static GLsync APIENTRY fence(GLenum condition, GLbitfield flags)
{
    (void)condition;
    (void)flags;
    return (GLsync)buffers;
}

/* A tile is finished. */
static GLenum APIENTRY wait_fence(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    const char *text = getenv("NULL_DRIVER_TILE_MS");
    const long ms = text ? strtol(text, NULL, 10) : 0;

    (void)sync;
    (void)flags;
    (void)timeout;
    if (ms > 0) {
        nanosleep(&(struct timespec){ms / 1000, ms % 1000 * 1000000}, NULL);
    }
    return GL_ALREADY_SIGNALED;
}

static const struct {
    const char *name;
    function call;
} functions[] = {
    {"eglQueryDevicesEXT", (function)query_devices},
    {"eglQueryDeviceStringEXT", (function)query_device},
    {"glGetString", (function)get_string},
    {"glGetIntegerv", (function)get_integer},
    {"glGetShaderiv", (function)is_well},
    {"glGetProgramiv", (function)is_well},
    {"glCreateProgram", (function)create},
    {"glCreateShader", (function)create_shader},
    {"glGenBuffers", (function)generate},
    {"glGenFramebuffers", (function)generate},
    {"glGenQueries", (function)generate},
    {"glGenTextures", (function)generate},
    {"glGenVertexArrays", (function)generate},
    {"glBindBuffer", (function)bind_buffer},
    {"glBufferData", (function)buffer_data},
    {"glDeleteBuffers", (function)delete_buffers},
    {"glReadPixels", (function)read_pixels},
    {"glMapBufferRange", (function)map_buffer},
    {"glUnmapBuffer", (function)unmap_buffer},
    {"glGetBufferSubData", (function)get_buffer},
    {"glCheckFramebufferStatus", (function)framebuffer_status},
    {"glFenceSync", (function)fence},
    {"glClientWaitSync", (function)wait_fence},
};

EGLAPI function EGLAPIENTRY eglGetProcAddress(const char *name)
{
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        if (strcmp(functions[i].name, name) == 0) {
            return functions[i].call;
        }
    }
    return (function)nothing;
}
