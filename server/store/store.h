/* SPDX-License-Identifier: MIT */
/* The store: scenes, uploaded files and the library on disk. A scene has a snapshot of its
 * document, the log of later edits with their inverses, and the authors of these edits. One thread
 * commits the queued writes in order; all waiting writes share a transaction. A write that was told
 * durable survives kill -9 and loss of power. A failed commit ends the program with
 * STORE_EXIT_STATUS, because a repeated fsync after a failed one proves nothing. Only
 * store_sqlite.c knows the database. */
#ifndef SERVER_STORE_H
#define SERVER_STORE_H

#include <stdint.h>

#include "protocol/asset.h"
#include "protocol/error.h"
#include "protocol/limits.h"
#include "server/metrics.h"

enum {
    STORE_EXIT_STATUS = 74, /* EX_IOERR */
    STORE_LOG_KEPT = 10000, /* edits kept from before the newest snapshot */
    STORE_PAST = 4096,      /* edits read at a load for undo and redo */
    STORE_PAST_BYTES = 16777216,
};

struct store;

enum store_kind {
    STORE_CREATE,   /* a scene with its first document */
    STORE_EDIT,     /* an entry of the log */
    STORE_REPLACE,  /* a new document at a new revision */
    STORE_SNAPSHOT, /* the document at a revision that the log has reached */
    STORE_AUTHOR,   /* the key of an author who has none */
    STORE_DELETE,
    STORE_ASSET,        /* a new file */
    STORE_ASSET_DELETE, /* `asset` has its id and no bytes */
    STORE_POSTER,       /* the scene's last picture, in `asset`; replaces the old one */
    STORE_LIBRARY,      /* an entry of the library, `scene` is its id; replaces the old one */
    STORE_LIBRARY_DELETE,
};

/* A file that scenes name by its SHA-256. */
struct store_asset {
    char id[ASSET_ID_CHARACTERS + 1];
    struct asset_info info;
    size_t length;
    void *bytes; /* NULL in a list */
};

/* The data of an edit for undo, as in struct history_entry. All texts are owned. */
struct store_step {
    int kind; /* enum history_kind */
    size_t undo, redo;
    char *group, *label;
    char *inverse; /* NULL: the edit cannot be undone */
};
void store_step_finish(struct store_step *step);

struct store_write {
    enum store_kind kind;
    char scene[LIMIT_ID_BYTES + 1];
    uint64_t revision;
    char author[LIMIT_ID_BYTES + 1];
    char key[ASSET_ID_CHARACTERS + 1]; /* digest of the author's key; "": none */
    int64_t edit;                      /* the author's number; 0: none */
    char *text;                        /* owned: the operations of an edit, or the document */
    struct store_step step;            /* for STORE_EDIT; owned */
    char *name; /* owned: the scene's new name; NULL for STORE_SNAPSHOT and STORE_DELETE */
    size_t nodes;
    struct store_asset *asset; /* owned, with its bytes: for STORE_ASSET and STORE_POSTER */
    const char *sort;          /* static: the kind of an entry of the library */
    int64_t time_ms;           /* since 1970 */
    /* Called on the writer's thread after the commit; may be NULL. */
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

/* An entry of the library. */
struct store_entry {
    const char *id, *kind, *name, *document;
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
/* An author with an edit in the log. */
struct store_author {
    char author[LIMIT_ID_BYTES + 1];
    char key[ASSET_ID_CHARACTERS + 1]; /* digest of the key; "": older than keys */
    int64_t edit;                      /* the newest edit number */
    uint64_t revision;                 /* which that edit made */
};
/* The result of store_load: a document, the later edits in order (`edits`), and the newest edits of
 * any revision with their inverses (`past`). */
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

/* Creates the directory if needed and locks it against other processes. */
struct store *store_open(const char *directory, struct metrics *metrics, struct error *err);
/* The damage of the database that was found at the start; "": none. */
const char *store_damage(const struct store *store);
/* Checks a directory for damage. A store may have it open. A missing database is no damage. */
bool store_check(const char *directory, struct error *err);
/* Commits what is queued, then closes. */
void store_close(struct store *store);
/* Calls `each` for every scene, in the order of ids. */
bool store_list(struct store *store, void (*each)(void *data, const struct store_scene *scene),
                void *data, struct error *err);
/* Loads the committed state of a scene. Any thread. */
bool store_load(struct store *store, const char *scene, struct store_loaded *out,
                struct error *err);
/* The revision that an author's edit made; 0: the edit is not in the committed log. Any thread.
 * Reads one row by its index and does not wait for other readers. */
bool store_find_edit(struct store *store, const char *scene, const char *author, int64_t edit,
                     uint64_t *out_revision, struct error *err);
/* Calls `each` for every file, oldest first, without its bytes. */
bool store_list_assets(struct store *store,
                       void (*each)(void *data, const struct store_asset *asset), void *data,
                       struct error *err);
/* Calls `each` for the texts of all scenes: the newest document of each, and its later edits as
 * JSON. */
bool store_list_texts(struct store *store,
                      void (*each)(void *data, const char *scene, const char *text), void *data,
                      struct error *err);
/* Loads a file. Any thread; the caller frees the bytes. */
bool store_load_asset(struct store *store, const char *id, void **out_bytes, size_t *out_length,
                      struct error *err);
/* The scene's last picture, a JPEG; as store_load_asset. */
bool store_load_poster(struct store *store, const char *scene, void **out_bytes, size_t *out_length,
                       struct error *err);
/* Calls `each` for every entry of the library, in the order of ids. */
bool store_list_library(struct store *store,
                        void (*each)(void *data, const struct store_entry *entry), void *data,
                        struct error *err);
/* Queues a write. Any thread; never waits. Takes `write`, which is on the heap, with its texts. */
void store_push(struct store *store, struct store_write *write);
/* The same for writes that are linked by `next`: all or none of them are committed. */
void store_push_all(struct store *store, struct store_write *first);
/* Waits until all earlier writes are committed and their on_durable has run. */
void store_flush(struct store *store);

#endif
