/* SPDX-License-Identifier: MIT */
/* Devices are tried one by one: opened, given a context, asked what they are. Names alone do not
 * tell: a device may be listed and yet fail, and software may answer in the place of a GPU. */
#include "egl.h"

#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* OpenGL times ten: with compute shaders, and what is needed at least. */
enum { GL_BEST = 43, GL_LEAST = 33 };

/* One way to a display: an EGL device, or the surfaceless platform of Mesa. */
struct candidate {
    EGLDeviceEXT device; /* EGL_NO_DEVICE_EXT: surfaceless */
    char name[192];
    bool software; /* says so itself, before it is opened */
};

const char *egl_error_name(EGLint error)
{
    static const struct {
        EGLint code;
        const char *name;
    } names[] = {
        {EGL_SUCCESS, "EGL_SUCCESS"},           {EGL_NOT_INITIALIZED, "EGL_NOT_INITIALIZED"},
        {EGL_BAD_ACCESS, "EGL_BAD_ACCESS"},     {EGL_BAD_ALLOC, "EGL_BAD_ALLOC"},
        {EGL_BAD_MATCH, "EGL_BAD_MATCH"},       {EGL_BAD_ATTRIBUTE, "EGL_BAD_ATTRIBUTE"},
        {EGL_BAD_CONFIG, "EGL_BAD_CONFIG"},     {EGL_BAD_CONTEXT, "EGL_BAD_CONTEXT"},
        {EGL_BAD_DISPLAY, "EGL_BAD_DISPLAY"},   {EGL_BAD_PARAMETER, "EGL_BAD_PARAMETER"},
        {EGL_CONTEXT_LOST, "EGL_CONTEXT_LOST"},
    };

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (names[i].code == error) {
            return names[i].name;
        }
    }
    return "an unknown EGL error";
}

static bool has_extension(const char *list, const char *name)
{
    const size_t length = strlen(name);

    for (const char *at = list; at && (at = strstr(at, name)); at += length) {
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) {
            return true;
        }
    }
    return false;
}

static bool egl_fail(struct error *err, const char *what)
{
    return error_set(err, ERROR_UNAVAILABLE, "", "%s: %s", what, egl_error_name(eglGetError()));
}

static void describe_device(EGLDeviceEXT device, int index, struct candidate *out)
{
    PFNEGLQUERYDEVICESTRINGEXTPROC query =
        (PFNEGLQUERYDEVICESTRINGEXTPROC)eglGetProcAddress("eglQueryDeviceStringEXT");
    const char *extensions = query ? query(device, EGL_EXTENSIONS) : NULL;
    const char *node = NULL;

    *out = (struct candidate){.device = device};
    out->software = has_extension(extensions, "EGL_MESA_device_software");
    if (query && has_extension(extensions, "EGL_EXT_device_drm_render_node")) {
        node = query(device, EGL_DRM_RENDER_NODE_FILE_EXT);
    }
    if (query && !node && has_extension(extensions, "EGL_EXT_device_drm")) {
        node = query(device, EGL_DRM_DEVICE_FILE_EXT);
    }
    snprintf(out->name, sizeof out->name, "EGL device %d%s", index,
             out->software ? " (software)" : "");
    if (node) {
        snprintf(out->name, sizeof out->name, "EGL device %d (%s)", index, node);
    }
}

/* Every device in the driver's order, then the surfaceless platform. */
static size_t list_candidates(struct candidate out[EGL_DEVICES_MAX + 1])
{
    const char *client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLQUERYDEVICESEXTPROC query =
        (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    EGLDeviceEXT devices[EGL_DEVICES_MAX];
    EGLint count = 0;
    size_t used = 0;

    if (query && has_extension(client, "EGL_EXT_platform_device") &&
        query(EGL_DEVICES_MAX, devices, &count)) {
        for (EGLint i = 0; i < count; i++) {
            describe_device(devices[i], i, &out[used++]);
        }
    }
    if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
        out[used++] =
            (struct candidate){.device = EGL_NO_DEVICE_EXT, .name = "EGL surfaceless platform"};
    }
    return used;
}

static EGLContext make_context(const struct egl *egl, EGLContext share)
{
    EGLint attributes[24];
    size_t n = 0;

    attributes[n++] = EGL_CONTEXT_MAJOR_VERSION;
    attributes[n++] = egl->version / 10;
    attributes[n++] = EGL_CONTEXT_MINOR_VERSION;
    attributes[n++] = egl->version % 10;
    attributes[n++] = EGL_CONTEXT_OPENGL_PROFILE_MASK;
    attributes[n++] = EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT;
    if (egl->debug) {
        attributes[n++] = EGL_CONTEXT_OPENGL_DEBUG;
        attributes[n++] = EGL_TRUE;
    }
    if (egl->robust) {
        attributes[n++] = EGL_CONTEXT_OPENGL_ROBUST_ACCESS;
        attributes[n++] = EGL_TRUE;
        attributes[n++] = EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY;
        attributes[n++] = EGL_LOSE_CONTEXT_ON_RESET;
    }
    attributes[n] = EGL_NONE;
    return eglCreateContext(egl->display, EGL_NO_CONFIG_KHR, share, attributes);
}

static EGLDisplay open_display(const struct candidate *candidate)
{
    return candidate->device == EGL_NO_DEVICE_EXT
               ? eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL)
               : eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, candidate->device, NULL);
}

static bool make_draw_context(struct egl *egl, struct error *err)
{
    static const struct {
        int version;
        bool robust;
    } wishes[] = {{GL_BEST, true}, {GL_BEST, false}, {GL_LEAST, true}, {GL_LEAST, false}};

    for (size_t i = 0; i < sizeof wishes / sizeof wishes[0]; i++) {
        egl->version = wishes[i].version;
        egl->robust = wishes[i].robust;
        egl->draw = make_context(egl, EGL_NO_CONTEXT);
        if (egl->draw != EGL_NO_CONTEXT) {
            return true;
        }
    }
    return error_set(err, ERROR_UNAVAILABLE, "",
                     "no OpenGL %d.%d core context (%s), which fieldcast needs", GL_LEAST / 10,
                     GL_LEAST % 10, egl_error_name(eglGetError()));
}

bool egl_make_compilers(struct egl *egl, struct error *err)
{
    for (int i = 0; i < EGL_COMPILERS; i++) {
        if (egl->compile[i] == EGL_NO_CONTEXT) {
            egl->compile[i] = make_context(egl, egl->draw);
        }
        if (egl->compile[i] == EGL_NO_CONTEXT) {
            return egl_fail(err, "no second context that shares objects");
        }
    }
    return true;
}

/* Renderers that draw on the CPU, by the names they give themselves. */
static bool is_software_name(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "SwiftShader", "swrast",
                                        "Software Rasterizer"};

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (strstr(renderer, names[i])) {
            return true;
        }
    }
    return false;
}

static bool identify(struct egl *egl, char *out_name, size_t size, struct error *err)
{
    PFNGLGETSTRINGPROC get = (PFNGLGETSTRINGPROC)eglGetProcAddress("glGetString");
    const char *name;

    if (!egl_bind(egl, egl->draw, err)) {
        return false;
    }
    name = get ? (const char *)get(GL_RENDERER) : NULL;
    if (!name) {
        return error_set(err, ERROR_UNAVAILABLE, "", "the driver does not tell its name");
    }
    egl->software = egl->software || is_software_name(name);
    snprintf(out_name, size, "%s", name);
    return true;
}

/* Opens one candidate fully; on success its draw context is current. */
static bool open_candidate(struct egl *egl, const struct candidate *candidate, bool debug,
                           char *out_name, size_t name_size, struct error *err)
{
    const char *extensions;

    *egl = (struct egl){.software = candidate->software, .debug = debug};
    snprintf(egl->device, sizeof egl->device, "%s", candidate->name);
    egl->display = open_display(candidate);
    if (egl->display == EGL_NO_DISPLAY) {
        return egl_fail(err, "no display");
    }
    if (!eglInitialize(egl->display, NULL, NULL)) {
        egl_fail(err, "cannot be initialised");
        egl->display = EGL_NO_DISPLAY;
        return false;
    }
    extensions = eglQueryString(egl->display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context") ||
        !has_extension(extensions, "EGL_KHR_no_config_context") || !eglBindAPI(EGL_OPENGL_API)) {
        error_set(err, ERROR_UNAVAILABLE, "",
                  "has no desktop OpenGL without a window (EGL_KHR_surfaceless_context, "
                  "EGL_KHR_no_config_context)");
        goto fail;
    }
    if (!make_draw_context(egl, err) || !identify(egl, out_name, name_size, err) ||
        (!egl->software && !egl_make_compilers(egl, err))) {
        goto fail;
    }
    return true;
fail:
    egl_finish(egl);
    return false;
}

/* What speaks against a working device, or NULL. */
static const char *objection(const struct egl *egl, int index, const struct device_params *params)
{
    if (params->index >= 0 && index != params->index) {
        return "works; another device was asked for by number";
    }
    if (params->kind == DEVICE_GPU && egl->software) {
        return "works, but it is software and a GPU was asked for";
    }
    if (params->kind == DEVICE_SOFTWARE && !egl->software) {
        return "works, but it is a GPU and software was asked for";
    }
    return NULL;
}

/* Where drivers keep compiled shaders: Mesa's name and NVIDIA's, whose cache is off for root. */
static void prepare_environment(const struct device_params *params)
{
    if (params->cache_dir) {
        setenv("MESA_SHADER_CACHE_DIR", params->cache_dir, 1);
        setenv("__GL_SHADER_DISK_CACHE", "1", 1);
        setenv("__GL_SHADER_DISK_CACHE_PATH", params->cache_dir, 1);
    }
}

static int rank(const struct egl *egl)
{
    return (egl->software ? 0 : 2) + (egl->version == GL_BEST);
}

/* GPUs first, and those with compute shaders before others, in the driver's order; the best stays
 * open in `*out`. Rows may be NULL. */
static bool choose(struct egl *out, const struct device_params *params, struct device_report *rows,
                   size_t max_rows, size_t *out_count)
{
    struct candidate candidates[EGL_DEVICES_MAX + 1];
    const size_t count = list_candidates(candidates);
    struct egl best = {0};
    size_t chosen = 0;
    bool found = false;

    for (size_t i = 0; i < count; i++) {
        struct device_report row = {.software = candidates[i].software};
        struct error err = {0};
        struct egl egl;
        char name[128] = "";
        const char *why;

        snprintf(row.name, sizeof row.name, "%s", candidates[i].name);
        if (!open_candidate(&egl, &candidates[i], params->debug, name, sizeof name, &err)) {
            snprintf(row.verdict, sizeof row.verdict, "%.190s", err.message);
        } else {
            row.usable = true;
            row.software = egl.software;
            why = objection(&egl, (int)i, params);
            if (!why && found && rank(&egl) <= rank(&best)) {
                why = "works; an earlier device is as good";
            }
            snprintf(row.verdict, sizeof row.verdict, "%.90s%s: %s", name,
                     egl.version == GL_BEST ? "" : " (without compute shaders)",
                     why ? why : "works");
            if (why) {
                egl_finish(&egl);
            } else {
                egl_finish(&best);
                best = egl;
                chosen = i;
                found = true;
            }
        }
        if (i < max_rows) {
            rows[i] = row;
        }
    }
    if (found && chosen < max_rows) {
        rows[chosen].chosen = true;
    }
    *out_count = count;
    *out = best;
    return found;
}

static bool refuse(const struct device_params *params, const struct device_report *rows,
                   size_t count, struct error *err)
{
    const char *asked = params->kind == DEVICE_GPU        ? "a GPU was asked for, but "
                        : params->kind == DEVICE_SOFTWARE ? "software was asked for, but "
                                                          : "";
    size_t length;

    if (count == 0) {
        return error_set(err, ERROR_UNAVAILABLE, "",
                         "%sEGL lists no device: is a driver installed (on Debian libgl1-mesa-dri "
                         "and libegl-mesa0)?",
                         asked);
    }
    error_set(err, ERROR_UNAVAILABLE, "", "%sno device serves:", asked);
    for (size_t i = 0; err && i < count; i++) {
        length = strlen(err->message);
        snprintf(err->message + length, sizeof err->message - length, "%s %s: %.90s", i ? ";" : "",
                 rows[i].name, rows[i].verdict);
    }
    return false;
}

bool egl_init(struct egl *out_egl, const struct device_params *params, struct error *err)
{
    struct device_report rows[EGL_DEVICES_MAX + 1];
    size_t count = 0;

    prepare_environment(params);
    if (!choose(out_egl, params, rows, EGL_DEVICES_MAX + 1, &count)) {
        return refuse(params, rows, count, err);
    }
    if (!egl_bind(out_egl, out_egl->draw, err)) {
        egl_finish(out_egl);
        return false;
    }
    return true;
}

void egl_finish(struct egl *egl)
{
    if (egl->display == EGL_NO_DISPLAY) {
        return;
    }
    eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    for (int i = 0; i < EGL_COMPILERS; i++) {
        if (egl->compile[i] != EGL_NO_CONTEXT) {
            eglDestroyContext(egl->display, egl->compile[i]);
        }
    }
    if (egl->draw != EGL_NO_CONTEXT) {
        eglDestroyContext(egl->display, egl->draw);
    }
    /* The display stays initialised: EGL hands out one display per device for the whole process,
     * and terminating it would end other renderers on the same device. */
    *egl = (struct egl){0};
}

bool egl_bind(const struct egl *egl, EGLContext context, struct error *err)
{
    if (!eglMakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return egl_fail(err, "the OpenGL context cannot be made current");
    }
    return true;
}

size_t egl_report(const struct device_params *params, struct device_report *out, size_t max)
{
    struct egl egl;
    size_t count;

    prepare_environment(params);
    if (choose(&egl, params, out, max, &count)) {
        egl_finish(&egl);
    }
    return count < max ? count : max;
}
