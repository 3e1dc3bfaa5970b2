/* SPDX-License-Identifier: MIT */
/* Pictures asked of the worker and not yet answered. Survives the worker: what was asked
 * is asked again of the next one, and a scene that kills workers is left out. Every function is
 * called under the hub's lock. */
#ifndef SERVER_RENDERS_H
#define SERVER_RENDERS_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"
#include "render_list.h"
#include "supervisor.h"

struct hub;
struct room;

void renders_init(struct renders *renders);
void renders_finish(struct renders *renders);
/* Id of the order; 0 and `err` when too many wait, in all or of one account, or the scene is left
 * out. */
uint32_t renders_submit(struct hub *hub, struct render_order *order, struct error *err);
void renders_cancel(struct hub *hub, uint32_t id);
/* Answers every order of the room with ERROR_NOT_FOUND. */
void renders_cancel_room(struct hub *hub, const struct room *room);
/* Moving pictures that are asked and not yet there. */
int renders_moving(const struct renders *renders);
bool renders_has_room(const struct renders *renders, const struct room *room);
/* Answers every order with ERROR_UNAVAILABLE. */
void renders_fail_all(struct hub *hub, const char *why);

/* Events of the supervisor. */
void renders_worker_ready(struct hub *hub);
void renders_worker_down(struct hub *hub, const struct supervisor_end *end);
/* Packets of the worker. */
void renders_frame(struct hub *hub, const struct packet *packet);
void renders_progress(struct hub *hub, uint32_t job);
void renders_failed(struct hub *hub, const struct packet_failed *failed);
/* Fails what is too old; returns the next deadline or 0. */
int64_t renders_tick(struct hub *hub, int64_t now_ms);

#endif
