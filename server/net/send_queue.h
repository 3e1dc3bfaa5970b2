/* SPDX-License-Identifier: MIT */
/* The send queue of one live connection: messages and the pieces in which they are written. Texts
 * go first; a frame goes in parts between texts. At most one frame waits behind the one being
 * written. A binary message goes behind all of these. Pure; not thread-safe.
 * Each chain of frames is a stream. A key frame decodes alone; any other frame needs all frames of
 * its chain since the last key. A lost frame therefore makes all frames of its chain up to the next
 * key useless; send_queue_wants_key asks for that key. A frame replaces the waiting one, unless it
 * needs it. */
#ifndef SERVER_SEND_QUEUE_H
#define SERVER_SEND_QUEUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/messages.h"
#include "shared_buffer.h"

enum {
    SEND_QUEUE_CHAINS = 8,
    SEND_QUEUE_PART_BYTES = 65536,
    /* Most text queued, apart from a first message and from the answer to hello. */
    SEND_QUEUE_TEXT_BYTES = 2097152,
};

struct send_queue_frame {
    struct shared_buffer *payload; /* NULL: no frame */
    uint8_t header[FRAME_HEADER_BYTES];
    uint32_t number;
    uint8_t chain;
    bool precious; /* a moving picture; once begun, it is written to its end */
    size_t sent;   /* payload bytes written */
    bool begun;
};

struct send_queue_text;

struct send_queue {
    struct send_queue_text *first, **end;
    size_t text_bytes; /* of those that count */
    size_t text_offset;
    struct send_queue_frame current, next;
    struct shared_buffer *behind; /* NULL: nothing */
    size_t behind_sent;           /* bytes written: once begun, it is written to its end */
    uint8_t linked;               /* a bit for each chain that lost no frame since its last key */
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
/* Queues a text; takes a reference of its own. False: too much waits, and nothing was queued. */
bool send_queue_text(struct send_queue *queue, struct shared_buffer *text);
/* The same of an answer to hello, which may be as long as the scene: it always fits, and does not
 * count for others. */
void send_queue_greeting(struct send_queue *queue, struct shared_buffer *text);
/* Queues a frame. Returns the number of the frame that is given up, or 0. That is an older frame,
 * or this one if it could not be decoded. */
uint32_t send_queue_frame(struct send_queue *queue, const struct frame_header *header,
                          struct shared_buffer *payload);
/* Call it when a frame of the stream is dropped before the queue. */
void send_queue_skip(struct send_queue *queue, uint8_t chain);
/* Whether the queue accepts a key frame alone. */
bool send_queue_wants_key(const struct send_queue *queue, uint8_t chain);
/* Queues a binary message that goes when nothing else waits; takes a reference of its own. One that
 * waits is replaced, so the caller waits for an acknowledgement. */
void send_queue_behind(struct send_queue *queue, struct shared_buffer *message);
bool send_queue_is_empty(const struct send_queue *queue);
/* Whether a frame waits to be written. `*out_precious`: a newer frame would not replace it. */
bool send_queue_has_frame(const struct send_queue *queue, bool *out_precious);
/* Copies the next piece to `out`, which has SEND_QUEUE_PART_BYTES + FRAME_HEADER_BYTES. False: the
 * queue is empty. */
bool send_queue_next(struct send_queue *queue, uint8_t *out, struct send_queue_piece *piece);

#endif
