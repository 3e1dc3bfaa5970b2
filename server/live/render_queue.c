/* SPDX-License-Identifier: MIT */
#include "render_queue.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "asset_index.h"
#include "hub.h"
#include "image_queue.h"
#include "protocol/memory.h"
#include "quarantine.h"
#include "room_state.h"
#include "room_sync.h"
#include "scene_error.h"
#include "server/clock.h"
#include "server/log.h"

void render_queue_init(struct render_queue *queue)
{
    memset(queue, 0, sizeof *queue);
    queue->end = &queue->first;
}

static void entry_destroy(struct render_entry *entry)
{
    render_request_finish(&entry->order.request);
    shared_buffer_unref(entry->document);
    free(entry->account);
    free(entry);
}

/* Takes it out of the list. */
static void detach(struct hub *hub, struct render_entry *entry)
{
    struct render_queue *queue = hub->render_queue;
    struct render_entry **link = &queue->first;

    while (*link != entry) {
        link = &(*link)->next;
    }
    *link = entry->next;
    if (!entry->next) {
        queue->end = link;
    }
    metric_add(&hub->metrics, METRIC_IMAGES_WAITING, -(entry->order.priority == RENDER_IMAGE));
    metric_add(&hub->metrics, METRIC_RENDER_QUEUE, -1);
}

void render_queue_finish(struct render_queue *queue)
{
    while (queue->first) {
        struct render_entry *entry = queue->first;

        queue->first = entry->next;
        entry_destroy(entry);
    }
    render_queue_init(queue);
}

static void scene_name(const struct render_entry *entry, char out[LIMIT_ID_BYTES + 16])
{
    if (entry->order.room) {
        snprintf(out, LIMIT_ID_BYTES + 16, "%s", entry->order.room->id);
    } else {
        snprintf(out, LIMIT_ID_BYTES + 16, "~%" PRIu32, entry->id);
    }
}

/* --- to the worker --- */

static void send_cancel(struct hub *hub, const struct render_entry *entry)
{
    supervisor_send(hub->supervisor,
                    &(struct packet){.kind = TO_WORKER_CANCEL, .job = {entry->id}});
}

static void send_drop(struct hub *hub, const struct render_entry *entry)
{
    char name[LIMIT_ID_BYTES + 16];

    scene_name(entry, name);
    supervisor_send(hub->supervisor,
                    &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = name}});
}

/* False: it is not known yet. */
static bool send_scene(struct hub *hub, const struct render_entry *entry)
{
    if (entry->order.room) {
        return room_sync_open(entry->order.room);
    }
    char name[LIMIT_ID_BYTES + 16];

    asset_index_send(hub, entry->order.image);
    scene_name(entry, name);
    const struct packet_scene packet = {
        .scene = name, .revision = 1, .portrait = entry->order.portrait};
    room_sync_send_scene(hub, &packet, entry->document);
    return true;
}

static struct render_demand render_demand(const struct render_order *order)
{
    const int width = render_request_int(&order->request, "width");
    const int height = render_request_int(&order->request, "height");

    return (struct render_demand){order->priority, (int64_t)width * height};
}

/* Asks for as much as the picture that a worker was lost with. */
static bool is_fatal(const struct render_entry *entry)
{
    const struct render_demand demand = render_demand(&entry->order);
    const struct render_demand *fatal = &entry->order.room->fatal;

    return demand.priority >= fatal->priority && demand.pixels >= fatal->pixels;
}

/* May end the next worker too. */
static bool is_suspect(const struct render_entry *entry)
{
    return entry->order.room ? entry->order.room->deaths > 0 && is_fatal(entry) : entry->deaths > 0;
}

/* Has to do with the loss of a worker: drawn in the smallest tiles. */
static bool is_careful(const struct render_entry *entry)
{
    return entry->deaths > 0 || (entry->order.room && entry->order.room->deaths > 0);
}

static void send_render(struct hub *hub, struct render_entry *entry)
{
    char name[LIMIT_ID_BYTES + 16];
    const struct room *room = entry->order.room;

    if (!send_scene(hub, entry)) {
        return;
    }
    scene_name(entry, name);
    supervisor_send(hub->supervisor, &(struct packet){.kind = TO_WORKER_RENDER,
                                                      .render = {
                                                          .job = entry->id,
                                                          .scene = name,
                                                          .account = entry->account,
                                                          .priority = entry->order.priority,
                                                          .patience = room ? room->patience : 1,
                                                          .careful = is_careful(entry),
                                                          .request = &entry->order.request,
                                                      }});
    entry->sent = true;
}

/* Sends what may go. A suspect goes alone, so that the next loss has one possible cause. */
static void dispatch(struct hub *hub)
{
    bool any_sent = false, suspect_sent = false;

    if (!hub->render_queue->ready) {
        return;
    }
    for (struct render_entry *entry = hub->render_queue->first; entry; entry = entry->next) {
        any_sent |= entry->sent;
        suspect_sent |= entry->sent && is_suspect(entry);
    }
    for (struct render_entry *entry = hub->render_queue->first; entry && !suspect_sent;
         entry = entry->next) {
        if (entry->sent) {
            continue;
        }
        if (is_suspect(entry)) {
            if (any_sent) {
                return;
            }
            suspect_sent = true;
        }
        send_render(hub, entry);
        any_sent |= entry->sent;
    }
}

/* --- who may ask --- */

static bool admits_image(struct hub *hub, const struct render_order *order, struct error *err)
{
    const struct room *room = order->room;

    if (room && room->scene_error.kind != ERROR_NONE &&
        room->scene_error_revision == room->revision) {
        *err = room->scene_error; /* an older state would be the wrong picture */
        return false;
    }
    return image_queue_admits(hub, order, err);
}

static bool admits(struct hub *hub, const struct render_order *order, struct error *err)
{
    if (atomic_load(&hub->draining)) {
        return error_set(err, ERROR_UNAVAILABLE, "", "the server is shutting down");
    }
    if (order->room && order->room->suspended.kind != ERROR_NONE) {
        if (err) {
            *err = order->room->suspended;
        }
        return false;
    }
    return order->priority != RENDER_IMAGE || admits_image(hub, order, err);
}

uint32_t render_queue_submit(struct hub *hub, struct render_order *order, struct error *err)
{
    struct render_queue *queue = hub->render_queue;

    if (!admits(hub, order, err)) {
        render_request_finish(&order->request);
        free(order->document);
        return 0;
    }
    struct render_entry *entry = memory_alloc(1, sizeof *entry);

    queue->last_id = queue->last_id % 0x7fffffff + 1;
    entry->id = queue->last_id;
    entry->order = *order;
    entry->account = memory_text(order->account);
    if (order->document) {
        entry->document = shared_buffer_take(order->document, strlen(order->document) + 1);
    }
    entry->asked = clock_ms();
    entry->deadline = entry->asked + RENDER_DEADLINE_MS;
    *queue->end = entry;
    queue->end = &entry->next;
    metric_add(&hub->metrics, METRIC_IMAGES_WAITING, order->priority == RENDER_IMAGE);
    metric_add(&hub->metrics, METRIC_RENDERS, 1);
    metric_add(&hub->metrics, METRIC_RENDER_QUEUE, 1);
    dispatch(hub);
    return entry->id;
}

/* --- ends of an order --- */

static struct render_entry *find(const struct render_queue *queue, uint32_t id)
{
    struct render_entry *entry = queue->first;

    while (entry && entry->id != id) {
        entry = entry->next;
    }
    return entry;
}

static void finish(struct hub *hub, struct render_entry *entry, const struct picture_answer *answer,
                   const struct error *err)
{
    detach(hub, entry);
    if (!entry->order.room && entry->sent) {
        send_drop(hub, entry);
    }
    entry->order.on_done(entry->order.data, answer, err);
    entry_destroy(entry);
}

static void cancel(struct hub *hub, struct render_entry *entry)
{
    detach(hub, entry);
    if (entry->sent) {
        send_cancel(hub, entry);
        if (!entry->order.room) {
            send_drop(hub, entry);
        }
    }
    entry_destroy(entry);
}

void render_queue_cancel(struct hub *hub, uint32_t id)
{
    struct render_entry *entry = find(hub->render_queue, id);

    if (entry) {
        cancel(hub, entry);
        dispatch(hub);
    }
}

void render_queue_fail_all(struct hub *hub, const char *why)
{
    struct error err = {0};

    error_set(&err, ERROR_UNAVAILABLE, "", "%s", why);
    while (hub->render_queue->first) {
        finish(hub, hub->render_queue->first, NULL, &err);
    }
}

void render_queue_cancel_room(struct hub *hub, const struct room *room)
{
    struct error err = {0};
    struct render_entry *entry = hub->render_queue->first;

    error_set(&err, ERROR_NOT_FOUND, room->id, "the scene was deleted");
    while (entry) {
        struct render_entry *next = entry->next;

        if (entry->order.room == room) {
            finish(hub, entry, NULL, &err);
            next = hub->render_queue->first; /* the callback may have changed the list */
        }
        entry = next;
    }
}

bool render_queue_has_room(const struct render_queue *queue, const struct room *room)
{
    const struct render_entry *entry = queue->first;

    while (entry && entry->order.room != room) {
        entry = entry->next;
    }
    return entry != NULL;
}

int render_queue_moving(const struct render_queue *queue)
{
    int count = 0;

    for (const struct render_entry *entry = queue->first; entry; entry = entry->next) {
        count += entry->order.priority == RENDER_MOVING;
    }
    return count;
}

/* Several are drawn by turns: what counts is how soon one follows another. */
static void learn_image(struct render_queue *queue, const struct render_entry *entry)
{
    const int64_t now = clock_ms();
    const int64_t since = queue->image_done > entry->asked ? queue->image_done : entry->asked;

    if (entry->order.priority == RENDER_IMAGE) {
        queue->image_ms =
            queue->image_ms > 0 ? (3 * queue->image_ms + now - since) / 4 : now - since;
        queue->image_done = now;
    }
}

static void count_times(struct hub *hub, const struct job_times *times)
{
    for (int i = 0; i < FRAME_STAGES; i++) {
        metric_add_stage(&hub->metrics, (enum frame_stage)i, times->us[i]);
    }
}

/* --- suspended scenes --- */

static const char *root_place(const struct room *room, char place[ERROR_PLACE_BYTES])
{
    snprintf(place, ERROR_PLACE_BYTES, "/nodes/%s", room->scene->root->id);
    return place;
}

static void describe_slow(const struct room *room, int measured_ms, int limit_ms, struct error *out)
{
    char place[ERROR_PLACE_BYTES];

    error_set_slow(out, root_place(room, place), "", measured_ms, limit_ms);
    snprintf(out->message, sizeof out->message,
             "Drawing the smallest part of this scene took over %.3g s here (limit %.3g s). It is "
             "not drawn until it is edited or tried again.",
             measured_ms / 1000.0, limit_ms / 1000.0);
}

static void describe_end(const struct room *room, const struct supervisor_end *end,
                         struct error *out)
{
    char place[ERROR_PLACE_BYTES];

    if (end->kind == SUPERVISOR_BUSY) {
        describe_slow(room, (int)end->measured_ms, (int)end->limit_ms, out);
    } else {
        error_set(out, ERROR_CRASHED, root_place(room, place),
                  "Drawing this scene ended the render process. It is not drawn until it is edited "
                  "or tried again.");
    }
}

static void suspend(struct room *room, const struct error *why)
{
    log_error("render_queue", "scene %s is suspended: %s", room->id, why->message);
    scene_error_suspend(room, why);
}

void render_queue_worker_ready(struct hub *hub)
{
    hub->render_queue->ready = true;
    dispatch(hub);
}

/* A picture was begun and cannot be drawn. The scene is suspended for viewers, for the last of the
 * pictures of a view too: those before it may have been the engine's. A picture that was ordered
 * may have asked for more. */
static void undrawn(const struct render_entry *entry, struct error *err)
{
    struct room *room = entry->order.room;

    if (room && err->kind == ERROR_TOO_SLOW) {
        describe_slow(room, err->measured_ms, err->limit_ms, err);
        if (entry->order.priority < RENDER_IMAGE && room->suspended.kind == ERROR_NONE) {
            suspend(room, err);
        }
    }
}

/* What waits for another order of its account goes on with that. */
static void go_on(struct render_queue *queue, const char *account)
{
    const int64_t deadline = clock_ms() + RENDER_DEADLINE_MS;

    for (struct render_entry *entry = queue->first; entry; entry = entry->next) {
        if (strcmp(entry->account, account) == 0) {
            entry->deadline = deadline;
        }
    }
}

/* NULL: cancelled meanwhile. What is heard of goes on. */
static struct render_entry *heard_of(struct hub *hub, uint32_t job)
{
    struct render_entry *entry = find(hub->render_queue, job);

    if (!entry || !entry->sent) {
        return NULL;
    }
    go_on(hub->render_queue, entry->account);
    return entry;
}

void render_queue_progress(struct hub *hub, uint32_t job)
{
    heard_of(hub, job);
}

void render_queue_failed(struct hub *hub, const struct packet_failed *failed)
{
    struct render_entry *entry = heard_of(hub, failed->job);
    struct error err = failed->error;

    if (!entry) {
        return;
    }
    metric_add(&hub->metrics, METRIC_RENDERS_FAILED, 1);
    if (failed->begun) {
        undrawn(entry, &err);
    }
    finish(hub, entry, NULL, &err);
    dispatch(hub);
}

void render_queue_frame(struct hub *hub, const struct packet *packet)
{
    struct render_entry *entry = heard_of(hub, packet->frame.job);
    const struct picture_answer answer = {&packet->frame, packet->payload, packet->payload_length};

    if (!entry) {
        return;
    }
    if (packet->frame.more) {
        if (entry->order.on_more) {
            entry->order.on_more(entry->order.data, &answer);
        }
        return;
    }
    count_times(hub, &packet->frame.times);
    learn_image(hub->render_queue, entry);
    if (entry->order.room && is_fatal(entry)) {
        entry->order.room->deaths = 0;
    }
    finish(hub, entry, &answer, NULL);
    dispatch(hub);
}

/* --- the worker's fate --- */

/* Which scenes may have been the cause: those asked for, and those whose shader was compiling.
 * `deaths`: as how many workers this one counts. */
static void blame(struct hub *hub, const struct supervisor_end *end, int deaths)
{
    for (struct room *room = hub->rooms; room; room = room->next) {
        bool asked = room->sent && room->settled < room->revision;

        for (struct render_entry *r = hub->render_queue->first; r && !asked; r = r->next) {
            asked = r->sent && r->order.room == room;
        }
        room->sent = room->shown = room->settled = 0;
        if (!quarantine_blames(hub, room->id, asked) || room->suspended.kind != ERROR_NONE) {
            continue;
        }
        const struct render_entry *drawn = strcmp(hub->quarantine->drawn.scene, room->id) == 0
                                               ? find(hub->render_queue, hub->quarantine->drawn.job)
                                               : NULL;

        room->fatal = drawn ? render_demand(&drawn->order) : (struct render_demand){0};
        room->deaths += deaths;
        if (room->deaths >= RENDER_DEATHS) {
            struct error why = {0};

            describe_end(room, end, &why);
            suspend(room, &why);
        }
    }
}

static bool gives_up(const struct render_entry *entry)
{
    return !entry->order.again ||
           (entry->order.room ? entry->order.room->suspended.kind != ERROR_NONE
                              : entry->deaths >= RENDER_DEATHS);
}

void render_queue_worker_down(struct hub *hub, const struct supervisor_end *end)
{
    struct error err = {0};

    const int deaths = hub->quarantine->sure ? RENDER_DEATHS : 1;

    hub->render_queue->ready = false;
    blame(hub, end, deaths);
    error_set(&err, ERROR_UNAVAILABLE, "", "the render process ended while it drew this");
    for (struct render_entry *entry = hub->render_queue->first, *next; entry; entry = next) {
        next = entry->next;
        if (!entry->sent) {
            continue;
        }
        char name[LIMIT_ID_BYTES + 16];

        scene_name(entry, name);
        entry->deaths += quarantine_blames(hub, name, true) ? deaths : 0;
        entry->sent = false;
        if (gives_up(entry)) {
            finish(hub, entry, NULL, &err);
        }
    }
}

int64_t render_queue_tick(struct hub *hub, int64_t now_ms)
{
    struct error err = {0};
    int64_t next_deadline = 0;

    error_set(&err, ERROR_UNAVAILABLE, "", "the picture did not go on for %d seconds",
              RENDER_DEADLINE_MS / 1000);
    for (struct render_entry *entry = hub->render_queue->first, *next; entry; entry = next) {
        next = entry->next;
        if (entry->deadline > now_ms) {
            next_deadline = clock_earlier(next_deadline, entry->deadline);
            continue;
        }
        if (entry->sent) {
            send_cancel(hub, entry);
        }
        finish(hub, entry, NULL, &err);
    }
    dispatch(hub); /* what waited for a document to be printed */
    return next_deadline;
}
