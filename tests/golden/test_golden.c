/* SPDX-License-Identifier: MIT */
/* Pictures against references: tests/golden/GROUP/CASE/{scene.json, picture.json, expected.png}.
 * picture.json, which may be absent, says {"width", "height", "samples", "aov"}.
 *
 * What was drawn is always written beside this program, with the difference, as
 * golden/GROUP-CASE-actual.png and -difference.png. With GOLDEN_ACCEPT=CASE (or =all) in the
 * environment the picture drawn becomes the reference. */
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "renderer/renderer.h"
#include "tests/support/picture.h"
#include "tests/support/text_file.h"

#define ROOT "tests/golden"

enum { CASES_MAX = 256, WIDTH = 160, HEIGHT = 120, PATH_BYTES = 1024, NAME_BYTES = 256 };

struct golden {
    char group[NAME_BYTES], name[NAME_BYTES], title[2 * NAME_BYTES];
};

static struct golden cases[CASES_MAX];
static size_t case_count;
static char out_dir[PATH_BYTES];
static struct renderer *renderer;

static const char *case_path(const struct golden *golden, const char *file)
{
    static char path[PATH_BYTES];

    snprintf(path, sizeof path, ROOT "/%s/%s/%s", golden->group, golden->name, file);
    return path;
}

static const char *out_path(const struct golden *golden, const char *what)
{
    static char path[2 * PATH_BYTES];

    snprintf(path, sizeof path, "%s/%s-%s-%s.png", out_dir, golden->group, golden->name, what);
    return path;
}

/* --- finding cases --- */

static int is_folder(const struct dirent *entry)
{
    return entry->d_type == DT_DIR && entry->d_name[0] != '.';
}

static void add_group(const char *group)
{
    struct dirent **names = NULL;
    char path[PATH_BYTES];
    int count;

    snprintf(path, sizeof path, ROOT "/%s", group);
    count = scandir(path, &names, is_folder, alphasort);
    for (int i = 0; i < count; i++) {
        if (case_count < CASES_MAX) {
            struct golden *golden = &cases[case_count++];
            snprintf(golden->group, sizeof golden->group, "%s", group);
            snprintf(golden->name, sizeof golden->name, "%s", names[i]->d_name);
            snprintf(golden->title, sizeof golden->title, "%.200s/%.200s", group, names[i]->d_name);
        }
        free(names[i]);
    }
    free(names);
}

static void find_cases(void)
{
    struct dirent **names = NULL;
    const int count = scandir(ROOT, &names, is_folder, alphasort);

    for (int i = 0; i < count; i++) {
        add_group(names[i]->d_name);
        free(names[i]);
    }
    free(names);
}

/* --- drawing --- */

static struct job_desc read_desc(const struct golden *golden)
{
    struct job_desc desc = {.width = WIDTH, .height = HEIGHT, .exact = true};
    const char *path = case_path(golden, "picture.json");

    if (access(path, R_OK) == 0) {
        size_t length;
        char *text = text_file_read(path, &length);
        cJSON *json = json_parse(text, length, NULL);
        assert_non_null(json);
        desc.width = (int)json_member_number(json, "width", WIDTH);
        desc.height = (int)json_member_number(json, "height", HEIGHT);
        desc.samples = (int)json_member_number(json, "samples", 0);
        desc.aov = (enum aov)aov_find(json_member_text(json, "aov", "color"));
        cJSON_Delete(json);
        free(text);
    }
    return desc;
}

static void draw(const struct golden *golden, struct picture *out)
{
    const struct job_desc desc = read_desc(golden);
    struct error err = {0};
    size_t bytes_length = 0, length;
    char *text = text_file_read(case_path(golden, "scene.json"), &length);
    struct scene *scene = scene_parse(text, length, &err);
    struct resident *resident;
    struct image image;
    uint8_t *bytes = NULL;

    if (!scene) {
        fail_msg("%s: %s: %s", golden->title, err.place, err.message);
    }
    resident = resident_create(renderer, scene, 1);
    if (!renderer_render(resident, &desc, &image, &err) ||
        !image_encode(&image, &(struct encode_params){.format = IMAGE_PNG}, &bytes, &bytes_length,
                      &err)) {
        fail_msg("%s: %s: %s", golden->title, err.place, err.message);
    }
    assert_true(picture_read_memory(out, bytes, bytes_length));
    image_finish(&image);
    free(bytes);
    resident_destroy(resident);
    free(text);
}

static bool is_accepted(const struct golden *golden)
{
    const char *accept = getenv("GOLDEN_ACCEPT");

    return accept && *accept &&
           (strcmp(accept, "all") == 0 || strcmp(accept, golden->name) == 0 ||
            strcmp(accept, golden->title) == 0);
}

/* False, with a message, where the picture is not that of the reference. */
static bool matches(const struct golden *golden, const struct picture *actual)
{
    struct picture expected, shown = {0};
    struct picture_difference difference;

    if (!picture_read(&expected, case_path(golden, "expected.png"))) {
        print_message("%s: no reference; look at %s, then make golden-accept CASE=%s\n",
                      golden->title, out_path(golden, "actual"), golden->name);
        return false;
    }
    difference = picture_compare(actual, &expected, &shown);
    if (difference.size) {
        print_message("%s: the sizes differ\n", golden->title);
    } else {
        assert_true(picture_write(&shown, out_path(golden, "difference")));
        if (!difference.same) {
            print_message("%s: %d pixels differ by more than %d (greatest %d, mean %.3f); see %s\n",
                          golden->title, difference.pixels, PICTURE_STEPS, difference.greatest,
                          difference.mean, out_path(golden, "difference"));
        }
    }
    picture_finish(&expected);
    picture_finish(&shown);
    return difference.same;
}

static void test_case(void **state)
{
    const struct golden *golden = *state;
    struct picture actual;
    bool same;

    draw(golden, &actual);
    assert_true(picture_write(&actual, out_path(golden, "actual")));
    if (is_accepted(golden)) {
        char *path = memory_text(case_path(golden, "expected.png"));
        assert_true(picture_write(&actual, path));
        free(path);
    }
    same = matches(golden, &actual);
    picture_finish(&actual);
    assert_true(same);
}

/* --- that the comparison can fail --- */

static void test_bad_reference(void **state)
{
    static const struct golden wrong = {"refused", "wrong", "refused/wrong"};
    struct picture actual;

    (void)state;
    draw(&wrong, &actual);
    assert_false(matches(&wrong, &actual));
    picture_finish(&actual);
}

static void test_missing_reference(void **state)
{
    static const struct golden missing = {"refused", "missing", "refused/missing"};
    struct picture actual;

    (void)state;
    draw(&missing, &actual);
    assert_false(matches(&missing, &actual));
    picture_finish(&actual);
}

/* Every row of the registry has a picture. */
static void test_registry_is_covered(void **state)
{
    size_t missing = 0;

    (void)state;
    for (size_t i = 0; i < node_type_count(); i++) {
        const struct golden golden = {"nodes", "", ""};
        char path[PATH_BYTES];
        snprintf(path, sizeof path, ROOT "/%s/%s/expected.png", golden.group,
                 node_type_at(i)->record.name);
        if (access(path, R_OK) != 0) {
            print_message("no golden picture: %s\n", path);
            missing++;
        }
    }
    assert_int_equal(missing, 0);
}

/* --- */

static int set_up(void **state)
{
    const struct renderer_params params = {.device_index = -1};
    struct error err = {0};

    (void)state;
    renderer = renderer_create(&params, &err);
    if (!renderer) {
        print_message("%s\n", err.message);
        return -1;
    }
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    renderer_destroy(renderer);
    return 0;
}

int main(int argc, char **argv)
{
    static struct CMUnitTest tests[CASES_MAX + 3];
    char *slash;
    size_t n = 0;

    (void)argc;
    snprintf(out_dir, sizeof out_dir - 8, "%s", argv[0]);
    slash = strrchr(out_dir, '/');
    snprintf(slash ? slash + 1 : out_dir, 8, "golden");
    if (mkdir(out_dir, 0777) != 0 && errno != EEXIST) {
        perror(out_dir);
        return 1;
    }
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_registry_is_covered);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_bad_reference);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(test_missing_reference);
    find_cases();
    for (size_t i = 0; i < case_count; i++) {
        if (strcmp(cases[i].group, "refused") != 0) {
            tests[n++] = (struct CMUnitTest){cases[i].title, test_case, NULL, NULL, &cases[i]};
        }
    }
    return _cmocka_run_group_tests("golden", tests, n, set_up, tear_down);
}
