/* SPDX-License-Identifier: MIT */
#include "send_queue.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/memory.h"

struct send_queue_text {
    struct send_queue_text *next;
    struct shared_buffer *text;
    size_t counted; /* bytes */
};

static void frame_clear(struct send_queue_frame *frame)
{
    shared_buffer_unref(frame->payload);
    memset(frame, 0, sizeof *frame);
}

static void text_remove(struct send_queue *queue)
{
    struct send_queue_text *text = queue->first;

    queue->text_bytes -= text->counted;
    queue->text_offset = 0;
    queue->first = text->next;
    if (!queue->first) {
        queue->end = &queue->first;
    }
    shared_buffer_unref(text->text);
    free(text);
}

void send_queue_init(struct send_queue *queue)
{
    memset(queue, 0, sizeof *queue);
    queue->end = &queue->first;
}

void send_queue_finish(struct send_queue *queue)
{
    while (queue->first) {
        text_remove(queue);
    }
    frame_clear(&queue->current);
    frame_clear(&queue->next);
    shared_buffer_unref(queue->behind);
}

static void add_text(struct send_queue *queue, struct shared_buffer *text, size_t counted)
{
    struct send_queue_text *entry = memory_alloc(1, sizeof *entry);

    entry->text = shared_buffer_ref(text);
    entry->counted = counted;
    *queue->end = entry;
    queue->end = &entry->next;
    queue->text_bytes += counted;
}

bool send_queue_text(struct send_queue *queue, struct shared_buffer *text)
{
    if (queue->first && queue->text_bytes - queue->first->counted > SEND_QUEUE_TEXT_BYTES) {
        return false;
    }
    add_text(queue, text, text->length);
    return true;
}

void send_queue_greeting(struct send_queue *queue, struct shared_buffer *text)
{
    add_text(queue, text, 0);
}

static uint8_t bit_of(uint8_t chain)
{
    return (uint8_t)(1U << chain);
}

void send_queue_skip(struct send_queue *queue, uint8_t chain)
{
    queue->linked &= (uint8_t)~bit_of(chain);
}

bool send_queue_wants_key(const struct send_queue *queue, uint8_t chain)
{
    return !(queue->linked & bit_of(chain));
}

uint32_t send_queue_frame(struct send_queue *queue, const struct frame_header *header,
                          struct shared_buffer *payload)
{
    struct send_queue_frame *slot = &queue->current;
    const bool key = header->flags & FRAME_KEY;

    /* A begun moving frame is finished: on a slow line nothing would ever arrive otherwise. */
    if (slot->payload && slot->begun && slot->precious) {
        slot = &queue->next;
    }
    if (!key && (send_queue_wants_key(queue, header->chain) ||
                 (slot->payload && slot->chain == header->chain))) {
        send_queue_skip(queue, header->chain);
        return header->number;
    }
    if (slot->payload) {
        send_queue_skip(queue, slot->chain);
    }
    queue->linked |= bit_of(header->chain);
    const uint32_t given_up = slot->payload ? slot->number : 0;
    frame_clear(slot);
    frame_header_pack(header, slot->header);
    slot->payload = shared_buffer_ref(payload);
    slot->number = header->number;
    slot->chain = header->chain;
    slot->precious = !(header->flags & FRAME_STILL);
    return given_up;
}

void send_queue_behind(struct send_queue *queue, struct shared_buffer *message)
{
    shared_buffer_unref(queue->behind);
    queue->behind = shared_buffer_ref(message);
    queue->behind_sent = 0;
}

bool send_queue_is_empty(const struct send_queue *queue)
{
    return !queue->first && !queue->current.payload && !queue->behind;
}

bool send_queue_has_frame(const struct send_queue *queue, bool *out_precious)
{
    *out_precious = queue->current.payload && queue->current.precious;
    return queue->current.payload;
}

static void next_text(struct send_queue *queue, uint8_t *out, struct send_queue_piece *piece)
{
    const struct shared_buffer *text = queue->first->text;
    const size_t left = text->length - queue->text_offset;
    size_t length = left < SEND_QUEUE_PART_BYTES ? left : SEND_QUEUE_PART_BYTES;

    memcpy(out, text->bytes + queue->text_offset, length);
    *piece = (struct send_queue_piece){.kind = SEND_QUEUE_TEXT,
                                       .first = queue->text_offset == 0,
                                       .last = length == left,
                                       .length = length};
    queue->text_offset += length;
    if (piece->last) {
        text_remove(queue);
    }
}

static void next_frame_part(struct send_queue *queue, uint8_t *out, struct send_queue_piece *piece)
{
    struct send_queue_frame *frame = &queue->current;
    const size_t head = frame->begun ? FRAME_PART_HEADER_BYTES : FRAME_HEADER_BYTES;
    const size_t left = frame->payload->length - frame->sent;
    size_t length = left < SEND_QUEUE_PART_BYTES ? left : SEND_QUEUE_PART_BYTES;

    if (frame->begun) {
        frame_part_pack(frame->number, out);
    } else {
        memcpy(out, frame->header, head);
    }
    memcpy(out + head, frame->payload->bytes + frame->sent, length);
    *piece = (struct send_queue_piece){
        .kind = SEND_QUEUE_BINARY, .first = true, .last = true, .length = head + length};
    frame->begun = true;
    frame->sent += length;
    if (length == left) {
        piece->frame_done = frame->number;
        piece->frame_bytes = frame->payload->length;
        frame_clear(frame);
        queue->current = queue->next;
        memset(&queue->next, 0, sizeof queue->next);
    }
}

static void next_behind(struct send_queue *queue, uint8_t *out, struct send_queue_piece *piece)
{
    const struct shared_buffer *message = queue->behind;
    const size_t left = message->length - queue->behind_sent;
    const size_t length = left < SEND_QUEUE_PART_BYTES ? left : SEND_QUEUE_PART_BYTES;

    memcpy(out, message->bytes + queue->behind_sent, length);
    *piece = (struct send_queue_piece){.kind = SEND_QUEUE_BINARY,
                                       .first = queue->behind_sent == 0,
                                       .last = length == left,
                                       .length = length};
    queue->behind_sent += length;
    if (piece->last) {
        shared_buffer_unref(queue->behind);
        queue->behind = NULL;
        queue->behind_sent = 0;
    }
}

bool send_queue_next(struct send_queue *queue, uint8_t *out, struct send_queue_piece *piece)
{
    const bool begun = queue->behind_sent > 0;

    if (queue->first && !begun) {
        next_text(queue, out, piece);
    } else if (queue->current.payload && !begun) {
        next_frame_part(queue, out, piece);
    } else if (queue->behind) {
        next_behind(queue, out, piece);
    } else {
        return false;
    }
    return true;
}
