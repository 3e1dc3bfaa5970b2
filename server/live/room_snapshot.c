/* SPDX-License-Identifier: MIT */
#include "room_snapshot.h"

#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "protocol/memory.h"
#include "room_apart.h"
#include "room_authors.h"
#include "room_store.h"

void room_snapshot(struct room *room)
{
    char *text =
        room->text ? memory_text((const char *)room->text->bytes) : scene_print(room->scene, false);

    room->bytes = strlen(text);
    room->edits_since_snapshot = 0;
    room_store_push(room, STORE_SNAPSHOT, &(struct room_change){.author = ""}, text, NULL);
    room_authors_cut(room);
}

void room_snapshot_apart(struct room *room)
{
    if (room_is_heavy(room)) {
        shared_buffer_unref(room_text(room));
    }
    room_snapshot(room);
}

struct snapshot {
    struct hub *hub;
    char id[LIMIT_ID_BYTES + 1];
};

static void store_snapshot(void *data, bool dropped)
{
    struct snapshot *snapshot = data;
    struct hub *hub = snapshot->hub;
    struct room *room = NULL;

    hub_lock(hub);
    /* It stays open until it has one. */
    while (!dropped && (room = hub_find_room(hub, snapshot->id)) && room->holds > 0) {
        hub_wait(hub, &hub->released);
    }
    if (room) {
        room->snapshot_soon = false;
        room_snapshot_apart(room);
    }
    hub_unlock(hub);
    free(snapshot);
}

void room_snapshot_soon(struct room *room)
{
    if (!room_is_heavy(room) || room->text) {
        room_snapshot(room);
        return;
    }
    if (room->snapshot_soon) {
        return;
    }
    struct snapshot *snapshot = memory_alloc(1, sizeof *snapshot);

    snapshot->hub = room->hub;
    snprintf(snapshot->id, sizeof snapshot->id, "%s", room->id);
    room->snapshot_soon = tasks_add(room->hub->tasks,
                                    &(struct task_order){.scene = room->id,
                                                         .account = "",
                                                         .heavy = true,
                                                         .run = store_snapshot,
                                                         .data = snapshot},
                                    NULL);
    if (!room->snapshot_soon) {
        free(snapshot);
    }
}
