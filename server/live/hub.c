/* SPDX-License-Identifier: MIT */
#include "hub.h"

#include <string.h>

#include "protocol/code_text.h"
#include "room_state.h"

void hub_lock(struct hub *hub)
{
    pthread_mutex_lock(&hub->lock);
}

void hub_unlock(struct hub *hub)
{
    pthread_mutex_unlock(&hub->lock);
}

bool hub_id_is_valid(const char *id)
{
    size_t length = strlen(id);

    return length > 0 && length <= LIMIT_ID_BYTES &&
           strspn(id, "abcdefghijklmnopqrstuvwxyz0123456789-") == length;
}

static bool refuse_code(const char *place, struct error *err)
{
    return error_set(err, ERROR_FORBIDDEN, place, "this server takes no code (option `code`)");
}

bool hub_accepts_scene(const struct hub *hub, const struct scene *scene, struct error *err)
{
    char place[ERROR_PLACE_BYTES];

    return !hub->code_refused || !code_text_in_scene(scene) ||
           refuse_code(code_text_changed(scene, NULL, place), err);
}

bool hub_accepts_edit(const struct hub *hub, const cJSON *ops, struct error *err)
{
    char place[ERROR_PLACE_BYTES];

    return !hub->code_refused || !code_text_find(ops, place) || refuse_code(place, err);
}

struct room *hub_find_room(const struct hub *hub, const char *id)
{
    struct room *room = hub->rooms;

    while (room && strcmp(room->id, id) != 0) {
        room = room->next;
    }
    return room;
}
