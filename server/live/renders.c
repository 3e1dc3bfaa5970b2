/* SPDX-License-Identifier: MIT */
#include "renders.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "image_queue.h"
#include "problem.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "protocol/messages.h"
#include "quarantine.h"
#include "room_state.h"
#include "room_worker.h"
#include "server/clock.h"
#include "server/log.h"
#include "uploads.h"

void renders_init(struct renders *renders)
{
    memset(renders, 0, sizeof(*renders));
    renders->end = &renders->first;
}

static void render_destroy(struct render *render)
{
    render_request_finish(&render->order.request);
    free(render->document);
    free(render->account);
    free(render);
}

/* Takes it out of the list. */
static void detach(struct hub *hub, struct render *render)
{
    struct renders *renders = hub->renders;
    struct render **link = &renders->first;

    while (*link != render) {
        link = &(*link)->next;
    }
    *link = render->next;
    if (!render->next) {
        renders->end = link;
    }
    metric_add(&hub->metrics, METRIC_IMAGES_WAITING, -(render->order.priority == RENDER_IMAGE));
    metric_add(&hub->metrics, METRIC_RENDER_QUEUE, -1);
}

void renders_finish(struct renders *renders)
{
    while (renders->first) {
        struct render *render = renders->first;

        renders->first = render->next;
        render_destroy(render);
    }
    renders_init(renders);
}

static void scene_name(const struct render *render, char out[LIMIT_ID_BYTES + 16])
{
    if (render->order.room) {
        snprintf(out, LIMIT_ID_BYTES + 16, "%s", render->order.room->id);
    } else {
        snprintf(out, LIMIT_ID_BYTES + 16, "~%" PRIu32, render->id);
    }
}

/* --- to the worker --- */

static void send_cancel(struct hub *hub, const struct render *render)
{
    supervisor_send(hub->supervisor,
                    &(struct packet){.kind = TO_WORKER_CANCEL, .job = {render->id}});
}

static void send_drop(struct hub *hub, const struct render *render)
{
    char name[LIMIT_ID_BYTES + 16];

    scene_name(render, name);
    supervisor_send(hub->supervisor,
                    &(struct packet){.kind = TO_WORKER_DROP, .state = {.scene = name}});
}

static void send_scene(struct hub *hub, const struct render *render)
{
    if (render->order.room) {
        room_worker_open(render->order.room);
        return;
    }
    char name[LIMIT_ID_BYTES + 16];
    cJSON *document = json_parse(render->document, strlen(render->document), NULL);
    const cJSON *environment = cJSON_GetObjectItemCaseSensitive(document, "environment");

    uploads_send(hub, json_member_text(environment, "image", ""));
    scene_name(render, name);
    room_worker_send_scene(hub, name, 1, document);
}

static struct render_demand render_demand(const struct render_order *order)
{
    const int width = render_request_int(&order->request, "width");
    const int height = render_request_int(&order->request, "height");

    return (struct render_demand){order->priority, (int64_t)width * height};
}

/* Asks for as much as the picture that a worker was lost with. */
static bool is_fatal(const struct render *render)
{
    const struct render_demand demand = render_demand(&render->order);
    const struct render_demand *fatal = &render->order.room->fatal;

    return demand.priority >= fatal->priority && demand.pixels >= fatal->pixels;
}

/* May end the next worker too. */
static bool is_suspect(const struct render *render)
{
    return render->order.room ? render->order.room->deaths > 0 && is_fatal(render)
                              : render->deaths > 0;
}

/* Has to do with the loss of a worker: drawn in the smallest tiles. */
static bool is_careful(const struct render *render)
{
    return render->deaths > 0 || (render->order.room && render->order.room->deaths > 0);
}

static void send_render(struct hub *hub, struct render *render)
{
    char name[LIMIT_ID_BYTES + 16];
    const struct room *room = render->order.room;

    send_scene(hub, render);
    scene_name(render, name);
    supervisor_send(hub->supervisor, &(struct packet){.kind = TO_WORKER_RENDER,
                                                      .render = {
                                                          .job = render->id,
                                                          .scene = name,
                                                          .account = render->account,
                                                          .priority = render->order.priority,
                                                          .patience = room ? room->patience : 1,
                                                          .careful = is_careful(render),
                                                          .request = &render->order.request,
                                                      }});
    render->sent = true;
}

/* Sends what may go. A suspect goes alone, so that the next loss has one possible cause. */
static void dispatch(struct hub *hub)
{
    bool any_sent = false, suspect_sent = false;

    if (!hub->renders->ready) {
        return;
    }
    for (struct render *render = hub->renders->first; render; render = render->next) {
        any_sent |= render->sent;
        suspect_sent |= render->sent && is_suspect(render);
    }
    for (struct render *render = hub->renders->first; render && !suspect_sent;
         render = render->next) {
        if (render->sent) {
            continue;
        }
        if (is_suspect(render)) {
            if (any_sent) {
                return;
            }
            suspect_sent = true;
        }
        send_render(hub, render);
        any_sent = true;
    }
}

/* --- who may ask --- */

static bool admits_image(struct hub *hub, const struct render_order *order, struct error *err)
{
    const struct room *room = order->room;

    if (room && room->problem.kind != ERROR_NONE && room->problem_revision == room->revision) {
        *err = room->problem; /* an older state would be the wrong picture */
        return false;
    }
    return image_queue_admits(hub, order, err);
}

static bool admits(struct hub *hub, const struct render_order *order, struct error *err)
{
    if (order->room && order->room->left_out.kind != ERROR_NONE) {
        if (err) {
            *err = order->room->left_out;
        }
        return false;
    }
    return order->priority != RENDER_IMAGE || admits_image(hub, order, err);
}

uint32_t renders_submit(struct hub *hub, struct render_order *order, struct error *err)
{
    struct renders *renders = hub->renders;

    if (!admits(hub, order, err)) {
        render_request_finish(&order->request);
        return 0;
    }
    struct render *render = memory_alloc(1, sizeof(*render));

    renders->last_id = renders->last_id % 0x7fffffff + 1;
    render->id = renders->last_id;
    render->order = *order;
    render->document = order->document ? memory_text(order->document) : NULL;
    render->account = memory_text(order->account);
    render->asked = clock_ms();
    render->deadline = render->asked + RENDER_DEADLINE_MS;
    *renders->end = render;
    renders->end = &render->next;
    metric_add(&hub->metrics, METRIC_IMAGES_WAITING, order->priority == RENDER_IMAGE);
    metric_add(&hub->metrics, METRIC_RENDERS, 1);
    metric_add(&hub->metrics, METRIC_RENDER_QUEUE, 1);
    dispatch(hub);
    return render->id;
}

/* --- ends of an order --- */

static struct render *find(const struct renders *renders, uint32_t id)
{
    struct render *render = renders->first;

    while (render && render->id != id) {
        render = render->next;
    }
    return render;
}

static void finish(struct hub *hub, struct render *render, const struct picture_answer *answer,
                   const struct error *err)
{
    detach(hub, render);
    if (!render->order.room && render->sent) {
        send_drop(hub, render);
    }
    render->order.on_done(render->order.data, answer, err);
    render_destroy(render);
}

static void cancel(struct hub *hub, struct render *render)
{
    detach(hub, render);
    if (render->sent) {
        send_cancel(hub, render);
        if (!render->order.room) {
            send_drop(hub, render);
        }
    }
    render_destroy(render);
}

void renders_cancel(struct hub *hub, uint32_t id)
{
    struct render *render = find(hub->renders, id);

    if (render) {
        cancel(hub, render);
        dispatch(hub);
    }
}

void renders_fail_all(struct hub *hub, const char *why)
{
    struct error err = {0};

    error_set(&err, ERROR_UNAVAILABLE, "", "%s", why);
    while (hub->renders->first) {
        finish(hub, hub->renders->first, NULL, &err);
    }
}

void renders_cancel_room(struct hub *hub, const struct room *room)
{
    struct error err = {0};
    struct render *render = hub->renders->first;

    error_set(&err, ERROR_NOT_FOUND, room->id, "the scene was deleted");
    while (render) {
        struct render *next = render->next;

        if (render->order.room == room) {
            finish(hub, render, NULL, &err);
            next = hub->renders->first; /* the callback may have changed the list */
        }
        render = next;
    }
}

bool renders_has_room(const struct renders *renders, const struct room *room)
{
    const struct render *render = renders->first;

    while (render && render->order.room != room) {
        render = render->next;
    }
    return render != NULL;
}

int renders_moving(const struct renders *renders)
{
    int count = 0;

    for (const struct render *render = renders->first; render; render = render->next) {
        count += render->order.priority == RENDER_MOVING;
    }
    return count;
}

/* Several are drawn by turns: what counts is how soon one follows another. */
static void learn_image(struct renders *renders, const struct render *render)
{
    const int64_t now = clock_ms();
    const int64_t since = renders->image_done > render->asked ? renders->image_done : render->asked;

    if (render->order.priority == RENDER_IMAGE) {
        renders->image_ms =
            renders->image_ms > 0 ? (3 * renders->image_ms + now - since) / 4 : now - since;
        renders->image_done = now;
    }
}

static void count_times(struct hub *hub, const struct job_times *times)
{
    for (int i = 0; i < FRAME_STAGES; i++) {
        metric_add_stage(&hub->metrics, (enum frame_stage)i, times->us[i]);
    }
}

/* --- scenes that are left out --- */

static const char *root_place(const struct room *room, char place[ERROR_PLACE_BYTES])
{
    snprintf(place, ERROR_PLACE_BYTES, "/nodes/%s", room->scene->root->id);
    return place;
}

static void describe_slow(const struct room *room, int measured_ms, int limit_ms, struct error *out)
{
    char place[ERROR_PLACE_BYTES];

    error_set_slow(out, root_place(room, place), "", measured_ms, limit_ms);
    snprintf(out->message, sizeof(out->message),
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
                  "Drawing this scene ended the render process %d times. It is not drawn until it "
                  "is edited or tried again.",
                  room->deaths);
    }
}

static void leave_out(struct room *room, const struct error *why)
{
    log_error("renders", "scene %s is left out: %s", room->id, why->message);
    problem_leave_out(room, why);
}

void renders_worker_ready(struct hub *hub)
{
    hub->renders->ready = true;
    dispatch(hub);
}

/* A picture was begun and cannot be drawn. What viewers see of the scene is left out for that; a
 * picture that was ordered may have been a larger wish. */
static void undrawn(const struct render *render, struct error *err)
{
    struct room *room = render->order.room;

    if (room && err->kind == ERROR_TOO_SLOW) {
        describe_slow(room, err->measured_ms, err->limit_ms, err);
        if (render->order.priority < RENDER_LOSSLESS && room->left_out.kind == ERROR_NONE) {
            leave_out(room, err);
        }
    }
}

/* NULL: cancelled meanwhile. What is heard of goes on. */
static struct render *heard_of(struct hub *hub, uint32_t job)
{
    struct render *render = find(hub->renders, job);

    if (!render || !render->sent) {
        return NULL;
    }
    render->deadline = clock_ms() + RENDER_DEADLINE_MS;
    return render;
}

void renders_progress(struct hub *hub, uint32_t job)
{
    heard_of(hub, job);
}

void renders_failed(struct hub *hub, const struct packet_failed *failed)
{
    struct render *render = heard_of(hub, failed->job);
    struct error err = failed->error;

    if (!render) {
        return;
    }
    metric_add(&hub->metrics, METRIC_RENDERS_FAILED, 1);
    if (failed->begun) {
        undrawn(render, &err);
    }
    finish(hub, render, NULL, &err);
    dispatch(hub);
}

void renders_frame(struct hub *hub, const struct packet *packet)
{
    struct render *render = heard_of(hub, packet->frame.job);
    const struct picture_answer answer = {&packet->frame, packet->payload, packet->payload_length};

    if (!render) {
        return;
    }
    if (packet->frame.more) {
        if (render->order.on_more) {
            render->order.on_more(render->order.data, &answer);
        }
        return;
    }
    count_times(hub, &packet->frame.times);
    learn_image(hub->renders, render);
    if (render->order.room && is_fatal(render)) {
        render->order.room->deaths = 0;
    }
    finish(hub, render, &answer, NULL);
    dispatch(hub);
}

/* --- the worker's fate --- */

/* Which scenes may have been the cause: those asked for, and those whose shader was compiling. */
static void blame(struct hub *hub, const struct supervisor_end *end)
{
    for (struct room *room = hub->rooms; room; room = room->next) {
        bool asked = room->sent && room->settled < room->revision;

        for (struct render *r = hub->renders->first; r && !asked; r = r->next) {
            asked = r->sent && r->order.room == room;
        }
        room->sent = room->shown = room->settled = 0;
        if (!quarantine_blames(hub, room->id, asked) || room->left_out.kind != ERROR_NONE) {
            continue;
        }
        const struct render *drawn = find(hub->renders, hub->quarantine->drawn.job);

        room->fatal = drawn ? render_demand(&drawn->order) : (struct render_demand){0};
        if (++room->deaths >= RENDER_DEATHS) {
            struct error why = {0};

            describe_end(room, end, &why);
            leave_out(room, &why);
        }
    }
}

static bool gives_up(const struct render *render)
{
    return !render->order.again ||
           (render->order.room ? render->order.room->left_out.kind != ERROR_NONE
                               : render->deaths >= RENDER_DEATHS);
}

void renders_worker_down(struct hub *hub, const struct supervisor_end *end)
{
    struct error err = {0};

    hub->renders->ready = false;
    blame(hub, end);
    error_set(&err, ERROR_UNAVAILABLE, "", "the render process ended while it drew this");
    for (struct render *render = hub->renders->first, *next; render; render = next) {
        next = render->next;
        if (!render->sent) {
            continue;
        }
        char name[LIMIT_ID_BYTES + 16];

        scene_name(render, name);
        render->deaths += quarantine_blames(hub, name, true);
        render->sent = false;
        if (gives_up(render)) {
            finish(hub, render, NULL, &err);
        }
    }
}

int64_t renders_tick(struct hub *hub, int64_t now_ms)
{
    struct error err = {0};
    int64_t next_deadline = 0;

    error_set(&err, ERROR_UNAVAILABLE, "", "the picture did not go on for %d seconds",
              RENDER_DEADLINE_MS / 1000);
    for (struct render *render = hub->renders->first, *next; render; render = next) {
        next = render->next;
        if (render->deadline > now_ms) {
            next_deadline = clock_earlier(next_deadline, render->deadline);
            continue;
        }
        if (render->sent) {
            send_cancel(hub, render);
        }
        finish(hub, render, NULL, &err);
    }
    return next_deadline;
}
