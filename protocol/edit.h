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

/* Undo and redo of one scene, a pair of stacks per author. A redo is built when its undo happens,
 * so n undos and n redos give back what was there, others' edits included. */
struct history;

struct history *history_create(void);
void history_destroy(struct history *history);
/* Records an edit's inverse. Edits of one author with the same non-empty group join in one step;
 * of several sets of one place in a group only the oldest value is kept. Takes `inverse`. */
void history_record(struct history *history, const char *author, const char *group, cJSON *inverse);
/* Applies the newest step of the author to the scene and moves it to the other stack. False with
 * ERROR_NOT_FOUND when there is none. `*out_applied` as in edit_apply. */
bool history_undo(struct history *history, struct scene *scene, const char *author,
                  cJSON **out_applied, struct error *err);
bool history_redo(struct history *history, struct scene *scene, const char *author,
                  cJSON **out_applied, struct error *err);
void history_depth(const struct history *history, const char *author, size_t *out_undo,
                   size_t *out_redo);

#endif
