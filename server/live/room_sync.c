/* SPDX-License-Identifier: MIT */
#include "room_sync.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "asset_index.h"
#include "hub.h"
#include "last_good.h"
#include "protocol/code_text.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "quarantine.h"
#include "render_entry.h"
#include "room_apart.h"
#include "room_history.h"

/* The file that the environment names, which the worker keeps as long as its scene does. */
static void send_image(struct room *room, const struct scene *scene)
{
    const char *image = record_text(&scene->environment, "image");

    if (*image && strcmp(image, room->image) != 0 && asset_index_find(room->hub->assets, image)) {
        snprintf(room->image, sizeof room->image, "%s", image);
        asset_index_send(room->hub, image);
    }
}

void room_sync_send_scene(struct hub *hub, const struct packet_scene *packet,
                          struct shared_buffer *text)
{
    supervisor_send_shared(hub->supervisor,
                           &(struct packet){.kind = TO_WORKER_SCENE,
                                            .scene = *packet,
                                            .payload_length = text->length - 1},
                           text);
}

/* Where code is not allowed, none reaches the worker. Takes the operations. */
static void send_edit(struct room *room, cJSON *ops)
{
    struct hub *hub = room->hub;

    send_image(room, room->scene);
    if (hub->code_refused) {
        code_text_remove(ops);
    }
    supervisor_send(hub->supervisor, &(struct packet){.kind = TO_WORKER_EDIT,
                                                      .edit = {room->id, room->revision, ops}});
    cJSON_Delete(ops);
    room->sent = room->revision;
}

/* Its document without code where that is not allowed. Needs no lock. */
static struct shared_buffer *print_scene(const struct hub *hub, const struct scene *scene)
{
    cJSON *document = scene_to_json(scene);

    if (hub->code_refused) {
        code_text_remove(document);
    }
    char *text = json_print(document, false);
    cJSON_Delete(document);
    memory_settle();
    return shared_buffer_take(text, strlen(text) + 1);
}

static bool is_printed(const struct room *room, const struct scene *scene)
{
    return room->text && scene == room->scene && !room->hub->code_refused;
}

/* Takes `text`. */
static void send_text(struct room *room, const struct scene *scene, uint64_t revision,
                      struct shared_buffer *text)
{
    send_image(room, scene);
    room_sync_send_scene(room->hub, &(struct packet_scene){.scene = room->id, .revision = revision},
                         text);
    shared_buffer_unref(text);
    room->sent = revision;
}

static void send_scene(struct room *room, const struct scene *scene, uint64_t revision)
{
    send_text(room, scene, revision,
              is_printed(room, scene) ? shared_buffer_ref(room->text)
                                      : print_scene(room->hub, scene));
}

/* What the worker gets first. */
static const struct scene *first_state(struct room *room, uint64_t *out_revision)
{
    const bool doubtful =
        room->scene_error.kind != ERROR_NONE || quarantine_is_tried_again(room->hub, room);
    const struct scene *good = doubtful ? last_good_state(room, out_revision) : NULL;

    if (!good) {
        *out_revision = room->revision;
    }
    return good ? good : room->scene;
}

/* --- many nodes --- */

/* Prints the state without the lock, and sends it, if it is still needed then. */
static void print_and_send(struct room *room)
{
    uint64_t revision;
    const struct scene *scene = first_state(room, &revision);
    struct shared_buffer *text;

    room_hold(room);
    room->last_good.readers++;
    if (scene == room->scene && !room->hub->code_refused) {
        text = room_text(room);
    } else {
        hub_unlock(room->hub);
        text = print_scene(room->hub, scene);
        hub_lock(room->hub);
    }
    if (room->sent == 0 && room->hub->render_queue->ready) {
        room->image[0] = '\0';
        send_text(room, scene, revision, text);
    } else {
        shared_buffer_unref(text);
    }
    room->last_good.readers--;
    room_release(room);
}

struct errand {
    struct hub *hub;
    char id[LIMIT_ID_BYTES + 1];
};

static void run_errand(void *data, bool dropped)
{
    struct errand *errand = data;

    hub_lock(errand->hub);
    struct room *room = dropped ? NULL : hub_find_room(errand->hub, errand->id);
    if (room) {
        print_and_send(room);
        room->printing = false;
        supervisor_wake(errand->hub->supervisor); /* orders wait for it */
    }
    hub_unlock(errand->hub);
    free(errand);
}

static void print_apart(struct room *room)
{
    if (room->printing) {
        return;
    }
    struct errand *errand = memory_alloc(1, sizeof *errand);

    errand->hub = room->hub;
    snprintf(errand->id, sizeof errand->id, "%s", room->id);
    const struct task_order order = {
        .scene = room->id, .account = "", .heavy = true, .run = run_errand, .data = errand};
    room->printing = tasks_add(room->hub->tasks, &order, NULL);
    if (!room->printing) {
        free(errand); /* the server is shutting down */
    }
}

bool room_sync_open(struct room *room)
{
    uint64_t revision;

    if (room->sent > 0) {
        return true;
    }
    const struct scene *scene = first_state(room, &revision);
    if (room_is_heavy(room) && !is_printed(room, scene)) {
        print_apart(room);
        return false;
    }
    room->image[0] = '\0';
    send_scene(room, scene, revision);
    return true;
}

void room_sync_done(struct room *room, uint64_t revision)
{
    if (room->sent == 0 || room->sent >= room->revision || revision < room->sent) {
        return;
    }
    if (room->sent < room->log_from) {
        send_scene(room, room->scene, room->revision);
        return;
    }
    send_edit(room, room_history_since(room, room->sent));
}

void room_sync_edit(struct room *room, const cJSON *ops, const char *text)
{
    if (room->sent == 0 || room->sent + 1 != room->revision) {
        return; /* room_sync_done sends all at once */
    }
    /* A text has no members that code_text_remove could find. */
    send_edit(room, room->hub->code_refused ? cJSON_Duplicate(ops, true) : cJSON_CreateRaw(text));
}

void room_sync_replace(struct room *room)
{
    if (room->sent > 0 && room->sent + 1 == room->revision) {
        send_scene(room, room->scene, room->revision);
    }
}

bool room_sync_upload(struct room *room, const char *id)
{
    const bool named = strcmp(record_text(&room->scene->environment, "image"), id) == 0;

    if (named && room->sent > 0) {
        send_image(room, room->scene);
    }
    return named;
}

void room_sync_close(struct room *room)
{
    if (room->sent > 0) {
        supervisor_send(room->hub->supervisor,
                        &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = room->id}});
    }
}
