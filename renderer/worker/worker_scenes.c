/* SPDX-License-Identifier: MIT */
/* The scenes that the render process holds. */
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "worker_internal.h"

enum { LARGE_NODES = 4096 }; /* compiling the field of fewer takes less time than a tile */

struct worker_scene **worker_find_scene(struct worker *w, const char *name)
{
    struct worker_scene **at = &w->scenes;

    while (*at && strcmp((*at)->name, name) != 0) {
        at = &(*at)->next;
    }
    return at;
}

const struct worker_scene *worker_find_structure(const struct worker *w, uint64_t structure_hash)
{
    const struct worker_scene *entry = w->scenes;

    while (entry && resident_structure_hash(entry->resident) != structure_hash) {
        entry = entry->next;
    }
    return entry;
}

const struct worker_scene *worker_find_image(const struct worker *w, const char *image)
{
    const struct worker_scene *entry = w->scenes;

    while (entry && strcmp(record_text(&resident_scene(entry->resident)->environment, "image"),
                           image) != 0) {
        entry = entry->next;
    }
    return entry;
}

void worker_drop_scene(struct worker_scene **at)
{
    struct worker_scene *gone = *at;

    *at = gone->next;
    resident_destroy(gone->resident);
    free(gone->name);
    free(gone);
}

static void announce_warning(struct worker *w, struct worker_scene *entry)
{
    const struct warning warning = resident_warning(entry->resident);
    const struct error *err = &warning.error;
    const bool known = strcmp(err->place, entry->told_warning.place) == 0 &&
                       strcmp(err->message, entry->told_warning.message) == 0;

    if (err->kind != ERROR_NONE && !known) {
        worker_send(w, &(struct packet){.kind = TO_FRONT_WARNED,
                                        .state = {.scene = entry->name,
                                                  .revision = resident_revision(entry->resident),
                                                  .warning = warning.kind,
                                                  .error = *err}});
    }
    entry->told_warning = *err;
}

void worker_announce(struct worker *w)
{
    for (struct worker_scene *entry = w->scenes; entry; entry = entry->next) {
        const uint64_t shown = resident_shown_revision(entry->resident);
        const uint64_t revision = resident_revision(entry->resident);
        const struct error *err = resident_error(entry->resident);

        if (shown != entry->told_shown) {
            worker_send(w, &(struct packet){.kind = TO_FRONT_SHOWN,
                                            .state = {.scene = entry->name, .revision = shown}});
            entry->told_shown = shown;
        }
        if (err->kind != ERROR_NONE && entry->told_broken != revision) {
            worker_send_broken(w, entry->name, revision, err,
                               resident_refused_structure(entry->resident));
            entry->told_broken = revision;
        }
        announce_warning(w, entry);
    }
}

void worker_on_compile(void *data, uint64_t structure_hash)
{
    struct worker *w = data;
    const struct worker_scene *entry = w->scenes;
    const struct worker_job *job = w->jobs;

    while (entry && resident_structure_with_code(entry->resident) != structure_hash) {
        entry = entry->next;
    }
    /* It may be left to a picture of an older state. */
    while (job && !(job->drawing && job_structure_with_code(job->drawing) == structure_hash)) {
        job = job->next;
    }
    if (structure_hash == 0 || (!entry && !job)) {
        worker_send_suspect(w, TO_FRONT_COMPILING, &(struct packet_suspect){0});
        return;
    }
    worker_send_suspect(w, TO_FRONT_COMPILING,
                        &(struct packet_suspect){
                            .scene = entry ? entry->name : job->scene,
                            .revision = entry ? resident_revision(entry->resident) : job->revision,
                            .structure_hash = structure_hash});
    worker_flush_all(w);
}

void worker_on_read(void *data, const char *image)
{
    struct worker *w = data;
    const struct worker_scene *entry = *image ? worker_find_image(w, image) : NULL;

    worker_send_suspect(
        w, TO_FRONT_READING,
        &(struct packet_suspect){.scene = entry ? entry->name : "",
                                 .revision = entry ? resident_revision(entry->resident) : 0,
                                 .asset = image});
    if (*image) {
        worker_flush_all(w);
    }
}

/* The engine draws portraits whatever draws scenes: no compiler is to work for them. */
static struct resident *make_resident(struct worker *w, const struct opened_scene *opened,
                                      const struct packet_scene *packet)
{
    const enum render_stage stage = renderer_info(w->renderer)->stage;

    if (packet->portrait) {
        renderer_use_stage(w->renderer, RENDER_ENGINE);
    }
    struct resident *resident = resident_create_opened(w->renderer, opened, packet->revision);
    renderer_use_stage(w->renderer, stage);
    return resident;
}

struct scene_document worker_document_of(struct worker *w, const struct packet *packet)
{
    const bool edit = packet->kind == TO_WORKER_EDIT;
    const struct worker_scene *entry =
        *worker_find_scene(w, edit ? packet->edit.scene : packet->scene.scene);

    return (struct scene_document){
        .text = packet->payload,
        .length = packet->payload_length,
        .portrait = !edit && packet->scene.portrait,
        .scene = edit ? (struct scene *)resident_scene(entry->resident) : NULL,
        .drawn = entry ? resident_drawn_field(entry->resident) : NULL,
    };
}

void worker_on_scene(struct worker *w, const struct packet_scene *packet,
                     const struct opened_scene *opened)
{
    struct worker_scene *entry = *worker_find_scene(w, packet->scene);

    if (!opened->scene) {
        worker_send_broken(w, packet->scene, packet->revision, &opened->error, 0);
    } else if (entry) {
        resident_replace_opened(entry->resident, opened, packet->revision);
    } else {
        entry = memory_alloc(1, sizeof *entry);
        entry->name = memory_text(packet->scene);
        entry->resident = make_resident(w, opened, packet);
        entry->next = w->scenes;
        w->scenes = entry;
    }
}

void worker_on_field(struct worker *w, const char *scene, const struct opened_scene *opened)
{
    struct resident *resident = (*worker_find_scene(w, scene))->resident;

    resident_replace_opened(resident, opened, resident_revision(resident));
}

static bool is_large(const struct worker_scene *entry)
{
    return resident_scene(entry->resident)->node_count > LARGE_NODES;
}

const struct scene *worker_stale_scene(struct worker *w, const char *scene)
{
    const struct worker_scene *entry = *worker_find_scene(w, scene);

    return entry && resident_is_stale(entry->resident) ? resident_scene(entry->resident) : NULL;
}

void worker_on_edit(struct worker *w, const struct packet_edit *packet)
{
    struct worker_scene *entry = *worker_find_scene(w, packet->scene);
    struct error err = {0};

    if (!entry) {
        error_set(&err, ERROR_NOT_FOUND, "scene", "no scene \"%s\" is held", packet->scene);
    }
    if (!entry || !resident_apply(entry->resident, packet->ops, packet->revision, &err)) {
        worker_send_broken(w, packet->scene, packet->revision, &err, 0);
    } else if (resident_is_stale(entry->resident) && !is_large(entry)) {
        resident_renew(entry->resident);
    }
}

void worker_on_drop(struct worker *w, const char *scene)
{
    struct worker_scene **at = worker_find_scene(w, scene);

    if (*at) {
        worker_drop_scene(at);
    }
}

void worker_on_judge(struct worker *w, const struct packet_judge *packet)
{
    struct renderer_verdict verdict = {
        .structure_hash = packet->structure_hash,
        .refused = packet->refused,
        .measured_ms = packet->measured_ms,
        .limit_ms = packet->limit_ms,
        .times = packet->times,
    };

    snprintf(verdict.image, sizeof verdict.image, "%s", packet->asset);
    renderer_judge(w->renderer, &verdict);
}
