/* SPDX-License-Identifier: MIT */
/* Large documents, which are read beside the drawing, and the packets that wait for them. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "renderer/field/field.h"
#include "worker_internal.h"

enum {
    AT_ONCE_BYTES = 8192,                    /* smaller ones take less time than a tile */
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

/* The document that has to be read before this packet is handled; NULL: none. */
static struct worker_document *find_awaited(const struct worker *w, const struct packet *packet)
{
    struct worker_document *document = w->documents;

    while (document && !(packet->kind == TO_WORKER_CANCEL
                             ? has_order(document, packet->job.job)
                             : strcmp(document->packet.scene.scene, scene_of(packet)) == 0)) {
        document = document->next;
    }
    return document;
}

static void add_document(struct worker *w, const struct packet *packet)
{
    struct worker_document **last = &w->documents;

    while (*last) {
        last = &(*last)->next;
    }
    *last = memory_alloc(1, sizeof **last);
    (*last)->packet = *packet;
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

void worker_take_packet(struct worker *w, struct packet *packet)
{
    struct worker_document *document = find_awaited(w, packet);

    if (document) {
        keep(w, document, packet);
    } else if (packet->kind == TO_WORKER_SCENE &&
               (packet->payload_length > AT_ONCE_BYTES || packet->scene.portrait)) {
        add_document(w, packet);
    } else {
        worker_on_packet(w, packet);
        packet_finish(packet);
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
    worker_on_scene(w, &document->packet.scene, opened);
    while ((waiting = take_first(w, document))) {
        worker_take_packet(w, &waiting->packet);
        free(waiting);
    }
    packet_finish(&document->packet);
    free(document);
}

/* Of the documents that wait the shortest is next, so that small ones do not wait for many. */
static struct worker_document *find_shortest(const struct worker *w)
{
    struct worker_document *shortest = w->documents;

    for (struct worker_document *document = shortest; document; document = document->next) {
        if (document->packet.payload_length < shortest->packet.payload_length) {
            shortest = document;
        }
    }
    return shortest;
}

/* A document, or with NULL that none is read any more. */
static void tell_opening(struct worker *w, const struct worker_document *document)
{
    const struct packet_scene none = {.scene = ""};
    const struct packet_scene *scene = document ? &document->packet.scene : &none;

    worker_send_suspect(
        w, TO_FRONT_OPENING,
        &(struct packet_suspect){.scene = scene->scene, .revision = scene->revision});
    if (document) {
        worker_flush_all(w);
    }
}

static void begin_opening(struct worker *w, struct worker_document *next)
{
    const struct scene_document document = worker_document_of(w, &next->packet);

    w->opening = next;
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
    struct worker_document *next = find_shortest(w);
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
