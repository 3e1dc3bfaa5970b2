/* SPDX-License-Identifier: MIT */
/* JSON in C sources, which would need an escape for each quotation mark: ' stands for ", but for
 * those inside of strings between two ". */
#ifndef TESTS_SUPPORT_JSON_TEXT_H
#define TESTS_SUPPORT_JSON_TEXT_H

#include <cjson/cJSON.h>

#include "protocol/scene.h"

/* Caller frees. What is JSON already stays as it is. */
char *json_text(const char *text);
void json_text_quote(char *text); /* in place */
/* Fails the test unless `printed` is the JSON of `text`. */
void json_text_assert_equal(const char *printed, const char *text);
/* NULL and `err` where it is refused. */
cJSON *json_text_parse(const char *text, struct error *err);
struct scene *json_text_scene(const char *text, struct error *err);
/* Fails the test where it is refused. */
struct scene *json_text_valid_scene(const char *text);

#endif
