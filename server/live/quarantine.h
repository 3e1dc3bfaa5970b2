/* SPDX-License-Identifier: MIT */
/* Shapes that ended a worker while they were compiled, and files while their picture was read: what
 * is called a shape here may be the id of a file, which is longer. The worker names what it will
 * compile, read or draw. What was being compiled or read when it ended gets a second try, with
 * LIMIT_RETRY_FACTOR times the time; if that ends a worker too, it is left alone until somebody
 * asks for a retry: a scene falls back to its last good state, or to a sky without its picture.
 * Drawing counts against a scene (render_queue.h). Every function is called under the hub's
 * lock. */
#ifndef SERVER_QUARANTINE_H
#define SERVER_QUARANTINE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"
#include "renderer/worker.h"
#include "supervisor.h"

struct hub;
struct room;

enum {
    QUARANTINE_SHAPES = 256, /* the oldest are forgotten: they may try again */
    QUARANTINE_SHAPE_BYTES = ASSET_ID_CHARACTERS + 1,
};

/* "" in `scene`: nobody. */
struct suspect {
    char scene[LIMIT_ID_BYTES + 16];
    uint64_t revision; /* of what is compiled */
    char shape[QUARANTINE_SHAPE_BYTES];
    uint32_t job; /* of what is drawn */
};

/* What is known of a shape. */
struct quarantine_case {
    char shape[QUARANTINE_SHAPE_BYTES];
    char scene[LIMIT_ID_BYTES + 16]; /* that it was named with last */
    int times;                       /* of the usual time, for the next try */
    bool tried;                      /* it ended a worker; the next time it is refused */
    enum error_kind refused;         /* ERROR_NONE: it is not */
    int measured_ms, limit_ms;       /* of ERROR_TOO_SLOW */
};

struct quarantine {
    struct suspect compiling, reading, drawing;
    bool named;                                      /* the last worker to end had named somebody */
    struct suspect drawn;                            /* what drawing may have ended it */
    struct suspect slow;                             /* what the worker ended itself for */
    int measured_ms, limit_ms;                       /* of `slow` */
    struct quarantine_case cases[QUARANTINE_SHAPES]; /* a ring */
    size_t count;                                    /* ever */
    double pace; /* how slow this machine compiles, as the workers measured it; 0: not known */
};

/* What the worker says of what it compiles, reads or draws, or that it was too slow. */
void quarantine_named(struct hub *hub, enum packet_to_front kind,
                      const struct packet_suspect *named);
/* A shape as it is called here. "" for 0. */
void quarantine_shape(uint64_t shape, char out[QUARANTINE_SHAPE_BYTES]);
/* Tells a new worker what earlier ones learned. */
void quarantine_worker_ready(struct hub *hub);
/* True: it had named somebody. */
bool quarantine_worker_down(struct hub *hub, const struct supervisor_end *end);
/* Whether the worker that has just ended may have done so by drawing this. Where it had named
 * nobody, all that it was asked for is suspect: `asked`. */
bool quarantine_blames(const struct hub *hub, const char *scene, bool asked);
/* A shape of the scene waits for its second try. */
bool quarantine_is_tried_again(const struct hub *hub, const struct room *room);
/* Lets the shape be compiled once more, with more time than the last. False: it is not refused. */
bool quarantine_pardon(struct hub *hub, const char *shape);
/* The picture that the room's scene names was refused before; tells so. `err`: the worker's. */
void quarantine_keeps_image(struct room *room, const struct error *err, uint64_t revision);

#endif
