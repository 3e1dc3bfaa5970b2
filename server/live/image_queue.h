/* SPDX-License-Identifier: MIT */
/* The queue of REST pictures: which requests are admitted, and their places in the queue. Clients
 * take turns; the small pictures of one client go before its large ones. Every function is called
 * under the hub's lock. */
#ifndef SERVER_IMAGE_QUEUE_H
#define SERVER_IMAGE_QUEUE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/error.h"

struct hub;
struct render_order;

struct image_place {
    const char *scene; /* its id; NULL: the request brought a document */
    int width, height;
    int position; /* from 1, the next one or the one being drawn */
    int64_t waited_ms;
    int64_t expected_ms; /* remaining, by recent drawing times; 0: not known */
};

/* False and `err` when too many pictures wait; `err` has the position this one would get. */
bool image_queue_admits(struct hub *hub, const struct render_order *order, struct error *err);
/* Calls `see` for the waiting pictures of one client, in the order of their requests. */
void image_queue_each(const struct hub *hub, const char *account,
                      void (*see)(void *data, const struct image_place *place), void *data);
/* The number of clients with a waiting picture. */
int image_queue_clients(const struct hub *hub);

#endif
