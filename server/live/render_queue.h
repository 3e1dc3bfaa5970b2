/* SPDX-License-Identifier: MIT */
/* The queue of pictures that the worker has to draw. It survives the worker: the next worker gets
 * the unanswered orders again. A scene that ends workers is suspended. Every function is called
 * under the hub's lock. */
#ifndef SERVER_RENDER_QUEUE_H
#define SERVER_RENDER_QUEUE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"
#include "render_entry.h"
#include "supervisor.h"

struct hub;
struct room;

void render_queue_init(struct render_queue *queue);
void render_queue_finish(struct render_queue *queue);
/* Returns the id of the order. 0 and `err` when too many orders wait, in all or of this account, or
 * when the scene is suspended. */
uint32_t render_queue_submit(struct hub *hub, struct render_order *order, struct error *err);
void render_queue_cancel(struct hub *hub, uint32_t id);
/* Answers every order of the room with ERROR_NOT_FOUND. */
void render_queue_cancel_room(struct hub *hub, const struct room *room);
/* The number of unanswered orders of moving pictures. */
int render_queue_moving(const struct render_queue *queue);
bool render_queue_has_room(const struct render_queue *queue, const struct room *room);
/* Answers every order with ERROR_UNAVAILABLE. */
void render_queue_fail_all(struct hub *hub, const char *why);

/* Events of the supervisor. */
void render_queue_worker_ready(struct hub *hub);
void render_queue_worker_down(struct hub *hub, const struct supervisor_end *end);
/* Packets of the worker. */
void render_queue_frame(struct hub *hub, const struct packet *packet);
void render_queue_progress(struct hub *hub, uint32_t job);
void render_queue_failed(struct hub *hub, const struct packet_failed *failed);
/* Fails orders past their deadline. Returns the next deadline (clock_ms), or 0. */
int64_t render_queue_tick(struct hub *hub, int64_t now_ms);

#endif
