/* SPDX-License-Identifier: MIT */
/* Threads that encode pictures as their rows come, so that a large one holds up neither drawing nor
 * answers. Urgent pictures, unless they are large, have one of their own; the other one leaves the
 * processors to those who draw. After a few rows of one picture each looks whether another goes
 * first. A small JPEG is encoded by its owner, at its end. */
#ifndef RENDERER_ENCODE_THREAD_H
#define RENDERER_ENCODE_THREAD_H

#include "renderer/renderer.h"
#include "stream_encoder.h"

enum { ENCODE_URGENT = 1 }; /* the highest priority number of urgent pictures */

struct encode_thread;

/* Of a picture with so many pixels. */
bool encode_is_urgent(int priority, uint64_t pixels);

/* A picture being encoded. It belongs to the thread until encode_thread_take gives it back. */
struct encoding {
    int priority; /* the lowest goes first, then the smallest picture, then the oldest */
    void *data;   /* the owner's */
    struct stream_packet packet; /* where it is ok */
    bool ok;                     /* else `error` says why, or it was cancelled */
    uint8_t *bytes;
    size_t length;
    uint32_t encode_us;
    struct error error;
};

/* `wake_fd` is an eventfd that is raised when a picture is finished or no longer full. */
struct encode_thread *encode_thread_create(int wake_fd, struct error *err);
/* Drops all pictures, their `data` excepted, which is not freed. */
void encode_thread_destroy(struct encode_thread *encode_thread);
/* Begins the next picture of a stream, of these outputs (job_image_info). The stream stays the
 * caller's, who leaves it alone until encode_thread_take has given the picture back. NULL and
 * `err` where the format cannot hold them. */
struct encoding *encode_thread_begin(struct encode_thread *encode_thread,
                                     struct stream_encoder *stream,
                                     const struct image shapes[AOV_COUNT],
                                     const struct encode_params *params, int priority, void *data,
                                     struct error *err);
/* The next rows of an output; takes them. */
void encode_thread_add(struct encode_thread *encode_thread, struct encoding *encoding, enum aov aov,
                       struct image image);
/* No more rows come: the picture is whole, or is not wanted any more. One that is finished may not
 * be wanted any more either. */
void encode_thread_end(struct encode_thread *encode_thread, struct encoding *encoding, bool whole);
/* Whether so much waits that more rows would only fill memory. */
bool encode_thread_is_full(struct encode_thread *encode_thread, const struct encoding *encoding);
/* The oldest that is finished, or NULL; the caller frees it with encoding_destroy. One that fails
 * is finished before its end. */
struct encoding *encode_thread_take(struct encode_thread *encode_thread);
void encoding_destroy(struct encoding *encoding);

#endif
