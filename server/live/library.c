/* SPDX-License-Identifier: MIT */
#include "library.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "protocol/memory.h"
#include "server/digest.h"

enum { SLUG_BYTES = 48 };

/* Where `id` is or would be. */
static size_t position(const struct library *library, const char *id)
{
    size_t low = 0, high = library->count;

    while (low < high) {
        const size_t middle = low + (high - low) / 2;

        if (strcmp(library->items[middle].id, id) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static bool is_at(const struct library *library, size_t at, const char *id)
{
    return at < library->count && strcmp(library->items[at].id, id) == 0;
}

static void item_finish(struct library_item *item)
{
    free(item->name);
    free(item->text);
}

void library_finish(struct library *library)
{
    for (size_t i = 0; i < library->count; i++) {
        item_finish(&library->items[i]);
    }
    free(library->items);
    *library = (struct library){0};
}

const struct library_item *library_find(const struct library *library, const char *id)
{
    const size_t at = position(library, id);

    return is_at(library, at, id) ? &library->items[at] : NULL;
}

static void set_tag(struct library_item *item)
{
    char digest[ASSET_ID_CHARACTERS + 1];

    digest_text(item->text, strlen(item->text), digest);
    snprintf(item->tag, sizeof item->tag, "\"%d-%.16s\"", (int)item->kind, digest);
}

/* Room for `id`, with nothing in it. */
static struct library_item *place(struct library *library, const char *id)
{
    const size_t at = position(library, id);

    if (is_at(library, at, id)) {
        library->bytes -= strlen(library->items[at].text);
        item_finish(&library->items[at]);
    } else {
        library->items = memory_one_more(library->items, library->count, sizeof *library->items);
        memmove(library->items + at + 1, library->items + at,
                (library->count - at) * sizeof *library->items);
        library->count++;
    }
    struct library_item *item = &library->items[at];
    *item = (struct library_item){0};
    snprintf(item->id, sizeof item->id, "%s", id);
    return item;
}

void library_add(void *data, const struct store_entry *entry)
{
    struct library *library = data;
    const enum library_kind kind = library_kind_find(entry->kind);

    if (kind == LIBRARY_KINDS) {
        return;
    }
    struct library_item *item = place(library, entry->id);
    item->kind = kind;
    item->name = memory_text(entry->name);
    item->text = memory_text(entry->document);
    item->nodes = entry->nodes;
    item->modified_ms = entry->modified_ms;
    library->bytes += strlen(item->text);
    set_tag(item);
}

bool library_has_room(const struct library *library, size_t count, size_t bytes, struct error *err)
{
    return (library->count + count <= LIMIT_LIBRARY_ENTRIES &&
            library->bytes + bytes <= LIMIT_LIBRARY_BYTES) ||
           error_set(err, ERROR_FULL, "/v1/library",
                     "%zu entries of %zu bytes would be kept; the limits are %d entries and %d "
                     "bytes",
                     library->count + count, library->bytes + bytes, LIMIT_LIBRARY_ENTRIES,
                     LIMIT_LIBRARY_BYTES);
}

/* "Mug, large" becomes "mug-large". */
static void make_slug(const char *name, char out[SLUG_BYTES])
{
    size_t length = 0;

    for (const char *c = name; *c && length < SLUG_BYTES - 1; c++) {
        if (isascii(*c) && isalnum(*c)) {
            out[length++] = (char)tolower(*c);
        } else if (length > 0 && out[length - 1] != '-') {
            out[length++] = '-';
        }
    }
    while (length > 0 && out[length - 1] == '-') {
        length--;
    }
    out[length] = '\0';
}

void library_free_id(const struct library *library, const struct library_entry *entry,
                     char out[LIMIT_ID_BYTES + 1])
{
    char slug[SLUG_BYTES];

    make_slug(record_text(&entry->scene->info, "name"), slug);
    if (!*slug) {
        snprintf(slug, sizeof slug, "%s", library_kind_name(entry->kind));
    }
    snprintf(out, LIMIT_ID_BYTES + 1, "%s", slug);
    for (int number = 2; library_find(library, out); number++) {
        snprintf(out, LIMIT_ID_BYTES + 1, "%s-%d", slug, number);
    }
}

struct store_write *library_set(struct library *library, const char *id,
                                const struct library_entry *entry)
{
    struct store_write *write = memory_alloc(1, sizeof *write);
    struct library_item *item = place(library, id);
    struct timespec now;

    clock_gettime(CLOCK_REALTIME, &now);
    item->kind = entry->kind;
    item->name = memory_text(record_text(&entry->scene->info, "name"));
    item->text = memory_text(entry->text);
    item->nodes = entry->scene->node_count;
    item->modified_ms = (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
    library->bytes += strlen(item->text);
    set_tag(item);
    *write = (struct store_write){.kind = STORE_LIBRARY,
                                  .sort = library_kind_name(entry->kind),
                                  .text = memory_text(entry->text),
                                  .name = memory_text(item->name),
                                  .nodes = item->nodes};
    snprintf(write->scene, sizeof write->scene, "%s", id);
    return write;
}

struct store_write *library_remove(struct library *library, const char *id)
{
    const size_t at = position(library, id);
    struct store_write *write = memory_alloc(1, sizeof *write);

    *write = (struct store_write){.kind = STORE_LIBRARY_DELETE};
    snprintf(write->scene, sizeof write->scene, "%s", id);
    if (is_at(library, at, id)) {
        library->bytes -= strlen(library->items[at].text);
        item_finish(&library->items[at]);
        library->count--;
        memmove(library->items + at, library->items + at + 1,
                (library->count - at) * sizeof *library->items);
    }
    return write;
}

static FILE *open_text(char **out, size_t *out_length)
{
    FILE *file = open_memstream(out, out_length);

    if (!file) {
        abort();
    }
    return file;
}

static void print_item(FILE *out, const struct library_item *item)
{
    fprintf(out, "{\"id\":\"%s\",\"kind\":\"%s\",\"document\":%s}", item->id,
            library_kind_name(item->kind), item->text);
}

char *library_print_item(const struct library_item *item, size_t *out_length)
{
    char *text = NULL;
    FILE *out = open_text(&text, out_length);

    print_item(out, item);
    fclose(out);
    return text;
}

char *library_print_file(const struct library *library, size_t *out_length)
{
    char *text = NULL;
    FILE *out = open_text(&text, out_length);

    fputs("{\"format\":\"" LIBRARY_FORMAT "\",\"entries\":[", out);
    for (size_t i = 0; i < library->count; i++) {
        fputs(i > 0 ? ",\n" : "", out);
        print_item(out, &library->items[i]);
    }
    fputs("]}\n", out);
    fclose(out);
    return text;
}

bool library_is_same(const struct library_item *item, const struct library_entry *entry)
{
    return item->kind == entry->kind && strcmp(item->text, entry->text) == 0;
}
