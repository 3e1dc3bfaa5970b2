/* SPDX-License-Identifier: MIT */
/* Entries of a library: what one scene lends to all. An entry is a scene document of a tree with
 * what it uses, and nothing else, so the checks, the printer and the drawing of scenes do for it.
 * Its kind says what a scene takes of it. */
#ifndef PROTOCOL_LIBRARY_H
#define PROTOCOL_LIBRARY_H

#include "scene.h"

#define LIBRARY_FORMAT "fieldcast-library/1"

enum library_kind {
    LIBRARY_PRIMITIVE, /* one node with code or an equation */
    LIBRARY_MATERIAL,  /* the only material; the tree is what it is shown on */
    LIBRARY_MODEL,     /* the tree */
    LIBRARY_KINDS
};

struct library_entry {
    enum library_kind kind;
    const char *id;      /* of the JSON, which has to live; NULL: it has none */
    struct scene *scene; /* with a name */
    char *text;          /* the printed scene */
};

const char *library_kind_name(enum library_kind kind);
/* LIBRARY_KINDS where there is none of that name. */
enum library_kind library_kind_find(const char *name);

/* Strictly reads {"id", "kind", "document"}; the id may be missing and is not looked at. False and
 * `err`, with its place below `place`. Caller finishes. */
bool library_entry_read(const cJSON *json, const char *place, struct library_entry *out,
                        struct error *err);
void library_entry_finish(struct library_entry *entry);

/* Strictly reads a file of entries, {"format", "entries": [...]}. NULL and `err` where one of them
 * breaks a rule. Caller frees with library_entries_destroy. */
struct library_entry *library_entries_read(const cJSON *json, size_t *out_count, struct error *err);
void library_entries_destroy(struct library_entry *entries, size_t count);

#endif
