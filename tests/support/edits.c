/* SPDX-License-Identifier: MIT */
/* Edits given as texts. */
#include "edits.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "json_text.h"
#include "protocol/json.h"

cJSON *edits_parse(const char *text)
{
    struct error err = {0};
    cJSON *json = json_text_parse(text, &err);

    assert_non_null(json);
    return json;
}

cJSON *edits_format(const char *format, ...)
{
    char text[300];
    va_list arguments;

    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    assert_in_range(length, 1, sizeof text - 1);
    return edits_parse(text);
}

void edits_assert_prints(cJSON *json, const char *expected)
{
    char *text = json_print(json, false), *wanted = json_text(expected);

    assert_string_equal(text, wanted);
    free(text);
    free(wanted);
    cJSON_Delete(json);
}

void edits_assert(struct scene *scene, const char *ops_text, const char *applied_text,
                  const char *inverse_text)
{
    struct error err = {0};
    cJSON *ops = edits_parse(ops_text), *applied, *inverse;
    char *before = scene_print(scene, false), *again;

    if (!edit_apply(scene, ops, &applied, &inverse, &err)) {
        fail_msg("%s: %s: %s", ops_text, err.place, err.message);
    }
    char *after = scene_print(scene, false);
    struct scene *copy = scene_parse(before, strlen(before), &err);
    assert_true(edit_apply(copy, applied, NULL, NULL, &err));
    again = scene_print(copy, false);
    assert_string_equal(again, after); /* the canonical form does the same */
    scene_destroy(copy);
    free(again);
    assert_true(edit_apply(scene, inverse, NULL, NULL, &err));
    again = scene_print(scene, false);
    assert_string_equal(again, before);
    edits_assert_prints(applied, applied_text ? applied_text : ops_text);
    if (inverse_text) {
        edits_assert_prints(inverse, inverse_text);
    } else {
        cJSON_Delete(inverse);
    }
    cJSON_Delete(ops);
    free(before);
    free(after);
    free(again);
}

void edits_assert_fails(struct scene *scene, const char *text, enum error_kind kind,
                        const char *place, const char *message)
{
    struct error err = {0};
    cJSON *ops = edits_parse(text);
    char *before = scene_print(scene, false), *after;

    assert_false(edit_apply(scene, ops, NULL, NULL, &err));
    assert_int_equal(err.kind, kind);
    assert_string_equal(err.place, place);
    assert_string_equal(err.message, message);
    after = scene_print(scene, false);
    assert_string_equal(before, after);
    free(before);
    free(after);
    cJSON_Delete(ops);
}

void edits_apply(struct scene *scene, const char *text)
{
    struct error err = {0};
    cJSON *ops = edits_parse(text);

    if (!edit_apply(scene, ops, NULL, NULL, &err)) {
        fail_msg("%s: %s: %s", text, err.place, err.message);
    }
    cJSON_Delete(ops);
}
