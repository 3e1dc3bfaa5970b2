/* SPDX-License-Identifier: MIT */
/* Scenes held ready: the newest state, and the newest that can be drawn. */
#include "renderer_internal.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/edit.h"
#include "protocol/memory.h"

enum {
    READ_POLL_MS = 5,
    TRIAL_US = 1000, /* between two steps of pictures */
};

/* Takes over what has become drawable; true when that is something newer. */
static bool advance(struct resident *resident)
{
    struct renderer *renderer = resident->renderer;
    struct snapshot *newest = resident->newest;

    if (!newest || newest == resident->drawable) {
        return false;
    }
    switch (snapshot_state(newest)) {
    case PROGRAM_PENDING:
        return false;
    case PROGRAM_FAILED:
        resident->error = *snapshot_error(newest);
        return false;
    case PROGRAM_READY:
        snapshot_unref(renderer, resident->drawable);
        resident->drawable = snapshot_ref(newest);
        return true;
    }
    return false;
}

struct field *resident_drawn_field(const struct resident *resident)
{
    const struct snapshot *newest = resident->newest;

    if (resident->drawable) {
        return resident->drawable->geometry.field;
    }
    return newest && snapshot_state(newest) != PROGRAM_FAILED && trial_is_over(newest->trial)
               ? newest->geometry.field
               : NULL;
}

/* Takes the newest snapshot; NULL: the scene cannot be drawn, for `err` or a refused structure. */
static void take_newest(struct resident *resident, struct snapshot *snapshot,
                        const struct error *err, uint64_t refused)
{
    struct renderer *renderer = resident->renderer;

    resident->renewals++;
    resident->error = *err;
    resident->refused_structure = refused;
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

static struct field *make_field(const struct scene *scene, const struct field *drawn,
                                struct error *err)
{
    return snapshot_field(scene, &(struct field_options){.drawn = drawn, .patchable = true}, err);
}

/* Takes the field; NULL: the scene is none, for `why`. */
static void take_field(struct resident *resident, struct field *field, const struct error *why)
{
    struct error err = *why;
    uint64_t refused = 0;

    resident->stale = false;
    struct snapshot *snapshot =
        field ? snapshot_create(resident->renderer, resident->scene, resident->revision, NULL,
                                upload_create(field), &refused, &err)
              : NULL;

    upload_pool_empty(&resident->uploads, &resident->renderer->gl);
    take_newest(resident, snapshot, &err, refused);
}

void resident_renew(struct resident *resident)
{
    struct error err = {0};
    struct field *field = make_field(resident->scene, resident_drawn_field(resident), &err);

    take_field(resident, field, &err);
}

/* False: the edit changes more than numbers, or there is nothing to patch. */
static bool patch(struct resident *resident, const cJSON *ops)
{
    struct renderer *renderer = resident->renderer;
    struct snapshot *newest = resident->newest;
    struct error err = {0};
    uint64_t refused = 0;

    if (!newest || snapshot_state(newest) == PROGRAM_FAILED) {
        return false;
    }
    struct upload *upload =
        upload_patch(newest->upload, upload_pool_spare(&resident->uploads), resident->scene, ops);
    if (!upload) {
        return false;
    }
    if (upload != newest->upload) {
        upload_pool_keep(&resident->uploads, upload, &renderer->gl);
    }
    struct snapshot *snapshot = snapshot_create(renderer, resident->scene, resident->revision,
                                                newest, upload, &refused, &err);
    take_newest(resident, snapshot, &err, refused);
    return true;
}

struct opened_scene opened_scene_make(struct scene *scene, const struct field *drawn)
{
    struct opened_scene opened = {.scene = scene};

    opened.field = make_field(scene, drawn, &opened.error);
    return opened;
}

struct resident *resident_create_opened(struct renderer *renderer,
                                        const struct opened_scene *opened, uint64_t revision)
{
    struct resident *resident = memory_alloc(1, sizeof *resident);

    resident->renderer = renderer;
    resident->scene = opened->scene;
    resident->revision = revision;
    resident->pace = pace_create();
    resident->next = renderer->residents;
    renderer->residents = resident;
    take_field(resident, opened->field, &opened->error);
    return resident;
}

struct resident *resident_create(struct renderer *renderer, struct scene *scene, uint64_t revision)
{
    const struct opened_scene opened = opened_scene_make(scene, NULL);

    return resident_create_opened(renderer, &opened, revision);
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
    upload_pool_empty(&resident->uploads, &resident->renderer->gl);
    scene_bin_take(resident->renderer->bin, resident->scene);
    pace_unref(resident->pace);
    free(resident);
}

void resident_replace_opened(struct resident *resident, const struct opened_scene *opened,
                             uint64_t revision)
{
    if (resident->scene != opened->scene) {
        scene_bin_take(resident->renderer->bin, resident->scene);
    }
    resident->scene = opened->scene;
    resident->revision = revision;
    take_field(resident, opened->field, &opened->error);
}

void resident_replace(struct resident *resident, struct scene *scene, uint64_t revision)
{
    const struct opened_scene opened = opened_scene_make(scene, resident_drawn_field(resident));

    resident_replace_opened(resident, &opened, revision);
}

bool resident_apply(struct resident *resident, const cJSON *ops, uint64_t revision,
                    struct error *err)
{
    if (!edit_apply(resident->scene, ops, NULL, NULL, err)) {
        if (resident->newest) {
            field_end_patches(resident->newest->geometry.field);
        }
        return false;
    }
    resident->revision = revision;
    resident->stale = !patch(resident, ops); /* nor can what comes after it be patched */
    return true;
}

bool resident_is_stale(const struct resident *resident)
{
    return resident->stale;
}

bool resident_edit(struct resident *resident, const cJSON *ops, uint64_t revision,
                   struct error *err)
{
    if (!resident_apply(resident, ops, revision, err)) {
        return false;
    }
    if (resident->stale) {
        resident_renew(resident);
    }
    return true;
}

const struct scene *resident_scene(const struct resident *resident)
{
    return resident->scene;
}

uint64_t resident_structure_with_code(const struct resident *resident)
{
    return resident->newest ? snapshot_structure_with_code(resident->newest) : 0;
}

uint64_t resident_structure_hash(const struct resident *resident)
{
    return resident->newest ? resident->newest->structure_hash : 0;
}

uint64_t resident_refused_structure(const struct resident *resident)
{
    return resident->refused_structure;
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

struct warning resident_warning(const struct resident *resident)
{
    return resident->newest ? snapshot_warning(resident->newest) : (struct warning){0};
}

/* A picture that ended a process is tried again alone, so that it is known what ends this one. */
static bool is_tried_again(const struct renderer *renderer, const struct picture *picture)
{
    const struct renderer_verdict *verdict =
        picture ? renderer_find_verdict(renderer, 0, picture_id(picture)) : NULL;

    return verdict && verdict->times > 1;
}

/* Lets the next program with code of users be compiled, once it is told. */
static void allow_next(struct renderer *renderer)
{
    const struct renderer_params *params = &renderer->params;
    struct picture *reading;
    bool busy;
    struct program *next = program_cache_next(renderer->programs, &busy);

    pictures_next(renderer->pictures, &reading);
    if (is_tried_again(renderer, reading)) {
        return;
    }
    if (params->on_compile && (next || (renderer->told_compile && !busy))) {
        params->on_compile(params->on_compile_data, next ? program_structure_hash(next) : 0);
        renderer->told_compile = next != NULL;
    }
    if (next) {
        program_cache_allow(renderer->programs, next);
    }
}

static int read_limit_ms(const struct renderer *renderer, const struct picture *picture)
{
    const struct renderer_verdict *verdict =
        renderer_find_verdict(renderer, 0, picture_id(picture));

    return LIMIT_READ_MS * (verdict && verdict->times > 0 ? verdict->times : 1);
}

/* The same with the next picture. */
static void read_next(struct renderer *renderer)
{
    const struct renderer_params *params = &renderer->params;
    struct picture *reading, *next = pictures_next(renderer->pictures, &reading);

    if (is_tried_again(renderer, next) && renderer->told_compile) {
        return;
    }
    if (params->on_read && (next || (renderer->told_read && !reading))) {
        params->on_read(params->on_compile_data, next ? picture_id(next) : "");
        renderer->told_read = next != NULL;
    }
    if (next) {
        pictures_allow(renderer->pictures, next, read_limit_ms(renderer, next));
    }
}

static bool advance_all(struct renderer *renderer)
{
    bool news = false;

    for (struct resident *r = renderer->residents; r; r = r->next) {
        news = advance(r) || news;
    }
    return news;
}

bool renderer_is_trying(const struct renderer *renderer)
{
    return renderer->trials.first;
}

bool renderer_poll(struct renderer *renderer, int wait_ms)
{
    const int turn_ms = renderer_is_trying(renderer)                  ? 0
                        : renderer->waiting && wait_ms > READ_POLL_MS ? READ_POLL_MS
                                                                      : wait_ms;
    bool news = trials_go_on(&renderer->trials, TRIAL_US) && advance_all(renderer);

    allow_next(renderer);
    read_next(renderer);
    if (pictures_collect(renderer->pictures, 0)) {
        snapshots_settle(renderer);
        read_next(renderer);
        news = advance_all(renderer) || news;
    }
    if (program_cache_wait(renderer->programs, news ? 0 : turn_ms)) {
        news = advance_all(renderer) || news;
        allow_next(renderer);
    }
    return news;
}
