/* SPDX-License-Identifier: MIT */
/* Large documents, which are read beside the drawing, large scenes, whose fields are compiled so
 * after edits, and the packets that wait for them. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "renderer/field/field.h"
#include "worker_internal.h"

enum {
    NODE_BYTES = 32,      /* of a text that takes as long as compiling one node */
    AT_ONCE_BYTES = 8192, /* smaller ones take less time than a tile */
    WAITING_FULL = 16 * LIMIT_DOCUMENT_BYTES /* the front lets no client have more on its way */
};

/* The scene that a packet is about; "": none. */
static const char *scene_of(const struct packet *packet)
{
    switch ((enum packet_to_worker)packet->kind) {
    case TO_WORKER_SCENE:
        return packet->scene.scene;
    case TO_WORKER_EDIT:
        return packet->edit.scene;
    case TO_WORKER_DROP:
        return packet->state.scene;
    case TO_WORKER_RENDER:
        return packet->render.scene;
    default:
        return "";
    }
}

/* Whether the order of a picture waits for this document. */
static bool has_order(const struct worker_document *document, uint32_t job)
{
    const struct worker_waiting *waiting = document->first;

    while (waiting &&
           !(waiting->packet.kind == TO_WORKER_RENDER && waiting->packet.render.job == job)) {
        waiting = waiting->next;
    }
    return waiting;
}

/* The document that has to be opened before this packet is handled; NULL: none. */
static struct worker_document *find_awaited(const struct worker *w, const struct packet *packet)
{
    struct worker_document *document = w->documents;

    while (document && !(packet->kind == TO_WORKER_CANCEL
                             ? has_order(document, packet->job.job)
                             : strcmp(scene_of(&document->packet), scene_of(packet)) == 0)) {
        document = document->next;
    }
    return document;
}

static void add_document(struct worker *w, const struct packet *packet, size_t size)
{
    struct worker_document **last = &w->documents;

    while (*last) {
        last = &(*last)->next;
    }
    *last = memory_alloc(1, sizeof **last);
    (*last)->packet = *packet;
    (*last)->size = size;
    (*last)->end = &(*last)->first;
    w->waiting_bytes += packet->length;
}

static void keep(struct worker *w, struct worker_document *document, const struct packet *packet)
{
    struct worker_waiting *waiting = memory_alloc(1, sizeof *waiting);

    waiting->packet = *packet;
    *document->end = waiting;
    document->end = &waiting->next;
    w->waiting_bytes += packet->length;
}

/* Edits that follow each other are applied before the field is compiled once for all of them. */
static bool joins(const struct worker *w, const struct worker_document *document,
                  const struct packet *packet)
{
    return packet->kind == TO_WORKER_EDIT && document->packet.kind == TO_WORKER_EDIT &&
           document != w->opening && !document->first;
}

/* Handles it. An edit may leave the field of a large scene to be compiled. */
static void handle(struct worker *w, struct packet *packet, bool joined)
{
    const struct scene *stale;

    worker_on_packet(w, packet);
    stale = packet->kind == TO_WORKER_EDIT && !joined ? worker_stale_scene(w, packet->edit.scene)
                                                      : NULL;
    if (stale) {
        add_document(w, packet, stale->node_count * NODE_BYTES);
    } else {
        packet_finish(packet);
    }
}

void worker_take_packet(struct worker *w, struct packet *packet)
{
    struct worker_document *document = find_awaited(w, packet);
    const bool joined = document && joins(w, document, packet);

    if (document && !joined) {
        keep(w, document, packet);
    } else if (packet->kind == TO_WORKER_SCENE &&
               (packet->payload_length > AT_ONCE_BYTES || packet->scene.portrait)) {
        add_document(w, packet, packet->payload_length);
    } else {
        handle(w, packet, joined);
    }
}

bool worker_documents_full(const struct worker *w)
{
    return w->waiting_bytes > WAITING_FULL;
}

/* Takes it out of the list. */
static void detach(struct worker *w, struct worker_document *document)
{
    struct worker_document **at = &w->documents;

    while (*at != document) {
        at = &(*at)->next;
    }
    *at = document->next;
    w->waiting_bytes -= document->packet.length;
}

static struct worker_waiting *take_first(struct worker *w, struct worker_document *document)
{
    struct worker_waiting *waiting = document->first;

    if (waiting) {
        document->first = waiting->next;
        w->waiting_bytes -= waiting->packet.length;
    }
    return waiting;
}

/* What waited may be another document of the scene, for which the rest waits again. */
static void end_opening(struct worker *w, const struct opened_scene *opened)
{
    struct worker_document *document = w->opening;
    struct worker_waiting *waiting;

    detach(w, document);
    field_unref(w->opening_drawn);
    w->opening_drawn = NULL;
    w->opening = NULL;
    if (document->packet.kind == TO_WORKER_SCENE) {
        worker_on_scene(w, &document->packet.scene, opened);
    } else {
        worker_on_field(w, document->packet.edit.scene, opened);
    }
    while ((waiting = take_first(w, document))) {
        worker_take_packet(w, &waiting->packet);
        free(waiting);
    }
    packet_finish(&document->packet);
    free(document);
}

/* By turns the smallest of those that wait, which is not to wait for many large ones, and the
 * oldest, which is not to wait for ever. */
static struct worker_document *find_next(const struct worker *w)
{
    struct worker_document *next = w->documents;

    for (struct worker_document *document = next; document; document = document->next) {
        if (w->openings % 2 == 0 && document->size < next->size) {
            next = document;
        }
    }
    return next;
}

/* A document, or with NULL that none is read any more. */
static void tell_opening(struct worker *w, const struct worker_document *document)
{
    worker_send_suspect(
        w, TO_FRONT_OPENING,
        &(struct packet_suspect){.scene = document ? scene_of(&document->packet) : ""});
    if (document) {
        worker_flush_all(w);
    }
}

static void begin_opening(struct worker *w, struct worker_document *next)
{
    const struct scene_document document = worker_document_of(w, &next->packet);

    w->opening = next;
    w->openings++;
    w->opening_drawn = document.drawn ? field_ref(document.drawn) : NULL;
    scene_reader_begin(w->scene_reader, &document);
}

void worker_read_documents(struct worker *w)
{
    const bool was_reading = w->opening;
    struct opened_scene opened;

    if (w->opening && scene_reader_take(w->scene_reader, &opened)) {
        end_opening(w, &opened);
    }
    if (w->opening) {
        if (scene_reader_stuck(w->scene_reader)) {
            worker_flush_all(w);
            _exit(WORKER_STUCK); /* its thread cannot be joined */
        }
        return;
    }
    struct worker_document *next = find_next(w);
    if (next || was_reading) {
        tell_opening(w, next);
    }
    if (next) {
        begin_opening(w, next);
    }
}

void worker_drop_documents(struct worker *w)
{
    struct worker_waiting *waiting;

    scene_reader_destroy(w->scene_reader);
    field_unref(w->opening_drawn);
    while (w->documents) {
        struct worker_document *document = w->documents;

        while ((waiting = take_first(w, document))) {
            packet_finish(&waiting->packet);
            free(waiting);
        }
        detach(w, document);
        packet_finish(&document->packet);
        free(document);
    }
}
