/* SPDX-License-Identifier: MIT */
#include "room_store.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "catalog.h"
#include "hub.h"
#include "protocol/memory.h"
#include "room_apart.h"
#include "session.h"

/* A commit under way. */
struct commit {
    struct room *room;
    uint64_t revision;
    char author[LIMIT_ID_BYTES + 1];
    int64_t edit;
    void (*then)(void *data);
    void *data;
};

static void on_durable(void *data)
{
    struct commit *commit = data;
    struct room *room = commit->room;
    struct hub *hub = room->hub;

    hub_lock(hub);
    if (commit->revision > room->durable) {
        room->durable = commit->revision;
    }
    const struct author *author =
        commit->edit > 0 ? authors_find(&room->authors, commit->author) : NULL;
    if (author && author->session) {
        session_tell_durable(author->session, commit->edit, commit->revision);
    }
    room->pending--;
    const bool last = room->deleted && room->pending == 0;
    hub_unlock(hub);
    if (last) {
        room_drop(room); /* nobody else knows it any more */
    }
    if (commit->then) {
        commit->then(commit->data);
    }
    free(commit);
}

void room_store_push(struct room *room, enum store_kind kind, const struct room_change *change,
                     char *text, const struct store_step *step)
{
    struct store_write *write = memory_alloc(1, sizeof *write);
    struct commit *commit = memory_alloc(1, sizeof *commit);
    const char *name = record_text(&room->scene->info, "name");

    commit->room = room;
    commit->revision = room->revision;
    commit->edit = change->edit;
    commit->then = change->then;
    commit->data = change->data;
    snprintf(commit->author, sizeof commit->author, "%s", change->author);
    write->kind = kind;
    write->revision = room->revision;
    write->edit = change->edit;
    write->text = text;
    write->step = step ? *step : (struct store_step){0};
    write->name = memory_text(name);
    write->nodes = room->scene->node_count;
    write->on_durable = on_durable;
    write->data = commit;
    snprintf(write->scene, sizeof write->scene, "%s", room->id);
    snprintf(write->author, sizeof write->author, "%s", change->author);
    snprintf(write->key, sizeof write->key, "%s", change->by ? change->by->key : "");
    room->pending++;
    store_push(room->hub->store, write);
    if (kind == STORE_CREATE || kind == STORE_EDIT || kind == STORE_REPLACE) {
        struct timespec now;

        clock_gettime(CLOCK_REALTIME, &now);
        catalog_set(room->hub->catalog, room->id, name, room->revision, room->scene->node_count,
                    (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000);
    }
}

void room_store_new(struct room *room, char *text, void (*then)(void *data), void *data)
{
    room_store_push(room, STORE_CREATE,
                    &(struct room_change){.author = "", .then = then, .data = data}, text, NULL);
}

void room_store_deleted(struct room *room, void (*then)(void *data), void *data)
{
    room->deleted = true;
    room_store_push(room, STORE_DELETE,
                    &(struct room_change){.author = "", .then = then, .data = data}, NULL, NULL);
}

void room_store_author(struct room *room, struct author *author)
{
    room_store_push(room, STORE_AUTHOR, &(struct room_change){.author = author->id, .by = author},
                    NULL, NULL);
}
