/* SPDX-License-Identifier: MIT */
/* The inside of struct renderer and struct resident, for the files of this layer that make them up:
 * renderer.c, resident.c, snapshot.c, job.c. */
#ifndef RENDERER_CONTEXT_H
#define RENDERER_CONTEXT_H

#include "draw.h"
#include "renderer/gl/egl.h"
#include "snapshot.h"

struct renderer {
    struct renderer_params params;
    struct renderer_info info;
    struct gl_sink sink;
    struct egl egl;
    struct gl gl;
    struct draw *draw;
    struct environments *environments;
    struct asset *assets; /* a list */
    struct program_cache *programs;
    struct resident *residents; /* a list */
    struct renderer_counters counters;
    uint64_t *refused; /* shapes */
    size_t refused_count;
    bool told_compile; /* on_compile was called with a shape, and not yet with 0 */
};

struct resident {
    struct renderer *renderer;
    struct resident *next;
    struct scene *scene;
    uint64_t revision;
    struct snapshot *newest;   /* NULL while the scene is no field */
    struct snapshot *drawable; /* the newest whose program is ready; NULL: none yet */
    struct error error;
};

/* A snapshot of the scene as it is now becomes the newest. */
void resident_renew(struct resident *resident);

void renderer_log(const struct renderer *renderer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
