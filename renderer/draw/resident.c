/* SPDX-License-Identifier: MIT */
/* Scenes held ready: the newest state, and the newest that can be drawn. */
#include "context.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/edit.h"
#include "protocol/memory.h"

/* Takes over what has become drawable; true when that is something newer. */
static bool advance(struct resident *resident)
{
    struct renderer *renderer = resident->renderer;
    struct snapshot *newest = resident->newest;

    if (!newest || newest == resident->drawable) {
        return false;
    }
    switch (program_state(newest->program)) {
    case PROGRAM_PENDING:
        return false;
    case PROGRAM_FAILED:
        resident->error = *program_error(newest->program);
        return false;
    case PROGRAM_READY:
        snapshot_unref(renderer, resident->drawable);
        resident->drawable = snapshot_ref(newest);
        return true;
    }
    return false;
}

/* What is drawn, or is going to be: what stands in there and is hidden stays in it. */
static const struct field *drawn_field(const struct resident *resident)
{
    const struct snapshot *newest = resident->newest;

    if (resident->drawable) {
        return resident->drawable->field;
    }
    return newest && program_state(newest->program) != PROGRAM_FAILED ? newest->field : NULL;
}

void resident_renew(struct resident *resident)
{
    struct renderer *renderer = resident->renderer;
    const struct field_wish wish = {.drawn = drawn_field(resident)};
    struct error err = {0};
    uint64_t refused = 0;
    struct snapshot *snapshot =
        snapshot_create(renderer, resident->scene, resident->revision, &wish, &refused, &err);

    resident->renewals++;
    resident->error = err;
    resident->refused_shape = refused;
    snapshot_unref(renderer, resident->newest);
    resident->newest = snapshot;
    if (snapshot && snapshot->fewer_steps) {
        renderer_log(renderer,
                     "revision %llu: fewer steps than asked for, since the driver bounds "
                     "the loops of a shader",
                     (unsigned long long)resident->revision);
    }
    advance(resident);
}

struct resident *resident_create(struct renderer *renderer, struct scene *scene, uint64_t revision)
{
    struct resident *resident = memory_alloc(1, sizeof *resident);

    resident->renderer = renderer;
    resident->scene = scene;
    resident->revision = revision;
    resident->pace = pace_create();
    resident->next = renderer->residents;
    renderer->residents = resident;
    resident_renew(resident);
    return resident;
}

void resident_destroy(struct resident *resident)
{
    if (!resident) {
        return;
    }
    for (struct resident **at = &resident->renderer->residents; *at; at = &(*at)->next) {
        if (*at == resident) {
            *at = resident->next;
            break;
        }
    }
    snapshot_unref(resident->renderer, resident->newest);
    snapshot_unref(resident->renderer, resident->drawable);
    resident_forget_views(resident);
    scene_destroy(resident->scene);
    pace_unref(resident->pace);
    free(resident);
}

void resident_replace(struct resident *resident, struct scene *scene, uint64_t revision)
{
    scene_destroy(resident->scene);
    resident->scene = scene;
    resident->revision = revision;
    resident_renew(resident);
}

bool resident_edit(struct resident *resident, const cJSON *ops, uint64_t revision,
                   struct error *err)
{
    if (!edit_apply(resident->scene, ops, NULL, NULL, err)) {
        return false;
    }
    resident->revision = revision;
    resident_renew(resident);
    return true;
}

const struct scene *resident_scene(const struct resident *resident)
{
    return resident->scene;
}

uint64_t resident_shape_with_code(const struct resident *resident)
{
    return resident->newest ? snapshot_shape_with_code(resident->newest) : 0;
}

uint64_t resident_shape(const struct resident *resident)
{
    return resident->newest ? program_shape(resident->newest->program) : 0;
}

uint64_t resident_refused_shape(const struct resident *resident)
{
    return resident->refused_shape;
}

uint64_t resident_revision(const struct resident *resident)
{
    return resident->revision;
}

uint64_t resident_shown_revision(const struct resident *resident)
{
    return resident->drawable ? resident->drawable->revision : 0;
}

const struct error *resident_error(const struct resident *resident)
{
    return &resident->error;
}

const struct error *resident_warning(const struct resident *resident)
{
    static const struct error none;

    return resident->newest ? &resident->newest->warning : &none;
}

/* Lets the next program with code of users be compiled, once it is told. */
static void allow_next(struct renderer *renderer)
{
    const struct renderer_params *params = &renderer->params;
    bool busy;
    struct program *next = program_cache_next(renderer->programs, &busy);

    if (params->on_compile && (next || (renderer->told_compile && !busy))) {
        params->on_compile(params->on_compile_data, next ? program_shape(next) : 0);
        renderer->told_compile = next != NULL;
    }
    if (next) {
        program_cache_allow(renderer->programs, next);
    }
}

bool renderer_poll(struct renderer *renderer, int wait_ms)
{
    bool news = false;

    allow_next(renderer);
    if (program_cache_wait(renderer->programs, wait_ms)) {
        for (struct resident *r = renderer->residents; r; r = r->next) {
            news = advance(r) || news;
        }
        allow_next(renderer);
    }
    return news;
}
