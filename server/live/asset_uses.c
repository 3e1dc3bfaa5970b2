/* SPDX-License-Identifier: MIT */
/* A name is looked for in the texts of documents and of edits behind them: 64 hexadecimal digits.
 * An edit that is not yet part of a document may have been undone; then a file counts as named for
 * a while. */
#include "asset_uses.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "asset_index.h"
#include "catalog.h"
#include "hub.h"
#include "protocol/memory.h"
#include "room_snapshot.h"

static struct asset_use *find(const struct asset_uses *names, const char *id, size_t length)
{
    for (size_t i = 0; length == ASSET_ID_CHARACTERS && i < names->count; i++) {
        if (memcmp(names->items[i].id, id, length) == 0) {
            return &names->items[i];
        }
    }
    return NULL;
}

static void add(struct asset_uses *names, const char *id, size_t length, const char *scene)
{
    struct asset_use *name = find(names, id, length);

    if (name) {
        snprintf(name->scene, sizeof name->scene, "%s", scene);
    }
}

static void read_text(void *data, const char *scene, const char *text)
{
    static const char digits[] = "0123456789abcdef";

    while (*(text += strcspn(text, digits))) {
        const size_t length = strspn(text, digits);

        add(data, text, length, scene);
        text += length;
    }
}

/* Under the hub's lock. */
static void begin(const struct hub *hub, struct asset_uses *out)
{
    out->count = hub->assets->count;
    out->items = memory_alloc(out->count, sizeof *out->items);
    for (size_t i = 0; i < out->count; i++) {
        memcpy(out->items[i].id, hub->assets->items[i].id, sizeof out->items[i].id);
    }
}

/* Under the hub's lock: the first edited room behind the one with the id `after`, by their ids. */
static struct room *next_edited(const struct hub *hub, const char *after)
{
    struct room *next = NULL;

    for (struct room *room = hub->rooms; room; room = room->next) {
        if (room->edits_since_snapshot && !room->deleted && strcmp(room->id, after) > 0 &&
            (!next || strcmp(room->id, next->id) < 0)) {
            next = room;
        }
    }
    return next;
}

/* Others have the lock between two rooms. */
static void store_edited(struct hub *hub)
{
    char id[LIMIT_ID_BYTES + 1] = "";

    for (struct room *room;;) {
        hub_lock(hub);
        room = next_edited(hub, id);
        if (room) {
            snprintf(id, sizeof id, "%s", room->id);
            room_snapshot_apart(room);
        }
        hub_unlock(hub);
        if (!room) {
            return;
        }
    }
}

bool asset_uses_read(struct hub *hub, struct asset_uses *out, struct error *err)
{
    hub_lock(hub);
    begin(hub, out);
    hub_unlock(hub);
    store_edited(hub);
    store_flush(hub->store);
    if (!store_list_texts(hub->store, read_text, out, err)) {
        asset_uses_finish(out);
        return false;
    }
    return true;
}

void asset_uses_finish(struct asset_uses *names)
{
    free(names->items);
    *names = (struct asset_uses){0};
}

void asset_uses_add_open(struct asset_uses *names, const struct hub *hub)
{
    for (const struct room *room = hub->rooms; room; room = room->next) {
        const char *image = record_text(&room->scene->environment, "image");

        if (!room->deleted) {
            add(names, image, strlen(image), room->id);
        }
    }
}

const char *asset_uses_scene(const struct asset_uses *names, const char *id)
{
    const struct asset_use *name = find(names, id, strlen(id));

    return !name ? "" : *name->scene ? name->scene : NULL;
}
