/* SPDX-License-Identifier: MIT */
#include "json_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "protocol/json.h"
#include "protocol/memory.h"

void json_text_quote(char *text)
{
    bool inside = false; /* of a string between two " */

    for (char *at = text; *at; at++) {
        if (*at == '\\' && at[1]) {
            at++;
        } else if (*at == '"') {
            inside = !inside;
        } else if (*at == '\'' && !inside) {
            *at = '"';
        }
    }
}

char *json_text(const char *text)
{
    char *out = memory_text(text);

    json_text_quote(out);
    return out;
}

void json_text_assert_equal(const char *printed, const char *text)
{
    char *json = json_text(text);

    assert_string_equal(printed, json);
    free(json);
}

cJSON *json_text_parse(const char *text, struct error *err)
{
    char *json = json_text(text);
    cJSON *parsed = json_parse(json, strlen(json), err);

    free(json);
    return parsed;
}

struct scene *json_text_scene(const char *text, struct error *err)
{
    char *json = json_text(text);
    struct scene *scene = scene_parse(json, strlen(json), err);

    free(json);
    return scene;
}

struct scene *json_text_valid_scene(const char *text)
{
    struct error err = {0};
    struct scene *scene = json_text_scene(text, &err);

    if (!scene) {
        fail_msg("%s: %s\n%s", err.place, err.message, text);
    }
    return scene;
}
