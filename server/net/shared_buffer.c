/* SPDX-License-Identifier: MIT */
#include "shared_buffer.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct shared_buffer *shared_buffer_create(const void *bytes, size_t length)
{
    struct shared_buffer *buffer = memory_alloc(1, sizeof *buffer + length);

    atomic_init(&buffer->references, 1);
    buffer->length = length;
    buffer->bytes = memcpy(buffer + 1, bytes, length);
    return buffer;
}

struct shared_buffer *shared_buffer_take(void *bytes, size_t length)
{
    struct shared_buffer *buffer = memory_alloc(1, sizeof *buffer);

    atomic_init(&buffer->references, 1);
    buffer->length = length;
    buffer->bytes = buffer->taken = bytes;
    return buffer;
}

struct shared_buffer *shared_buffer_ref(struct shared_buffer *buffer)
{
    atomic_fetch_add(&buffer->references, 1);
    return buffer;
}

void shared_buffer_unref(struct shared_buffer *buffer)
{
    if (buffer && atomic_fetch_sub(&buffer->references, 1) == 1) {
        free(buffer->taken);
        free(buffer);
    }
}
