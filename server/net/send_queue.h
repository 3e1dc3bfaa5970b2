/* SPDX-License-Identifier: MIT */
/* What waits to be written to one live connection, and in which pieces: text first, frames in
 * parts between texts, at most one frame waiting behind the one being written. Pure; not
 * thread-safe.
 *
 * Frames are a stream: a key decodes alone, any other one with all frames since the last key. So
 * one that is lost takes those with it that follow until the next key, which is asked for
 * (send_queue_wants_key). A key takes the place of what waits; no other frame does, since it needs
 * that. */
#ifndef SERVER_SEND_QUEUE_H
#define SERVER_SEND_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/messages.h"

enum {
    SEND_QUEUE_PART_BYTES = 65536,
    SEND_QUEUE_TEXT_BYTES = 2097152, /* queued for one client at most, behind a first message */
};

/* Immutable bytes shared by those who send them. */
struct shared_buffer {
    _Atomic int references;
    size_t length;
    uint8_t bytes[];
};
struct shared_buffer *shared_buffer_create(const void *bytes, size_t length);
struct shared_buffer *shared_buffer_ref(struct shared_buffer *buffer);
void shared_buffer_unref(struct shared_buffer *buffer);

struct send_queue_frame {
    struct shared_buffer *payload; /* NULL: no frame */
    uint8_t header[FRAME_HEADER_BYTES];
    uint32_t number;
    bool precious; /* a moving picture, which is finished once begun */
    size_t sent;   /* payload bytes */
    bool begun;
};

struct send_queue_text;

struct send_queue {
    struct send_queue_text *first, **end;
    size_t text_bytes, text_offset;
    struct send_queue_frame current, next;
    bool linked; /* what comes next can build on the last frame: none has been lost since a key */
};

enum send_queue_kind { SEND_QUEUE_TEXT, SEND_QUEUE_BINARY };

/* One write: a piece of a text message or a whole binary message. */
struct send_queue_piece {
    enum send_queue_kind kind;
    bool first, last; /* of its WebSocket message */
    size_t length;
    uint32_t frame_done; /* number of the frame that this completes; 0: none */
    size_t frame_bytes;
};

void send_queue_init(struct send_queue *queue);
void send_queue_finish(struct send_queue *queue);
/* Takes a reference of its own. False: too much waits already; nothing was queued. */
bool send_queue_text(struct send_queue *queue, struct shared_buffer *text);
/* Queues a frame. Returns the number of the frame that is given up: an older one, this one where it
 * cannot be decoded or would take the place of what it needs, or 0. */
uint32_t send_queue_frame(struct send_queue *queue, const struct frame_header *header,
                          struct shared_buffer *payload);
/* A frame of the stream, a key or not, is not queued at all. */
void send_queue_skip(struct send_queue *queue);
/* No other frame than a key would be queued. */
bool send_queue_wants_key(const struct send_queue *queue);
bool send_queue_is_empty(const struct send_queue *queue);
/* A frame waits to be written. `*out_precious`: it would not be given up for a newer one. */
bool send_queue_has_frame(const struct send_queue *queue, bool *out_precious);
/* Copies the next piece to `out`, which holds SEND_QUEUE_PART_BYTES + FRAME_HEADER_BYTES. False:
 * there is nothing. */
bool send_queue_next(struct send_queue *queue, uint8_t *out, struct send_queue_piece *piece);

#endif
