/* SPDX-License-Identifier: MIT */
/* The pictures of REST that wait: who may ask for one, and which is there when. Clients take turns,
 * and of one client's pictures the small ones go first. Every function is called under the hub's
 * lock. */
#ifndef SERVER_IMAGE_QUEUE_H
#define SERVER_IMAGE_QUEUE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"

struct hub;
struct render_order;

struct image_place {
    const char *scene; /* its id; NULL: a document that was sent along */
    int width, height;
    int position; /* 1: the next, or being drawn */
    int64_t waited_ms;
    int64_t expected_ms; /* from now on, as pictures have taken lately; 0: not known */
};

/* Refuses where too many wait, with the position that this one would have. */
bool image_queue_admits(struct hub *hub, const struct render_order *order, struct error *err);
/* The pictures of one client, in the order of asking. */
void image_queue_each(const struct hub *hub, const char *account,
                      void (*see)(void *data, const struct image_place *place), void *data);
/* Those who have one waiting. */
int image_queue_clients(const struct hub *hub);

#endif
