/* SPDX-License-Identifier: MIT */
/* The orders of pictures that the worker has not answered yet, as render_queue.c keeps them. */
#ifndef SERVER_RENDER_ENTRY_H
#define SERVER_RENDER_ENTRY_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/asset.h"
#include "protocol/render_request.h"
#include "renderer/worker/worker.h"

struct room;
struct render_entry;

enum {
    RENDER_MOVING = 0, /* priorities: the lowest number is drawn first */
    RENDER_STILL = 1,
    RENDER_LOSSLESS = 2,
    RENDER_IMAGE = 3,
    RENDER_THUMBNAIL = RENDER_STILL, /* drawn at rest alone; thumbnails.h */
    /* After so long without progress, also of another order of its account, an order fails. */
    RENDER_DEADLINE_MS = 120000,
    RENDER_DEATHS = 2, /* workers that one scene may have ended */
};

struct render_queue {
    struct render_entry *first, **end; /* in the order of submission */
    uint32_t last_id;
    int64_t image_done; /* clock_ms of the last finished RENDER_IMAGE */
    int64_t image_ms;   /* running mean of their drawing times; 0: none yet */
    bool ready;         /* a worker is ready */
};

/* A picture from the worker. */
struct picture_answer {
    const struct packet_frame *frame;
    const void *bytes;
    size_t length;
};

struct render_order {
    struct room *room; /* the scene; or */
    char *document;    /* of one for this picture alone: its text, without refused code; taken */
    char image[ASSET_ID_CHARACTERS + 1]; /* file of the document's environment; "": none */
    bool portrait;                       /* of which only the nodes count (renderer/portrait.h) */
    struct render_request request;       /* taken */
    int priority;
    /* Who pays for the time: the id of a live connection, or the address of a client; copied. */
    const char *account;
    bool again; /* repeat the order when the worker ends */
    /* Called once, under the hub's lock, with the answer or with `err`. Not called after a
     * cancel. */
    void (*on_done)(void *data, const struct picture_answer *answer, const struct error *err);
    /* Called before on_done with each earlier answer; NULL: only one answer is wanted. */
    void (*on_more)(void *data, const struct picture_answer *answer);
    void *data;
};

struct render_entry {
    struct render_entry *next;
    uint32_t id;
    struct render_order order;
    char *account;                  /* a copy of order.account */
    struct shared_buffer *document; /* has order.document; NULL: there is none */
    int64_t asked;                  /* clock_ms */
    int deaths;                     /* workers lost to this order, if it belongs to no room */
    bool sent;
    int64_t deadline;
};

#endif
