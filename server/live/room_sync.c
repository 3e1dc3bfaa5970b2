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
#include "quarantine.h"
#include "room_history.h"
#include "room_state.h"

/* The file that the environment names, which the worker keeps as long as its scene does. */
static void send_image(struct room *room, const struct scene *scene)
{
    const char *image = record_text(&scene->environment, "image");

    if (*image && strcmp(image, room->image) != 0 && asset_index_find(room->hub->assets, image)) {
        snprintf(room->image, sizeof room->image, "%s", image);
        asset_index_send(room->hub, image);
    }
}

void room_sync_send_scene(struct hub *hub, const struct packet_scene *packet, const char *text)
{
    supervisor_send(hub->supervisor, &(struct packet){.kind = TO_WORKER_SCENE,
                                                      .scene = *packet,
                                                      .payload = (uint8_t *)text,
                                                      .payload_length = strlen(text)});
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

/* Its document without code where that is not allowed. Caller frees. */
static char *print_scene(const struct hub *hub, const struct scene *scene)
{
    cJSON *document = scene_to_json(scene);

    if (hub->code_refused) {
        code_text_remove(document);
    }
    char *text = json_print(document, false);
    cJSON_Delete(document);
    return text;
}

static void send_scene(struct room *room, const struct scene *scene, uint64_t revision)
{
    const bool printed = room->text && scene == room->scene && !room->hub->code_refused;
    char *text = printed ? NULL : print_scene(room->hub, scene);

    send_image(room, scene);
    room_sync_send_scene(room->hub, &(struct packet_scene){.scene = room->id, .revision = revision},
                         text ? text : (const char *)room->text->bytes);
    free(text);
    room->sent = revision;
}

void room_sync_open(struct room *room)
{
    uint64_t revision = 0;
    const bool doubtful =
        room->scene_error.kind != ERROR_NONE || quarantine_is_tried_again(room->hub, room);
    const struct scene *good = doubtful ? last_good_state(room, &revision) : NULL;

    if (room->sent == 0) {
        room->image[0] = '\0';
        send_scene(room, good ? good : room->scene, good ? revision : room->revision);
    }
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
