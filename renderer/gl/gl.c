/* SPDX-License-Identifier: MIT */
/* Function loading, debug output, error names. */
#include "gl.h"

#include <EGL/egl.h>
#include <stdio.h>

static bool is_43(const struct gl *gl)
{
    GLint major = 0, minor = 0;

    gl->GetIntegerv(GL_MAJOR_VERSION, &major);
    gl->GetIntegerv(GL_MINOR_VERSION, &minor);
    return major > 4 || (major == 4 && minor >= 3);
}

/* Functions above the context's version stay NULL: drivers give addresses of them all the same. */
bool gl_load(struct gl *out_gl, struct error *err)
{
    struct gl gl = {0};
    const char *missing = NULL;

#define X(upper, name)                                                                             \
    gl.name = (PFNGL##upper##PROC)eglGetProcAddress("gl" #name);                                   \
    if (!gl.name && !missing) {                                                                    \
        missing = "gl" #name;                                                                      \
    }
    GL_FUNCTIONS(X)
    gl.has_compute = !missing && is_43(&gl);
    if (gl.has_compute) {
        GL_COMPUTE_FUNCTIONS(X)
    }
#undef X
    if (missing) {
        return error_set(err, ERROR_UNAVAILABLE, "", "the OpenGL driver has no function %s",
                         missing);
    }
    gl.GetGraphicsResetStatus =
        (PFNGLGETGRAPHICSRESETSTATUSPROC)eglGetProcAddress("glGetGraphicsResetStatus");
    *out_gl = gl;
    return true;
}

static void APIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                GLsizei length, const GLchar *message, const void *data)
{
    const struct gl_sink *sink = data;
    char line[512];

    (void)source;
    (void)length;
    /* Compilers report through the info log as well; what is left are misuse and lack of memory. */
    if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) {
        return;
    }
    snprintf(line, sizeof line, "gl: %s (%u)", message, id);
    sink->log(sink->data, line);
}

void gl_debug(const struct gl *gl, const struct gl_sink *sink)
{
    if (sink->log && gl->has_compute) {
        gl->Enable(GL_DEBUG_OUTPUT);
        gl->DebugMessageCallback(on_message, sink);
    }
}

const char *gl_error_name(GLenum error)
{
    switch (error) {
    case GL_NO_ERROR:
        return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown GL error";
    }
}

bool gl_check(const struct gl *gl, const char *what, struct error *err)
{
    const GLenum error = gl->GetError();

    if (error == GL_NO_ERROR) {
        return true;
    }
    while (gl->GetError() != GL_NO_ERROR) {
        if (error == GL_CONTEXT_LOST) {
            break;
        }
    }
    return error_set(err, ERROR_INTERNAL, "", "%s: %s", what, gl_error_name(error));
}
