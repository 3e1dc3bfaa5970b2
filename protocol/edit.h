/* SPDX-License-Identifier: MIT */
/* Edits: lists of operations applied all or none, each with its inverse. The wire form (README.md)
 * is also the form in memory, in the store and between front and worker: a cJSON array. */
#ifndef PROTOCOL_EDIT_H
#define PROTOCOL_EDIT_H

#include "scene.h"

/* Checks the form of `ops` without a scene: an array of at most LIMIT_OPERATIONS objects with known
 * members. For what comes from outside: edit_apply checks the form too, but not how many, because
 * an inverse may be longer than its edit. */
bool edit_check(const cJSON *ops, struct error *err);

/* Applies every operation of `ops`, or none: on failure the scene is as before and `err` names the
 * operation's place. On success `*out_inverse` (may be NULL) is the array that undoes it, and
 * `*out_applied` (may be NULL) the canonical form of `ops` (ids filled in). Caller frees both. */
bool edit_apply(struct scene *scene, const cJSON *ops, cJSON **out_applied, cJSON **out_inverse,
                struct error *err);

/* Like edit_apply, but leaves out operations that no longer apply (their target is gone). Fails
 * only when none applies. This is how undo treats what others changed meanwhile. */
bool edit_apply_some(struct scene *scene, const cJSON *ops, cJSON **out_applied,
                     cJSON **out_inverse, struct error *err);

/* An estimate of the work of applying `ops`: operations, JSON values that they bring, long texts
 * among them for several, and nodes that they remove, move, change or look at. Counts little
 * further than `most`. */
size_t edit_weight(const struct scene *scene, const cJSON *ops, size_t most);

/* Undo and redo of one scene, a pair of stacks of steps per author. A redo is built when its undo
 * happens, so n undos and n redos give back what was there, others' edits included.
 *
 * A step records the values that its edits left. A value that differs now was set by another
 * author; undo and redo do not change it. */
struct history;
struct step;

enum history_kind { HISTORY_EDIT, HISTORY_UNDO, HISTORY_REDO };

/* What was done, as it may be kept and recorded again: of the same entries the same steps come. */
struct history_entry {
    enum history_kind kind;
    const char *author;
    const char *group; /* of an edit; NULL or "": a step of its own */
    const char *label; /* for people; may be NULL */
    const cJSON *applied;
    cJSON *inverse;    /* taken */
    size_t undo, redo; /* steps that the author had before it */
    struct step *step; /* of an edit, by history_prepare; taken; NULL: it is made of the others */
};

struct history *history_create(void);
void history_destroy(struct history *history);
/* The steps of all authors, or of one, are gone. */
void history_clear(struct history *history);
void history_forget(struct history *history, const char *author);
/* About how long the operations and values of all steps are. */
size_t history_bytes(const struct history *history);
/* Steps that are gone, as one list for history_discard, and how long they are; NULL: none. Freeing
 * them takes long, so the history does that only when it is destroyed itself. */
struct step *history_take_dropped(struct history *history, size_t *out_bytes);
/* Edits of one author with the same non-empty group join in one step; of several sets of one place
 * in a group only the oldest value is kept. An undo or redo moves a step without applying it. */
void history_record(struct history *history, const struct history_entry *entry);
/* What is long about recording an edit, without the history; takes the inverse. */
struct step *history_prepare(const struct history_entry *entry);
/* Frees one of an edit that is not recorded after all, or a list; NULL is fine. */
void history_discard(struct step *step);

/* What an undo or redo did. */
struct history_move {
    cJSON *applied;       /* as of edit_apply; NULL: nothing */
    cJSON *skipped;       /* operations left out, since others have set their places; or NULL */
    const cJSON *inverse; /* the history's, until its next change */
    const char *label;    /* the same */
    size_t undo, redo;    /* as in struct history_entry */
    struct step *step;    /* between history_take and history_put: the one that was taken; NULL
                           * once it is discarded, which takes long, and cannot be returned */
    struct step *back;    /* between history_apply and history_put: what takes that back */
};
void history_move_finish(struct history_move *move);
/* Applies the newest step of the author to the scene and moves it to the other stack. False with
 * ERROR_NOT_FOUND when there is none, and with ERROR_CONFLICT when others have set all of its
 * places: then `skipped` has the operations, and the step is gone. `out` may be NULL. */
bool history_undo(struct history *history, struct scene *scene, const char *author,
                  struct history_move *out, struct error *err);
bool history_redo(struct history *history, struct scene *scene, const char *author,
                  struct history_move *out, struct error *err);
/* The same in three calls: the step is taken from its stack, applied, which may take long and needs
 * no history, and what takes it back is put on the other stack, unless nothing was applied. Nothing
 * else may happen to the document and the author's steps meanwhile. If the applied scene is thrown
 * away instead, history_return leaves the author's steps as they were before; it does nothing where
 * nothing was taken or applied. */
bool history_take(struct history *history, const char *author, bool redo, struct history_move *out,
                  struct error *err);
bool history_apply(struct history_move *move, struct scene *scene, struct error *err);
void history_put(struct history *history, const char *author, bool redo, struct history_move *move);
void history_return(struct history *history, const char *author, bool redo,
                    struct history_move *move);
/* Operations of the step that would be next; NULL: there is none. */
const cJSON *history_next(const struct history *history, const char *author, bool redo);
void history_depth(const struct history *history, const char *author, size_t *out_undo,
                   size_t *out_redo);
/* Of the author's step number `index` of a stack, the newest is 0; NULL: there is none. */
const char *history_label(const struct history *history, const char *author, bool redo,
                          size_t index);

#endif
