/* SPDX-License-Identifier: MIT */
/* Pictures asked of the worker and not yet answered. Survives the worker: what was asked
 * is asked again of the next one, and a scene that kills workers is left out. Every function is
 * called under the hub's lock. */
#ifndef SERVER_RENDERS_H
#define SERVER_RENDERS_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"
#include "renderer/worker.h"
#include "supervisor.h"

struct hub;
struct room;
struct render;

enum {
    RENDER_MOVING = 0, /* priorities: the lowest number goes first */
    RENDER_STILL = 1,
    RENDER_LOSSLESS = 2,
    RENDER_IMAGE = 3,
    RENDER_DEADLINE_MS = 120000, /* without progress */
    RENDER_DEATHS = 2,           /* workers that one scene may take with it */
};

/* How much a picture asks for. */
struct render_demand {
    int priority;
    int64_t pixels;
};

struct renders {
    struct render *first, **end; /* in order of asking */
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

struct render_demand render_demand(const struct render_order *order);

void renders_init(struct renders *renders);
void renders_finish(struct renders *renders);
/* Id of the order; 0 and `err` when too many wait, in all or of one account, or the scene is left
 * out. */
uint32_t renders_submit(struct hub *hub, struct render_order *order, struct error *err);
void renders_cancel(struct hub *hub, uint32_t id);
/* Answers every order of the room with ERROR_NOT_FOUND. */
void renders_cancel_room(struct hub *hub, const struct room *room);
/* Moving pictures that are asked and not yet there. */
int renders_moving(const struct renders *renders);
bool renders_has_room(const struct renders *renders, const struct room *room);
/* Answers every order with ERROR_UNAVAILABLE. */
void renders_fail_all(struct hub *hub, const char *why);

/* Events of the supervisor. */
void renders_worker_ready(struct hub *hub);
void renders_worker_down(struct hub *hub, const struct supervisor_end *end);
/* Packets of the worker. */
void renders_frame(struct hub *hub, const struct packet *packet);
void renders_progress(struct hub *hub, uint32_t job);
void renders_failed(struct hub *hub, const struct packet_failed *failed);
/* Fails what is too old; returns the next deadline or 0. */
int64_t renders_tick(struct hub *hub, int64_t now_ms);

#endif
