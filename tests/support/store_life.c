/* SPDX-License-Identifier: MIT */
#include "store_life.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "server/cli/files.h"
#include "server/store/store.h"
#include "tests/support/drivers/disk_driver.h"
#include "tests/support/preload.h"

enum { FIRST_LIFE = 3, REVISIONS = 8, SNAPSHOT_AT = 6, PADDING = 2000 };

static disk_note_function *note; /* NULL: the disk remembers nothing */
static struct metrics metrics;
static int told;
static const char asset_id[] = "00000000000000000000000000000000000000000000000000000000000000aa";

void store_life_make_base(char *out, size_t size, const char *name)
{
    snprintf(out, size, "%s/fieldcast-%s-XXXXXX",
             access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp", name);
    if (!mkdtemp(out)) {
        abort();
    }
}

/* The document, or the operations, of a revision; caller frees. */
static char *text_of(const char *what, uint64_t revision)
{
    char *text = memory_alloc(PADDING + 100, 1);

    const int length = snprintf(text, 100, "%s %llu ", what, (unsigned long long)revision);
    memset(text + length, 'a' + (int)(revision % 26), PADDING);
    return text;
}

static void tell(int64_t number)
{
    if (note) {
        note(number);
    }
    if (write(told, &number, sizeof number) != sizeof number) {
        abort();
    }
}

static void on_durable(void *data)
{
    tell((int64_t)(intptr_t)data);
}

static void push(struct store *store, enum store_kind kind, uint64_t revision)
{
    struct store_write *write = memory_alloc(1, sizeof *write);

    write->kind = kind;
    write->revision = revision;
    snprintf(write->scene, sizeof write->scene, "s");
    snprintf(write->author, sizeof write->author, "ann");
    write->edit = kind == STORE_EDIT ? (int64_t)revision : 0;
    write->text = text_of(kind == STORE_EDIT ? "edit" : "document", revision);
    write->name = kind == STORE_SNAPSHOT ? NULL : memory_text("name");
    if (kind != STORE_SNAPSHOT) {
        write->on_durable = on_durable;
        write->data = (void *)(intptr_t)revision;
    }
    store_push(store, write);
}

static void push_asset(struct store *store)
{
    struct store_write *write = memory_alloc(1, sizeof *write);

    write->kind = STORE_ASSET;
    write->text = memory_text("");
    write->asset = memory_alloc(1, sizeof *write->asset);
    snprintf(write->asset->id, sizeof write->asset->id, "%s", asset_id);
    write->asset->info = (struct asset_info){.type = "image/png", .width = 1, .height = 1};
    write->asset->bytes = text_of("asset", 1);
    write->asset->length = strlen(write->asset->bytes);
    write->on_durable = on_durable;
    write->data = (void *)(intptr_t)STORE_LIFE_ASSET;
    store_push(store, write);
}

/* Some commits hold one write, some several. */
static void write_revisions(struct store *store, uint64_t first, uint64_t last)
{
    for (uint64_t revision = first; revision <= last; revision++) {
        push(store, revision == 1 ? STORE_CREATE : STORE_EDIT, revision);
        if (revision == SNAPSHOT_AT) {
            push(store, STORE_SNAPSHOT, revision);
            push_asset(store);
        }
        if (revision % 4 != 0) {
            store_flush(store);
        }
    }
}

int store_life(const char *directory, int told_fd)
{
    static const uint64_t ends[][2] = {{1, FIRST_LIFE}, {FIRST_LIFE + 1, REVISIONS}};
    struct error err = {0};

    told = told_fd;
    note = (disk_note_function *)preload_symbol("disk_note");
    if (!directory_make(directory, &err)) {
        return *err.message ? STORE_LIFE_REFUSED : STORE_LIFE_SILENT;
    }
    for (int i = 0; i < 2; i++) {
        struct store *store = store_open(directory, &metrics, &err);
        struct store_loaded loaded;
        if (!store) {
            return *err.message ? STORE_LIFE_REFUSED : STORE_LIFE_SILENT;
        }
        write_revisions(store, ends[i][0], ends[i][1]);
        if (store_load(store, "s", &loaded, &err)) {
            store_loaded_finish(&loaded);
        }
        store_close(store);
    }
    return 0;
}

void store_life_read_told(int fd, struct store_told *out)
{
    int64_t number;

    *out = (struct store_told){0};
    while (read(fd, &number, sizeof number) == sizeof number) {
        if (number == STORE_LIFE_ASSET) {
            out->asset = true;
        } else {
            out->revision = number;
        }
    }
}

static bool is_text_of(const char *text, const char *what, uint64_t revision)
{
    char *wanted = text_of(what, revision);
    const bool same = strcmp(text, wanted) == 0;

    free(wanted);
    return same;
}

static const char *fault_of(const struct store_loaded *loaded, int64_t revision)
{
    if (!is_text_of(loaded->document, "document", loaded->revision)) {
        return "another document";
    }
    for (size_t i = 0; i < loaded->edit_count; i++) {
        if (loaded->edits[i].revision != loaded->revision + i + 1 ||
            !is_text_of(loaded->edits[i].ops, "edit", loaded->edits[i].revision)) {
            return "another edit";
        }
    }
    return loaded->revision + loaded->edit_count < (uint64_t)revision ? "an edit is lost" : NULL;
}

static const char *fault_of_asset(struct store *store)
{
    void *bytes;
    size_t length;

    if (!store_load_asset(store, asset_id, &bytes, &length, NULL)) {
        return "a file is lost";
    }
    char *wanted = text_of("asset", 1);
    const bool same = length == strlen(wanted) && memcmp(bytes, wanted, length) == 0;
    free(wanted);
    free(bytes);
    return same ? NULL : "another file";
}

const char *store_life_fault(const char *directory, const struct store_told *durable)
{
    static char why[600];
    struct error err = {0};
    struct store_loaded loaded;
    const char *fault = NULL;

    if (access(directory, F_OK) != 0) {
        return durable->revision > 0 ? "the directory is lost" : NULL;
    }
    struct store *store = store_open(directory, &metrics, &err);
    if (!store) {
        snprintf(why, sizeof why, "not opened: %s", err.message);
        return why;
    }
    if (*store_damage(store)) {
        snprintf(why, sizeof why, "damaged: %s", store_damage(store));
        fault = why;
    } else if (store_load(store, "s", &loaded, &err)) {
        fault = fault_of(&loaded, durable->revision);
        store_loaded_finish(&loaded);
    } else if (durable->revision > 0) {
        snprintf(why, sizeof why, "not loaded: %s", err.message);
        fault = why;
    }
    if (!fault && durable->asset) {
        fault = fault_of_asset(store);
    }
    store_close(store);
    return fault;
}
