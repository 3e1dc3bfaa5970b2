/* SPDX-License-Identifier: MIT */
#include "room.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>

#include "catalog.h"
#include "hub.h"
#include "last_good.h"
#include "picker.h"
#include "poster.h"
#include "protocol/code_text.h"
#include "protocol/json.h"
#include "protocol/memory.h"
#include "room_apart.h"
#include "room_authors.h"
#include "room_history.h"
#include "room_snapshot.h"
#include "room_store.h"
#include "room_sync.h"
#include "scene_error.h"
#include "server/clock.h"
#include "server/log.h"
#include "server_message.h"
#include "session.h"
#include "stream.h"

/* --- birth and death --- */

static void make_epoch(char out[17])
{
    uint64_t number = 0;

    if (getrandom(&number, sizeof number, 0) != sizeof number) {
        abort();
    }
    snprintf(out, 17, "%016" PRIx64, number);
}

struct room *room_create(struct hub *hub, const char *id, struct scene *scene, uint64_t revision)
{
    struct room *room = memory_alloc(1, sizeof *room);

    room->hub = hub;
    snprintf(room->id, sizeof room->id, "%s", id);
    room->scene = scene;
    room->history = history_create();
    room->revision = room->durable = room->log_from = revision;
    room->idle_since = clock_ms();
    room->patience = 1;
    room->last_good.code = code_text_in_scene(scene);
    make_epoch(room->epoch);
    room->destroy = room_destroy;
    return room;
}

void room_destroy(struct room *room)
{
    if (!room) {
        return;
    }
    room_history_clear(room);
    last_good_finish(room);
    poster_finish(room);
    picker_finish_room(room);
    room_forget_text(room);
    authors_finish(&room->authors);
    history_destroy(room->history);
    scene_destroy(room->scene);
    free(room);
}

static bool replay(struct room *room, const struct store_edit *edit, struct error *err)
{
    cJSON *ops = NULL;
    bool ok = false;

    if (edit->revision != room->revision + 1) {
        error_set(err, ERROR_INTERNAL, room->id, "the log lacks revision %" PRIu64,
                  room->revision + 1);
        return false;
    }
    ops = json_parse_printed(edit->ops, strlen(edit->ops), err);
    ok = ops && edit_apply(room->scene, ops, NULL, NULL, err);
    cJSON_Delete(ops);
    room->revision = edit->revision;
    return ok;
}

/* What can be undone, rebuilt from what was done. */
static bool recall(struct room *room, const struct store_edit *past, struct error *err)
{
    const struct store_step *step = &past->step;
    cJSON *ops = json_parse_printed(past->ops, strlen(past->ops), err);
    cJSON *inverse = json_parse_printed(step->inverse, strlen(step->inverse), err);
    const bool ok = ops && inverse;

    if (ok) {
        history_record(room->history, &(struct history_entry){.kind = (enum history_kind)step->kind,
                                                              .author = past->author,
                                                              .group = step->group,
                                                              .label = step->label,
                                                              .applied = ops,
                                                              .inverse = inverse,
                                                              .undo = step->undo,
                                                              .redo = step->redo});
    } else {
        cJSON_Delete(inverse);
    }
    cJSON_Delete(ops);
    return ok;
}

/* A scene is not lost for what cannot be undone. */
static void recall_all(struct room *room, const struct store_loaded *loaded)
{
    struct error err = {0};

    for (size_t i = 0; i < loaded->past_count; i++) {
        if (!recall(room, &loaded->past[i], &err)) {
            log_warning("room", "%s: what was done before cannot be undone: %s", room->id,
                        err.message);
            history_clear(room->history);
            return;
        }
    }
}

struct room *room_load(struct hub *hub, const char *id, const struct store_loaded *loaded,
                       struct error *err)
{
    struct scene *scene = scene_parse_printed(loaded->document, strlen(loaded->document), err);

    if (!scene) {
        return NULL;
    }
    struct room *room = room_create(hub, id, scene, loaded->revision);
    bool ok = true;
    room->bytes = strlen(loaded->document);
    for (size_t i = 0; i < loaded->edit_count && ok; i++) {
        room->bytes += strlen(loaded->edits[i].ops);
        ok = replay(room, &loaded->edits[i], err);
    }
    if (!ok) {
        room_destroy(room);
        return NULL;
    }
    recall_all(room, loaded);
    room_drop_steps(room);
    room_authors_load(room, loaded);
    room->durable = room->log_from = room->revision;
    room->edits_since_snapshot = (int)loaded->edit_count;
    return room;
}

/* --- what follows an accepted change --- */

static void tell_others(struct room *room, const struct room_change *change, const char *ops)
{
    struct shared_buffer *message =
        message_changed(room->revision, room_change_name(change), ops, 0);

    for (struct session *session = room->sessions; session; session = session->next) {
        if (session != change->session) {
            session_send(session, message);
        }
        stream_changed(session);
    }
    shared_buffer_unref(message);
}

/* The scene holds the change already; gives it a revision and tells everybody but the author. Takes
 * `text`, which is what `ops` print as, and what `step` holds. */
static void commit_change(struct room *room, const struct room_change *change, const cJSON *ops,
                          char *text, const struct store_step *step)
{
    room->revision++;
    if (change->by) {
        authors_edited(&room->authors, change->by, change->edit, room->revision);
    }
    room_history_add(room, change, text);
    tell_others(room, change, text);
    scene_error_resume(room); /* it may have helped */
    room_sync_edit(room, ops, text);
    room_store_push(room, STORE_EDIT, change, text, step);
    metric_add(&room->hub->metrics, METRIC_EDITS, 1);
    if (++room->edits_since_snapshot >= ROOM_SNAPSHOT_EDITS) {
        room_snapshot_soon(room);
    }
}

static bool check_open(const struct room *room, struct error *err)
{
    return !atomic_load(&room->hub->draining) ||
           error_set(err, ERROR_UNAVAILABLE, "", "the server is shutting down");
}

/* Takes the inverse and its text. */
static struct store_step record_step(struct room *room, const struct room_change *change,
                                     const struct room_work *work)
{
    struct store_step step = {.kind = HISTORY_EDIT,
                              .group = memory_text(change->group ? change->group : ""),
                              .label = memory_text(change->label ? change->label : ""),
                              .inverse = work->inverse_text};

    history_depth(room->history, change->author, &step.undo, &step.redo);
    history_record(room->history, &(struct history_entry){.kind = HISTORY_EDIT,
                                                          .author = change->author,
                                                          .group = step.group,
                                                          .label = step.label,
                                                          .applied = work->applied,
                                                          .step = work->step,
                                                          .undo = step.undo,
                                                          .redo = step.redo});
    room_drop_steps(room);
    return step;
}

enum room_outcome room_edit(struct room *room, const struct room_change *change, const cJSON *ops,
                            uint64_t *out_revision, struct error *err)
{
    struct room_work work = {0};
    const struct room_order order = {
        .change = change, .ops = ops, .heavy = room_edit_is_heavy(room, ops)};
    const cJSON *new_code = change->plain ? NULL : ops;
    const enum room_outcome outcome = room_authors_check_number(room, change, out_revision, err);

    if (outcome != ROOM_APPLIED) {
        return outcome;
    }
    last_good_before_edit(room, new_code);
    if (!check_open(room, err) || !hub_accepts_edit(room->hub, new_code, err) ||
        !room_apply(room, &order, &work, err)) {
        metric_add(&room->hub->metrics, METRIC_EDITS_REJECTED, 1);
        return ROOM_REFUSED;
    }
    const struct store_step step = record_step(room, change, &work);
    commit_change(room, change, work.applied, work.applied_text, &step);
    *out_revision = room->revision;
    room_work_finish(room, &work);
    return ROOM_APPLIED;
}

static bool step_is_heavy(const struct room *room, const char *author, bool redo)
{
    return room_edit_is_heavy(room, history_next(room->history, author, redo));
}

bool room_edit_releases(const struct room *room, const cJSON *ops)
{
    return room_edit_is_heavy(room, ops) || (room_is_heavy(room) && last_good_is_copied(room, ops));
}

bool room_undo_releases(const struct room *room, const char *author, bool redo)
{
    return step_is_heavy(room, author, redo) ||
           (room_is_heavy(room) && last_good_is_copied(room, NULL));
}

/* Applies the newest step of the author; the other stack has what takes it back then. */
static bool move_step(struct room *room, const struct room_change *change, bool redo,
                      struct history_move *move, struct room_work *work, struct error *err)
{
    const struct room_order order = {
        .change = change, .move = move, .heavy = step_is_heavy(room, change->author, redo)};
    const bool ok = check_open(room, err) &&
                    history_take(room->history, change->author, redo, move, err) &&
                    room_apply(room, &order, work, err);

    if (ok) {
        history_put(room->history, change->author, redo, move);
    } else {
        history_return(room->history, change->author, redo, move);
    }
    room_drop_steps(room);
    return ok;
}

enum room_outcome room_undo(struct room *room, const struct room_change *change, bool redo,
                            uint64_t *out_revision, cJSON **out_skipped, struct error *err)
{
    struct history_move move = {0};
    struct room_work work = {0};
    const enum room_outcome outcome = room_authors_check_number(room, change, out_revision, err);

    *out_skipped = NULL;
    if (outcome != ROOM_APPLIED) {
        return outcome;
    }
    last_good_before_edit(room, NULL);
    const bool ok = move_step(room, change, redo, &move, &work, err);
    *out_skipped = move.skipped;
    if (!ok) {
        metric_add(&room->hub->metrics, METRIC_EDITS_REJECTED, 1);
        return ROOM_REFUSED;
    }
    const struct store_step step = {.kind = redo ? HISTORY_REDO : HISTORY_UNDO,
                                    .undo = move.undo,
                                    .redo = move.redo,
                                    .group = memory_text(""),
                                    .label = memory_text(move.label),
                                    .inverse = work.inverse_text};
    commit_change(room, change, work.applied, work.applied_text, &step);
    *out_revision = room->revision;
    room_work_finish(room, &work);
    return ROOM_APPLIED;
}

static void tell_document(struct room *room)
{
    struct shared_buffer *message = room->sessions ? room_document_message(room) : NULL;

    for (struct session *session = message ? room->sessions : NULL; session;
         session = session->next) {
        session_send(session, message);
        stream_changed(session);
    }
    shared_buffer_unref(message);
}

struct scene *room_replace(struct room *room, const struct room_document *document,
                           const struct room_change *change)
{
    struct scene *before = last_good_before_replace(room, document->has_code) ? NULL : room->scene;

    room->scene = document->scene;
    room->bytes = strlen(document->text);
    history_clear(room->history);
    room_drop_steps(room);
    room->revision++;
    room->edits_since_snapshot = 0;
    room_keep_text(room, document->kept);
    scene_error_resume(room); /* it may have helped */
    room_history_clear(room);
    room_sync_replace(room);
    room_store_push(room, STORE_REPLACE, change, document->text, NULL);
    metric_add(&room->hub->metrics, METRIC_EDITS, 1);
    tell_document(room);
    return before;
}

/* --- what others ask of it --- */

struct shared_buffer *room_document_message(struct room *room)
{
    struct shared_buffer *text = room_text(room);
    const uint64_t revision = room->revision;
    const bool heavy = room_is_heavy(room);

    if (heavy) {
        room_hold(room);
        hub_unlock(room->hub);
    }
    struct shared_buffer *message =
        message_document(revision, (const char *)text->bytes, text->length - 1);
    shared_buffer_unref(text);
    if (heavy) {
        hub_lock(room->hub);
        room_release(room);
    }
    return message;
}

struct shared_buffer *room_changed_message(const struct room *room, uint64_t revision,
                                           const char *client)
{
    const struct room_entry *entry = room_entry_of(room, revision);
    const bool own = strcmp(entry->author, client) == 0;

    return message_changed(revision, entry->name, entry->ops, own ? entry->edit : 0);
}

void room_tell_all(struct room *room, const char *level, const char *code, const char *place,
                   const char *text)
{
    struct shared_buffer *message = message_notice(level, code, place, text);

    for (struct session *session = room->sessions; session; session = session->next) {
        session_send(session, message);
    }
    shared_buffer_unref(message);
}
