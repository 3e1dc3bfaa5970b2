/* SPDX-License-Identifier: MIT */
/* A thread that encodes pictures, so that a large one holds up neither drawing nor answers. */
#ifndef RENDERER_ENCODER_H
#define RENDERER_ENCODER_H

#include "renderer/renderer.h"

struct encoding {
    uint64_t job;
    int priority; /* the lowest goes first, then the oldest */
    struct image image;
    struct encode_params params;
    void *data; /* the owner's */
    /* filled in by the encoder */
    bool ok;
    uint8_t *bytes;
    size_t length;
    uint32_t encode_us;
    struct error error;
    struct encoding *next;
};

struct encoder;

/* `wake_fd` is an eventfd that is raised for each result. */
struct encoder *encoder_create(int wake_fd, struct error *err);
/* Waits for the picture under way; drops the others, `data` excepted, which is not freed. */
void encoder_destroy(struct encoder *encoder);
/* Takes the encoding, heap-allocated. */
void encoder_add(struct encoder *encoder, struct encoding *encoding);
/* The oldest result or NULL; the caller frees it with encoding_destroy. */
struct encoding *encoder_take(struct encoder *encoder);
void encoding_destroy(struct encoding *encoding);

#endif
