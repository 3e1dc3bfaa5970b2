/* SPDX-License-Identifier: MIT */
/* What waits to be written to one live connection, and in which pieces: text first, frames in
 * parts between texts, at most one frame waiting behind the one being written. Pure; not
 * thread-safe.
 *
 * Frames are a stream: a key decodes alone, any other one with all frames since the last key. So
 * one that is lost takes those with it that follow until the next key, which is asked for
 * (outbox_wants_key). A key takes the place of what waits; no other frame does, since it needs
 * that. */
#ifndef SERVER_OUTBOX_H
#define SERVER_OUTBOX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/messages.h"

enum {
    OUTBOX_PART_BYTES = 65536,
    OUTBOX_TEXT_BYTES = 2097152, /* queued for one client at most, behind a first message */
};

/* Immutable bytes shared by those who send them. */
struct blob {
    _Atomic int references;
    size_t length;
    uint8_t bytes[];
};
struct blob *blob_create(const void *bytes, size_t length);
struct blob *blob_ref(struct blob *blob);
void blob_unref(struct blob *blob);

struct outbox_frame {
    struct blob *payload; /* NULL: no frame */
    uint8_t header[FRAME_HEADER_BYTES];
    uint32_t number;
    bool precious; /* a moving picture, which is finished once begun */
    size_t sent;   /* payload bytes */
    bool begun;
};

struct outbox_text;

struct outbox {
    struct outbox_text *first, **end;
    size_t text_bytes, text_offset;
    struct outbox_frame current, next;
    bool linked; /* what comes next can build on the last frame: none has been lost since a key */
};

enum outbox_kind { OUTBOX_TEXT, OUTBOX_BINARY };

/* One write: a piece of a text message or a whole binary message. */
struct outbox_piece {
    enum outbox_kind kind;
    bool first, last; /* of its WebSocket message */
    size_t length;
    uint32_t frame_done; /* number of the frame that this completes; 0: none */
    size_t frame_bytes;
};

void outbox_init(struct outbox *outbox);
void outbox_finish(struct outbox *outbox);
/* Takes a reference of its own. False: too much waits already; nothing was queued. */
bool outbox_text(struct outbox *outbox, struct blob *text);
/* Queues a frame. Returns the number of the frame that is given up: an older one, this one where it
 * cannot be decoded or would take the place of what it needs, or 0. */
uint32_t outbox_frame(struct outbox *outbox, const struct frame_header *header,
                      struct blob *payload);
/* A frame of the stream, a key or not, is not queued at all. */
void outbox_skip(struct outbox *outbox);
/* No other frame than a key would be queued. */
bool outbox_wants_key(const struct outbox *outbox);
bool outbox_is_empty(const struct outbox *outbox);
/* A frame waits to be written. `*out_precious`: it would not be given up for a newer one. */
bool outbox_has_frame(const struct outbox *outbox, bool *out_precious);
/* Copies the next piece to `out`, which holds OUTBOX_PART_BYTES + FRAME_HEADER_BYTES. False: there
 * is nothing. */
bool outbox_next(struct outbox *outbox, uint8_t *out, struct outbox_piece *piece);

#endif
