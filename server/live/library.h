/* SPDX-License-Identifier: MIT */
/* The library in memory: what it holds is listed, read and drawn without the disk. Every change is
 * queued for the store at once. Every function is called under the hub's lock. */
#ifndef SERVER_LIBRARY_H
#define SERVER_LIBRARY_H

#include "protocol/library.h"
#include "server/store/store.h"

enum { LIBRARY_TAG_BYTES = 24 };

struct library_item {
    char id[LIMIT_ID_BYTES + 1];
    char tag[LIBRARY_TAG_BYTES]; /* of kind and document, with its quotes */
    enum library_kind kind;
    char *name, *text; /* the printed document */
    size_t nodes;
    int64_t modified_ms; /* since 1970 */
};

/* Sorted by id. */
struct library {
    struct library_item *items;
    size_t count;
    size_t bytes; /* of the texts */
};

void library_finish(struct library *library);
/* Adds an entry that the store lists; `data` is the library. */
void library_add(void *data, const struct store_entry *entry);
const struct library_item *library_find(const struct library *library, const char *id);
/* Whether `count` more entries with `bytes` of text may be kept. False and `err`: no. */
bool library_has_room(const struct library *library, size_t count, size_t bytes, struct error *err);
/* A free id that resembles the name. */
void library_free_id(const struct library *library, const struct library_entry *entry,
                     char out[LIMIT_ID_BYTES + 1]);
/* Puts an entry under an id, in place of what is there. The write is to be pushed by the caller. */
struct store_write *library_set(struct library *library, const char *id,
                                const struct library_entry *entry);
struct store_write *library_remove(struct library *library, const char *id);
/* JSON that library_entry_read and library_entries_read take. Caller frees. */
char *library_print_item(const struct library_item *item, size_t *out_length);
char *library_print_file(const struct library *library, size_t *out_length);
bool library_is_same(const struct library_item *item, const struct library_entry *entry);

#endif
