/* SPDX-License-Identifier: MIT */
#include "room_history.h"

#include <stdlib.h>
#include <string.h>

#include "last_good.h"
#include "protocol/json.h"
#include "protocol/memory.h"

static struct room_entry *entry_at(struct room *room, uint64_t revision)
{
    return &room->log[revision % ROOM_LOG];
}

void room_history_clear(struct room *room)
{
    for (size_t i = 0; i < ROOM_LOG; i++) {
        free(room->log[i].ops);
    }
    memset(room->log, 0, sizeof room->log);
    room->log_bytes = 0;
    room->log_from = room->revision;
}

static void forget_oldest(struct room *room)
{
    last_good_forget(room, room->log_from + 1);
    struct room_entry *entry = entry_at(room, ++room->log_from);

    room->log_bytes -= strlen(entry->ops);
    free(entry->ops);
    memset(entry, 0, sizeof *entry);
}

void room_history_add(struct room *room, const struct room_change *change, const char *ops)
{
    const size_t length = strlen(ops);

    while (room->log_from + 1 < room->revision &&
           (room->revision - room->log_from > ROOM_LOG ||
            (room->log_bytes + length > ROOM_LOG_BYTES && room->log_from < room->durable))) {
        forget_oldest(room);
    }
    struct room_entry *entry = entry_at(room, room->revision);
    *entry = (struct room_entry){
        .revision = room->revision, .edit = change->edit, .ops = memory_text(ops)};
    snprintf(entry->author, sizeof entry->author, "%s", change->author);
    snprintf(entry->name, sizeof entry->name, "%s", room_change_name(change));
    room->log_bytes += length;
}

const struct room_entry *room_history_find(const struct room *room, const char *author,
                                           int64_t edit)
{
    for (uint64_t r = room->revision; r > room->log_from; r--) {
        const struct room_entry *entry = room_entry_of(room, r);

        if (entry->edit == edit && strcmp(entry->author, author) == 0) {
            return entry;
        }
    }
    return NULL;
}

cJSON *room_history_since(const struct room *room, uint64_t from)
{
    cJSON *all = cJSON_CreateArray();

    for (uint64_t r = from + 1; r <= room->revision; r++) {
        const char *text = room_entry_of(room, r)->ops;
        cJSON *ops = json_parse_printed(text, strlen(text), NULL);

        while (ops && ops->child) {
            cJSON_AddItemToArray(all, cJSON_DetachItemViaPointer(ops, ops->child));
        }
        cJSON_Delete(ops);
    }
    return all;
}
