/* SPDX-License-Identifier: MIT */
/* The inside of struct renderer and struct resident, for the files of this layer that make them up:
 * renderer.c, resident.c, snapshot.c, job.c. */
#ifndef RENDERER_INTERNAL_H
#define RENDERER_INTERNAL_H

#include "renderer.h"
#include "renderer/draw/draw.h"
#include "renderer/draw/pace.h"
#include "renderer/draw/pictures.h"
#include "renderer/gl/egl.h"
#include "scene_bin.h"
#include "snapshot.h"

struct renderer {
    struct renderer_params params;
    struct renderer_info info;
    enum render_stage best;               /* what RENDER_AUTO is here */
    enum render_programs programs_wanted; /* never PROGRAMS_AUTO */
    struct gl_sink sink;
    struct egl egl;
    struct gl gl;
    struct draw *draw;
    struct environments *environments;
    struct asset *assets; /* a list */
    bool holds_assets;    /* see renderer_hold_assets */
    struct pictures *pictures;
    struct snapshot *waiting; /* for a picture; a list */
    struct trials trials;
    struct program_cache *programs;
    struct resident *residents; /* a list */
    struct scene_bin *bin;      /* of scenes that were theirs */
    struct renderer_counters counters;
    bool shared; /* see renderer_share */
    struct renderer_verdict *verdicts;
    size_t verdict_count;
    bool told_compile; /* on_compile was called with a structure, and not yet with 0 */
    bool told_read;    /* the same of on_read */
};

/* What RENDER_AUTO is before a trial: never compute shaders where the device has none. */
enum render_stage renderer_best_stage(const struct renderer_info *info);

enum { ISOLATIONS_KEPT = 8 }; /* of a scene; the least recently used go beyond this */

/* A scene with nodes isolated: of the same program as the scene itself. */
struct isolated_view {
    char *key;                 /* the ids, a line each; NULL: free */
    uint64_t renewals;         /* of the resident when `newest` was made */
    uint64_t last_use;         /* counts jobs */
    struct snapshot *newest;   /* NULL: not made yet */
    struct snapshot *drawable; /* the newest whose program is ready; NULL: none yet */
};

struct resident {
    struct renderer *renderer;
    struct resident *next;
    struct scene *scene;
    uint64_t revision;
    bool stale;                 /* the newest was made before edits of more than numbers */
    struct snapshot *newest;    /* NULL while the scene is no field */
    struct snapshot *drawable;  /* the newest whose program is ready; NULL: none yet */
    struct upload_pool uploads; /* of the newest's structure */
    struct error error;
    struct pace *pace;
    uint64_t refused_structure; /* why there is no newest, if that is it; else 0 */
    uint64_t renewals, uses;    /* counted */
    struct isolated_view isolated[ISOLATIONS_KEPT];
};

/* Of a structure, or with an id of a file; NULL: nothing is known of it. */
struct renderer_verdict *renderer_find_verdict(const struct renderer *renderer,
                                               uint64_t structure_hash, const char *image);

/* What a picture shows: the newest state, or unless that is asked for (`exact`) the newest that can
 * be drawn, by its program or by the engine meanwhile. Borrowed until the resident changes. NULL
 * and `err`: nothing. */
struct snapshot *resident_snapshot(struct resident *resident, const struct job_desc *desc,
                                   struct error *err);
void resident_forget_views(struct resident *resident);

void renderer_log(const struct renderer *renderer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
