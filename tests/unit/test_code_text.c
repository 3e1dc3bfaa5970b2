/* SPDX-License-Identifier: MIT */
/* Where users' code stands, in JSON and in scenes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/code_text.h"
#include "protocol/edit.h"
#include "protocol/json.h"
#include "tests/support/json_text.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))
#define DOCUMENT(rest)                                                                             \
    "{'format': 'fieldcast/1', " rest "'root': {'id': 'root', 'type': 'union',"                    \
    " 'children': [{'id': 'ball', 'type': 'sphere',"                                               \
    " 'name': 'code'}]}}"

static cJSON *parse(const char *text)
{
    cJSON *json = json_text_parse(text, NULL);

    assert_non_null(json);
    return json;
}

/* Text, and the place of its code; NULL: there is none. */
static const struct {
    const char *text, *place;
} rows[] = {
    {DOCUMENT("'primitives': {'a': {'code': ''}, 'b': {'code': 'x'}}, "), "/primitives/b/code"},
    {DOCUMENT("'shaders': {'code': {'code': 'x'}}, "), "/shaders/code/code"},
    {DOCUMENT("'models': {'m': {'type': 'field', 'params': {'code': 'x'}}}, "),
     "/models/m/params/code"},
    {DOCUMENT("'primitives': {'code': {'code': ''}}, "), NULL},
    {DOCUMENT("'name': 'code', "), NULL},
    {"[{'op': 'set', 'at': '/name', 'value': 'code'}, {'op': 'set', 'at': '/shaders/s/code',"
     " 'value': 'x'}]",
     "/shaders/s/code"},
    {"[{'op': 'set', 'at': '/shaders/s/code', 'value': null}]", NULL},
    {"[{'op': 'set', 'at': '/shaders/s/code', 'value': ''}]", NULL},
    {"[{'op': 'insert', 'into': '/primitives', 'name': 'p', 'value': {'code': 'x'}}]",
     "/0/value/code"},
    {"[{'op': 'insert', 'into': '/nodes/root', 'before': null, 'value': {'type': 'union',"
     " 'children': [{'type': 'field', 'params': {'code': 'x'}}]}}]",
     "/0/value/children/0/params/code"},
    {"[{'op': 'remove', 'at': '/shaders/s/code'}]", NULL},
};

static void code_is_found(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        cJSON *json = parse(rows[i].text);
        char place[ERROR_PLACE_BYTES] = "";

        assert_int_equal(code_text_find(json, place), rows[i].place != NULL);
        assert_int_equal(code_text_find(json, NULL), rows[i].place != NULL);
        assert_string_equal(place, rows[i].place ? rows[i].place : "");
        cJSON_Delete(json);
    }
}

static void code_is_removed(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(rows); i++) {
        cJSON *json = parse(rows[i].text), *before = parse(rows[i].text);
        char place[ERROR_PLACE_BYTES];

        code_text_remove(json);
        assert_false(code_text_find(json, place));
        assert_int_equal(cJSON_Compare(json, before, true), rows[i].place == NULL);
        cJSON_Delete(json);
        cJSON_Delete(before);
    }
}

static void code_of_scenes_is_found(void **state)
{
    static const char text[] =
        DOCUMENT("'primitives': {'p': {'code': 'float sdf(vec3 p) { return 1; }'}},"
                 "'shaders': {'s': {'code': 'x'}},'models': {'m': {'id': 'in', 'type': 'field',"
                 " 'params': {'code': 'x'}}}, ");
    static const char *const changed[] = {"/primitives/p/code", "/shaders/s/code",
                                          "/nodes/in/params/code"};
    struct scene *plain = json_text_valid_scene(DOCUMENT("")),
                 *before = json_text_valid_scene(text);
    char place[ERROR_PLACE_BYTES];

    (void)state;
    assert_false(code_text_in_scene(plain));
    assert_true(code_text_in_scene(before));
    assert_string_equal(code_text_changed(plain, before, place), "");
    assert_string_equal(code_text_changed(before, NULL, place), "/primitives/p/code");
    assert_string_equal(code_text_changed(before, plain, place), "/primitives/p/code");
    for (size_t i = 0; i < COUNT(changed); i++) {
        struct scene *after = scene_copy(before);
        char ops[128];

        snprintf(ops, sizeof ops, "[{'op': 'set', 'at': '%s', 'value': 'y'}]", changed[i]);
        cJSON *json = parse(ops);
        assert_true(edit_apply(after, json, NULL, NULL, NULL));
        assert_string_equal(code_text_changed(after, before, place), changed[i]);
        cJSON_Delete(json);
        scene_destroy(after);
    }
    scene_destroy(plain);
    scene_destroy(before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(code_is_found),
        cmocka_unit_test(code_is_removed),
        cmocka_unit_test(code_of_scenes_is_found),
    };

    cmocka_set_message_output(CM_OUTPUT_TAP);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
