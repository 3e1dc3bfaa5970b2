/* SPDX-License-Identifier: MIT */
#include "room_state.h"

const char *room_change_name(const struct room_change *change)
{
    return change->by ? change->by->name : change->author;
}

const struct room_entry *room_entry_of(const struct room *room, uint64_t revision)
{
    return &room->log[revision % ROOM_LOG];
}
