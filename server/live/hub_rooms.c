/* SPDX-License-Identifier: MIT */
#include "hub_rooms.h"

#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "catalog.h"
#include "protocol/memory.h"
#include "render_queue.h"
#include "room.h"
#include "room_apart.h"
#include "room_store.h"
#include "room_sync.h"
#include "server/log.h"
#include "session_life.h"

static void add_room(struct hub *hub, struct room *room)
{
    room->next = hub->rooms;
    hub->rooms = room;
    metric_add(&hub->metrics, METRIC_ROOMS, 1);
}

void hub_remove_room(struct hub *hub, struct room *room)
{
    struct room **link = &hub->rooms;

    while (*link != room) {
        link = &(*link)->next;
    }
    *link = room->next;
    metric_add(&hub->metrics, METRIC_ROOMS, -1);
    room_sync_close(room);
}

static struct room *load_room(struct hub *hub, const char *id, struct error *err)
{
    struct store_loaded loaded;
    struct room *room = NULL;

    if (store_load(hub->store, id, &loaded, err)) {
        room = room_load(hub, id, &loaded, err);
        store_loaded_finish(&loaded);
        if (!room) {
            log_error("hub", "scene %s cannot be read: %s: %s", id, err->place, err->message);
            err->kind = ERROR_INTERNAL;
        }
    }
    metric_add(&hub->metrics, METRIC_SCENES_UNREADABLE, !room && err->kind == ERROR_INTERNAL);
    return room;
}

bool hub_has_scene(struct hub *hub, const char *id)
{
    hub_lock(hub);
    const bool found = catalog_find(hub->catalog, id) != NULL;
    hub_unlock(hub);
    return found;
}

bool hub_scene_is_heavy(struct hub *hub, const char *id)
{
    hub_lock(hub);
    const struct catalog_entry *entry = catalog_find(hub->catalog, id);
    const bool heavy = entry && entry->nodes > TASK_LIGHT_NODES;
    hub_unlock(hub);
    return heavy;
}

bool hub_is_ready(struct hub *hub, const char *id)
{
    hub_lock(hub);
    const struct catalog_entry *entry = catalog_find(hub->catalog, id);
    const bool ready = !entry || (hub_find_room(hub, id) && entry->nodes <= TASK_LIGHT_NODES);
    hub_unlock(hub);
    return ready;
}

static struct room *no_such_scene(const char *id, struct error *err)
{
    error_set(err, ERROR_NOT_FOUND, "", "there is no scene %s", id);
    return NULL;
}

/* A damaged database may list a scene and not find it. Under the lock. */
static void tell_lost(struct hub *hub, const char *id, struct error *err)
{
    if (err && err->kind == ERROR_NOT_FOUND) {
        log_error("hub", "scene %s is listed, and the database does not find it", id);
        metric_add(&hub->metrics, METRIC_SCENES_UNREADABLE, 1);
        error_set(err, ERROR_INTERNAL, id, "the database does not find it");
    }
}

/* Only this function loads, and none twice at a time, so a room found missing stays missing until
 * here it is added. A room that left memory was committed before. */
struct room *hub_lock_room(struct hub *hub, const char *id, struct error *err)
{
    hub_lock(hub);
    struct room *room = hub_find_room(hub, id);
    if (room) {
        return room;
    }
    const struct catalog_entry *entry = catalog_find(hub->catalog, id);
    pthread_mutex_t *load_lock = &hub->load_lock[entry && entry->nodes > TASK_LIGHT_NODES];
    hub_unlock(hub);
    if (!entry) {
        return no_such_scene(id, err);
    }

    pthread_mutex_lock(load_lock);
    hub_lock(hub);
    room = hub_find_room(hub, id);
    if (!room) {
        hub_unlock(hub);
        struct room *loaded = load_room(hub, id, err);

        hub_lock(hub);
        const bool listed = catalog_find(hub->catalog, id) != NULL;
        if (loaded && listed) {
            room = loaded;
            add_room(hub, room);
        } else {
            room_destroy(loaded);
        }
        if (!loaded && listed) {
            tell_lost(hub, id, err);
        }
    }
    if (!room) {
        hub_unlock(hub);
        if (err && err->kind == ERROR_NONE) {
            no_such_scene(id, err);
        }
    }
    pthread_mutex_unlock(load_lock);
    return room;
}

struct room *hub_lock_room_to_change(struct hub *hub, const char *id, struct error *err)
{
    struct room *room;

    while ((room = hub_lock_room(hub, id, err)) && room->holds > 0) {
        hub_wait(hub, &hub->released);
        hub_unlock(hub);
    }
    return room;
}

/* An id that people can say: "amber-fox-482". */
static void invent_id(const struct hub *hub, char out[LIMIT_ID_BYTES + 1])
{
    static const char *const colours[] = {"amber", "azure", "coral", "ivory", "jade", "lilac",
                                          "mint",  "ochre", "olive", "pearl", "ruby", "sable",
                                          "sand",  "slate", "teal",  "umber"};
    static const char *const things[] = {"arch",  "bell",  "bridge", "cloud",  "cove",  "dune",
                                         "fern",  "fox",   "harbor", "island", "maple", "meadow",
                                         "otter", "river", "stone",  "tower"};
    uint32_t number = 0;

    do {
        if (getrandom(&number, sizeof number, 0) != sizeof number) {
            abort();
        }
        snprintf(out, LIMIT_ID_BYTES + 1, "%s-%s-%u", colours[number & 15],
                 things[number >> 4 & 15], 100 + (number >> 8) % 99900);
    } while (catalog_find(hub->catalog, out));
}

struct room *hub_lock_new_room(struct hub *hub, const char *id, struct scene *scene, char *text,
                               void (*then)(void *data), void *data, struct error *err)
{
    struct room *room = room_create(hub, "", scene, 1); /* looks through the scene */
    char name[LIMIT_ID_BYTES + 1];

    hub_lock(hub);
    snprintf(name, sizeof name, "%s", id);
    if (!*name) {
        invent_id(hub, name);
    }
    if (atomic_load(&hub->draining)) {
        error_set(err, ERROR_UNAVAILABLE, "", "the server is shutting down");
    } else if (!hub_id_is_valid(name)) {
        error_set(err, ERROR_INVALID, "?id", "an id is 1 to %d of a-z, 0-9 and -", LIMIT_ID_BYTES);
    } else if (catalog_find(hub->catalog, name)) {
        error_set(err, ERROR_CONFLICT, "?id", "there is a scene %s already", name);
    } else if (room_check_bytes(strlen(text), err)) {
        snprintf(room->id, sizeof room->id, "%s", name);
        room->bytes = strlen(text);
        add_room(hub, room);
        room_store_new(room, text, then, data);
        metric_set(&hub->metrics, METRIC_SCENES, (int64_t)hub->catalog->count);
        return room;
    }
    hub_unlock(hub);
    room_destroy(room);
    free(text);
    return NULL;
}

void hub_delete_room(struct hub *hub, struct room *room, void (*then)(void *data), void *data)
{
    render_queue_cancel_room(hub, room);
    while (room->sessions) {
        session_close(room->sessions, CLOSE_NORMAL, "deleted", -1);
        session_leave_room(room->sessions);
    }
    hub_remove_room(hub, room);
    catalog_remove(hub->catalog, room->id);
    metric_set(&hub->metrics, METRIC_SCENES, (int64_t)hub->catalog->count);
    room_store_deleted(room, then, data);
}
