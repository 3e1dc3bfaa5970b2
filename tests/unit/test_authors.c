/* SPDX-License-Identifier: MIT */
/* The authors of a scene: found, kept, forgotten with the log; whose key counts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"
#include "server/live/authors.h"
#include "server/live/catalog.h"
#include "server/live/hub.h"
#include "server/live/room.h"
#include "server/live/room_authors.h"
#include "server/live/room_store.h"
#include "tests/support/json_text.h"

enum { MANY = 25000 };

static char directory[] = "/tmp/fieldcast-authors-XXXXXX";

static const char *nth(int i)
{
    static char id[LIMIT_ID_BYTES + 1];

    snprintf(id, sizeof id, "author-%d", i * 7919 % MANY);
    return id;
}

static void found_by_id(void **state)
{
    struct authors authors = {0};

    (void)state;
    assert_null(authors_find(&authors, "author-1"));
    for (int i = 0; i < 1000; i++) {
        authors_edited(&authors, authors_add(&authors, nth(i)), i + 1, (uint64_t)i + 2);
    }
    for (int i = 0; i < 1000; i++) {
        assert_int_equal(authors_find(&authors, nth(i))->edit, i + 1);
    }
    for (int i = 0; i < 1000; i += 2) {
        authors_remove(&authors, authors_find(&authors, nth(i)));
    }
    assert_int_equal(authors.count, 500);
    assert_null(authors_find(&authors, nth(998)));
    assert_string_equal(authors.newest->id, nth(999));
    assert_string_equal(authors.oldest->id, nth(1));
    authors_finish(&authors);
    assert_int_equal(authors.count, 0);
}

static void count_forgotten(void *data, const struct author *author)
{
    assert_null(author->session);
    ++*(int *)data;
}

/* Everybody edits once, the log keeps 100 edits; one stays connected, an edit of one is being
 * applied, one only looks on. */
static void as_many_as_the_log_has(void **state)
{
    struct session *const connected = (struct session *)directory; /* is not looked at */
    struct authors authors = {0};
    int forgotten = 0;

    (void)state;
    authors_add(&authors, "looks-on")->session = connected;
    for (int i = 0; i < MANY; i++) {
        struct author *author = authors_add(&authors, nth(i));

        author->session = i == 5 ? connected : NULL;
        author->applying = i == 6;
        authors_edited(&authors, author, 1, (uint64_t)i + 1);
        if (i >= 100) {
            authors_cut(&authors, (uint64_t)i - 99, count_forgotten, &forgotten);
        }
        assert_true(authors.count <= 100 + 3);
    }
    assert_int_equal(authors.count, 100 + 3);
    assert_int_equal(forgotten, MANY - 102);
    assert_non_null(authors_find(&authors, "looks-on"));
    assert_non_null(authors_find(&authors, nth(5)));
    assert_non_null(authors_find(&authors, nth(6)));
    assert_null(authors_find(&authors, nth(7)));
    authors_finish(&authors);
}

static void keys_differ_and_names_follow(void **state)
{
    char one[MESSAGE_KEY_CHARACTERS + 1], other[MESSAGE_KEY_CHARACTERS + 1];
    struct author author = {0}, again = {0};

    (void)state;
    author_make_key(one);
    author_make_key(other);
    assert_int_equal(strlen(one), MESSAGE_KEY_CHARACTERS);
    assert_string_not_equal(one, other);
    assert_false(author_has_key(&author, ""));
    assert_false(author_has_key(&author, one));
    author_set_key(&author, one);
    assert_true(author_has_key(&author, one));
    assert_false(author_has_key(&author, other));
    assert_false(author_has_key(&author, ""));
    assert_false(author_has_key(&author, author.key));
    assert_int_equal(strlen(author.name), AUTHOR_NAME_CHARACTERS);
    assert_null(strstr(author.key, author.name));
    author_set_digest(&again, author.key);
    assert_string_equal(again.name, author.name);
    author_set_digest(&again, "");
    assert_string_equal(again.name, "");
}

/* --- rooms --- */

static void open_hub(struct hub *hub)
{
    struct error err = {0};

    memset(hub, 0, sizeof *hub);
    pthread_mutex_init(&hub->lock, NULL);
    hub->catalog = memory_alloc(1, sizeof *hub->catalog);
    hub->store = store_open(directory, &hub->metrics, &err);
    assert_non_null(hub->store);
}

static void close_hub(struct hub *hub)
{
    store_close(hub->store);
    catalog_finish(hub->catalog);
    free(hub->catalog);
    pthread_mutex_destroy(&hub->lock);
}

static struct room *load(struct hub *hub, const char *scene)
{
    struct store_loaded loaded;

    assert_true(store_load(hub->store, scene, &loaded, NULL));
    struct room *room = room_load(hub, scene, &loaded, NULL);
    store_loaded_finish(&loaded);
    assert_non_null(room);
    return room;
}

/* As a release without keys has left it. */
static void write_old_database(void)
{
    struct hub hub;
    struct error err = {0};
    char path[200];
    sqlite3 *db = NULL;
    const char text[] = "{'format':'fieldcast/1','root':{'id':'ball','type':'sphere'}}";
    const char ops[] = "[{'op':'set','at':'/name','value':'new'}]";

    open_hub(&hub);
    struct room *room = room_create(&hub, "old", json_text_scene(text, &err), 1);
    struct author *author = authors_add(&room->authors, "the-author");
    cJSON *json = json_text_parse(ops, &err);
    uint64_t revision = 0;
    hub_lock(&hub);
    room_store_new(room, scene_print(room->scene, false), NULL, NULL);
    assert_int_equal(room_edit(room,
                               &(struct room_change){.author = author->id, .by = author, .edit = 8},
                               json, &revision, &err),
                     ROOM_APPLIED);
    hub_unlock(&hub);
    store_flush(hub.store);
    cJSON_Delete(json);
    room_destroy(room);
    close_hub(&hub);
    snprintf(path, sizeof path, "%s/scenes.sqlite", directory);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db,
                                  "DROP TABLE library; ALTER TABLE authors DROP COLUMN key;"
                                  "ALTER TABLE authors DROP COLUMN revision;"
                                  "INSERT INTO authors VALUES('old', 'nothing-in-the-log', 3);"
                                  "PRAGMA user_version = 4",
                                  NULL, NULL, NULL),
                     SQLITE_OK);
    sqlite3_close(db);
}

static size_t steps_of(const struct room *room, const char *id)
{
    size_t undo = 0, redo = 0;

    history_depth(room->history, id, &undo, &redo);
    return undo;
}

/* The first client that comes gets the key, and keeps it whatever happens. */
static void authors_of_old_logs_are_claimed_once(void **state)
{
    char key[MESSAGE_KEY_CHARACTERS + 1], other[MESSAGE_KEY_CHARACTERS + 1];
    struct error err = {0};
    struct hub hub;

    (void)state;
    write_old_database();
    open_hub(&hub);
    struct room *room = load(&hub, "old");
    assert_int_equal(room->authors.count, 1);
    assert_null(authors_find(&room->authors, "nothing-in-the-log"));
    struct author *author = room_authors_admit(room, "the-author", "", key, &err);
    assert_non_null(author);
    assert_int_equal(author->edit, 8);
    assert_int_equal(author->revision, 2);
    assert_int_equal(steps_of(room, "the-author"), 1);
    assert_null(room_authors_admit(room, "the-author", "", other, &err));
    store_flush(hub.store);
    room_destroy(room);
    close_hub(&hub);

    open_hub(&hub);
    room = load(&hub, "old");
    assert_null(room_authors_admit(room, "the-author", "", other, &err));
    assert_int_equal(err.kind, ERROR_FORBIDDEN);
    assert_string_equal(err.place, "/key");
    author = room_authors_admit(room, "the-author", key, other, &err);
    assert_non_null(author);
    assert_string_equal(key, other);
    assert_int_equal(steps_of(room, "the-author"), 1);
    room_destroy(room);
    close_hub(&hub);
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
        cmocka_unit_test(found_by_id),
        cmocka_unit_test(as_many_as_the_log_has),
        cmocka_unit_test(keys_differ_and_names_follow),
        cmocka_unit_test(authors_of_old_logs_are_claimed_once),
    };

    return cmocka_run_group_tests_name("authors", tests, make_directory, remove_directory);
}
