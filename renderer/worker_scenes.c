/* SPDX-License-Identifier: MIT */
/* The scenes that the render process holds. */
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "protocol/messages.h"
#include "worker_parts.h"

struct held **worker_find_scene(struct worker *w, const char *name)
{
    struct held **at = &w->scenes;

    while (*at && strcmp((*at)->name, name) != 0) {
        at = &(*at)->next;
    }
    return at;
}

const struct held *worker_find_shape(const struct worker *w, uint64_t shape)
{
    const struct held *held = w->scenes;

    while (held && resident_shape(held->resident) != shape) {
        held = held->next;
    }
    return held;
}

const struct held *worker_find_image(const struct worker *w, const char *image)
{
    const struct held *held = w->scenes;

    while (held &&
           strcmp(record_text(&resident_scene(held->resident)->environment, "image"), image) != 0) {
        held = held->next;
    }
    return held;
}

void worker_drop_scene(struct held **at)
{
    struct held *gone = *at;

    *at = gone->next;
    resident_destroy(gone->resident);
    free(gone->name);
    free(gone);
}

static void announce_warning(struct worker *w, struct held *held)
{
    const struct error *warning = resident_warning(held->resident);
    const bool known = strcmp(warning->place, held->told_warning.place) == 0 &&
                       strcmp(warning->message, held->told_warning.message) == 0;

    if (warning->kind != ERROR_NONE && !known) {
        worker_send_fault(w, "warned", held->name, resident_revision(held->resident), warning, 0);
    }
    held->told_warning = *warning;
}

void worker_announce(struct worker *w)
{
    for (struct held *held = w->scenes; held; held = held->next) {
        const uint64_t shown = resident_shown_revision(held->resident);
        const uint64_t revision = resident_revision(held->resident);
        const struct error *err = resident_error(held->resident);

        if (shown != held->told_shown) {
            cJSON *json = worker_answer("shown");
            cJSON_AddStringToObject(json, "scene", held->name);
            cJSON_AddNumberToObject(json, "revision", (double)shown);
            worker_send(w, json, NULL, 0);
            held->told_shown = shown;
        }
        if (err->kind != ERROR_NONE && held->told_broken != revision) {
            worker_send_fault(w, "broken", held->name, revision, err,
                              resident_refused_shape(held->resident));
            held->told_broken = revision;
        }
        announce_warning(w, held);
    }
}

void worker_on_compile(void *data, uint64_t shape)
{
    struct worker *w = data;
    const struct held *held = w->scenes;
    const struct task *task = w->tasks;

    while (held && resident_shape_with_code(held->resident) != shape) {
        held = held->next;
    }
    /* It may be left to a picture of an older state. */
    while (task && !(task->job && job_shape_with_code(task->job) == shape)) {
        task = task->next;
    }
    if (shape == 0 || (!held && !task)) {
        worker_send_compiling(w, "", 0, 0);
    } else {
        worker_send_compiling(w, held ? held->name : task->scene,
                              held ? resident_revision(held->resident) : task->revision, shape);
        worker_flush_all(w);
    }
}

void worker_on_read(void *data, const char *image)
{
    struct worker *w = data;

    worker_send_reading(w, *image ? worker_find_image(w, image) : NULL, image);
    if (*image) {
        worker_flush_all(w);
    }
}

void worker_on_scene(struct worker *w, const cJSON *packet)
{
    const char *name = json_member_text(packet, "scene", "");
    const uint64_t revision = (uint64_t)json_member_number(packet, "revision", 0);
    struct held *held = *worker_find_scene(w, name);
    struct error err = {0};
    struct scene *scene = scene_read(cJSON_GetObjectItemCaseSensitive(packet, "document"), &err);

    if (!scene) {
        worker_send_fault(w, "broken", name, revision, &err, 0);
    } else if (held) {
        resident_replace(held->resident, scene, revision);
    } else {
        held = memory_alloc(1, sizeof *held);
        held->name = memory_text(name);
        held->resident = resident_create(w->renderer, scene, revision);
        held->next = w->scenes;
        w->scenes = held;
    }
}

void worker_on_edit(struct worker *w, const cJSON *packet)
{
    const char *name = json_member_text(packet, "scene", "");
    const uint64_t revision = (uint64_t)json_member_number(packet, "revision", 0);
    const cJSON *ops = cJSON_GetObjectItemCaseSensitive(packet, "ops");
    struct held *held = *worker_find_scene(w, name);
    struct error err = {0};

    if (!held) {
        error_set(&err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", name);
    }
    if (!held || !resident_edit(held->resident, ops, revision, &err)) {
        worker_send_fault(w, "broken", name, revision, &err, 0);
    }
}

void worker_on_drop(struct worker *w, const cJSON *packet)
{
    struct held **at = worker_find_scene(w, json_member_text(packet, "scene", ""));

    if (*at) {
        worker_drop_scene(at);
    }
}

/* Empty or unknown: none. */
static enum error_kind read_kind(const char *code)
{
    return strcmp(code, error_kind_name(ERROR_TOO_SLOW)) == 0  ? ERROR_TOO_SLOW
           : strcmp(code, error_kind_name(ERROR_CRASHED)) == 0 ? ERROR_CRASHED
                                                               : ERROR_NONE;
}

void worker_on_judge(struct worker *w, const cJSON *packet)
{
    const double pace = json_member_number(packet, "pace", 0);
    const cJSON *row;

    if (pace > 0) {
        renderer_set_pace(w->renderer, pace);
    }
    cJSON_ArrayForEach(row, cJSON_GetObjectItemCaseSensitive(packet, "shapes"))
    {
        struct renderer_verdict verdict = {
            .shape = strtoull(json_member_text(row, "shape", ""), NULL, 16),
            .refused = read_kind(json_member_text(row, "code", "")),
            .measured_ms = (int)json_member_number(row, "measured", 0),
            .limit_ms = (int)json_member_number(row, "limit", 0),
            .times = (int)json_member_number(row, "times", 1),
        };
        snprintf(verdict.image, sizeof verdict.image, "%s", json_member_text(row, "asset", ""));
        renderer_judge(w->renderer, &verdict);
    }
}
