/* SPDX-License-Identifier: MIT */
#include "last_good.h"

#include <string.h>

#include "hub.h"
#include "protocol/code_text.h"
#include "protocol/json.h"
#include "room_apart.h"

static void drop(struct room *room)
{
    room_drop_scene(room->hub, room->last_good.scene);
    room->last_good.scene = NULL;
}

void last_good_finish(struct room *room)
{
    scene_destroy(room->last_good.scene);
}

void last_good_proven(struct room *room, uint64_t revision)
{
    if (revision > room->last_good.proven) {
        room->last_good.proven = revision;
    }
}

/* Takes the copy one revision further. */
static void step(struct room *room)
{
    struct last_good *good = &room->last_good;
    const char *text = room_entry_of(room, good->revision + 1)->ops;
    cJSON *ops = json_parse_printed(text, strlen(text), NULL);

    if (ops && edit_apply(good->scene, ops, NULL, NULL, NULL)) {
        good->revision++;
    } else {
        drop(room);
    }
    cJSON_Delete(ops);
}

/* The log leads on from it. */
static bool is_linked(const struct room *room)
{
    return room->last_good.scene && room->last_good.revision >= room->log_from;
}

static void advance(struct room *room)
{
    while (room->last_good.readers == 0 && is_linked(room) &&
           room->last_good.revision < room->last_good.proven &&
           room->last_good.revision < room->revision) {
        step(room);
    }
}

/* What holds no code needs no proof. */
static void prove_plain(struct room *room)
{
    if (!code_text_in_scene(room->scene)) {
        last_good_proven(room, room->revision);
    }
}

bool last_good_is_copied(const struct room *room, const cJSON *ops)
{
    const struct last_good *good = &room->last_good;
    char place[ERROR_PLACE_BYTES];

    return (good->code || (ops && code_text_find(ops, place))) && !is_linked(room) &&
           !(good->scene && good->proven < room->revision);
}

void last_good_before_edit(struct room *room, const cJSON *ops)
{
    struct last_good *good = &room->last_good;

    if (!last_good_is_copied(room, ops)) {
        return;
    }
    good->code = true;
    prove_plain(room);
    drop(room);
    good->scene = room_copy_to_edit(room);
    good->revision = room->revision;
}

bool last_good_before_replace(struct room *room, bool next_has_code)
{
    struct last_good *good = &room->last_good;

    if (!good->code && !next_has_code) {
        return false;
    }
    good->code = true;
    prove_plain(room);
    advance(room);
    if (good->proven < room->revision) {
        return false;
    }
    drop(room);
    good->scene = room->scene;
    good->revision = room->revision;
    return true;
}

void last_good_forget(struct room *room, uint64_t revision)
{
    struct last_good *good = &room->last_good;

    if (!good->scene || good->revision + 1 != revision) {
        return;
    }
    if (good->proven >= revision) {
        step(room);
    } else if (good->proven < good->revision) {
        drop(room);
    }
}

struct scene *last_good_copy(struct room *room, const struct scene *good)
{
    room_hold(room);
    room->last_good.readers++;
    hub_unlock(room->hub);
    struct scene *copy = scene_copy(good);
    hub_lock(room->hub);
    room->last_good.readers--;
    room_release(room);
    return copy;
}

const struct scene *last_good_state(struct room *room, uint64_t *out_revision)
{
    struct last_good *good = &room->last_good;

    advance(room);
    if (!good->scene || good->revision > good->proven || good->revision >= room->revision) {
        return NULL;
    }
    *out_revision = good->revision;
    return good->scene;
}
