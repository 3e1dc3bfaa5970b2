/* SPDX-License-Identifier: MIT */
/* The state of an open scene: its document, revision and history, its sessions, and what each part
 * of the server keeps for it. Guarded by the hub's lock. */
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
#include "stream_state.h"

struct hub;
struct session;

/* last_good.h */
struct last_good {
    bool code;           /* the scene has or had users' code */
    uint64_t proven;     /* newest revision drawn by a worker; 0: none */
    struct scene *scene; /* NULL: none */
    uint64_t revision;   /* of `scene` */
    size_t readers;      /* of `scene` without the lock: it does not change meanwhile */
};

/* picker.h */
enum { PICKER_FIELDS = 4 }; /* of a room: for the whole scene, and for isolated nodes */

struct picker_field {
    struct id_set isolate;    /* empty: the whole scene */
    uint64_t last_use;        /* 0: never */
    struct pick_field *field; /* NULL: none yet */
    uint64_t revision;        /* of `field` */
    uint64_t tried;           /* newest revision that a field was built for */
};

/* How much work a picture is. */
struct render_demand {
    int priority;
    int64_t pixels;
};

enum {
    ROOM_LOG = 2048,          /* edits kept in memory for sessions that resume */
    ROOM_LOG_BYTES = 4194304, /* the same in bytes; uncommitted edits may exceed it */
    ROOM_SNAPSHOT_EDITS = 256,
    ROOM_IDLE_MS = 60000, /* without a session for so long, the room closes */
};

/* An edit as it was applied. */
struct room_entry {
    uint64_t revision;
    int64_t edit; /* the author's number; 0: none */
    char author[LIMIT_ID_BYTES + 1];
    char name[AUTHOR_NAME_CHARACTERS + 1]; /* shown to others */
    char *ops;
};

struct room {
    struct hub *hub;
    struct room *next;
    char id[LIMIT_ID_BYTES + 1];
    struct scene *scene;
    struct history *history;
    uint64_t revision, durable;
    size_t bytes;                    /* of the document, printed: at most */
    char epoch[17];                  /* new with each load: revisions may repeat after a crash */
    struct room_entry log[ROOM_LOG]; /* ring: entry of revision r at r % ROOM_LOG */
    uint64_t log_from;               /* the log holds every revision above this one */
    size_t log_bytes;
    struct authors authors;
    void (*destroy)(struct room *room); /* called when it is deleted and nothing is pending */
    struct session *sessions;
    size_t session_count;
    size_t holds;   /* readers without the lock; nobody changes the document meanwhile */
    size_t pending; /* writes not yet committed: the room stays */
    int edits_since_snapshot;
    bool snapshot_soon; /* a task will store a snapshot */
    bool printing;      /* a task will print the document for the worker */
    bool deleted;
    struct shared_buffer *text; /* the printed document; NULL: not known */
    int64_t idle_since;         /* clock_ms; 0: in use */
    struct picker_field picks[PICKER_FIELDS];

    /* What the worker knows of it. */
    uint64_t sent;  /* newest revision sent; 0: the worker does not hold the scene */
    uint64_t shown; /* newest revision that it can draw */
    char image[ASSET_ID_CHARACTERS + 1]; /* file of its environment that the worker was sent last */
    uint64_t settled;                    /* newest revision with a known result: drawable or not */
    int64_t compiling_since;             /* clock_ms; 0: no revision is awaited */
    bool compiling_told;
    bool told_lost;             /* sessions know that the worker is gone */
    int deaths;                 /* workers lost while they drew this scene */
    struct render_demand fatal; /* its work; a finished picture of as much resets `deaths` */
    struct stream_rate rate;    /* over all sessions */
    int patience;               /* factor on the time that a tile may take */
    struct error suspended;     /* why it is not drawn until an edit; ERROR_NONE: it is drawn */
    struct last_good last_good;
    struct shared_buffer *poster; /* the last picture; NULL: none since the room was opened */
    bool poster_stored;
    struct error scene_error; /* why the newest state cannot be drawn; ERROR_NONE: no error known */
    uint64_t scene_error_revision;             /* revision with that error */
    char refused_key[ASSET_ID_CHARACTERS + 1]; /* in quarantine, too slow or crashed */
};

struct room_change {
    const char *author;        /* client id, or "rest" */
    struct author *by;         /* NULL: "rest", which has no edit numbers */
    int64_t edit;              /* 0: none */
    const char *group, *label; /* of the step of undo; may be NULL */
    struct session *session;   /* of the author; NULL: none */
    bool plain;                /* the operations hold no code, as was found without the lock */
    void (*then)(void *data);  /* after the commit, on the store's thread; may be NULL */
    void *data;
};
/* The author's name as others see it. */
const char *room_change_name(const struct room_change *change);

enum room_outcome { ROOM_APPLIED, ROOM_KNOWN /* a repeated edit: nothing changed */, ROOM_REFUSED };

/* The entry of a revision that the log holds: above room->log_from. */
const struct room_entry *room_entry_of(const struct room *room, uint64_t revision);

#endif
