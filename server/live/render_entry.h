/* SPDX-License-Identifier: MIT */
/* The pictures that are asked of the worker and not yet there, as render_queue.c keeps them. */
#ifndef SERVER_RENDER_ENTRY_H
#define SERVER_RENDER_ENTRY_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/render_request.h"
#include "renderer/worker.h"

struct room;
struct render_entry;

enum {
    RENDER_MOVING = 0, /* priorities: the lowest number goes first */
    RENDER_STILL = 1,
    RENDER_LOSSLESS = 2,
    RENDER_IMAGE = 3,
    RENDER_DEADLINE_MS = 120000, /* without progress */
    RENDER_DEATHS = 2,           /* workers that one scene may take with it */
};

struct render_queue {
    struct render_entry *first, **end; /* in order of asking */
    uint32_t last_id;
    int64_t image_done; /* clock_ms when the last of these was there */
    int64_t image_ms;   /* running mean of what one of these takes; 0: none yet */
    bool ready;         /* a worker is there */
};

/* A picture that has come. */
struct picture_answer {
    const struct packet_frame *frame;
    const void *bytes;
    size_t length;
};

struct render_order {
    struct room *room;             /* the scene; or */
    const char *document;          /* the text of one that is used once */
    struct render_request request; /* taken */
    int priority;
    /* Whose time it takes: the id of a live connection, or the address of a client; copied. */
    const char *account;
    bool again; /* ask the next worker when this one dies */
    /* Called once, under the hub's lock, with the answer or with `err`; not after a cancel. */
    void (*on_done)(void *data, const struct picture_answer *answer, const struct error *err);
    /* Called before it with each answer that is not the last; NULL: there is one. */
    void (*on_more)(void *data, const struct picture_answer *answer);
    void *data;
};

struct render_entry {
    struct render_entry *next;
    uint32_t id;
    struct render_order order;
    char *document; /* a copy of order.document */
    char *account;  /* a copy of order.account */
    int64_t asked;  /* clock_ms */
    int deaths;     /* workers lost while this was asked and belongs to no room */
    bool sent;
    int64_t deadline;
};

#endif
