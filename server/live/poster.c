/* SPDX-License-Identifier: MIT */
#include "poster.h"

#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "protocol/limits.h"
#include "protocol/memory.h"
#include "room_state.h"

void poster_set(struct room *room, struct shared_buffer *jpeg)
{
    if (jpeg->length > LIMIT_POSTER_BYTES || jpeg == room->poster) {
        return;
    }
    poster_finish(room);
    room->poster = shared_buffer_ref(jpeg);
    room->poster_stored = false;
}

void poster_store(struct room *room)
{
    if (!room->poster || room->poster_stored) {
        return;
    }
    struct store_write *write = memory_alloc(1, sizeof *write);
    struct store_asset *picture = memory_alloc(1, sizeof *picture);

    picture->length = room->poster->length;
    picture->bytes = memory_alloc(picture->length, 1);
    memcpy(picture->bytes, room->poster->bytes, picture->length);
    *write = (struct store_write){.kind = STORE_POSTER, .asset = picture};
    snprintf(write->scene, sizeof write->scene, "%s", room->id);
    room->poster_stored = true;
    store_push(room->hub->store, write);
}

void poster_finish(struct room *room)
{
    if (room->poster) {
        shared_buffer_unref(room->poster);
    }
    room->poster = NULL;
}

static struct shared_buffer *find_open(struct hub *hub, const char *scene)
{
    struct shared_buffer *poster = NULL;

    hub_lock(hub);
    for (struct room *room = hub->rooms; room && !poster; room = room->next) {
        if (strcmp(room->id, scene) == 0 && room->poster) {
            poster = shared_buffer_ref(room->poster);
        }
    }
    hub_unlock(hub);
    return poster;
}

struct shared_buffer *poster_find(struct hub *hub, const char *scene)
{
    struct shared_buffer *poster = find_open(hub, scene);
    size_t length = 0;
    void *bytes = NULL;

    if (!poster && store_load_poster(hub->store, scene, &bytes, &length, NULL)) {
        poster = shared_buffer_create(bytes, length);
    }
    free(bytes);
    return poster;
}
