/* SPDX-License-Identifier: MIT */
/* The reason why the newest state of a scene cannot be drawn. It is kept as room->scene_error and
 * told to all sessions, later ones too. Every function is called under the hub's lock. */
#ifndef SERVER_SCENE_ERROR_H
#define SERVER_SCENE_ERROR_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"

struct room;
struct session;

/* Whether the error is a refusal, which lasts until a retry. */
bool scene_error_is_refusal(const struct error *err);
/* Sets the error and tells it, unless it is the same as before. */
void scene_error_set(struct room *room, const struct error *err, uint64_t revision);
/* This revision can be drawn: ends the error of an older one and tells so. */
void scene_error_cure(struct room *room, uint64_t revision);
/* Suspends the scene for this reason. */
void scene_error_suspend(struct room *room, const struct error *why);
/* Resumes a suspended scene after an edit. */
void scene_error_resume(struct room *room);
/* Tells that the shape at this place is tried again. */
void scene_error_tell_retry(const struct room *room, const char *place);
/* Tells a new session the error, if there is one. */
void scene_error_tell(struct session *session, const struct room *room);

#endif
