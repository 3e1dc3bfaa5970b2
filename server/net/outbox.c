/* SPDX-License-Identifier: MIT */
#include "outbox.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct outbox_text {
    struct outbox_text *next;
    struct blob *text;
};

struct blob *blob_create(const void *bytes, size_t length)
{
    struct blob *blob = memory_alloc(1, sizeof(*blob) + length);

    atomic_init(&blob->references, 1);
    blob->length = length;
    memcpy(blob->bytes, bytes, length);
    return blob;
}

struct blob *blob_ref(struct blob *blob)
{
    atomic_fetch_add(&blob->references, 1);
    return blob;
}

void blob_unref(struct blob *blob)
{
    if (blob && atomic_fetch_sub(&blob->references, 1) == 1) {
        free(blob);
    }
}

static void frame_clear(struct outbox_frame *frame)
{
    blob_unref(frame->payload);
    memset(frame, 0, sizeof(*frame));
}

static void text_remove(struct outbox *outbox)
{
    struct outbox_text *text = outbox->first;

    outbox->text_bytes -= text->text->length;
    outbox->text_offset = 0;
    outbox->first = text->next;
    if (!outbox->first) {
        outbox->end = &outbox->first;
    }
    blob_unref(text->text);
    free(text);
}

void outbox_init(struct outbox *outbox)
{
    memset(outbox, 0, sizeof(*outbox));
    outbox->end = &outbox->first;
}

void outbox_finish(struct outbox *outbox)
{
    while (outbox->first) {
        text_remove(outbox);
    }
    frame_clear(&outbox->current);
    frame_clear(&outbox->next);
}

bool outbox_text(struct outbox *outbox, struct blob *text)
{
    if (outbox->first && outbox->text_bytes - outbox->first->text->length > OUTBOX_TEXT_BYTES) {
        return false;
    }
    struct outbox_text *entry = memory_alloc(1, sizeof(*entry));
    entry->text = blob_ref(text);
    *outbox->end = entry;
    outbox->end = &entry->next;
    outbox->text_bytes += text->length;
    return true;
}

void outbox_skip(struct outbox *outbox)
{
    outbox->linked = false;
}

bool outbox_wants_key(const struct outbox *outbox)
{
    return !outbox->linked;
}

uint32_t outbox_frame(struct outbox *outbox, const struct frame_header *header,
                      struct blob *payload)
{
    struct outbox_frame *slot = &outbox->current;
    const bool key = header->flags & FRAME_KEY;

    /* A begun moving frame is finished: on a slow line nothing would ever arrive otherwise. */
    if (slot->payload && slot->begun && slot->precious) {
        slot = &outbox->next;
    }
    outbox->linked = key || (outbox->linked && !slot->payload);
    if (!outbox->linked) {
        return header->number;
    }
    uint32_t given_up = slot->payload ? slot->number : 0;
    frame_clear(slot);
    frame_header_pack(header, slot->header);
    slot->payload = blob_ref(payload);
    slot->number = header->number;
    slot->precious = !(header->flags & FRAME_STILL);
    return given_up;
}

bool outbox_is_empty(const struct outbox *outbox)
{
    return !outbox->first && !outbox->current.payload;
}

bool outbox_has_frame(const struct outbox *outbox, bool *out_precious)
{
    *out_precious = outbox->current.payload && outbox->current.precious;
    return outbox->current.payload;
}

static void next_text(struct outbox *outbox, uint8_t *out, struct outbox_piece *piece)
{
    const struct blob *text = outbox->first->text;
    size_t left = text->length - outbox->text_offset;
    size_t length = left < OUTBOX_PART_BYTES ? left : OUTBOX_PART_BYTES;

    memcpy(out, text->bytes + outbox->text_offset, length);
    *piece = (struct outbox_piece){.kind = OUTBOX_TEXT,
                                   .first = outbox->text_offset == 0,
                                   .last = length == left,
                                   .length = length};
    outbox->text_offset += length;
    if (piece->last) {
        text_remove(outbox);
    }
}

static void next_frame_part(struct outbox *outbox, uint8_t *out, struct outbox_piece *piece)
{
    struct outbox_frame *frame = &outbox->current;
    size_t head = frame->begun ? FRAME_PART_HEADER_BYTES : FRAME_HEADER_BYTES;
    size_t left = frame->payload->length - frame->sent;
    size_t length = left < OUTBOX_PART_BYTES ? left : OUTBOX_PART_BYTES;

    if (frame->begun) {
        frame_part_pack(frame->number, out);
    } else {
        memcpy(out, frame->header, head);
    }
    memcpy(out + head, frame->payload->bytes + frame->sent, length);
    *piece = (struct outbox_piece){
        .kind = OUTBOX_BINARY, .first = true, .last = true, .length = head + length};
    frame->begun = true;
    frame->sent += length;
    if (length == left) {
        piece->frame_done = frame->number;
        piece->frame_bytes = frame->payload->length;
        frame_clear(frame);
        outbox->current = outbox->next;
        memset(&outbox->next, 0, sizeof(outbox->next));
    }
}

bool outbox_next(struct outbox *outbox, uint8_t *out, struct outbox_piece *piece)
{
    if (outbox->first) {
        next_text(outbox, out, piece);
    } else if (outbox->current.payload) {
        next_frame_part(outbox, out, piece);
    } else {
        return false;
    }
    return true;
}
