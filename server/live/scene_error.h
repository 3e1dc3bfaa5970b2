/* SPDX-License-Identifier: MIT */
/* Why the newest state of a scene cannot be drawn, kept as room->scene_error for all who edit it,
 * later ones too. Every function is called under the hub's lock. */
#ifndef SERVER_SCENE_ERROR_H
#define SERVER_SCENE_ERROR_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"

struct room;
struct session;

/* Of what is refused, until it is tried again. */
bool scene_error_is_refusal(const struct error *err);
/* Tells it, unless it is what was told before. */
void scene_error_set(struct room *room, const struct error *err, uint64_t revision);
/* The scene can be drawn as of this revision: tells that the error of an older one is over. */
void scene_error_cure(struct room *room, uint64_t revision);
/* The scene is suspended for this reason. */
void scene_error_suspend(struct room *room, const struct error *why);
/* It is drawn again, since it was edited. */
void scene_error_resume(struct room *room);
/* What is at this place is tried again. */
void scene_error_tell_retry(const struct room *room, const char *place);
/* For somebody who has just come; nothing where there is none. */
void scene_error_tell(struct session *session, const struct room *room);

#endif
