/* SPDX-License-Identifier: MIT */
/* Entries of the library: what is read is printed and read again, in memory they are found by id,
 * and free ids resemble names. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"
#include "server/live/library.h"
#include "tests/support/json_text.h"

static struct library_entry read_entry(const char *text, cJSON **out_json)
{
    struct library_entry entry;
    struct error err = {0};
    char *json = json_text(text);

    *out_json = json_parse(json, strlen(json), &err);
    assert_non_null(*out_json);
    if (!library_entry_read(*out_json, "", &entry, &err)) {
        fail_msg("%s: %s", err.place, err.message);
    }
    free(json);
    return entry;
}

static struct library_entry named(const char *name)
{
    char text[400];
    cJSON *json;

    snprintf(text, sizeof text,
             "{'kind': 'model', 'document': {'format': 'fieldcast/1', 'name': '%s',"
             " 'root': {'type': 'sphere'}}}",
             name);
    struct library_entry entry = read_entry(text, &json);
    cJSON_Delete(json);
    return entry;
}

static void free_write(struct store_write *write)
{
    free(write->text);
    free(write->name);
    free(write);
}

static void a_printed_file_reads_back_the_same(void **state)
{
    static const char text[] =
        "{'id': 'brass', 'kind': 'material', 'document': {'format': 'fieldcast/1',"
        " 'name': 'Brass \\u2713', 'materials': {'brass': {'shader': 'standard'}},"
        " 'root': {'type': 'sphere', 'material': 'brass'}}}";
    struct library library = {0};
    struct error err = {0};
    size_t length = 0, count = 0;
    cJSON *json;
    struct library_entry entry = read_entry(text, &json), other = named("Other");

    (void)state;
    free_write(library_set(&library, entry.id, &entry));
    free_write(library_set(&library, "other", &other));
    char *file = library_print_file(&library, &length);
    cJSON *again = json_parse(file, length, &err);
    struct library_entry *entries = library_entries_read(again, &count, &err);
    assert_non_null(entries);
    assert_int_equal(count, 2);
    assert_string_equal(entries[0].id, "brass");
    assert_int_equal(entries[0].kind, LIBRARY_MATERIAL);
    assert_string_equal(entries[0].text, entry.text);
    assert_string_equal(entries[1].text, other.text);
    library_entries_destroy(entries, count);
    library_entry_finish(&entry);
    library_entry_finish(&other);
    library_finish(&library);
    cJSON_Delete(again);
    cJSON_Delete(json);
    free(file);
}

static void put(struct library *library, const char *id, const char *name)
{
    struct library_entry entry = named(name);
    struct store_write *write = library_set(library, id, &entry);

    assert_int_equal(write->kind, STORE_LIBRARY);
    assert_string_equal(write->scene, id);
    assert_string_equal(write->text, entry.text);
    assert_true(library_is_same(library_find(library, id), &entry));
    free_write(write);
    library_entry_finish(&entry);
}

static void entries_are_found_by_their_ids(void **state)
{
    static const char *const ids[] = {"m", "a", "z", "b", "n", "a"};
    struct library library = {0};
    char tag[LIBRARY_TAG_BYTES];

    (void)state;
    for (size_t i = 0; i < sizeof ids / sizeof *ids; i++) {
        put(&library, ids[i], ids[i]);
    }
    assert_int_equal(library.count, 5);
    for (size_t i = 1; i < library.count; i++) {
        assert_true(strcmp(library.items[i - 1].id, library.items[i].id) < 0);
    }
    snprintf(tag, sizeof tag, "%s", library_find(&library, "n")->tag);
    put(&library, "n", "other");
    assert_string_not_equal(library_find(&library, "n")->tag, tag);
    put(&library, "n", "n");
    assert_string_equal(library_find(&library, "n")->tag, tag);
    for (size_t i = 0; i < 5; i++) {
        free(library_remove(&library, ids[i]));
        assert_null(library_find(&library, ids[i]));
    }
    assert_int_equal(library.count, 0);
    assert_int_equal(library.bytes, 0);
    library_finish(&library);
}

static void expect_id(struct library *library, const char *name, const char *expected)
{
    struct library_entry entry = named(name);
    char id[LIMIT_ID_BYTES + 1];

    library_free_id(library, &entry, id);
    assert_string_equal(id, expected);
    library_entry_finish(&entry);
}

static void free_ids_resemble_names(void **state)
{
    struct library library = {0};

    (void)state;
    expect_id(&library, "Mug, Large (2)", "mug-large-2");
    expect_id(&library, "../../etc/passwd", "etc-passwd");
    expect_id(&library, "---", "model");
    expect_id(&library, "\\u00fc\\u2713", "model");
    expect_id(&library, "a long name of which there is more than an id can hold, whatever is in it",
              "a-long-name-of-which-there-is-more-than-an-id-c");
    put(&library, "mug", "Mug");
    expect_id(&library, "Mug", "mug-2");
    put(&library, "mug-2", "Mug");
    expect_id(&library, "Mug", "mug-3");
    library_finish(&library);
}

static void what_the_store_has_is_added(void **state)
{
    struct library library = {0};

    (void)state;
    library_add(&library, &(struct store_entry){"a", "material", "A", "{}", 2, 7});
    library_add(&library, &(struct store_entry){"b", "of another version", "B", "{}", 2, 7});
    assert_int_equal(library.count, 1);
    assert_int_equal(library.bytes, 2);
    assert_int_equal(library_find(&library, "a")->kind, LIBRARY_MATERIAL);
    assert_int_equal(library_find(&library, "a")->modified_ms, 7);
    library_finish(&library);
}

static void there_is_room_up_to_the_limits(void **state)
{
    struct library library = {.count = LIMIT_LIBRARY_ENTRIES - 1, .bytes = LIMIT_LIBRARY_BYTES - 5};
    struct error err = {0};

    (void)state;
    assert_true(library_has_room(&library, 1, 5, &err));
    assert_false(library_has_room(&library, 2, 5, &err));
    assert_int_equal(err.kind, ERROR_FULL);
    assert_false(library_has_room(&library, 1, 6, &err));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_printed_file_reads_back_the_same),
        cmocka_unit_test(entries_are_found_by_their_ids),
        cmocka_unit_test(free_ids_resemble_names),
        cmocka_unit_test(what_the_store_has_is_added),
        cmocka_unit_test(there_is_room_up_to_the_limits),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
