/* SPDX-License-Identifier: MIT */
/* Scenes on disk: for each a snapshot of its document, the log of edits since with what undoes
 * them, and who has edits in it; and the files that scenes name. Writes are
 * queued and committed in order by one thread, as many as wait in one transaction; what was told
 * durable survives kill -9 and loss of power. A failed commit ends the program with
 * STORE_EXIT_STATUS: after a failed fsync nothing on disk can be trusted to become durable by
 * trying again. Only store_sqlite.c knows the database. */
#ifndef SERVER_STORE_H
#define SERVER_STORE_H

#include <stdint.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"
#include "server/metrics.h"

enum {
    STORE_EXIT_STATUS = 74, /* EX_IOERR */
    STORE_LOG_KEPT = 10000, /* edits kept before the newest snapshot */
    STORE_PAST = 4096,      /* edits that are read to know what can be undone */
    STORE_PAST_BYTES = 16777216,
};

struct store;

enum store_kind {
    STORE_CREATE,   /* a scene with its first document */
    STORE_EDIT,     /* an entry of the log */
    STORE_REPLACE,  /* a new document at a new revision */
    STORE_SNAPSHOT, /* the document at a revision that the log has reached */
    STORE_AUTHOR,   /* the key of an author that has none yet */
    STORE_DELETE,
    STORE_ASSET,        /* a file, once */
    STORE_ASSET_DELETE, /* it is named by its id in `asset`, without bytes */
    STORE_POSTER,       /* the scene's last picture, in `asset`; what it was before is gone */
};

/* A file that scenes name by its SHA-256. */
struct store_asset {
    char id[ASSET_ID_CHARACTERS + 1];
    struct asset_info info;
    size_t length;
    void *bytes; /* NULL in a list */
};

/* What an edit means for undo, as in struct history_entry. Owned. */
struct store_step {
    int kind; /* enum history_kind */
    size_t undo, redo;
    char *group, *label;
    char *inverse; /* NULL: it cannot be undone */
};
void store_step_finish(struct store_step *step);

struct store_write {
    enum store_kind kind;
    char scene[LIMIT_ID_BYTES + 1];
    uint64_t revision;
    char author[LIMIT_ID_BYTES + 1];
    char key[ASSET_ID_CHARACTERS + 1]; /* digest of the author's; "": none */
    int64_t edit;                      /* the author's number; 0: none */
    char *text;                        /* owned: operations of an edit, else the document */
    struct store_step step;            /* of STORE_EDIT; owned */
    char *name; /* owned: the scene's name now; NULL for STORE_SNAPSHOT and STORE_DELETE */
    size_t nodes;
    struct store_asset *asset; /* owned, with its bytes: of STORE_ASSET and STORE_POSTER */
    int64_t time_ms;           /* since 1970 */
    /* On the writer's thread after the commit; may be NULL. */
    void (*on_durable)(void *data);
    void *data;
    struct store_write *next; /* the store's */
};

/* A row of the list of scenes. */
struct store_scene {
    const char *id, *name;
    uint64_t revision;
    size_t nodes;
    int64_t modified_ms;
};

struct store_edit {
    uint64_t revision;
    char author[LIMIT_ID_BYTES + 1];
    int64_t edit;
    char *ops;
    struct store_step step;
};
/* Somebody with an edit in the log. */
struct store_author {
    char author[LIMIT_ID_BYTES + 1];
    char key[ASSET_ID_CHARACTERS + 1]; /* digest; "": from before there were keys */
    int64_t edit;                      /* the newest number */
    uint64_t revision;                 /* that it made */
};
/* What store_load found: a document, the edits that come after it in order, and the newest edits
 * with what undoes them, from before and after the document's revision. */
struct store_loaded {
    char *document;
    uint64_t revision; /* of `document` */
    struct store_edit *edits;
    size_t edit_count;
    struct store_edit *past;
    size_t past_count;
    size_t past_bytes;
    struct store_author *authors; /* by revision */
    size_t author_count;
};
void store_loaded_finish(struct store_loaded *loaded);

/* Makes the directory when it is missing and takes hold of it against other processes. */
struct store *store_open(const char *directory, struct metrics *metrics, struct error *err);
/* What is wrong with the database, as it was found at the start; "": nothing. */
const char *store_damage(const struct store *store);
/* Looks for damage in a directory that a store may have open. No database is no damage. */
bool store_check(const char *directory, struct error *err);
/* Commits what is queued, then closes. */
void store_close(struct store *store);
/* Calls `each` for every scene, by id. */
bool store_list(struct store *store, void (*each)(void *data, const struct store_scene *scene),
                void *data, struct error *err);
/* Any thread; sees what is committed. */
bool store_load(struct store *store, const char *scene, struct store_loaded *out,
                struct error *err);
/* The revision that an author's edit made, among what is committed; 0: it is not in the log. Any
 * thread; one row by its index, and no wait for other readers. */
bool store_find_edit(struct store *store, const char *scene, const char *author, int64_t edit,
                     uint64_t *out_revision, struct error *err);
/* Calls `each` for every file, oldest first, without its bytes. */
bool store_list_assets(struct store *store,
                       void (*each)(void *data, const struct store_asset *asset), void *data,
                       struct error *err);
/* Calls `each` for all that scenes are made of: the newest document of each and, as JSON, the edits
 * behind it. */
bool store_list_texts(struct store *store,
                      void (*each)(void *data, const char *scene, const char *text), void *data,
                      struct error *err);
/* Any thread; the caller frees the bytes. */
bool store_load_asset(struct store *store, const char *id, void **out_bytes, size_t *out_length,
                      struct error *err);
/* The scene's last picture, a JPEG; as store_load_asset. */
bool store_load_poster(struct store *store, const char *scene, void **out_bytes, size_t *out_length,
                       struct error *err);
/* Any thread; takes a `write` from the heap, with its texts. Never waits. */
void store_push(struct store *store, struct store_write *write);
/* Waits until everything pushed before is committed and told. */
void store_flush(struct store *store);

#endif
