/* SPDX-License-Identifier: MIT */
/* The SQLite database of the store. There is one writer thread and any number of readers, which
 * share a lock of their own. */
#ifndef SERVER_STORE_SQLITE_H
#define SERVER_STORE_SQLITE_H

#include "store.h"

struct store_sqlite;

struct store_sqlite *store_sqlite_open(const char *file, struct error *err);
/* See store_damage and store_check. */
const char *store_sqlite_damage(const struct store_sqlite *db);
bool store_sqlite_check(const char *file, struct error *err);
void store_sqlite_close(struct store_sqlite *db);
/* Commits the whole list in one transaction. False: the database has none of it. */
bool store_sqlite_commit(struct store_sqlite *db, const struct store_write *writes,
                         struct error *err);
bool store_sqlite_list(struct store_sqlite *db,
                       void (*each)(void *data, const struct store_scene *scene), void *data,
                       struct error *err);
bool store_sqlite_load(struct store_sqlite *db, const char *scene, struct store_loaded *out,
                       struct error *err);
bool store_sqlite_find_edit(struct store_sqlite *db, const char *scene, const char *author,
                            int64_t edit, uint64_t *out_revision, struct error *err);
bool store_sqlite_list_assets(struct store_sqlite *db,
                              void (*each)(void *data, const struct store_asset *asset), void *data,
                              struct error *err);
bool store_sqlite_list_texts(struct store_sqlite *db,
                             void (*each)(void *data, const char *scene, const char *text),
                             void *data, struct error *err);
bool store_sqlite_list_library(struct store_sqlite *db,
                               void (*each)(void *data, const struct store_entry *entry),
                               void *data, struct error *err);
bool store_sqlite_load_asset(struct store_sqlite *db, const char *id, void **out_bytes,
                             size_t *out_length, struct error *err);
bool store_sqlite_load_poster(struct store_sqlite *db, const char *scene, void **out_bytes,
                              size_t *out_length, struct error *err);

#endif
