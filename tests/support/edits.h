/* SPDX-License-Identifier: MIT */
/* Edits given as texts, for tests that say what comes of them. */
#ifndef TESTS_SUPPORT_EDITS_H
#define TESTS_SUPPORT_EDITS_H

#include "protocol/edit.h"

cJSON *edits_parse(const char *text);
/* Of a text below 300 bytes. */
cJSON *edits_format(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* The edit has to do `applied` (NULL: what it says) and its inverse to be `inverse` (NULL: not
 * looked at). Takes it back. */
void edits_assert(struct scene *scene, const char *ops, const char *applied, const char *inverse);
void edits_assert_prints(cJSON *json, const char *expected); /* takes `json` */
/* The edit has to be refused like this and to leave nothing. */
void edits_assert_fails(struct scene *scene, const char *ops, enum error_kind kind,
                        const char *place, const char *message);
void edits_apply(struct scene *scene, const char *ops);

#endif
