/* SPDX-License-Identifier: MIT */
/* The scenes that the render process holds. */
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
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
    const struct warning *warning = resident_warning(held->resident);
    const struct error *err = &warning->error;
    const bool known = strcmp(err->place, held->told_warning.place) == 0 &&
                       strcmp(err->message, held->told_warning.message) == 0;

    if (err->kind != ERROR_NONE && !known) {
        worker_send(w, &(struct packet){.kind = TO_FRONT_WARNED,
                                        .state = {.scene = held->name,
                                                  .revision = resident_revision(held->resident),
                                                  .warning = warning->kind,
                                                  .error = *err}});
    }
    held->told_warning = *err;
}

void worker_announce(struct worker *w)
{
    for (struct held *held = w->scenes; held; held = held->next) {
        const uint64_t shown = resident_shown_revision(held->resident);
        const uint64_t revision = resident_revision(held->resident);
        const struct error *err = resident_error(held->resident);

        if (shown != held->told_shown) {
            worker_send(w, &(struct packet){.kind = TO_FRONT_SHOWN,
                                            .state = {.scene = held->name, .revision = shown}});
            held->told_shown = shown;
        }
        if (err->kind != ERROR_NONE && held->told_broken != revision) {
            worker_send_broken(w, held->name, revision, err,
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
        worker_send_suspect(w, TO_FRONT_COMPILING, &(struct packet_suspect){0});
        return;
    }
    worker_send_suspect(w, TO_FRONT_COMPILING,
                        &(struct packet_suspect){
                            .scene = held ? held->name : task->scene,
                            .revision = held ? resident_revision(held->resident) : task->revision,
                            .shape = shape});
    worker_flush_all(w);
}

void worker_on_read(void *data, const char *image)
{
    struct worker *w = data;
    const struct held *held = *image ? worker_find_image(w, image) : NULL;

    worker_send_suspect(
        w, TO_FRONT_READING,
        &(struct packet_suspect){.scene = held ? held->name : "",
                                 .revision = held ? resident_revision(held->resident) : 0,
                                 .asset = image});
    if (*image) {
        worker_flush_all(w);
    }
}

void worker_on_scene(struct worker *w, const struct packet_scene *packet)
{
    struct held *held = *worker_find_scene(w, packet->scene);
    struct error err = {0};
    struct scene *scene = scene_read(packet->document, &err);

    if (!scene) {
        worker_send_broken(w, packet->scene, packet->revision, &err, 0);
    } else if (held) {
        resident_replace(held->resident, scene, packet->revision);
    } else {
        held = memory_alloc(1, sizeof *held);
        held->name = memory_text(packet->scene);
        held->resident = resident_create(w->renderer, scene, packet->revision);
        held->next = w->scenes;
        w->scenes = held;
    }
}

void worker_on_edit(struct worker *w, const struct packet_edit *packet)
{
    struct held *held = *worker_find_scene(w, packet->scene);
    struct error err = {0};

    if (!held) {
        error_set(&err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", packet->scene);
    }
    if (!held || !resident_edit(held->resident, packet->ops, packet->revision, &err)) {
        worker_send_broken(w, packet->scene, packet->revision, &err, 0);
    }
}

void worker_on_drop(struct worker *w, const char *scene)
{
    struct held **at = worker_find_scene(w, scene);

    if (*at) {
        worker_drop_scene(at);
    }
}

void worker_on_judge(struct worker *w, const struct packet_judge *packet)
{
    struct renderer_verdict verdict = {
        .shape = packet->shape,
        .refused = packet->refused,
        .measured_ms = packet->measured_ms,
        .limit_ms = packet->limit_ms,
        .times = packet->times,
    };

    snprintf(verdict.image, sizeof verdict.image, "%s", packet->asset);
    renderer_judge(w->renderer, &verdict);
}
