/* SPDX-License-Identifier: MIT */
/* A thread that encodes pictures as their rows come, so that a large one holds up neither drawing
 * nor answers. After a few rows of one picture it looks whether another is more urgent. */
#ifndef RENDERER_ENCODER_H
#define RENDERER_ENCODER_H

#include "renderer/renderer.h"
#include "stream_encoder.h"

struct encoder;

/* A picture being encoded. It belongs to the encoder until encoder_take gives it back. */
struct encoding {
    int priority;                /* the lowest goes first, then the oldest */
    void *data;                  /* the owner's */
    struct stream_packet packet; /* where it is ok */
    bool ok;                     /* else `error` says why, or nobody wanted it */
    uint8_t *bytes;
    size_t length;
    uint32_t encode_us;
    struct error error;
};

/* `wake_fd` is an eventfd that is raised when a picture is finished or no longer full. */
struct encoder *encoder_create(int wake_fd, struct error *err);
/* Drops all pictures, their `data` excepted, which is not freed. */
void encoder_destroy(struct encoder *encoder);
/* Begins the next picture of a stream, of these outputs (job_image_shape). The stream stays the
 * caller's, who leaves it alone until encoder_take has given the picture back. NULL and `err` where
 * the format cannot hold them. */
struct encoding *encoder_begin(struct encoder *encoder, struct stream_encoder *stream,
                               const struct image shapes[AOV_COUNT],
                               const struct encode_params *params, int priority, void *data,
                               struct error *err);
/* The next rows of an output; takes them. */
void encoder_add(struct encoder *encoder, struct encoding *encoding, enum aov aov,
                 struct image rows);
/* No more rows come: the picture is whole, or is not wanted any more. */
void encoder_end(struct encoder *encoder, struct encoding *encoding, bool whole);
/* Whether so much waits that more rows would only fill memory. */
bool encoder_is_full(struct encoder *encoder, const struct encoding *encoding);
/* The oldest that is finished, or NULL; the caller frees it with encoding_destroy. One that fails
 * is finished before its end. */
struct encoding *encoder_take(struct encoder *encoder);
void encoding_destroy(struct encoding *encoding);

#endif
