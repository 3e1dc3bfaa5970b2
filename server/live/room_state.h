/* SPDX-License-Identifier: MIT */
/* What an open scene is: the document, its revision and history, who looks at it, and what each
 * part of the server keeps of it. Guarded by the hub's lock. */
#ifndef SERVER_ROOM_STATE_H
#define SERVER_ROOM_STATE_H

#include <stdint.h>

#include "authors.h"
#include "protocol/asset.h"
#include "protocol/edit.h"
#include "protocol/id_set.h"
#include "protocol/limits.h"
#include "protocol/scene.h"
#include "server/net/send_queue.h"

struct hub;
struct session;

/* last_good.h */
struct last_good {
    bool code;           /* there is code in the scene, or there was */
    uint64_t proven;     /* newest revision that a worker could draw; 0: none */
    struct scene *scene; /* NULL: none */
    uint64_t revision;   /* of `scene` */
};

/* picker.h */
enum { PICKER_FIELDS = 4 }; /* that a room keeps: all that is seen, and what viewers isolate */

struct picker_field {
    struct id_set isolate;    /* none: all that is there */
    uint64_t last_use;        /* 0: never */
    struct pick_field *field; /* NULL: none yet */
    uint64_t revision;        /* of `field` */
    uint64_t tried;           /* newest of which one was to be made */
};

/* How much a picture asks for. */
struct render_demand {
    int priority;
    int64_t pixels;
};

enum {
    ROOM_LOG = 2048,          /* edits kept in memory for those who resume */
    ROOM_LOG_BYTES = 4194304, /* the same, in operations; more where they are not committed */
    ROOM_SNAPSHOT_EDITS = 256,
    ROOM_IDLE_MS = 60000, /* closed when nobody looked at it for so long */
};

/* An edit as it was applied. */
struct room_entry {
    uint64_t revision;
    int64_t edit; /* the author's number; 0: none */
    char author[LIMIT_ID_BYTES + 1];
    char name[AUTHOR_NAME_CHARACTERS + 1]; /* that others are told */
    char *ops;
};

struct room {
    struct hub *hub;
    struct room *next;
    char id[LIMIT_ID_BYTES + 1];
    struct scene *scene;
    struct history *history;
    uint64_t revision, durable;
    char epoch[17];                  /* differs whenever revisions may have been given twice */
    struct room_entry log[ROOM_LOG]; /* ring: entry of revision r at r % ROOM_LOG */
    uint64_t log_from;               /* the log holds every revision above this one */
    size_t log_bytes;
    struct authors authors;
    void (*destroy)(struct room *room); /* when it is deleted, and nothing is pending */
    struct session *sessions;
    size_t session_count;
    size_t holds;   /* who reads the document without the lock: nobody changes it meanwhile */
    size_t pending; /* writes not yet committed: the room stays */
    int edits_since_snapshot;
    bool snapshot_soon; /* a task will store one */
    bool deleted;
    struct shared_buffer *text; /* what the document prints as; NULL: not known */
    int64_t idle_since;         /* clock_ms; 0: in use */
    struct picker_field picks[PICKER_FIELDS];

    /* What the worker has of it. */
    uint64_t sent;  /* newest revision that it was told of; 0: it does not hold the scene */
    uint64_t shown; /* newest revision that it can draw */
    char image[ASSET_ID_CHARACTERS + 1]; /* file of its environment that the worker was sent last */
    uint64_t settled;                    /* newest of which it is known whether it can */
    int64_t compiling_since;             /* clock_ms; 0: nothing is waited for */
    bool compiling_told;
    bool told_lost;             /* that the worker is gone */
    int deaths;                 /* workers lost while they drew this scene, */
    struct render_demand fatal; /* the last with a picture of so much: another one ends `deaths` */
    double ns_per_pixel;        /* of moving pictures, by all who look: stream.h; 0: none yet */
    int patience;               /* times the usual time that a tile of it may take */
    struct error suspended;     /* why it is not drawn until it is edited; ERROR_NONE: it is */
    struct last_good last_good;
    struct shared_buffer *poster; /* the last picture; NULL: none since the room was opened */
    bool poster_stored;
    struct error
        scene_error; /* why it cannot be drawn as it is; ERROR_NONE: it can, as far as known */
    uint64_t scene_error_revision;               /* that it is about */
    char refused_shape[ASSET_ID_CHARACTERS + 1]; /* of one that is too slow, or crashed */
};

struct room_change {
    const char *author;        /* client id, or "rest" */
    struct author *by;         /* NULL: "rest", who has no numbers */
    int64_t edit;              /* 0: none */
    const char *group, *label; /* of the step of undo; may be NULL */
    struct session *session;   /* of the author; NULL: none */
    void (*then)(void *data);  /* after the commit, on the store's thread; may be NULL */
    void *data;
};
/* What others are told of who it was. */
const char *room_change_name(const struct room_change *change);

enum room_outcome { ROOM_APPLIED, ROOM_KNOWN /* a resend: nothing changed */, ROOM_REFUSED };

/* That the log holds: of a revision above room->log_from. */
const struct room_entry *room_entry_of(const struct room *room, uint64_t revision);

#endif
