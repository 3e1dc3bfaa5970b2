/* SPDX-License-Identifier: MIT */
/* A headless OpenGL context on the best device: which one, and why not the others. */
#ifndef RENDERER_EGL_H
#define RENDERER_EGL_H

#include <EGL/egl.h>

#include "device.h"
#include "protocol/error.h"

enum { EGL_DEVICES_MAX = 32 };

enum { EGL_COMPILERS = 3 }; /* threads that compile, while another draws */

struct egl {
    EGLDisplay display;
    EGLContext draw, compile[EGL_COMPILERS]; /* sharing objects; one thread each */
    bool software;
    int version; /* of OpenGL that the contexts were made for, times ten */
    bool debug;
    bool robust; /* the contexts report resets */
    char device[192];
};

/* Opens the device that `params` asks for and makes the draw context current. Sets
 * MESA_SHADER_CACHE_DIR, so call it before other threads run. The debug output of the driver comes
 * only where `debug` is set. */
bool egl_init(struct egl *out_egl, const struct device_params *params, struct error *err);
void egl_finish(struct egl *egl);
/* Makes the compile contexts that are not there. egl_init does it for all but software, which draws
 * without them and takes long to make one. The draw context is current. */
bool egl_make_compilers(struct egl *egl, struct error *err);
/* Makes a context current in the calling thread; EGL_NO_CONTEXT releases it. */
bool egl_bind(const struct egl *egl, EGLContext context, struct error *err);
/* Tries every device as egl_init would; writes at most `max` rows, returns how many. */
size_t egl_report(const struct device_params *params, struct device_report *out, size_t max);
const char *egl_error_name(EGLint error);

#endif
