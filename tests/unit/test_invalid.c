/* SPDX-License-Identifier: MIT */
/* One invalid document or edit in each file of tests/invalid: refused with the expected kind, place
 * and message, and base.json, to which the edits are applied, stays as it is byte for byte. */
#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/edit.h"
#include "protocol/json.h"
#include "protocol/messages.h"
#include "tests/support/text_file.h"

static const char folder[] = "tests/invalid";
enum { CASES = 134 }; /* and base.json */

static struct scene *base;
static char *base_text;

static int set_up(void **state)
{
    (void)state;
    size_t length;
    char *text = text_file_read("tests/invalid/base.json", &length);

    base = scene_parse(text, length, NULL);
    free(text);
    base_text = base ? scene_print(base, true) : NULL;
    return base ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    scene_destroy(base);
    free(base_text);
    return 0;
}

/* The bytes of a case: a text, bytes in hexadecimal where they are no text, or any JSON value. */
static char *case_bytes(const cJSON *json, size_t *out_length)
{
    const char *text = json_member_text(json, "text", NULL);
    const char *hex = json_member_text(json, "hex", NULL);
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(json, "value");

    assert_int_equal((text != NULL) + (hex != NULL) + (value != NULL), 1);
    char *bytes = hex    ? calloc(strlen(hex) / 2 + 1, 1)
                  : text ? strdup(text)
                         : json_print(value, false);
    assert_non_null(bytes);
    *out_length = hex ? strlen(hex) / 2 : strlen(bytes);
    for (size_t i = 0; hex && i < *out_length; i++) {
        unsigned byte;
        assert_int_equal(sscanf(hex + 2 * i, "%2x", &byte), 1);
        bytes[i] = (char)byte;
    }
    return bytes;
}

static bool accepted(const cJSON *json, struct error *err)
{
    size_t length;
    char *bytes = case_bytes(json, &length);
    const char *kind = json_member_text(json, "kind", "");
    bool ok;

    if (strcmp(kind, "document") == 0) {
        struct scene *scene = scene_parse(bytes, length, err);
        ok = scene != NULL;
        scene_destroy(scene);
    } else {
        assert_string_equal(kind, "edit");
        cJSON *ops = json_parse(bytes, length, err);
        ok = ops && edit_check(ops, err) && edit_apply(base, ops, NULL, NULL, err);
        cJSON_Delete(ops);
    }
    free(bytes);
    return ok;
}

static void check_file(const char *name)
{
    char path[300];
    size_t length;
    struct error err = {0};

    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *text = text_file_read(path, &length);
    cJSON *json = json_parse(text, length, &err);
    if (!json) {
        fail_msg("%s itself: %s: %s", path, err.place, err.message);
    }
    const cJSON *expect = cJSON_GetObjectItemCaseSensitive(json, "expect");
    const char *fragment = json_member_text(expect, "message", NULL);
    assert_true(*json_member_text(json, "what", ""));
    assert_true(fragment && *fragment);
    if (accepted(json, &err)) {
        fail_msg("%s was accepted", path);
    }
    if (strcmp(error_kind_name(err.kind), json_member_text(expect, "code", "")) != 0 ||
        strcmp(err.place, json_member_text(expect, "place", "?")) != 0 ||
        !strstr(err.message, fragment)) {
        fail_msg("%s: got %s, \"%s\": %s", path, error_kind_name(err.kind), err.place, err.message);
    }
    char *now = scene_print(base, true);
    if (strcmp(now, base_text) != 0) {
        fail_msg("%s changed the scene", path);
    }
    free(now);
    cJSON_Delete(json);
    free(text);
}

/* Every file of the folder is a case, but for the scene that edits start from. */
static int is_case(const struct dirent *entry)
{
    return entry->d_name[0] != '.' && strcmp(entry->d_name, "base.json") != 0;
}

static void invalid_ones_are_refused(void **state)
{
    (void)state;
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_case, alphasort);

    assert_int_equal(count, CASES);
    for (int i = 0; i < count; i++) {
        check_file(entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(invalid_ones_are_refused, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("invalid", tests, NULL, NULL);
}
