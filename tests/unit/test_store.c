/* SPDX-License-Identifier: MIT */
/* What the store keeps, and that a commit is all or nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <sqlite3.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "server/store/store.h"
#include "server/store/store_sqlite.h"

static char directory[] = "/tmp/fieldcast-store-XXXXXX";
static struct metrics metrics;

static struct store_write write_of(enum store_kind kind, const char *scene, uint64_t revision,
                                   const char *author, int64_t edit, const char *text)
{
    struct store_write write = {.kind = kind,
                                .revision = revision,
                                .edit = edit,
                                .text = (char *)text,
                                .name = "name",
                                .nodes = 3};

    snprintf(write.scene, sizeof write.scene, "%s", scene);
    snprintf(write.author, sizeof write.author, "%s", author);
    return write;
}

static struct store_sqlite *open_database(const char *name)
{
    char path[200];
    struct error err = {0};

    snprintf(path, sizeof path, "%s/%s", directory, name);
    struct store_sqlite *db = store_sqlite_open(path, &err);
    assert_non_null(db);
    return db;
}

static bool commit_one(struct store_sqlite *db, struct store_write write)
{
    return store_sqlite_commit(db, &write, NULL);
}

static void gives_back_document_edits_and_authors(void **state)
{
    struct store_sqlite *db = open_database("a.sqlite");
    struct store_loaded loaded;

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "s", 1, "", 0, "first")));
    assert_true(commit_one(db, write_of(STORE_EDIT, "s", 2, "ann", 1, "[1]")));
    assert_true(commit_one(db, write_of(STORE_EDIT, "s", 3, "rest", 0, "[2]")));
    assert_true(commit_one(db, write_of(STORE_EDIT, "s", 4, "ann", 2, "[3]")));
    store_sqlite_close(db);
    db = open_database("a.sqlite");
    assert_true(store_sqlite_load(db, "s", &loaded, NULL));
    assert_string_equal(loaded.document, "first");
    assert_int_equal(loaded.edit_count, 3);
    assert_int_equal(loaded.edits[2].revision, 4);
    assert_string_equal(loaded.edits[2].ops, "[3]");
    assert_int_equal(loaded.author_count, 1);
    assert_string_equal(loaded.authors[0].author, "ann");
    assert_int_equal(loaded.authors[0].edit, 2);
    assert_int_equal(loaded.authors[0].revision, 4);
    store_loaded_finish(&loaded);

    assert_true(commit_one(db, write_of(STORE_SNAPSHOT, "s", 3, "", 0, "third")));
    assert_true(store_sqlite_load(db, "s", &loaded, NULL));
    assert_string_equal(loaded.document, "third");
    assert_int_equal(loaded.revision, 3);
    assert_int_equal(loaded.edit_count, 1);
    store_loaded_finish(&loaded);

    assert_true(commit_one(db, write_of(STORE_DELETE, "s", 4, "", 0, NULL)));
    struct error err = {0};
    assert_false(store_sqlite_load(db, "s", &loaded, &err));
    assert_int_equal(err.kind, ERROR_NOT_FOUND);
    store_sqlite_close(db);
}

/* An author's number twice, or a revision twice, is a fault of ours: nothing of the batch stays. */
static struct store_write step_of(uint64_t revision, const char *group, const char *inverse)
{
    struct store_write write =
        write_of(STORE_EDIT, "past", revision, "ann", (int64_t)revision, "[1]");

    write.step = (struct store_step){.kind = 1,
                                     .undo = 7,
                                     .redo = 9,
                                     .group = (char *)group,
                                     .label = "move",
                                     .inverse = (char *)inverse};
    return write;
}

/* Back to the newest document that was put in the place of another. */
static void gives_back_what_undoes(void **state)
{
    struct store_sqlite *db = open_database("p.sqlite");
    struct store_loaded loaded;

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "past", 1, "", 0, "first")));
    assert_true(commit_one(db, step_of(2, "g", "[2]")));
    assert_true(commit_one(db, write_of(STORE_REPLACE, "past", 3, "", 0, "second")));
    assert_true(commit_one(db, step_of(4, "g", "[4]")));
    assert_true(commit_one(db, step_of(5, "", "[5]")));
    assert_true(commit_one(db, write_of(STORE_SNAPSHOT, "past", 5, "", 0, "third")));
    assert_true(commit_one(db, step_of(6, "", NULL))); /* cannot be undone */
    assert_true(commit_one(db, step_of(7, "", "[7]")));
    assert_true(store_sqlite_load(db, "past", &loaded, NULL));
    assert_int_equal(loaded.edit_count, 2);
    assert_int_equal(loaded.past_count, 3);
    assert_int_equal(loaded.past[0].revision, 4);
    assert_int_equal(loaded.past[2].revision, 7);
    assert_string_equal(loaded.past[0].step.inverse, "[4]");
    assert_string_equal(loaded.past[0].step.group, "g");
    assert_string_equal(loaded.past[0].step.label, "move");
    assert_int_equal(loaded.past[0].step.kind, 1);
    assert_int_equal(loaded.past[0].step.undo, 7);
    assert_int_equal(loaded.past[0].step.redo, 9);
    store_loaded_finish(&loaded);
    store_sqlite_close(db);
}

/* The newest; and none of a scene that is gone. */
static void gives_back_posters(void **state)
{
    struct store_sqlite *db = open_database("q.sqlite");
    struct store_asset picture = {.bytes = (void *)"first", .length = 5};
    struct store_write write = write_of(STORE_POSTER, "s", 0, "", 0, NULL);
    size_t length = 0;
    void *bytes = NULL;

    (void)state;
    write.asset = &picture;
    assert_true(commit_one(db, write));
    assert_false(store_sqlite_load_poster(db, "s", &bytes, &length, NULL));
    assert_true(commit_one(db, write_of(STORE_CREATE, "s", 1, "", 0, "document")));
    assert_true(commit_one(db, write));
    picture.bytes = (void *)"other";
    assert_true(commit_one(db, write));
    assert_true(store_sqlite_load_poster(db, "s", &bytes, &length, NULL));
    assert_int_equal(length, 5);
    assert_memory_equal(bytes, "other", 5);
    free(bytes);
    assert_true(commit_one(db, write_of(STORE_DELETE, "s", 2, "", 0, NULL)));
    assert_false(store_sqlite_load_poster(db, "s", &bytes, &length, NULL));
    store_sqlite_close(db);
}

static void a_commit_is_all_or_nothing(void **state)
{
    struct store_sqlite *db = open_database("b.sqlite");
    struct store_loaded loaded;
    struct error err = {0};

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "s", 1, "", 0, "first")));
    struct store_write again = write_of(STORE_EDIT, "s", 3, "ann", 1, "[2]");
    struct store_write once = write_of(STORE_EDIT, "s", 2, "ann", 1, "[1]");
    once.next = &again;
    assert_false(store_sqlite_commit(db, &once, &err));
    assert_true(strstr(err.message, "UNIQUE") != NULL);
    assert_true(store_sqlite_load(db, "s", &loaded, NULL));
    assert_int_equal(loaded.edit_count, 0);
    assert_int_equal(loaded.author_count, 0);
    store_loaded_finish(&loaded);
    snprintf(again.author, sizeof again.author, "bob");
    assert_true(store_sqlite_commit(db, &once, &err));
    store_sqlite_close(db);
}

static uint64_t find_edit(struct store_sqlite *db, const char *author, int64_t edit)
{
    uint64_t revision = 99;

    assert_true(store_sqlite_find_edit(db, "s", author, edit, &revision, NULL));
    return revision;
}

static void finds_single_edits(void **state)
{
    struct store_sqlite *db = open_database("f.sqlite");

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "s", 1, "", 0, "first")));
    assert_true(commit_one(db, write_of(STORE_EDIT, "s", 2, "ann", 7, "[1]")));
    assert_true(commit_one(db, write_of(STORE_EDIT, "s", 3, "rest", 0, "[2]")));
    assert_int_equal(find_edit(db, "ann", 7), 2);
    assert_int_equal(find_edit(db, "ann", 6), 0);
    assert_int_equal(find_edit(db, "bob", 7), 0);
    assert_int_equal(find_edit(db, "rest", 0), 0);
    assert_true(commit_one(db, write_of(STORE_DELETE, "s", 3, "", 0, NULL)));
    assert_int_equal(find_edit(db, "ann", 7), 0);
    store_sqlite_close(db);
}

/* Each edit is of another author; of all that there ever were those of the log are kept. */
static void keeps_the_authors_of_the_log(void **state)
{
    struct store_sqlite *db = open_database("g.sqlite");
    struct store_loaded loaded;
    const uint64_t last = STORE_LOG_KEPT + 500;
    char author[16];

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "s", 1, "", 0, "first")));
    struct store_write *writes = memory_alloc((size_t)last, sizeof *writes);
    for (uint64_t revision = 2; revision <= last; revision++) {
        snprintf(author, sizeof author, "%u", (unsigned)revision);
        writes[revision - 2] = write_of(STORE_EDIT, "s", revision, author, 1, "[]");
        writes[revision - 2].next = revision < last ? &writes[revision - 1] : NULL;
    }
    assert_true(store_sqlite_commit(db, writes, NULL));
    free(writes);
    assert_true(commit_one(db, write_of(STORE_SNAPSHOT, "s", last, "", 0, "last")));
    assert_true(store_sqlite_load(db, "s", &loaded, NULL));
    assert_int_equal(loaded.author_count, STORE_LOG_KEPT);
    assert_int_equal(loaded.authors[0].revision, last - STORE_LOG_KEPT + 1);
    store_loaded_finish(&loaded);
    /* Nothing of a forgotten one is left that its numbers could meet. */
    assert_int_equal(find_edit(db, "2", 1), 0);
    assert_true(commit_one(db, write_of(STORE_EDIT, "s", last + 1, "2", 1, "[]")));
    store_sqlite_close(db);
}

static void see(void *data, const struct store_asset *asset)
{
    struct store_asset *seen = data;

    *seen = *asset;
    seen->info.type = strcmp(asset->info.type, "image/png") == 0 ? "image/png" : "?";
}

static void keep_a_file(struct store_sqlite *db)
{
    char bytes[] = "any\0bytes";
    struct store_asset asset = {
        .id = "d1", .info = {"image/png", 3, 2, 0}, .length = sizeof bytes, .bytes = bytes};
    struct store_write write = write_of(STORE_ASSET, "", 0, "", 0, NULL);
    struct store_asset seen = {0};
    size_t length = 0;
    void *found = NULL;
    struct error err = {0};

    write.asset = &asset;
    assert_true(commit_one(db, write));
    assert_true(commit_one(db, write)); /* another who sends the same */
    assert_true(store_sqlite_list_assets(db, see, &seen, NULL));
    assert_string_equal(seen.id, "d1");
    assert_string_equal(seen.info.type, "image/png");
    assert_int_equal(seen.info.width * 10 + seen.info.height, 32);
    assert_int_equal(seen.length, sizeof bytes);
    assert_true(store_sqlite_load_asset(db, "d1", &found, &length, NULL));
    assert_int_equal(length, sizeof bytes);
    assert_memory_equal(found, bytes, length);
    free(found);
    assert_false(store_sqlite_load_asset(db, "d2", &found, &length, &err));
    assert_int_equal(err.kind, ERROR_NOT_FOUND);
}

static void gives_back_files(void **state)
{
    struct store_sqlite *db = open_database("c.sqlite");

    (void)state;
    keep_a_file(db);
    store_sqlite_close(db);
}

struct seen_entry {
    int count;
    char text[200]; /* of the last one */
};

static void see_entry(void *data, const struct store_entry *entry)
{
    struct seen_entry *seen = data;

    seen->count++;
    snprintf(seen->text, sizeof seen->text, "%s %s %s %d %s %d", entry->id, entry->kind,
             entry->name, (int)entry->nodes, entry->document, entry->modified_ms > 0);
}

static struct store_write entry_of(enum store_kind kind, const char *id, const char *text)
{
    struct store_write write = write_of(kind, id, 0, "", 0, text);

    write.sort = "model";
    write.time_ms = 1;
    return write;
}

/* The newest under an id; none that was deleted; nothing of a scene of that id. */
static void gives_back_the_library(void **state)
{
    struct store_sqlite *db = open_database("l.sqlite");
    struct seen_entry seen = {0};

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "mug", 1, "", 0, "scene")));
    assert_true(commit_one(db, entry_of(STORE_LIBRARY, "mug", "first")));
    assert_true(commit_one(db, entry_of(STORE_LIBRARY, "mug", "second")));
    assert_true(commit_one(db, entry_of(STORE_LIBRARY, "cup", "cup")));
    assert_true(commit_one(db, entry_of(STORE_LIBRARY_DELETE, "cup", NULL)));
    assert_true(commit_one(db, write_of(STORE_DELETE, "mug", 2, "", 0, NULL)));
    store_sqlite_close(db);
    db = open_database("l.sqlite");
    assert_true(store_sqlite_list_library(db, see_entry, &seen, NULL));
    assert_int_equal(seen.count, 1);
    assert_string_equal(seen.text, "mug model name 3 second 1");
    store_sqlite_close(db);
}

/* Runs SQL on a database that no store has open. */
static void run_sql(const char *name, const char *sql)
{
    char path[200];
    sqlite3 *db = NULL;

    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

/* What an older version wrote is brought up to date; what a newer one did is left alone. */
static void knows_older_databases(void **state)
{
    struct store_sqlite *db = open_database("d.sqlite");
    struct store_loaded loaded;
    struct error err = {0};
    char path[200];

    (void)state;
    assert_true(commit_one(db, write_of(STORE_CREATE, "s", 1, "", 0, "first")));
    store_sqlite_close(db);
    run_sql("d.sqlite", "DROP TABLE assets; DROP TABLE posters; DROP TABLE library;"
                        "ALTER TABLE edits DROP COLUMN kind;"
                        "ALTER TABLE edits DROP COLUMN undo;"
                        "ALTER TABLE edits DROP COLUMN redo;"
                        "ALTER TABLE edits DROP COLUMN step;"
                        "ALTER TABLE edits DROP COLUMN label;"
                        "ALTER TABLE edits DROP COLUMN inverse;"
                        "ALTER TABLE authors DROP COLUMN key;"
                        "ALTER TABLE authors DROP COLUMN revision;"
                        "ALTER TABLE scenes DROP COLUMN replaced; PRAGMA user_version = 1");
    db = open_database("d.sqlite");
    assert_true(store_sqlite_load(db, "s", &loaded, NULL));
    assert_string_equal(loaded.document, "first");
    store_loaded_finish(&loaded);
    keep_a_file(db);
    store_sqlite_close(db);

    run_sql("d.sqlite", "PRAGMA user_version = 99");
    snprintf(path, sizeof path, "%s/d.sqlite", directory);
    assert_null(store_sqlite_open(path, &err));
    assert_non_null(strstr(err.message, "another version: 99"));
}

static void count(void *data)
{
    atomic_fetch_add((atomic_int *)data, 1);
}

static void flush_waits_until_all_is_told(void **state)
{
    struct error err = {0};
    struct store *store = store_open(directory, &metrics, &err);
    atomic_int told = 0;

    (void)state;
    assert_non_null(store);
    for (uint64_t revision = 1; revision <= 500; revision++) {
        struct store_write *write = memory_alloc(1, sizeof *write);

        *write = write_of(revision == 1 ? STORE_CREATE : STORE_EDIT, "s", revision, "ann",
                          (int64_t)revision, NULL);
        write->text = memory_text("[]");
        write->name = memory_text("name");
        write->on_durable = count;
        write->data = &told;
        store_push(store, write);
    }
    store_flush(store);
    assert_int_equal(atomic_load(&told), 500);
    assert_null(store_open(directory, &metrics, &err));
    assert_int_equal(err.kind, ERROR_CONFLICT);
    store_close(store);
}

static int make_directory(void **state)
{
    (void)state;
    return mkdtemp(directory) ? 0 : -1;
}

static int remove_directory(void **state)
{
    char command[100];

    (void)state;
    snprintf(command, sizeof command, "rm -r %s", directory);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gives_back_document_edits_and_authors),
        cmocka_unit_test(gives_back_what_undoes),
        cmocka_unit_test(gives_back_posters),
        cmocka_unit_test(a_commit_is_all_or_nothing),
        cmocka_unit_test(finds_single_edits),
        cmocka_unit_test(keeps_the_authors_of_the_log),
        cmocka_unit_test(gives_back_files),
        cmocka_unit_test(gives_back_the_library),
        cmocka_unit_test(knows_older_databases),
        cmocka_unit_test(flush_waits_until_all_is_told),
    };

    return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
