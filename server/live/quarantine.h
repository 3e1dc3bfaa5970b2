/* SPDX-License-Identifier: MIT */
/* The quarantine of structures that ended a worker during compilation, and of files that ended one
 * while their picture was read. A key is either: a structure hash in digits, or the longer id of an
 * asset. The worker names what it is about to compile, read or draw. The key named when a worker
 * ended gets a second try with LIMIT_RETRY_FACTOR times the time. If that ends a worker too, or if
 * the thread at work crashed (renderer/crash.h), the key is refused until a retry is asked for.
 * Its scene falls back to the last good state, or to a sky without the picture. Drawing counts
 * against a scene instead (render_queue.h). Every function is called under the hub's lock. */
#ifndef SERVER_QUARANTINE_H
#define SERVER_QUARANTINE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"
#include "renderer/worker/worker.h"
#include "supervisor.h"

struct hub;
struct room;

enum {
    QUARANTINE_CASES = 256, /* the oldest are dropped and may try again */
    QUARANTINE_KEY_BYTES = ASSET_ID_CHARACTERS + 1,
};

/* What a worker was at. `scene` is "": nothing. */
struct suspect {
    char scene[LIMIT_ID_BYTES + 16];
    uint64_t revision; /* that is compiled */
    char key[QUARANTINE_KEY_BYTES];
    uint32_t job; /* that is drawn */
};

/* What is known of a key. */
struct quarantine_case {
    char key[QUARANTINE_KEY_BYTES];
    char scene[LIMIT_ID_BYTES + 16]; /* scene of its last naming */
    int times;                       /* factor on the usual time for the next try */
    bool tried;                      /* it may have ended a worker; after another it is refused */
    enum error_kind refused;         /* why; ERROR_NONE: it is not refused */
    int measured_ms, limit_ms;       /* of ERROR_TOO_SLOW */
};

struct quarantine {
    struct suspect compiling, reading, opening, drawing;
    bool named;                /* the last worker that ended had named a suspect */
    bool sure;                 /* that is the cause: its thread crashed */
    struct suspect drawn;      /* the picture that may have ended it */
    struct suspect opened;     /* the same of a document */
    struct suspect slow;       /* why the worker ended itself */
    int measured_ms, limit_ms; /* of `slow` */
    struct quarantine_case cases[QUARANTINE_CASES]; /* a ring */
    size_t count;                                   /* ever added */
    double pace; /* compile time on this machine, measured by workers; 0: not known */
};

/* The worker has named a suspect, or has reported that one was too slow. */
void quarantine_named(struct hub *hub, enum packet_to_front kind,
                      const struct packet_suspect *named);
/* The key of a structure; "" for 0. */
void quarantine_key(uint64_t structure_hash, char out[QUARANTINE_KEY_BYTES]);
/* Tells a new worker what earlier workers measured and which keys are refused. */
void quarantine_worker_ready(struct hub *hub);
/* A worker has ended. True: it had named a suspect. */
bool quarantine_worker_down(struct hub *hub, const struct supervisor_end *end);
/* Whether drawing this scene, or reading its document, may have ended the last worker. If that
 * worker had named nothing, every scene with a picture asked of it is suspect: `asked`. */
bool quarantine_blames(const struct hub *hub, const char *scene, bool asked);
/* Whether a key of the scene waits for its second try. */
bool quarantine_is_tried_again(const struct hub *hub, const struct room *room);
/* Allows one more compilation with more time than the last. False: the key is not refused. */
bool quarantine_pardon(struct hub *hub, const char *key);
/* Tells the room that the picture of its environment stays refused. `err` is the worker's error. */
void quarantine_keeps_image(struct room *room, const struct error *err, uint64_t revision);

#endif
