/* SPDX-License-Identifier: MIT */
/* What the database holds: scenes with their logs, the library, files. */
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "store_sqlite_internal.h"

static char *column_text(sqlite3_stmt *statement, int column)
{
    return memory_text((const char *)sqlite3_column_text(statement, column));
}

/* An id, or a digest, which is as long. */
static void column_id(sqlite3_stmt *statement, int column, char out[LIMIT_ID_BYTES + 1])
{
    snprintf(out, LIMIT_ID_BYTES + 1, "%s", (const char *)sqlite3_column_text(statement, column));
}
_Static_assert((int)ASSET_ID_CHARACTERS == (int)LIMIT_ID_BYTES, "column_id reads both");

/* Calls `row` for each row; `scene` is parameter 1 where the statement has one. */
static bool query_on(sqlite3 *reader, const char *sql, const char *scene, int64_t number,
                     void (*row)(void *data, sqlite3_stmt *statement), void *data,
                     struct error *err)
{
    sqlite3_stmt *statement = NULL;
    int result = sqlite3_prepare_v2(reader, sql, -1, &statement, NULL);

    if (result == SQLITE_OK) {
        store_sqlite_bind_text(statement, 1, scene);
        sqlite3_bind_int64(statement, 2, number);
        while ((result = sqlite3_step(statement)) == SQLITE_ROW) {
            row(data, statement);
        }
    }
    if (result != SQLITE_DONE) {
        store_sqlite_error(reader, sql, err);
    }
    sqlite3_finalize(statement);
    return result == SQLITE_DONE;
}

static bool query(struct store_sqlite *db, const char *sql, const char *scene, int64_t number,
                  void (*row)(void *data, sqlite3_stmt *statement), void *data, struct error *err)
{
    return query_on(db->reader, sql, scene, number, row, data, err);
}

struct list_call {
    void (*each)(void *data, const struct store_scene *scene);
    void *data;
};

static void list_row(void *data, sqlite3_stmt *statement)
{
    struct list_call *call = data;
    struct store_scene scene = {
        .id = (const char *)sqlite3_column_text(statement, 0),
        .name = (const char *)sqlite3_column_text(statement, 1),
        .revision = (uint64_t)sqlite3_column_int64(statement, 2),
        .nodes = (size_t)sqlite3_column_int64(statement, 3),
        .modified_ms = sqlite3_column_int64(statement, 4),
    };

    call->each(call->data, &scene);
}

bool store_sqlite_list(struct store_sqlite *db,
                       void (*each)(void *data, const struct store_scene *scene), void *data,
                       struct error *err)
{
    struct list_call call = {each, data};

    pthread_mutex_lock(&db->read_lock);
    const bool ok = query(db, "SELECT id, name, revision, nodes, modified FROM scenes ORDER BY id",
                          "", 0, list_row, &call, err);
    pthread_mutex_unlock(&db->read_lock);
    return ok;
}

static void document_row(void *data, sqlite3_stmt *statement)
{
    struct store_loaded *loaded = data;

    loaded->revision = (uint64_t)sqlite3_column_int64(statement, 0);
    loaded->document = column_text(statement, 1);
}

static struct store_edit *add_edit(struct store_edit **edits, size_t *count,
                                   sqlite3_stmt *statement)
{
    *edits = memory_one_more(*edits, *count, sizeof(**edits));
    struct store_edit *edit = &(*edits)[(*count)++];
    *edit = (struct store_edit){
        .revision = (uint64_t)sqlite3_column_int64(statement, 0),
        .edit = sqlite3_column_int64(statement, 2),
        .ops = column_text(statement, 3),
    };
    column_id(statement, 1, edit->author);
    return edit;
}

static void edit_row(void *data, sqlite3_stmt *statement)
{
    struct store_loaded *loaded = data;

    add_edit(&loaded->edits, &loaded->edit_count, statement);
}

/* Newest first; what lies before the first that is too much stays unread. */
static void past_row(void *data, sqlite3_stmt *statement)
{
    struct store_loaded *loaded = data;

    loaded->past_bytes +=
        (size_t)sqlite3_column_bytes(statement, 3) + (size_t)sqlite3_column_bytes(statement, 9);
    if (loaded->past_bytes > STORE_PAST_BYTES) {
        return;
    }
    struct store_edit *edit = add_edit(&loaded->past, &loaded->past_count, statement);
    edit->step = (struct store_step){
        .kind = sqlite3_column_int(statement, 4),
        .undo = (size_t)sqlite3_column_int64(statement, 5),
        .redo = (size_t)sqlite3_column_int64(statement, 6),
        .group = column_text(statement, 7),
        .label = column_text(statement, 8),
        .inverse = column_text(statement, 9),
    };
}

static void turn_round(struct store_edit *edits, size_t count)
{
    for (size_t i = 0; i < count / 2; i++) {
        const struct store_edit edit = edits[i];

        edits[i] = edits[count - 1 - i];
        edits[count - 1 - i] = edit;
    }
}

static bool load_past(struct store_sqlite *db, const char *scene, struct store_loaded *out,
                      struct error *err)
{
    const bool ok = query(db,
                          "SELECT e.revision, e.author, e.edit, e.ops, e.kind, e.undo, e.redo,"
                          " e.step, e.label, e.inverse FROM edits e JOIN scenes s ON s.id=e.scene"
                          " WHERE e.scene=?1 AND e.revision>s.replaced AND e.inverse<>''"
                          " ORDER BY e.revision DESC LIMIT ?2",
                          scene, STORE_PAST, past_row, out, err);

    turn_round(out->past, out->past_count);
    return ok;
}

static void author_row(void *data, sqlite3_stmt *statement)
{
    struct store_loaded *loaded = data;

    loaded->authors =
        memory_one_more(loaded->authors, loaded->author_count, sizeof *loaded->authors);
    struct store_author *author = &loaded->authors[loaded->author_count++];
    column_id(statement, 0, author->author);
    author->edit = sqlite3_column_int64(statement, 1);
    column_id(statement, 2, author->key);
    author->revision = (uint64_t)sqlite3_column_int64(statement, 3);
}

static bool load_rows(struct store_sqlite *db, const char *scene, struct store_loaded *out,
                      struct error *err)
{
    if (!query(db,
               "SELECT revision, document FROM snapshots WHERE scene=?1"
               " ORDER BY revision DESC LIMIT 1",
               scene, 0, document_row, out, err)) {
        return false;
    }
    if (!out->document) {
        return error_set(err, ERROR_NOT_FOUND, scene, "there is no such scene");
    }
    return query(db,
                 "SELECT revision, author, edit, ops FROM edits WHERE scene=?1 AND revision>?2"
                 " ORDER BY revision",
                 scene, (int64_t)out->revision, edit_row, out, err) &&
           load_past(db, scene, out, err) &&
           query(db,
                 "SELECT author, edit, key, revision FROM authors WHERE scene=?1"
                 " ORDER BY revision",
                 scene, 0, author_row, out, err);
}

bool store_sqlite_load(struct store_sqlite *db, const char *scene, struct store_loaded *out,
                       struct error *err)
{
    memset(out, 0, sizeof *out);
    pthread_mutex_lock(&db->read_lock);
    /* One transaction: the three queries see one state. */
    const bool ok =
        store_sqlite_execute(db->reader, "BEGIN", err) && load_rows(db, scene, out, err);
    store_sqlite_execute(db->reader, "COMMIT", NULL);
    pthread_mutex_unlock(&db->read_lock);
    if (!ok) {
        store_loaded_finish(out);
    }
    return ok;
}

bool store_sqlite_find_edit(struct store_sqlite *db, const char *scene, const char *author,
                            int64_t edit, uint64_t *out_revision, struct error *err)
{
    pthread_mutex_lock(&db->find_lock);
    store_sqlite_bind_text(db->find_edit, 1, scene);
    store_sqlite_bind_text(db->find_edit, 2, author);
    sqlite3_bind_int64(db->find_edit, 3, edit);
    const int result = sqlite3_step(db->find_edit);
    const bool ok = result == SQLITE_ROW || result == SQLITE_DONE;
    if (ok) {
        *out_revision = result == SQLITE_ROW ? (uint64_t)sqlite3_column_int64(db->find_edit, 0) : 0;
    } else {
        store_sqlite_error(db->finder, "finding an edit", err);
    }
    sqlite3_reset(db->find_edit);
    sqlite3_clear_bindings(db->find_edit);
    pthread_mutex_unlock(&db->find_lock);
    return ok;
}

struct text_call {
    void (*each)(void *data, const char *scene, const char *text);
    void *data;
};

static void text_row(void *data, sqlite3_stmt *statement)
{
    struct text_call *call = data;

    call->each(call->data, (const char *)sqlite3_column_text(statement, 0),
               (const char *)sqlite3_column_text(statement, 1));
}

bool store_sqlite_list_texts(struct store_sqlite *db,
                             void (*each)(void *data, const char *scene, const char *text),
                             void *data, struct error *err)
{
    struct text_call call = {each, data};

    pthread_mutex_lock(&db->scan_lock);
    const bool ok = query_on(db->scanner,
                             "SELECT scene, document FROM snapshots AS s WHERE revision ="
                             " (SELECT max(revision) FROM snapshots WHERE scene = s.scene)"
                             " UNION ALL SELECT scene, ops FROM edits AS e WHERE revision >"
                             " (SELECT max(revision) FROM snapshots WHERE scene = e.scene)",
                             "", 0, text_row, &call, err);
    pthread_mutex_unlock(&db->scan_lock);
    return ok;
}

/* --- the library --- */

struct entry_call {
    void (*each)(void *data, const struct store_entry *entry);
    void *data;
};

static void entry_row(void *data, sqlite3_stmt *statement)
{
    struct entry_call *call = data;
    struct store_entry entry = {
        .id = (const char *)sqlite3_column_text(statement, 0),
        .kind = (const char *)sqlite3_column_text(statement, 1),
        .name = (const char *)sqlite3_column_text(statement, 2),
        .nodes = (size_t)sqlite3_column_int64(statement, 3),
        .modified_ms = sqlite3_column_int64(statement, 4),
        .document = (const char *)sqlite3_column_text(statement, 5),
    };

    call->each(call->data, &entry);
}

bool store_sqlite_list_library(struct store_sqlite *db,
                               void (*each)(void *data, const struct store_entry *entry),
                               void *data, struct error *err)
{
    struct entry_call call = {each, data};

    pthread_mutex_lock(&db->read_lock);
    const bool ok =
        query(db, "SELECT id, kind, name, nodes, modified, document FROM library ORDER BY id", "",
              0, entry_row, &call, err);
    pthread_mutex_unlock(&db->read_lock);
    return ok;
}

/* --- files --- */

struct asset_call {
    void (*each)(void *data, const struct store_asset *asset);
    void *data;
};

static void asset_row(void *data, sqlite3_stmt *statement)
{
    struct asset_call *call = data;
    struct store_asset asset = {
        .info = {.type = (const char *)sqlite3_column_text(statement, 1),
                 .width = sqlite3_column_int(statement, 2),
                 .height = sqlite3_column_int(statement, 3)},
        .length = (size_t)sqlite3_column_int64(statement, 4),
    };

    column_id(statement, 0, asset.id);
    call->each(call->data, &asset);
}

bool store_sqlite_list_assets(struct store_sqlite *db,
                              void (*each)(void *data, const struct store_asset *asset), void *data,
                              struct error *err)
{
    struct asset_call call = {each, data};

    pthread_mutex_lock(&db->read_lock);
    const bool ok =
        query(db, "SELECT id, type, width, height, length(bytes) FROM assets ORDER BY rowid", "", 0,
              asset_row, &call, err);
    pthread_mutex_unlock(&db->read_lock);
    return ok;
}

struct bytes_call {
    void *bytes;
    size_t length;
};

static void bytes_row(void *data, sqlite3_stmt *statement)
{
    struct bytes_call *call = data;

    call->length = (size_t)sqlite3_column_bytes(statement, 0);
    call->bytes = memory_alloc(call->length, 1);
    memcpy(call->bytes, sqlite3_column_blob(statement, 0), call->length);
}

static bool load_bytes(struct store_sqlite *db, const char *sql, const char *id, const char *what,
                       void **out_bytes, size_t *out_length, struct error *err)
{
    struct bytes_call call = {0};

    pthread_mutex_lock(&db->read_lock);
    bool ok = query(db, sql, id, 0, bytes_row, &call, err);
    pthread_mutex_unlock(&db->read_lock);
    if (ok && !call.bytes) {
        ok = error_set(err, ERROR_NOT_FOUND, "", "there is no %s %s", what, id);
    }
    *out_bytes = call.bytes;
    *out_length = call.length;
    return ok;
}

bool store_sqlite_load_asset(struct store_sqlite *db, const char *id, void **out_bytes,
                             size_t *out_length, struct error *err)
{
    return load_bytes(db, "SELECT bytes FROM assets WHERE id=?1", id, "asset", out_bytes,
                      out_length, err);
}

bool store_sqlite_load_poster(struct store_sqlite *db, const char *scene, void **out_bytes,
                              size_t *out_length, struct error *err)
{
    return load_bytes(db, "SELECT bytes FROM posters WHERE scene=?1", scene, "picture of",
                      out_bytes, out_length, err);
}
