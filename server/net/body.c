/* SPDX-License-Identifier: MIT */
#include "body.h"

#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

/* So much of each is not counted, so that large ones cannot keep edits out. */
enum { SMALL_BYTES = 65536 };

static size_t counted(size_t capacity)
{
    return capacity > SMALL_BYTES ? capacity - SMALL_BYTES : 0;
}

static size_t next_capacity(const struct body *body, size_t wanted)
{
    size_t capacity = body->capacity * 2;

    if (capacity > body->most + 1) {
        capacity = body->most + 1;
    }
    return capacity > wanted ? capacity : wanted;
}

bool body_add(struct body *body, struct request *request, const char *bytes, size_t length)
{
    const size_t wanted = request->body_length + length + 1;

    if (wanted > body->capacity) {
        const size_t capacity = next_capacity(body, wanted);
        const size_t more = counted(capacity) - counted(body->capacity);

        if (atomic_load(&body->bodies->held) + more > LIMIT_BODIES_BYTES) {
            free(request->body);
            request->body = NULL;
            request->body_length = 0;
            body_finish(body);
            return false;
        }
        atomic_fetch_add(&body->bodies->held, more);
        body->capacity = capacity;
        request->body = memory_resize(request->body, capacity, 1);
    }
    memcpy(request->body + request->body_length, bytes, length);
    request->body_length += length;
    request->body[request->body_length] = '\0';
    return true;
}

void body_finish(struct body *body)
{
    atomic_fetch_sub(&body->bodies->held, counted(body->capacity));
    body->capacity = 0;
}
