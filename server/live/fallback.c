/* SPDX-License-Identifier: MIT */
#include "fallback.h"

#include <string.h>

#include "protocol/code_text.h"
#include "protocol/json.h"
#include "room_state.h"

static void drop(struct fallback *fallback)
{
    scene_destroy(fallback->scene);
    fallback->scene = NULL;
}

void fallback_finish(struct room *room)
{
    drop(&room->fallback);
}

void fallback_proven(struct room *room, uint64_t revision)
{
    if (revision > room->fallback.proven) {
        room->fallback.proven = revision;
    }
}

/* Takes the copy one revision further. */
static void step(struct room *room)
{
    struct fallback *fallback = &room->fallback;
    const char *text = room_entry_of(room, fallback->revision + 1)->ops;
    cJSON *ops = json_parse(text, strlen(text), NULL);

    if (ops && edit_apply(fallback->scene, ops, NULL, NULL, NULL)) {
        fallback->revision++;
    } else {
        drop(fallback);
    }
    cJSON_Delete(ops);
}

/* The log leads on from it. */
static bool is_linked(const struct room *room)
{
    return room->fallback.scene && room->fallback.revision >= room->log_from;
}

static void advance(struct room *room)
{
    while (is_linked(room) && room->fallback.revision < room->fallback.proven &&
           room->fallback.revision < room->revision) {
        step(room);
    }
}

/* What holds no code needs no proof. */
static void prove_plain(struct room *room)
{
    if (!code_text_in_scene(room->scene)) {
        fallback_proven(room, room->revision);
    }
}

void fallback_before_edit(struct room *room, const cJSON *ops)
{
    struct fallback *fallback = &room->fallback;
    char place[ERROR_PLACE_BYTES];

    fallback->code = fallback->code || (ops && code_text_find(ops, place));
    if (!fallback->code || is_linked(room) ||
        (fallback->scene && fallback->proven < room->revision)) {
        return;
    }
    prove_plain(room);
    drop(fallback);
    fallback->scene = scene_copy(room->scene);
    fallback->revision = room->revision;
}

bool fallback_before_replace(struct room *room, const struct scene *next)
{
    struct fallback *fallback = &room->fallback;

    if (!fallback->code && !code_text_in_scene(next)) {
        return false;
    }
    fallback->code = true;
    prove_plain(room);
    advance(room);
    if (fallback->proven < room->revision) {
        return false;
    }
    drop(fallback);
    fallback->scene = room->scene;
    fallback->revision = room->revision;
    return true;
}

void fallback_forget(struct room *room, uint64_t revision)
{
    struct fallback *fallback = &room->fallback;

    if (!fallback->scene || fallback->revision + 1 != revision) {
        return;
    }
    if (fallback->proven >= revision) {
        step(room);
    } else if (fallback->proven < fallback->revision) {
        drop(fallback);
    }
}

const struct scene *fallback_state(struct room *room, uint64_t *out_revision)
{
    struct fallback *fallback = &room->fallback;

    advance(room);
    if (!fallback->scene || fallback->revision > fallback->proven ||
        fallback->revision >= room->revision) {
        return NULL;
    }
    *out_revision = fallback->revision;
    return fallback->scene;
}
