/* SPDX-License-Identifier: MIT */
/* Reads the JSON of imported folders, which is written by hand and printed on paper. Strict but
 * for three things that the format's own listings do: line breaks and tabs stand in texts as they
 * are; a comma between two members or elements may be missing; and members after the end of an
 * object in a list still belong to that object. Values know where they stood. */
#ifndef PROTOCOL_IMPORT_TEXT_H
#define PROTOCOL_IMPORT_TEXT_H

#include <cjson/cJSON.h>
#include <stddef.h>

#include "protocol/error.h"

enum import_kind {
    IMPORT_NULL,
    IMPORT_BOOL,
    IMPORT_NUMBER,
    IMPORT_TEXT,
    IMPORT_LIST,
    IMPORT_OBJECT
};

struct import_value {
    enum import_kind kind;
    int line, column;                  /* where it begins, from 1 */
    double number;                     /* 0 or 1 of a boolean */
    char *text;                        /* line breaks as \n */
    char *name;                        /* as a member of an object */
    struct import_value *first, *next; /* members or elements in order */
    struct import_value *last;         /* of the members */
    void *names;                       /* search tree of the members */
    size_t count;
};

/* The object that the text is; NULL and `err`, whose place is `path`, with line and column. What
 * was put right, but for line breaks, is added to `notes` (an array) as "path:line:column: what".
 * Caller destroys. */
struct import_value *import_text_read(const char *path, const char *text, size_t length,
                                      cJSON *notes, struct error *err);
void import_value_destroy(struct import_value *value); /* NULL: nothing */
const struct import_value *import_member(const struct import_value *object, const char *name);

#endif
