/* SPDX-License-Identifier: MIT */
/* One open scene: the document, its revision and history, and who looks at it. The one place where
 * edits get their order. Every function is called under the hub's lock. */
#ifndef SERVER_ROOM_H
#define SERVER_ROOM_H

#include <stdint.h>

#include "authors.h"
#include "fallback.h"
#include "picker.h"
#include "protocol/asset.h"
#include "protocol/edit.h"
#include "protocol/limits.h"
#include "protocol/scene.h"
#include "quarantine.h"
#include "renders.h"
#include "server/net/outbox.h"

struct hub;
struct session;
struct store_loaded;

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
    struct session *sessions;
    size_t session_count;
    size_t holds;   /* who reads the document without the lock: nobody changes it meanwhile */
    size_t pending; /* writes not yet committed: the room stays */
    int edits_since_snapshot;
    bool snapshot_soon; /* a task will store one */
    bool deleted;
    struct blob *text;  /* what the document prints as; NULL: not known */
    int64_t idle_since; /* clock_ms; 0: in use */
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
    double ns_per_pixel;        /* of moving pictures, by all who look: frames.h; 0: none yet */
    int patience;               /* times the usual time that a tile of it may take */
    struct error left_out;      /* why it is not drawn until it is edited; ERROR_NONE: it is */
    struct fallback fallback;
    struct blob *poster; /* the last picture; NULL: none since the room was opened */
    bool poster_stored;
    struct error problem; /* why it cannot be drawn as it is; ERROR_NONE: it can, as far as known */
    uint64_t problem_revision;                  /* that it is about */
    char refused_shape[QUARANTINE_SHAPE_BYTES]; /* of a problem that is too slow, or crashed */
};

/* Takes `scene`. */
struct room *room_create(struct hub *hub, const char *id, struct scene *scene, uint64_t revision);
/* The newest state of what the store holds. */
struct room *room_load(struct hub *hub, const char *id, const struct store_loaded *loaded,
                       struct error *err);
void room_destroy(struct room *room);
/* Queues the creation of a new room's scene, whose text it takes, or its deletion, after which the
 * room frees itself. */
void room_store_new(struct room *room, char *text, void (*then)(void *data), void *data);
void room_store_deleted(struct room *room, void (*then)(void *data), void *data);
/* Queues the key of an author whose edits are older than it. */
void room_store_author(struct room *room, struct author *author);

/* Between these two the document is as it was, without the lock too, and the room stays. */
void room_hold(struct room *room);
void room_release(struct room *room);

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

/* Checks, orders, applies, stores and tells one edit. `then` runs only after ROOM_APPLIED. Nobody
 * may hold the room. Many operations are applied to a copy, for which the lock is let go; only on
 * threads of tasks, where `change` stays valid meanwhile. */
enum room_outcome room_edit(struct room *room, const struct room_change *change, const cJSON *ops,
                            uint64_t *out_revision, struct error *err);
/* `*out_skipped`: operations that were left out because others have set their places since; NULL:
 * none. Of ROOM_REFUSED too. The caller frees it. */
enum room_outcome room_undo(struct room *room, const struct room_change *change, bool redo,
                            uint64_t *out_revision, cJSON **out_skipped, struct error *err);
/* Whether it would let go of the lock: then only on threads of tasks, as with room_edit. */
bool room_undo_is_heavy(const struct room *room, const char *author, bool redo);
/* Puts another document in place; takes `scene` and `text`, which is what it prints as. Returns the
 * one before, to be destroyed; NULL: it is still needed. */
struct scene *room_replace(struct room *room, struct scene *scene, char *text,
                           const struct room_change *change);

/* What the document prints as. One of many nodes is printed without the lock and kept until the
 * next edit; only on threads of tasks then. A text with its NUL; caller unrefs. */
struct blob *room_text(struct room *room);
/* The `document` message, made of room_text; caller unrefs. */
struct blob *room_document_message(struct room *room);
/* The `changed` message of a logged revision for `client`: `edit` only where that is the author.
 * Caller unrefs. */
struct blob *room_changed_message(const struct room *room, uint64_t revision, const char *client);
void room_snapshot(struct room *room);
void room_tell_all(struct room *room, const char *level, const char *code, const char *place,
                   const char *text);

#endif
