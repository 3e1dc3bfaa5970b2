/* SPDX-License-Identifier: MIT */
/* The inside of the database, for the files store_sqlite*.c. */
#ifndef SERVER_STORE_SQLITE_INTERNAL_H
#define SERVER_STORE_SQLITE_INTERNAL_H

#include <pthread.h>
#include <sqlite3.h>

#include "store_sqlite.h"

struct store_sqlite {
    sqlite3 *writer, *reader;
    sqlite3_stmt **statements; /* of the writer */
    pthread_mutex_t read_lock;
    sqlite3 *finder; /* of single edits: a scene that is being read delays nobody */
    sqlite3_stmt *find_edit;
    pthread_mutex_t find_lock;
    sqlite3 *scanner; /* of all texts, for the same reason */
    pthread_mutex_t scan_lock;
    char damage[200];
};

/* Always false: `what` failed. */
bool store_sqlite_error(sqlite3 *db, const char *what, struct error *err);
/* Statements without parameters and rows. */
bool store_sqlite_execute(sqlite3 *db, const char *sql, struct error *err);
/* NULL: an empty text. It has to stay until the statement has run. */
void store_sqlite_bind_text(sqlite3_stmt *statement, int index, const char *text);

#endif
