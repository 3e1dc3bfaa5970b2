/* SPDX-License-Identifier: MIT */
/* Pictures against references: tests/golden/GROUP/CASE/{scene.json, picture.json, expected.png}.
 * picture.json, which may be absent, says {"width", "height", "samples", "aov"}; the scene says the
 * rest. A panorama.png beside them is the file that the scene names by its digest.
 *
 * What was drawn, what was expected and the difference are left in BUILD/golden, where index.html
 * shows them side by side. With GOLDEN_ACCEPT=CASE (or =GROUP, =GROUP/CASE, =all) in the
 * environment only these are drawn, and become the references. */
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
#include "server/digest.h"
#include "tests/support/golden_page.h"
#include "tests/support/picture.h"
#include "tests/support/text_file.h"

#define ROOT "tests/golden"

enum {
    CASES = 184,
    CASES_MAX = 400,
    WIDTH = 160,
    HEIGHT = 120,
    PATH_BYTES = 1024,
    NAME_BYTES = 256
};

struct golden {
    char group[NAME_BYTES], name[NAME_BYTES], title[2 * NAME_BYTES];
};

static struct golden cases[CASES_MAX];
static size_t case_count;
static char out_dir[PATH_MAX + 8];
static FILE *page;
static struct renderer *renderer;

static const char *case_path(const struct golden *golden, const char *file)
{
    static char path[PATH_BYTES];

    snprintf(path, sizeof path, ROOT "/%s/%s/%s", golden->group, golden->name, file);
    return path;
}

static const char *out_path(const struct golden *golden, const char *what)
{
    static char path[PATH_MAX + PATH_BYTES];

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
    struct job_desc desc = {
        .width = WIDTH, .height = HEIGHT, .level = -1, .transparent = -1, .exact = true};
    const char *path = case_path(golden, "picture.json");

    if (access(path, R_OK) == 0) {
        size_t length;
        char *text = text_file_read(path, &length);
        cJSON *json = json_parse(text, length, NULL);
        assert_non_null(json);
        desc.width = (int)json_member_number(json, "width", WIDTH);
        desc.height = (int)json_member_number(json, "height", HEIGHT);
        desc.samples = (int)json_member_number(json, "samples", 0);
        const int aov = aov_find(json_member_text(json, "aov", aov_name(AOV_COLOR)));
        assert_true(aov >= 0);
        desc.aovs[aov] = true;
        cJSON_Delete(json);
        free(text);
    }
    return desc;
}

static bool draw_scene(struct scene *scene, const struct job_desc *desc, struct picture *out,
                       struct error *err)
{
    struct resident *resident = resident_create(renderer, scene, 1);
    struct image image = {0};
    uint8_t *bytes = NULL;
    size_t length = 0;
    const bool good =
        renderer_render(resident, desc, &image, err) &&
        image_encode(&image, &(struct encode_params){.format = CODEC_PNG}, &bytes, &length, err);

    if (good) {
        assert_true(picture_read_memory(out, bytes, length));
    }
    image_finish(&image);
    free(bytes);
    resident_destroy(resident);
    return good;
}

static void give_panorama(const struct golden *golden)
{
    const char *path = case_path(golden, "panorama.png");
    char id[ASSET_ID_CHARACTERS + 1];

    if (access(path, R_OK) == 0) {
        size_t length;
        char *bytes = text_file_read(path, &length);
        digest_text(bytes, length, id);
        renderer_asset(renderer, id, bytes, length);
        free(bytes);
    }
}

static bool draw(const struct golden *golden, struct picture *out, struct error *err)
{
    const struct job_desc desc = read_desc(golden);
    size_t length;
    char *text = text_file_read(case_path(golden, "scene.json"), &length);
    struct scene *scene = scene_parse(text, length, err);

    free(text);
    give_panorama(golden);
    return scene && draw_scene(scene, &desc, out, err);
}

/* --- judging --- */

/* What is to be accepted; NULL: nothing is. */
static const char *accepted(void)
{
    const char *accept = getenv("GOLDEN_ACCEPT");

    return accept && *accept ? accept : NULL;
}

static bool is_accepted(const struct golden *golden)
{
    const char *accept = accepted();

    return accept && (strcmp(accept, "all") == 0 || strcmp(accept, golden->name) == 0 ||
                      strcmp(accept, golden->group) == 0 || strcmp(accept, golden->title) == 0);
}

static void say(struct golden_verdict *verdict, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void say(struct golden_verdict *verdict, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(verdict->message, sizeof verdict->message, format, arguments);
    va_end(arguments);
}

static void compare(struct golden_verdict *verdict, const struct golden *golden,
                    const struct picture *actual, const struct picture *expected)
{
    struct picture shown = {0};
    const struct picture_difference difference = picture_compare(actual, expected, &shown);

    assert_true(picture_write(expected, out_path(golden, "expected")));
    verdict->difference = difference;
    verdict->compared = !difference.size;
    verdict->same = difference.same;
    if (difference.size) {
        say(verdict, "%d x %d pixels, not %d x %d", actual->width, actual->height, expected->width,
            expected->height);
        return;
    }
    assert_true(picture_write(&shown, out_path(golden, "difference")));
    if (!difference.same) {
        say(verdict, "%d pixels differ by more than %d (greatest %d, mean %.3f)", difference.pixels,
            PICTURE_STEPS, difference.greatest, difference.mean);
    }
    picture_finish(&shown);
}

/* What an earlier run left. */
static void forget(const struct golden *golden)
{
    static const char *const left[] = {"expected", "actual", "difference"};

    for (size_t i = 0; i < sizeof left / sizeof left[0]; i++) {
        unlink(out_path(golden, left[i]));
    }
}

static struct golden_verdict judge(const struct golden *golden)
{
    struct golden_verdict verdict = {0};
    struct picture actual = {0}, expected = {0};
    struct error err = {0};

    forget(golden);
    if (!draw(golden, &actual, &err)) {
        say(&verdict, "%s: %s", err.place, err.message);
        return verdict;
    }
    assert_true(picture_write(&actual, out_path(golden, "actual")));
    if (is_accepted(golden)) {
        assert_true(picture_write(&actual, case_path(golden, "expected.png")));
    }
    if (picture_read(&expected, case_path(golden, "expected.png"))) {
        compare(&verdict, golden, &actual, &expected);
    } else {
        say(&verdict, "no reference; look at it, then make golden-accept CASE=%s", golden->title);
    }
    picture_finish(&actual);
    picture_finish(&expected);
    return verdict;
}

static void picture_is_as_accepted(void **state)
{
    const struct golden *golden = *state;
    const struct golden_verdict verdict = judge(golden);

    golden_page_add(page, golden->title, &verdict);
    if (!verdict.same) {
        print_message("%s: %s; see %s/index.html\n", golden->title, verdict.message, out_dir);
    }
    assert_true(verdict.same);
}

/* --- that the comparison can fail --- */

static void bad_reference(void **state)
{
    static const struct golden wrong = {"refused", "wrong", "refused/wrong"};
    const struct golden_verdict verdict = judge(&wrong);

    (void)state;
    assert_true(verdict.compared);
    assert_false(verdict.same);
}

static void missing_reference(void **state)
{
    static const struct golden missing = {"refused", "missing", "refused/missing"};
    const struct golden_verdict verdict = judge(&missing);

    (void)state;
    assert_false(verdict.compared || verdict.same);
    assert_non_null(strstr(verdict.message, "no reference"));
}

/* Every row of the registry has a picture. */
static void registry_is_covered(void **state)
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

static void no_case_is_lost(void **state)
{
    (void)state;
    assert_int_equal(case_count, CASES);
}

/* What a case has of its own would be seen. */
static void pictures_of_a_group_differ(void **state)
{
    size_t alike = 0;

    (void)state;
    for (size_t i = 0; i < case_count; i++) {
        for (size_t k = i + 1; k < case_count && strcmp(cases[k].group, cases[i].group) == 0; k++) {
            struct picture a = {0}, b = {0};
            if (picture_read(&a, case_path(&cases[i], "expected.png")) &&
                picture_read(&b, case_path(&cases[k], "expected.png")) &&
                picture_compare(&a, &b, NULL).same) {
                print_message("%s is as %s\n", cases[k].title, cases[i].title);
                alike++;
            }
            picture_finish(&a);
            picture_finish(&b);
        }
    }
    assert_int_equal(alike, 0);
}

/* --- */

static int set_up(void **state)
{
    const struct renderer_params params = {.device = {.index = -1}};
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
    golden_page_end(page);
    return 0;
}

/* This program is BUILD/tests/golden/test_golden. */
static bool open_page(const char *program)
{
    if (!realpath(program, out_dir)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        *strrchr(out_dir, '/') = '\0';
    }
    strcat(out_dir, "/golden");
    if (mkdir(out_dir, 0777) != 0 && errno != EEXIST) {
        return false;
    }
    page = golden_page_begin(out_dir);
    return page != NULL;
}

int main(int argc, char **argv)
{
    static struct CMUnitTest tests[CASES_MAX + 5];
    size_t n = 0;

    (void)argc;
    if (!open_page(argv[0])) {
        perror(out_dir);
        return 1;
    }
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(registry_is_covered);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(no_case_is_lost);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(bad_reference);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(missing_reference);
    tests[n++] = (struct CMUnitTest)cmocka_unit_test(pictures_of_a_group_differ);
    find_cases();
    for (size_t i = 0; i < case_count; i++) {
        if (strcmp(cases[i].group, "refused") != 0 && (!accepted() || is_accepted(&cases[i]))) {
            tests[n++] =
                (struct CMUnitTest){cases[i].title, picture_is_as_accepted, NULL, NULL, &cases[i]};
        }
    }
    return _cmocka_run_group_tests("golden", tests, n, set_up, tear_down);
}
