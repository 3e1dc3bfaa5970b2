/* SPDX-License-Identifier: MIT */
/* Immutable bytes with a reference count: those who send the same share one copy. Any thread. */
#ifndef SERVER_SHARED_BUFFER_H
#define SERVER_SHARED_BUFFER_H

#include <stddef.h>
#include <stdint.h>

struct shared_buffer {
    _Atomic int references;
    int answers;                  /* that hold it, under the lock of answers.c, */
    struct answers_client *payer; /* and who is charged for them there */
    size_t length;
    uint8_t *bytes;
    void *taken; /* the same, where they were not copied */
};

struct shared_buffer *shared_buffer_create(const void *bytes, size_t length); /* copies */
struct shared_buffer *shared_buffer_take(void *bytes, size_t length);         /* frees them */
struct shared_buffer *shared_buffer_ref(struct shared_buffer *buffer);
void shared_buffer_unref(struct shared_buffer *buffer); /* may be NULL */

#endif
