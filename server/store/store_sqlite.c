/* SPDX-License-Identifier: MIT */
/* SQLite in WAL mode with synchronous=FULL: each commit is on the disk when it returns. */
#include "store_sqlite.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "store_sqlite_internal.h"

/* What each version of the tables adds to the one before. */
static const char *const schema[] = {
    "CREATE TABLE scenes(id TEXT PRIMARY KEY, name TEXT NOT NULL, revision INTEGER NOT NULL,"
    " nodes INTEGER NOT NULL, modified INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE snapshots(scene TEXT NOT NULL, revision INTEGER NOT NULL,"
    " document TEXT NOT NULL, UNIQUE(scene, revision));"
    "CREATE TABLE edits(scene TEXT NOT NULL, revision INTEGER NOT NULL, author TEXT NOT NULL,"
    " edit INTEGER NOT NULL, time INTEGER NOT NULL, ops TEXT NOT NULL,"
    " PRIMARY KEY(scene, revision)) WITHOUT ROWID;"
    /* An author's edit is in the log once, whatever happens. */
    "CREATE UNIQUE INDEX edits_once ON edits(scene, author, edit) WHERE edit > 0;"
    "CREATE TABLE authors(scene TEXT NOT NULL, author TEXT NOT NULL, edit INTEGER NOT NULL,"
    " PRIMARY KEY(scene, author)) WITHOUT ROWID;"
    "PRAGMA user_version = 1;",
    "CREATE TABLE assets(id TEXT PRIMARY KEY, type TEXT NOT NULL, width INTEGER NOT NULL,"
    " height INTEGER NOT NULL, time INTEGER NOT NULL, bytes BLOB NOT NULL);"
    "PRAGMA user_version = 2;",
    /* What undoes an edit, and how it became a step of undo; nothing at and before scenes.replaced
     * can be undone. */
    "ALTER TABLE edits ADD COLUMN kind INTEGER NOT NULL DEFAULT 0;"
    "ALTER TABLE edits ADD COLUMN undo INTEGER NOT NULL DEFAULT 0;"
    "ALTER TABLE edits ADD COLUMN redo INTEGER NOT NULL DEFAULT 0;"
    "ALTER TABLE edits ADD COLUMN step TEXT NOT NULL DEFAULT '';"
    "ALTER TABLE edits ADD COLUMN label TEXT NOT NULL DEFAULT '';"
    "ALTER TABLE edits ADD COLUMN inverse TEXT NOT NULL DEFAULT '';"
    "ALTER TABLE scenes ADD COLUMN replaced INTEGER NOT NULL DEFAULT 0;"
    "PRAGMA user_version = 3;",
    "CREATE TABLE posters(scene TEXT PRIMARY KEY, bytes BLOB NOT NULL);"
    "PRAGMA user_version = 4;",
    /* Authors are those who have an edit in the log; `key` is a digest. */
    "ALTER TABLE authors ADD COLUMN key TEXT NOT NULL DEFAULT '';"
    "ALTER TABLE authors ADD COLUMN revision INTEGER NOT NULL DEFAULT 0;"
    "UPDATE authors SET revision=coalesce((SELECT max(e.revision) FROM edits e"
    " WHERE e.scene=authors.scene AND e.author=authors.author AND e.edit>0), 0);"
    "DELETE FROM authors WHERE revision=0;"
    "PRAGMA user_version = 5;",
    "CREATE TABLE library(id TEXT PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL,"
    " nodes INTEGER NOT NULL, modified INTEGER NOT NULL, document TEXT NOT NULL) WITHOUT ROWID;"
    "PRAGMA user_version = 6;",
};
enum { SCHEMA_VERSION = sizeof schema / sizeof schema[0] };

/* Parameters of every statement: 1 scene, 2 revision, 3 author, 4 edit, 5 text, 6 name, 7 nodes,
 * 8 time, 9 edits kept; of an asset 10 id, 11 type, 12 width, 13 height, 14 bytes; of an edit's
 * step 15 kind, 16 undo, 17 redo, 18 group, 19 label, 20 inverse; 21 key; 22 kind of an entry. */
enum statement {
    CREATE_SCENE,
    UPDATE_SCENE,
    SET_REPLACED,
    ADD_SNAPSHOT,
    DROP_SNAPSHOTS,
    ADD_EDIT,
    SET_AUTHOR,
    SET_KEY,
    CUT_LOG,
    CUT_AUTHORS,
    DELETE_SCENE,
    DELETE_SNAPSHOTS,
    DELETE_EDITS,
    DELETE_AUTHORS,
    ADD_ASSET,
    DELETE_ASSET,
    SET_POSTER,
    DELETE_POSTER,
    SET_ENTRY,
    DELETE_ENTRY,
    STATEMENT_COUNT
};

static const char *const texts[STATEMENT_COUNT] = {
    [CREATE_SCENE] = "INSERT INTO scenes(id, name, revision, nodes, modified)"
                     " VALUES(?1, ?6, ?2, ?7, ?8)",
    [UPDATE_SCENE] = "UPDATE scenes SET name=?6, revision=?2, nodes=?7, modified=?8 WHERE id=?1",
    [SET_REPLACED] = "UPDATE scenes SET replaced=?2 WHERE id=?1",
    [ADD_SNAPSHOT] = "INSERT OR REPLACE INTO snapshots(scene, revision, document)"
                     " VALUES(?1, ?2, ?5)",
    [DROP_SNAPSHOTS] = "DELETE FROM snapshots WHERE scene=?1 AND revision<?2",
    [ADD_EDIT] = "INSERT INTO edits(scene, revision, author, edit, time, ops, kind, undo,"
                 " redo, step, label, inverse)"
                 " VALUES(?1, ?2, ?3, ?4, ?8, ?5, ?15, ?16, ?17, ?18, ?19, ?20)",
    [SET_AUTHOR] = "INSERT INTO authors(scene, author, edit, key, revision)"
                   " SELECT ?1, ?3, ?4, ?21, ?2 WHERE ?4 > 0"
                   " ON CONFLICT(scene, author) DO UPDATE SET edit=excluded.edit,"
                   " key=excluded.key, revision=excluded.revision",
    [SET_KEY] = "UPDATE authors SET key=?21 WHERE scene=?1 AND author=?3 AND key=''",
    [CUT_LOG] = "DELETE FROM edits WHERE scene=?1 AND revision<=?2-?9",
    [CUT_AUTHORS] = "DELETE FROM authors WHERE scene=?1 AND revision<=?2-?9",
    [DELETE_SCENE] = "DELETE FROM scenes WHERE id=?1",
    [DELETE_SNAPSHOTS] = "DELETE FROM snapshots WHERE scene=?1",
    [DELETE_EDITS] = "DELETE FROM edits WHERE scene=?1",
    [DELETE_AUTHORS] = "DELETE FROM authors WHERE scene=?1",
    /* The scene may have been deleted meanwhile. */
    [SET_POSTER] = "INSERT OR REPLACE INTO posters(scene, bytes) SELECT id, ?14 FROM scenes"
                   " WHERE id=?1",
    [DELETE_POSTER] = "DELETE FROM posters WHERE scene=?1",
    [SET_ENTRY] = "INSERT OR REPLACE INTO library(id, kind, name, nodes, modified, document)"
                  " VALUES(?1, ?22, ?6, ?7, ?8, ?5)",
    [DELETE_ENTRY] = "DELETE FROM library WHERE id=?1",
    [DELETE_ASSET] = "DELETE FROM assets WHERE id=?10",
    [ADD_ASSET] = "INSERT OR IGNORE INTO assets(id, type, width, height, time, bytes)"
                  " VALUES(?10, ?11, ?12, ?13, ?8, ?14)",
};

/* What each kind of write runs. */
static const int steps[][6] = {
    [STORE_CREATE] = {CREATE_SCENE, ADD_SNAPSHOT, -1},
    [STORE_EDIT] = {ADD_EDIT, SET_AUTHOR, UPDATE_SCENE, -1},
    [STORE_REPLACE] = {ADD_SNAPSHOT, DROP_SNAPSHOTS, UPDATE_SCENE, SET_REPLACED, -1},
    [STORE_SNAPSHOT] = {ADD_SNAPSHOT, DROP_SNAPSHOTS, CUT_LOG, CUT_AUTHORS, -1},
    [STORE_AUTHOR] = {SET_KEY, -1},
    [STORE_DELETE] = {DELETE_SCENE, DELETE_SNAPSHOTS, DELETE_EDITS, DELETE_AUTHORS, DELETE_POSTER,
                      -1},
    [STORE_ASSET] = {ADD_ASSET, -1},
    [STORE_ASSET_DELETE] = {DELETE_ASSET, -1},
    [STORE_POSTER] = {SET_POSTER, -1},
    [STORE_LIBRARY] = {SET_ENTRY, -1},
    [STORE_LIBRARY_DELETE] = {DELETE_ENTRY, -1},
};

bool store_sqlite_error(sqlite3 *db, const char *what, struct error *err)
{
    return error_set(err, ERROR_INTERNAL, "store", "%s: %s", what, sqlite3_errmsg(db));
}

bool store_sqlite_execute(sqlite3 *db, const char *sql, struct error *err)
{
    return sqlite3_exec(db, sql, NULL, NULL, NULL) == SQLITE_OK || store_sqlite_error(db, sql, err);
}

static int user_version(sqlite3 *db)
{
    sqlite3_stmt *statement = NULL;
    int version = -1;

    if (sqlite3_prepare_v2(db, "PRAGMA user_version", -1, &statement, NULL) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW) {
        version = sqlite3_column_int(statement, 0);
    }
    sqlite3_finalize(statement);
    return version;
}

/* What PRAGMA quick_check says first, "" for "ok": every page is read, indices are not compared. */
static void look_for_damage(sqlite3 *db, char *out, size_t size)
{
    sqlite3_stmt *statement = NULL;
    int result = sqlite3_prepare_v2(db, "PRAGMA quick_check(1)", -1, &statement, NULL);

    if (result == SQLITE_OK) {
        result = sqlite3_step(statement);
    }
    const char *said =
        result == SQLITE_ROW ? (const char *)sqlite3_column_text(statement, 0) : sqlite3_errmsg(db);
    snprintf(out, size, "%s", said && strcmp(said, "ok") != 0 ? said : "");
    for (char *c = out; *c; c++) {
        *c = *c == '\n' ? ' ' : *c;
    }
    sqlite3_finalize(statement);
}

static bool bring_up_to_date(sqlite3 *db, const char *file, struct error *err)
{
    const int version = user_version(db);

    if (version < 0 || version > SCHEMA_VERSION) {
        return error_set(err, ERROR_INVALID, file, "written by another version: %d, not %d",
                         version, SCHEMA_VERSION);
    }
    for (int i = version; i < SCHEMA_VERSION; i++) {
        if (!store_sqlite_execute(db, "BEGIN IMMEDIATE", err) ||
            !store_sqlite_execute(db, schema[i], err) || !store_sqlite_execute(db, "COMMIT", err)) {
            return false;
        }
    }
    return true;
}

static bool open_writer(struct store_sqlite *db, const char *file, struct error *err)
{
    if (sqlite3_open_v2(file, &db->writer,
                        SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX,
                        NULL) != SQLITE_OK) {
        return store_sqlite_error(db->writer, file, err);
    }
    sqlite3_busy_timeout(db->writer, 5000);
    if (!store_sqlite_execute(db->writer, "PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL",
                              err)) {
        return false;
    }
    if (!bring_up_to_date(db->writer, file, err)) {
        return false;
    }
    for (int i = 0; i < STATEMENT_COUNT; i++) {
        if (sqlite3_prepare_v2(db->writer, texts[i], -1, &db->statements[i], NULL) != SQLITE_OK) {
            return store_sqlite_error(db->writer, texts[i], err);
        }
    }
    return true;
}

static bool open_reader(sqlite3 **out, const char *file, struct error *err)
{
    if (sqlite3_open_v2(file, out, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, NULL) != SQLITE_OK) {
        return store_sqlite_error(*out, file, err);
    }
    sqlite3_busy_timeout(*out, 5000);
    return true;
}

struct store_sqlite *store_sqlite_open(const char *file, struct error *err)
{
    struct store_sqlite *db = memory_alloc(1, sizeof *db);

    db->statements = memory_alloc(STATEMENT_COUNT, sizeof(sqlite3_stmt *));
    pthread_mutex_init(&db->read_lock, NULL);
    pthread_mutex_init(&db->find_lock, NULL);
    pthread_mutex_init(&db->scan_lock, NULL);
    if (!open_writer(db, file, err) || !open_reader(&db->reader, file, err) ||
        !open_reader(&db->finder, file, err) || !open_reader(&db->scanner, file, err)) {
        goto fail;
    }
    look_for_damage(db->writer, db->damage, sizeof db->damage);
    if (sqlite3_prepare_v2(db->finder,
                           "SELECT revision FROM edits"
                           " WHERE scene=?1 AND author=?2 AND edit=?3 AND edit>0",
                           -1, &db->find_edit, NULL) != SQLITE_OK) {
        store_sqlite_error(db->finder, file, err);
        goto fail;
    }
    return db;
fail:
    store_sqlite_close(db);
    return NULL;
}

const char *store_sqlite_damage(const struct store_sqlite *db)
{
    return db->damage;
}

bool store_sqlite_check(const char *file, struct error *err)
{
    char damage[200];
    sqlite3 *db = NULL;
    bool ok = sqlite3_open_v2(file, &db, SQLITE_OPEN_READONLY, NULL) == SQLITE_OK ||
              store_sqlite_error(db, file, err);

    if (ok) {
        sqlite3_busy_timeout(db, 5000);
        look_for_damage(db, damage, sizeof damage);
        ok = !*damage || error_set(err, ERROR_INTERNAL, file, "damaged: %s", damage);
    }
    sqlite3_close(db);
    return ok;
}

void store_sqlite_close(struct store_sqlite *db)
{
    if (!db) {
        return;
    }
    for (int i = 0; i < STATEMENT_COUNT; i++) {
        sqlite3_finalize(db->statements[i]);
    }
    sqlite3_finalize(db->find_edit);
    sqlite3_close(db->finder);
    sqlite3_close(db->scanner);
    sqlite3_close(db->reader);
    sqlite3_close(db->writer); /* the last one checkpoints */
    pthread_mutex_destroy(&db->scan_lock);
    pthread_mutex_destroy(&db->find_lock);
    pthread_mutex_destroy(&db->read_lock);
    free(db->statements);
    free(db);
}

/* --- writing --- */

void store_sqlite_bind_text(sqlite3_stmt *statement, int index, const char *text)
{
    /* A statement that lacks the parameter answers SQLITE_RANGE, which is right. */
    sqlite3_bind_text(statement, index, text ? text : "", -1, SQLITE_STATIC);
}

static void bind_asset(sqlite3_stmt *statement, const struct store_asset *asset)
{
    store_sqlite_bind_text(statement, 10, asset->id);
    store_sqlite_bind_text(statement, 11, asset->info.type);
    sqlite3_bind_int(statement, 12, asset->info.width);
    sqlite3_bind_int(statement, 13, asset->info.height);
    sqlite3_bind_blob64(statement, 14, asset->bytes, asset->length, SQLITE_STATIC);
}

static void bind_step(sqlite3_stmt *statement, const struct store_step *step)
{
    sqlite3_bind_int(statement, 15, step->kind);
    sqlite3_bind_int64(statement, 16, (sqlite3_int64)step->undo);
    sqlite3_bind_int64(statement, 17, (sqlite3_int64)step->redo);
    store_sqlite_bind_text(statement, 18, step->group);
    store_sqlite_bind_text(statement, 19, step->label);
    store_sqlite_bind_text(statement, 20, step->inverse);
}

static bool run_statement(struct store_sqlite *db, int which, const struct store_write *write,
                          struct error *err)
{
    sqlite3_stmt *statement = db->statements[which];

    store_sqlite_bind_text(statement, 1, write->scene);
    sqlite3_bind_int64(statement, 2, (sqlite3_int64)write->revision);
    store_sqlite_bind_text(statement, 3, write->author);
    sqlite3_bind_int64(statement, 4, write->edit);
    store_sqlite_bind_text(statement, 5, write->text);
    store_sqlite_bind_text(statement, 6, write->name);
    sqlite3_bind_int64(statement, 7, (sqlite3_int64)write->nodes);
    sqlite3_bind_int64(statement, 8, write->time_ms);
    sqlite3_bind_int64(statement, 9, STORE_LOG_KEPT);
    bind_step(statement, &write->step);
    store_sqlite_bind_text(statement, 21, write->key);
    store_sqlite_bind_text(statement, 22, write->sort);
    if (write->asset) {
        bind_asset(statement, write->asset);
    }
    const bool ok = sqlite3_step(statement) == SQLITE_DONE;
    if (!ok) {
        error_set(err, ERROR_INTERNAL, write->scene, "revision %llu: %s",
                  (unsigned long long)write->revision, sqlite3_errmsg(db->writer));
    }
    sqlite3_reset(statement);
    sqlite3_clear_bindings(statement);
    return ok;
}

static bool write_one(struct store_sqlite *db, const struct store_write *write, struct error *err)
{
    for (const int *step = steps[write->kind]; *step >= 0; step++) {
        if (!run_statement(db, *step, write, err)) {
            return false;
        }
    }
    return true;
}

bool store_sqlite_commit(struct store_sqlite *db, const struct store_write *writes,
                         struct error *err)
{
    if (!store_sqlite_execute(db->writer, "BEGIN IMMEDIATE", err)) {
        return false;
    }
    for (; writes; writes = writes->next) {
        if (!write_one(db, writes, err)) {
            store_sqlite_execute(db->writer, "ROLLBACK", NULL);
            return false;
        }
    }
    return store_sqlite_execute(db->writer, "COMMIT", err);
}
