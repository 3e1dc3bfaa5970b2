/* SPDX-License-Identifier: MIT */
/* The JSON examples of protocol/README.md: scenes and files of the library are read, edits are
 * applied to the scene before them. And every file of protocol/examples is a valid scene. */
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
#include "protocol/library.h"
#include "tests/support/text_file.h"

static struct error err;

static struct scene *read_scene(const char *text, size_t length, const char *what)
{
    struct scene *scene = scene_parse(text, length, &err);

    if (!scene) {
        fail_msg("%s: %s: %s", what, err.place, err.message);
    }
    return scene;
}

static void apply(struct scene *scene, const char *text, size_t length)
{
    cJSON *ops = json_parse(text, length, &err), *inverse = NULL;
    char *before = scene_print(scene, false);

    if (!ops || !edit_check(ops, &err) || !edit_apply(scene, ops, NULL, &inverse, &err)) {
        fail_msg("%.*s: %s: %s", (int)length, text, err.place, err.message);
    }
    assert_true(edit_apply(scene, inverse, NULL, NULL, &err));
    char *after = scene_print(scene, false);
    assert_string_equal(before, after);
    free(before);
    free(after);
    cJSON_Delete(ops);
    cJSON_Delete(inverse);
}

static void read_library(const char *text, size_t length)
{
    cJSON *json = json_parse(text, length, &err);
    size_t count = 0;
    struct library_entry *entries = library_entries_read(json, &count, &err);

    if (!entries) {
        fail_msg("%s: %s", err.place, err.message);
    }
    library_entries_destroy(entries, count);
    cJSON_Delete(json);
}

static void examples_of_the_readme(void **state)
{
    (void)state;
    static const char fence[] = "\n```json ";
    char *readme = text_file_read("protocol/README.md", NULL);
    struct scene *scene = NULL;
    int scenes = 0, edits = 0;

    for (char *block = strstr(readme, fence); block; block = strstr(block, fence)) {
        const char *kind = block + strlen(fence), *start = strchr(kind, '\n') + 1;
        char *end = strstr(start, "\n```");
        assert_non_null(end);
        if (strncmp(kind, "scene\n", 6) == 0) {
            scene_destroy(scene);
            scene = read_scene(start, (size_t)(end - start), "protocol/README.md");
            scenes++;
        } else if (strncmp(kind, "edit\n", 5) == 0) {
            assert_non_null(scene);
            apply(scene, start, (size_t)(end - start));
            edits++;
        } else if (strncmp(kind, "library\n", 8) == 0) {
            read_library(start, (size_t)(end - start));
        } else {
            fail_msg("protocol/README.md: unknown kind of example: %.20s", kind);
        }
        block = end;
    }
    assert_int_equal(scenes, 7);
    assert_int_equal(edits, 5);
    assert_null(strstr(readme, "\n```json\n")); /* every example says what it is */
    scene_destroy(scene);
    free(readme);
}

enum { EXAMPLES = 73 };

static void example_scenes(void **state)
{
    (void)state;
    static const char folder[] = "protocol/examples";
    DIR *directory = opendir(folder);
    struct dirent *entry;
    int count = 0;

    assert_non_null(directory);
    while ((entry = readdir(directory))) {
        char path[300];
        size_t length;
        if (!strstr(entry->d_name, ".json")) {
            continue;
        }
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        char *text = text_file_read(path, &length);
        scene_destroy(read_scene(text, length, path));
        free(text);
        count++;
    }
    closedir(directory);
    assert_int_equal(count, EXAMPLES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(examples_of_the_readme),
        cmocka_unit_test(example_scenes),
    };

    return cmocka_run_group_tests_name("readme", tests, NULL, NULL);
}
