/* SPDX-License-Identifier: MIT */
#include "quarantine.h"

#include <inttypes.h>
#include <string.h>

#include "hub.h"
#include "problem.h"
#include "protocol/code_text.h"
#include "protocol/messages.h"
#include "room.h"
#include "say.h"
#include "server/log.h"

void quarantine_named(struct hub *hub, const struct packet *packet)
{
    struct quarantine *quarantine = &hub->quarantine;
    const cJSON *json = packet->json;
    const bool compiling = strcmp(json_member_text(json, "type", ""), "compiling") == 0;
    struct suspect *suspect = compiling ? &quarantine->compiling : &quarantine->drawing;

    suspect->revision = (uint64_t)json_member_number(json, "revision", 0);
    snprintf(suspect->scene, sizeof(suspect->scene), "%s", json_member_text(json, "scene", ""));
    snprintf(suspect->shape, sizeof(suspect->shape), "%s", json_member_text(json, "shape", ""));
}

void quarantine_worker_ready(struct hub *hub)
{
    const struct quarantine *quarantine = &hub->quarantine;
    cJSON *packet = say_begin("refuse");
    cJSON *shapes = cJSON_AddArrayToObject(packet, "shapes");

    for (size_t i = 0; i < quarantine->count && i < QUARANTINE_SHAPES; i++) {
        cJSON_AddItemToArray(shapes, cJSON_CreateString(quarantine->shapes[i]));
    }
    supervisor_send(hub->supervisor, packet);
    cJSON_Delete(packet);
}

/* The room falls back to its last good state. */
static void seclude(struct room *room, uint64_t revision)
{
    struct error err = {0};
    char place[ERROR_PLACE_BYTES];
    uint64_t good_revision;
    const struct scene *good = fallback_state(room, &good_revision);

    error_set(&err, ERROR_QUARANTINED, code_text_changed(room->scene, good, place),
              "compiling this code ended the render process; until it is edited the scene is %s",
              good ? "shown as it was before" : "not shown");
    problem_set(room, &err, revision);
}

static void convict(struct hub *hub, const struct suspect *suspect)
{
    struct quarantine *quarantine = &hub->quarantine;
    struct room *room = hub->rooms;

    while (room && strcmp(room->id, suspect->scene) != 0) {
        room = room->next;
    }
    log_error("quarantine",
              "compiling the code of scene %s, revision %" PRIu64 ", ended the worker",
              suspect->scene, suspect->revision);
    memcpy(quarantine->shapes[quarantine->count++ % QUARANTINE_SHAPES], suspect->shape,
           sizeof(suspect->shape));
    if (room) {
        seclude(room, suspect->revision);
    }
}

bool quarantine_worker_down(struct hub *hub, bool hung)
{
    struct quarantine *quarantine = &hub->quarantine;
    const struct suspect none = {.scene = ""};

    quarantine->named = *quarantine->compiling.scene || *quarantine->drawing.scene;
    /* A crash has one cause, and compilers are the likelier one; silence may come from either. */
    quarantine->drawn = hung || !*quarantine->compiling.scene ? quarantine->drawing : none;
    if (*quarantine->compiling.scene) {
        convict(hub, &quarantine->compiling);
    }
    quarantine->compiling = quarantine->drawing = none;
    return quarantine->named;
}

bool quarantine_blames(const struct hub *hub, const char *scene, bool asked)
{
    return hub->quarantine.named ? strcmp(hub->quarantine.drawn.scene, scene) == 0 : asked;
}
