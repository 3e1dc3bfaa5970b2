/* SPDX-License-Identifier: MIT */
/* The memory of request bodies, with one bound for all of them. Bodies grow on the thread of http
 * alone. One whose client left earlier than its answer came ends on the thread that answers. */
#ifndef SERVER_BODY_H
#define SERVER_BODY_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include "request.h"

/* All bodies together. */
struct bodies {
    atomic_size_t held; /* bytes, without the first block of each body */
};

/* One body, beside its request. */
struct body {
    struct bodies *bodies;
    size_t most; /* greatest length: as announced, else by its limit */
    size_t capacity;
};

/* Appends bytes. False: all bodies would exceed LIMIT_BODIES_BYTES; this body is freed. */
bool body_add(struct body *body, struct request *request, const char *bytes, size_t length);
/* Returns its share of the bound, on any thread. The request keeps the bytes. */
void body_finish(struct body *body);

#endif
