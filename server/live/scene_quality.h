/* SPDX-License-Identifier: MIT */
/* How well the equations of a scene are drawn (renderer/field/field_quality.h), as JSON. */
#ifndef SERVER_SCENE_QUALITY_H
#define SERVER_SCENE_QUALITY_H

#include <cjson/cJSON.h>

#include "protocol/error.h"

struct hub;

/* Of the scene as it is, or of one node of it; `node` NULL: of all, up to LIMIT_JUDGED_EQUATIONS.
 * Takes the lock for a moment. A second for each equation at most: threads of tasks only. The
 * caller deletes the answer; NULL and `err`: there is no such scene or node, or too many. */
cJSON *scene_quality(struct hub *hub, const char *id, const char *node, struct error *err);

#endif
