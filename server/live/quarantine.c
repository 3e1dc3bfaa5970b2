/* SPDX-License-Identifier: MIT */
#include "quarantine.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "last_good.h"
#include "protocol/code_text.h"
#include "room_state.h"
#include "scene_error.h"
#include "server/log.h"

/* --- what is known of keys --- */

/* And not what is compiled. */
static bool is_image(const char *key)
{
    return strlen(key) == ASSET_ID_CHARACTERS;
}

static struct quarantine_case *find_case(struct quarantine *quarantine, const char *key)
{
    for (size_t i = 0; i < quarantine->count && i < QUARANTINE_CASES; i++) {
        if (strcmp(quarantine->cases[i].key, key) == 0) {
            return &quarantine->cases[i];
        }
    }
    return NULL;
}

static struct quarantine_case *get_case(struct quarantine *quarantine,
                                        const struct suspect *suspect)
{
    struct quarantine_case *known = find_case(quarantine, suspect->key);

    if (!known) {
        known = &quarantine->cases[quarantine->count++ % QUARANTINE_CASES];
        *known = (struct quarantine_case){.times = 1};
        memcpy(known->key, suspect->key, sizeof known->key);
    }
    memcpy(known->scene, suspect->scene, sizeof known->scene);
    return known;
}

static void give_more_time(struct quarantine_case *known)
{
    known->times =
        known->times < LIMIT_RETRY_TIMES ? known->times * LIMIT_RETRY_FACTOR : LIMIT_RETRY_TIMES;
}

static void send_case(struct hub *hub, const struct quarantine_case *known)
{
    const bool image = is_image(known->key);

    supervisor_send(
        hub->supervisor,
        &(struct packet){.kind = TO_WORKER_JUDGE,
                         .judge = {
                             .structure_hash = image ? 0 : strtoull(known->key, NULL, 16),
                             .asset = image ? known->key : "",
                             .refused = known->refused,
                             .measured_ms = known->measured_ms,
                             .limit_ms = known->limit_ms,
                             .times = known->times,
                         }});
}

void quarantine_worker_ready(struct hub *hub)
{
    const struct quarantine *quarantine = hub->quarantine;

    for (size_t i = 0; i < quarantine->count && i < QUARANTINE_CASES; i++) {
        send_case(hub, &quarantine->cases[i]);
    }
    if (quarantine->pace > 0) {
        supervisor_send(hub->supervisor,
                        &(struct packet){.kind = TO_WORKER_PACE, .pace = {quarantine->pace}});
    }
}

/* --- what the worker says --- */

void quarantine_key(uint64_t structure_hash, char out[QUARANTINE_KEY_BYTES])
{
    *out = '\0';
    if (structure_hash) {
        snprintf(out, QUARANTINE_KEY_BYTES, "%016" PRIx64, structure_hash);
    }
}

static struct suspect read_suspect(const struct packet_suspect *named)
{
    struct suspect suspect = {.revision = named->revision, .job = named->job};

    snprintf(suspect.scene, sizeof suspect.scene, "%s", named->scene);
    quarantine_key(named->structure_hash, suspect.key);
    if (named->asset && *named->asset) {
        snprintf(suspect.key, sizeof suspect.key, "%s", named->asset);
    }
    return suspect;
}

/* What was compiled or read before has come to a good end. */
static void go_on(struct quarantine *quarantine, struct suspect *suspect,
                  const struct suspect *next)
{
    struct quarantine_case *before = find_case(quarantine, suspect->key);

    if (before && strcmp(before->key, next->key) != 0) {
        before->tried = false;
    }
    *suspect = *next;
}

static struct room *find_room(const struct hub *hub, const char *scene)
{
    struct room *room = hub->rooms;

    while (room && strcmp(room->id, scene) != 0) {
        room = room->next;
    }
    return room;
}

static void drawing(struct hub *hub, const struct suspect *suspect)
{
    const struct room *room = find_room(hub, suspect->scene);

    hub->quarantine->drawing = *suspect;
    supervisor_set_patience(hub->supervisor, room ? room->patience : 1);
}

void quarantine_named(struct hub *hub, enum packet_to_front kind,
                      const struct packet_suspect *named)
{
    struct quarantine *quarantine = hub->quarantine;
    const struct suspect suspect = read_suspect(named);

    switch (kind) {
    case TO_FRONT_COMPILING:
        go_on(quarantine, &quarantine->compiling, &suspect);
        break;
    case TO_FRONT_READING:
        go_on(quarantine, &quarantine->reading, &suspect);
        break;
    case TO_FRONT_OPENING:
        quarantine->opening = suspect;
        break;
    case TO_FRONT_DRAWING:
        drawing(hub, &suspect);
        break;
    default:
        quarantine->slow = suspect;
        quarantine->measured_ms = named->measured_ms;
        quarantine->limit_ms = named->still ? 0 : named->limit_ms;
        break;
    }
}

/* --- its end --- */

static const char *place_of(const struct room *room, const struct scene *good,
                            char place[ERROR_PLACE_BYTES])
{
    if (code_text_in_scene(room->scene)) {
        return code_text_changed(room->scene, good, place);
    }
    snprintf(place, ERROR_PLACE_BYTES, "/nodes/%s", room->scene->root->id);
    return place;
}

static void tell(struct room *room, const struct error *err, const char *key, uint64_t revision)
{
    scene_error_set(room, err, revision);
    snprintf(room->refused_key, sizeof room->refused_key, "%s", key);
}

/* `what`: "code" or the like. `shown`: what is seen instead. */
static void describe_refusal(const struct quarantine_case *known, const char *place,
                             const char *what, const char *shown, struct error *out)
{
    const bool image = is_image(known->key);

    if (known->refused == ERROR_TOO_SLOW) {
        error_set_slow(out, place, "", known->measured_ms, known->limit_ms);
        snprintf(out->message, sizeof out->message,
                 "This %s took over %.3g s to %s here (limit %.3g s). %s", what,
                 known->measured_ms / 1000.0, image ? "read" : "compile", known->limit_ms / 1000.0,
                 shown);
    } else {
        error_set(out, known->refused, place, "%s this %s ended the render process. %s",
                  image ? "Reading" : "Compiling", what, shown);
    }
}

/* All scenes that name it. */
static void seclude_image(const struct hub *hub, const struct quarantine_case *known)
{
    struct error err = {0};

    describe_refusal(known, "/environment/image", "picture", "The sky is drawn without it.", &err);
    for (struct room *room = hub->rooms; room; room = room->next) {
        if (strcmp(record_text(&room->scene->environment, "image"), known->key) == 0) {
            tell(room, &err, known->key, room->revision);
        }
    }
}

/* The room falls back to its last good state. */
static void seclude(struct room *room, const struct quarantine_case *known, uint64_t revision)
{
    struct error err = {0};
    char place[ERROR_PLACE_BYTES];
    uint64_t good_revision;
    const struct scene *good = last_good_state(room, &good_revision);

    describe_refusal(known, place_of(room, good, place),
                     code_text_in_scene(room->scene) ? "code" : "scene",
                     good ? "The last picture stays." : "It is not shown.", &err);
    tell(room, &err, known->key, revision);
}

void quarantine_keeps_image(struct room *room, const struct error *err, uint64_t revision)
{
    tell(room, err, record_text(&room->scene->environment, "image"), revision);
}

/* The second time it is refused, or the first if it is the cause for sure. */
static void judge(struct hub *hub, const struct suspect *suspect, bool slow)
{
    struct quarantine *quarantine = hub->quarantine;
    struct quarantine_case *known = get_case(quarantine, suspect);
    struct room *room = find_room(hub, suspect->scene);
    const bool image = is_image(suspect->key);

    if (!known->tried && !quarantine->sure) {
        known->tried = true;
        give_more_time(known);
        log_warning("quarantine", "scene %s, revision %" PRIu64 ", %s; it is tried again",
                    suspect->scene, suspect->revision,
                    slow    ? "took too long"
                    : image ? "ended the worker while its picture was read"
                            : "ended the worker while it was compiled");
        return;
    }
    known->refused = slow ? ERROR_TOO_SLOW : ERROR_CRASHED;
    known->measured_ms = slow ? quarantine->measured_ms : 0;
    known->limit_ms = slow ? quarantine->limit_ms : 0;
    log_error("quarantine", "scene %s, revision %" PRIu64 ", is not %s again: %s", suspect->scene,
              suspect->revision, image ? "read" : "compiled", error_kind_name(known->refused));
    if (image) {
        seclude_image(hub, known);
    } else if (room) {
        seclude(room, known, suspect->revision);
    }
}

/* What may have ended the worker. Of one that crashed at something it is that alone; else a crash
 * has one cause, and compilers are the likelier one. Stillness may come from either. */
static void find_suspects(struct quarantine *quarantine, const struct supervisor_end *end,
                          struct suspect *compiled, struct suspect *read)
{
    const bool sure = end->crash != CRASH_ANYWHERE, slow = *quarantine->slow.key;
    const bool busy = end->kind == SUPERVISOR_BUSY;

    if (slow) {
        *compiled = quarantine->slow;
    } else if (sure ? end->crash == CRASH_COMPILING : !busy || !*quarantine->drawing.scene) {
        *compiled = quarantine->compiling;
    }
    if (sure ? end->crash == CRASH_READING : !(slow && quarantine->limit_ms > 0) && !busy) {
        *read = quarantine->reading;
    }
    const bool other = end->kind == SUPERVISOR_STILL || (!*compiled->key && !*read->key);

    if (sure ? end->crash == CRASH_DRAWING : other) {
        quarantine->drawn = quarantine->drawing;
    }
    if (sure ? end->crash == CRASH_OPENING : other) {
        quarantine->opened = quarantine->opening;
    }
}

bool quarantine_worker_down(struct hub *hub, const struct supervisor_end *end)
{
    struct quarantine *quarantine = hub->quarantine;
    const struct suspect none = {.scene = ""};
    const bool slow = *quarantine->slow.key && quarantine->limit_ms > 0;
    struct suspect compiled = none, read = none;

    quarantine->drawn = quarantine->opened = none;
    find_suspects(quarantine, end, &compiled, &read);
    quarantine->named =
        *compiled.key || *read.key || *quarantine->opening.scene || *quarantine->drawing.scene;
    quarantine->sure = end->crash != CRASH_ANYWHERE && quarantine->named;
    if (*compiled.key) {
        judge(hub, &compiled, slow);
    }
    if (*read.key) {
        judge(hub, &read, false);
    }
    quarantine->compiling = quarantine->reading = quarantine->opening = none;
    quarantine->drawing = quarantine->slow = none;
    return quarantine->named;
}

bool quarantine_blames(const struct hub *hub, const char *scene, bool asked)
{
    const struct quarantine *quarantine = hub->quarantine;

    return quarantine->named ? strcmp(quarantine->drawn.scene, scene) == 0 ||
                                   strcmp(quarantine->opened.scene, scene) == 0
                             : asked;
}

/* --- second tries --- */

bool quarantine_is_tried_again(const struct hub *hub, const struct room *room)
{
    const struct quarantine *quarantine = hub->quarantine;

    for (size_t i = 0; i < quarantine->count && i < QUARANTINE_CASES; i++) {
        const struct quarantine_case *known = &quarantine->cases[i];

        if (known->tried && known->refused == ERROR_NONE && strcmp(known->scene, room->id) == 0) {
            return true;
        }
    }
    return false;
}

bool quarantine_pardon(struct hub *hub, const char *key)
{
    struct quarantine_case *known = find_case(hub->quarantine, key);

    if (!known || known->refused == ERROR_NONE) {
        return false;
    }
    known->refused = ERROR_NONE;
    give_more_time(known);
    send_case(hub, known);
    return true;
}
