/* SPDX-License-Identifier: MIT */
#include "hub_life.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "asset_index.h"
#include "catalog.h"
#include "compiles.h"
#include "hub_rooms.h"
#include "image_cache.h"
#include "last_good.h"
#include "library.h"
#include "picker.h"
#include "poster.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/schema.h"
#include "quarantine.h"
#include "render_queue.h"
#include "room.h"
#include "room_apart.h"
#include "room_snapshot.h"
#include "room_sync.h"
#include "scene_error.h"
#include "server/algebra.h"
#include "server/clock.h"
#include "server/log.h"
#include "server/questions.h"
#include "session.h"
#include "stream.h"
#include "thumbnails.h"

enum { ASSETS_LOOK_MS = 1000 }; /* between looks at the copies of files in memory */

/* --- events of the worker --- */

/* What keeps the worker from the rest of the machine. */
static void tell_confinement(struct hub *hub, const struct packet_ready *ready)
{
    metric_set(&hub->metrics, METRIC_WORKER_FILES_CONFINED, ready->files);
    metric_set(&hub->metrics, METRIC_WORKER_CALLS_CONFINED, ready->calls);
    if (ready->files && ready->calls) {
        log_info("worker", "confined: files, system calls");
    } else {
        log_warning("worker", "confined: %s; %s",
                    ready->files   ? "files alone"
                    : ready->calls ? "system calls alone"
                                   : "nothing",
                    *ready->why ? ready->why : "--confine is off");
    }
}

static void on_ready(void *data, const struct packet_ready *ready)
{
    struct hub *hub = data;
    struct renderer_info *info = &hub->renderer;

    hub_lock(hub);
    snprintf(info->name, sizeof info->name, "%s", ready->name);
    snprintf(info->version, sizeof info->version, "%s", ready->version);
    snprintf(info->device, sizeof info->device, "%s", ready->device);
    info->software = ready->software;
    info->stage = ready->stage < RENDER_STAGES ? (enum render_stage)ready->stage : RENDER_AUTO;
    log_info("worker", "ready: %s%s, stage %s", info->name, info->software ? " (software)" : "",
             render_stage_names[info->stage]);
    tell_confinement(hub, ready);
    for (struct room *room = hub->rooms; room; room = room->next) {
        if (room->told_lost) {
            room->told_lost = false;
            room_tell_all(room, "info", "worker_ready", "", "The render process is back.");
        }
    }
    quarantine_worker_ready(hub);
    render_queue_worker_ready(hub);
    hub_unlock(hub);
}

/* Somebody waits for a picture of it. */
static bool is_waited_for(const struct room *room)
{
    for (const struct session *session = room->sessions; session; session = session->next) {
        if (stream_is_waiting(session->stream)) {
            return true;
        }
    }
    return false;
}

/* Whom it concerns, but not those who are told of their own scene later. */
static void tell_lost(struct hub *hub, const struct supervisor_end *end)
{
    const char *slow = hub->quarantine->slow.scene;
    const bool too_slow = *hub->quarantine->slow.key || end->kind == SUPERVISOR_BUSY;

    for (struct room *room = hub->rooms; room; room = room->next) {
        if (is_waited_for(room) && strcmp(room->id, slow) != 0) {
            room->told_lost = true;
            room_tell_all(room, too_slow ? "info" : "warning", "worker_restarting", "",
                          too_slow ? "A scene took the render process too long. It is started "
                                     "again, and pictures go on."
                                   : "The render process ended and is started again.");
        }
    }
}

static bool on_down(void *data, const struct supervisor_end *end)
{
    struct hub *hub = data;

    hub_lock(hub);
    log_debug("hub", "worker down: %s", end->text);
    tell_lost(hub, end);
    const bool known = quarantine_worker_down(hub, end);
    render_queue_worker_down(hub, end);
    hub_unlock(hub);
    return known;
}

static void on_pace(void *data, double pace)
{
    struct hub *hub = data;

    hub_lock(hub);
    hub->quarantine->pace = pace;
    hub_unlock(hub);
}

static void on_hopeless(void *data)
{
    struct hub *hub = data;

    atomic_store(&hub->hopeless, true);
    kill(getpid(), SIGTERM); /* the main thread waits for it */
}

/* A revision of a scene can be drawn, or cannot. */
static void compiled(struct hub *hub, const struct packet_state *state, bool broken)
{
    struct room *room = hub_find_room(hub, state->scene);
    const uint64_t revision = state->revision;

    if (!room) {
        return;
    }
    if (revision > room->settled) {
        room->settled = revision;
    }
    if (broken) {
        quarantine_key(state->structure_hash, room->refused_key);
        scene_error_set(room, &state->error, revision);
    } else {
        room->shown = revision;
        last_good_proven(room, revision);
        scene_error_cure(room, revision);
        for (struct session *session = room->sessions; session; session = session->next) {
            stream_shown(session);
        }
    }
    room_sync_done(room, revision);
}

/* Nothing that keeps it from being drawn. */
static void warned(struct hub *hub, const struct packet_state *state)
{
    static const char *const codes[] = {
        [WARNING_LIPSCHITZ] = "lipschitz", [WARNING_ASSET] = "asset"};
    struct room *room = hub_find_room(hub, state->scene);

    if (room && scene_error_is_refusal(&state->error)) {
        quarantine_keeps_image(room, &state->error, state->revision);
    } else if (room) {
        room_tell_all(room, "warning", codes[state->warning], state->error.place,
                      state->error.message);
    }
}

static void on_packet(void *data, const struct packet *packet)
{
    struct hub *hub = data;

    hub_lock(hub);
    switch ((enum packet_to_front)packet->kind) {
    case TO_FRONT_SHOWN:
    case TO_FRONT_BROKEN:
        compiled(hub, &packet->state, packet->kind == TO_FRONT_BROKEN);
        break;
    case TO_FRONT_WARNED:
        warned(hub, &packet->state);
        break;
    case TO_FRONT_COMPILING:
    case TO_FRONT_READING:
    case TO_FRONT_OPENING:
    case TO_FRONT_DRAWING:
    case TO_FRONT_SLOW:
        quarantine_named(hub, (enum packet_to_front)packet->kind, &packet->suspect);
        break;
    case TO_FRONT_FRAME:
        render_queue_frame(hub, packet);
        break;
    case TO_FRONT_PROGRESS:
        render_queue_progress(hub, packet->job.job);
        break;
    case TO_FRONT_FAILED:
        render_queue_failed(hub, &packet->failed);
        break;
    case TO_FRONT_READY: /* the supervisor's */
    case TO_FRONT_PONG:
    case TO_FRONT_COUNT:
        break;
    }
    hub_unlock(hub);
}

/* --- time --- */

/* Scenes that nobody has looked at for a while leave memory, once all is committed: the list of
 * those that the caller destroys without the lock. */
static struct room *close_idle_rooms(struct hub *hub, int64_t now_ms)
{
    struct room *closed = NULL;

    for (struct room *room = hub->rooms, *next; room; room = next) {
        next = room->next;
        if (room->sessions || room->pending || room->holds ||
            render_queue_has_room(hub->render_queue, room) ||
            now_ms - room->idle_since < ROOM_IDLE_MS) {
            continue;
        }
        if (room->edits_since_snapshot) {
            room_snapshot_soon(room);
            continue;
        }
        poster_store(room);
        hub_remove_room(hub, room);
        room->next = closed;
        closed = room;
    }
    return closed;
}

static void drop_rooms(struct room *room)
{
    while (room) {
        struct room *next = room->next;

        room_drop(room);
        room = next;
    }
}

static int64_t on_tick(void *data, int64_t now_ms)
{
    struct hub *hub = data;
    struct room *closed = NULL;

    hub_lock(hub);
    int64_t next = render_queue_tick(hub, now_ms);
    for (struct room *room = hub->rooms; room; room = room->next) {
        for (struct session *session = room->sessions; session; session = session->next) {
            next = clock_earlier(next, stream_pump(session, now_ms));
        }
        next = clock_earlier(next, compiles_watch(room, now_ms));
    }
    next = clock_earlier(next, thumbnails_pump(hub, now_ms));
    if (asset_index_forget(hub->assets)) {
        next = clock_earlier(next, now_ms + ASSETS_LOOK_MS);
    }
    if (now_ms >= hub->next_cleaning) {
        closed = close_idle_rooms(hub, now_ms);
        hub->next_cleaning = now_ms + 5000;
    }
    hub_unlock(hub);
    drop_rooms(closed);
    return next;
}

/* --- birth and death --- */

static void build_schema(struct hub *hub)
{
    cJSON *schema = schema_build();
    unsigned sum = 0;

    hub->schema = json_print(schema, false);
    cJSON_Delete(schema);
    for (const char *c = hub->schema; *c; c++) {
        sum = sum * 31 + (unsigned char)*c;
    }
    snprintf(hub->schema_tag, sizeof hub->schema_tag, "\"schema-%08x\"", sum);
}

static void add_to_catalog(void *data, const struct store_scene *scene)
{
    catalog_set(data, scene->id, scene->name, scene->revision, scene->nodes, scene->modified_ms);
}

/* The payload of a packet. */
static void *load_file(void *data, const char *id, size_t *out_length)
{
    return asset_index_load(data, id, out_length, NULL);
}

struct hub *hub_create(const struct hub_params *params, struct error *err)
{
    struct hub *hub = memory_alloc(1, sizeof *hub);

    pthread_mutex_init(&hub->lock, NULL);
    pthread_mutex_init(&hub->load_lock[0], NULL);
    pthread_mutex_init(&hub->load_lock[1], NULL);
    pthread_cond_init(&hub->released, NULL);
    hub->catalog = memory_alloc(1, sizeof *hub->catalog);
    hub->assets = memory_alloc(1, sizeof *hub->assets);
    hub->library = memory_alloc(1, sizeof *hub->library);
    hub->render_queue = memory_alloc(1, sizeof *hub->render_queue);
    hub->quarantine = memory_alloc(1, sizeof *hub->quarantine);
    hub->compiles = memory_alloc(1, sizeof *hub->compiles);
    hub->image_cache = memory_alloc(1, sizeof *hub->image_cache);
    hub->image_cache->limit = LIMIT_IMAGE_CACHE_BYTES;
    hub->thumbnails = thumbnails_create();
    render_queue_init(hub->render_queue);
    hub->access = params->access;
    hub->web_dir = params->web_dir;
    hub->code_refused = params->code_refused;
    build_schema(hub);
    hub->store = store_open(params->data_dir, &hub->metrics, err);
    asset_index_add_embedded(hub->assets);
    if (!hub->store || !store_list(hub->store, add_to_catalog, hub->catalog, err) ||
        !store_list_assets(hub->store, asset_index_add, hub->assets, err) ||
        !store_list_library(hub->store, library_add, hub->library, err) ||
        !(hub->picker = picker_create(hub, err)) ||
        !(hub->tasks = tasks_create(&hub->metrics, err)) || !(hub->algebra = algebra_create(err))) {
        hub_destroy(hub);
        return NULL;
    }
    hub->questions = questions_create(hub->algebra);
    metric_set(&hub->metrics, METRIC_SCENES, (int64_t)hub->catalog->count);
    /* Its thread calls into the hub at once, and finds the pointer only under the lock. */
    hub_lock(hub);
    hub->supervisor = supervisor_create(&(struct supervisor_params){
        .argv = params->worker_argv,
        .silence_ms = params->worker_silence_ms,
        .busy_ms = params->worker_busy_ms,
        .metrics = &hub->metrics,
        .data = hub,
        .on_ready = on_ready,
        .on_packet = on_packet,
        .on_down = on_down,
        .on_hopeless = on_hopeless,
        .on_tick = on_tick,
        .on_pace = on_pace,
        .load_file = load_file,
    });
    hub_unlock(hub);
    return hub;
}

void hub_drain(struct hub *hub)
{
    atomic_store(&hub->draining, true);
    tasks_stop(hub->tasks);
    algebra_stop(hub->algebra);
    hub_lock(hub);
    for (struct room *room = hub->rooms; room; room = room->next) {
        if (room->edits_since_snapshot) {
            room_snapshot(room);
        }
        poster_store(room);
    }
    render_queue_fail_all(hub, "the server is shutting down");
    hub_unlock(hub);
    store_flush(hub->store);
}

void hub_stop(struct hub *hub)
{
    if (hub) {
        supervisor_stop(hub->supervisor);
    }
}

void hub_destroy(struct hub *hub)
{
    if (!hub) {
        return;
    }
    hub_stop(hub);
    algebra_destroy(hub->algebra);
    questions_destroy(hub->questions);
    picker_destroy(hub->picker);
    supervisor_destroy(hub->supervisor);
    store_close(hub->store);
    tasks_destroy(hub->tasks); /* the last commits of a room that was deleted end it */
    while (hub->rooms) {
        struct room *room = hub->rooms;

        hub->rooms = room->next;
        room_destroy(room);
    }
    render_queue_finish(hub->render_queue);
    image_cache_finish(hub->image_cache);
    thumbnails_destroy(hub->thumbnails);
    catalog_finish(hub->catalog);
    asset_index_finish(hub->assets);
    library_finish(hub->library);
    free(hub->catalog);
    free(hub->assets);
    free(hub->library);
    free(hub->render_queue);
    free(hub->quarantine);
    free(hub->compiles);
    free(hub->image_cache);
    free(hub->schema);
    pthread_cond_destroy(&hub->released);
    pthread_mutex_destroy(&hub->load_lock[1]);
    pthread_mutex_destroy(&hub->load_lock[0]);
    pthread_mutex_destroy(&hub->lock);
    free(hub);
}
