/* SPDX-License-Identifier: MIT */
/* The memory of request bodies that are being received: what each needs, and a bound for all
 * together. Of the thread of http. */
#ifndef SERVER_BODY_H
#define SERVER_BODY_H

#include <stdbool.h>
#include <stdint.h>

#include "request.h"

/* All of them. */
struct bodies {
    size_t held; /* bytes, without the first of each */
};

/* One, beside its request. */
struct body {
    struct bodies *bodies;
    size_t most; /* bytes that it may come to: as announced, else by its limit */
    size_t capacity;
};

/* False: all together would be above LIMIT_BODIES_BYTES; the body is gone. */
bool body_add(struct body *body, struct request *request, const char *bytes, size_t length);
/* Gives back what it held; the request keeps its bytes. */
void body_finish(struct body *body);

#endif
