/* SPDX-License-Identifier: MIT */
/* Finds users' code in documents and edits as JSON, and in scenes. */
#ifndef PROTOCOL_CODE_TEXT_H
#define PROTOCOL_CODE_TEXT_H

#include "scene.h"

/* The first code that a document, or an array of operations, brings: its place (NULL: of no
 * interest), and true. */
bool code_text_find(const cJSON *json, char *out_place);
/* Replaces all code by empty texts. */
void code_text_remove(cJSON *json);

bool code_text_in_scene(const struct scene *scene);
/* The place of the first code that is not the same in `before` (may be NULL), else of the first;
 * "" without any. Returns `out_place`. */
const char *code_text_changed(const struct scene *scene, const struct scene *before,
                              char out_place[ERROR_PLACE_BYTES]);

#endif
