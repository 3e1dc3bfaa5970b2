/* SPDX-License-Identifier: MIT */
#include "room_apart.h"

#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "protocol/json.h"
#include "protocol/memory.h"

void room_hold(struct room *room)
{
    room->holds++;
}

void room_release(struct room *room)
{
    room->holds--;
    pthread_cond_broadcast(&room->hub->released);
}

bool room_is_heavy(const struct room *room)
{
    return room->scene->node_count > TASK_LIGHT_NODES;
}

bool room_edit_is_heavy(const struct room *room, const cJSON *ops)
{
    return ops && (room->bytes + ROOM_LIGHT_BYTES > LIMIT_SCENE_BYTES ||
                   edit_weight(room->scene, ops, ROOM_LIGHT_WEIGHT) > ROOM_LIGHT_WEIGHT);
}

/* --- copies --- */

struct scene *room_copy(struct room *room)
{
    if (!room_is_heavy(room)) {
        return scene_copy(room->scene);
    }
    room_hold(room);
    hub_unlock(room->hub);
    struct scene *copy = scene_copy(room->scene);
    hub_lock(room->hub);
    room_release(room);
    return copy;
}

/* Others may still read the document when the caller wants to change it. */
static void release_to_edit(struct room *room)
{
    while (room->holds > 1) {
        hub_wait(room->hub, &room->hub->released);
    }
    room_release(room);
}

struct scene *room_copy_to_edit(struct room *room)
{
    room_hold(room);
    struct scene *copy = room_copy(room);
    release_to_edit(room);
    return copy;
}

/* --- ends --- */

/* Now, or on a thread of tasks what is large. */
static void destroy(struct hub *hub, void (*run)(void *data, bool dropped), void *data, bool large)
{
    const struct task_order order = {
        .scene = "", .account = "", .heavy = true, .run = run, .data = data};

    if (!large || !tasks_add(hub->tasks, &order, NULL)) {
        run(data, false);
    }
}

static void destroy_scene(void *data, bool dropped)
{
    (void)dropped;
    scene_destroy(data);
}

void room_drop_scene(struct hub *hub, struct scene *scene)
{
    destroy(hub, destroy_scene, scene, scene && scene->node_count > TASK_LIGHT_NODES);
}

static void destroy_steps(void *data, bool dropped)
{
    (void)dropped;
    history_discard(data);
}

void room_drop_steps(struct room *room)
{
    size_t bytes = 0;
    struct step *steps = history_take_dropped(room->history, &bytes);

    destroy(room->hub, destroy_steps, steps, bytes > TASK_LIGHT_BYTES);
}

static void destroy_room(void *data, bool dropped)
{
    struct room *room = data;

    (void)dropped;
    room->destroy(room);
}

void room_drop(struct room *room)
{
    destroy(room->hub, destroy_room, room,
            room_is_heavy(room) || history_bytes(room->history) > TASK_LIGHT_BYTES);
}

/* --- text --- */

static struct shared_buffer *with_end(const char *text)
{
    return shared_buffer_create(text, strlen(text) + 1);
}

struct shared_buffer *room_text_to_keep(const struct scene *scene, const char *text)
{
    return scene->node_count > TASK_LIGHT_NODES ? with_end(text) : NULL;
}

void room_keep_text(struct room *room, struct shared_buffer *kept)
{
    room_forget_text(room);
    room->text = kept;
}

void room_forget_text(struct room *room)
{
    shared_buffer_unref(room->text);
    room->text = NULL;
}

static struct shared_buffer *print(const struct room *room)
{
    char *text = scene_print(room->scene, false);
    struct shared_buffer *buffer = with_end(text);

    free(text);
    return buffer;
}

struct shared_buffer *room_text(struct room *room)
{
    if (room->text) {
        return shared_buffer_ref(room->text);
    }
    if (!room_is_heavy(room)) {
        return print(room);
    }
    room_hold(room);
    hub_unlock(room->hub);
    struct shared_buffer *text = print(room);
    hub_lock(room->hub);
    shared_buffer_unref(room->text);
    room->text = shared_buffer_ref(text);
    room_release(room);
    return text;
}

/* --- length --- */

bool room_check_bytes(size_t bytes, struct error *err)
{
    return bytes <= LIMIT_SCENE_BYTES ||
           error_set(err, ERROR_LIMIT, "",
                     "%zu bytes of the scene are above the maximum %d (scene_bytes)", bytes,
                     LIMIT_SCENE_BYTES);
}

/* Counts a document that may be too long. One that has been too long may grow no more. */
static bool check_length(const struct scene *scene, struct room_work *work, struct error *err)
{
    if (work->bytes <= LIMIT_SCENE_BYTES) {
        return true;
    }
    char *text = scene_print(scene, false);
    work->bytes = strlen(text);
    free(text);
    return strlen(work->applied_text) <= strlen(work->inverse_text) ||
           room_check_bytes(work->bytes, err);
}

/* --- edits --- */

static bool apply_operations(struct scene *scene, const struct room_order *order,
                             struct room_work *out, struct error *err)
{
    cJSON *inverse = NULL;

    if (!edit_apply(scene, order->ops, &out->applied, &inverse, err)) {
        return false;
    }
    out->inverse_text = json_print(inverse, false);
    out->step = history_prepare(&(struct history_entry){.group = order->change->group,
                                                        .label = order->change->label,
                                                        .applied = out->applied,
                                                        .inverse = inverse});
    return true;
}

static bool apply_step(struct scene *scene, struct history_move *move, struct room_work *out,
                       struct error *err)
{
    if (!history_apply(move, scene, err)) {
        return false;
    }
    out->inverse_text = json_print(move->inverse, false);
    out->applied = move->applied;
    move->applied = NULL;
    return true;
}

static bool apply(const struct room *room, struct scene *scene, const struct room_order *order,
                  struct room_work *out, struct error *err)
{
    const bool ok = order->move ? apply_step(scene, order->move, out, err)
                                : apply_operations(scene, order, out, err);

    if (ok) {
        out->applied_text = json_print(out->applied, false);
        out->bytes = room->bytes + strlen(out->applied_text);
    }
    return ok;
}

static void drop(struct room_work *work)
{
    history_discard(work->step);
    cJSON_Delete(work->applied);
    free(work->applied_text);
    free(work->inverse_text);
    *work = (struct room_work){0};
}

static bool apply_to_copy(struct room *room, const struct room_order *order, struct room_work *out,
                          struct error *err)
{
    room_hold(room);
    hub_unlock(room->hub);
    struct scene *copy = scene_copy(room->scene);
    bool ok = apply(room, copy, order, out, err);
    if (ok && !check_length(copy, out, err)) {
        drop(out);
        ok = false;
    }
    if (!ok) {
        scene_destroy(copy);
    } else if (order->move) {
        history_discard(order->move->step); /* while the lock is free */
        order->move->step = NULL;
    }
    hub_lock(room->hub);
    release_to_edit(room);
    if (ok) {
        out->before = room->scene;
        room->scene = copy;
    }
    return ok;
}

bool room_apply(struct room *room, const struct room_order *order, struct room_work *out,
                struct error *err)
{
    const bool ok = order->heavy ? apply_to_copy(room, order, out, err)
                                 : apply(room, room->scene, order, out, err);

    if (ok) {
        room->bytes = out->bytes;
        room_forget_text(room);
    }
    return ok;
}

void room_work_finish(struct room *room, struct room_work *work)
{
    if (work->before) {
        room_hold(room);
        hub_unlock(room->hub);
        scene_destroy(work->before);
        cJSON_Delete(work->applied);
        hub_lock(room->hub);
        room_release(room);
    } else {
        cJSON_Delete(work->applied);
    }
    *work = (struct room_work){0};
}
