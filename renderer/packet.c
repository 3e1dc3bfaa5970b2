/* SPDX-License-Identifier: MIT */
/* Packets between front and worker: two lengths, JSON, payload. */
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "worker.h"

enum {
    HEAD_BYTES = 8,
    JSON_MAX = 4 * LIMIT_DOCUMENT_BYTES,     /* a document, printed anew, in its envelope */
    PAYLOAD_MAX = LIMIT_IMAGE_BYTES + 65536, /* a picture, in a ZIP */
    READER_KEEPS = 1 << 20,                  /* capacity kept between packets */
};

void packet_finish(struct packet *packet)
{
    cJSON_Delete(packet->json);
    free(packet->payload);
    *packet = (struct packet){0};
}

uint8_t *packet_pack(const cJSON *json, const void *payload, size_t payload_length,
                     size_t *out_length)
{
    char *text = json_print(json, false);
    const uint32_t lengths[2] = {(uint32_t)strlen(text), (uint32_t)payload_length};
    uint8_t *bytes = memory_alloc(HEAD_BYTES + lengths[0] + payload_length, 1);

    memcpy(bytes, lengths, HEAD_BYTES);
    memcpy(bytes + HEAD_BYTES, text, lengths[0]);
    if (payload_length > 0) {
        memcpy(bytes + HEAD_BYTES + lengths[0], payload, payload_length);
    }
    free(text);
    *out_length = HEAD_BYTES + lengths[0] + payload_length;
    return bytes;
}

void packet_reader_finish(struct packet_reader *reader)
{
    free(reader->bytes);
    *reader = (struct packet_reader){0};
}

void packet_reader_add(struct packet_reader *reader, const void *bytes, size_t length)
{
    if (reader->length + length > reader->capacity) {
        size_t capacity = reader->capacity ? reader->capacity : 4096;
        while (capacity < reader->length + length) {
            capacity *= 2;
        }
        reader->bytes = memory_resize(reader->bytes, capacity, 1);
        reader->capacity = capacity;
    }
    memcpy(reader->bytes + reader->length, bytes, length);
    reader->length += length;
}

static void take(struct packet_reader *reader, size_t length)
{
    reader->length -= length;
    memmove(reader->bytes, reader->bytes + length, reader->length);
    if (reader->length == 0 && reader->capacity > READER_KEEPS) {
        packet_reader_finish(reader);
    }
}

int packet_reader_next(struct packet_reader *reader, struct packet *out)
{
    uint32_t lengths[2];
    struct packet packet = {0};
    size_t whole;

    if (reader->length < HEAD_BYTES) {
        return 0;
    }
    memcpy(lengths, reader->bytes, HEAD_BYTES);
    if (lengths[0] > JSON_MAX || lengths[1] > PAYLOAD_MAX) {
        return -1;
    }
    whole = HEAD_BYTES + (size_t)lengths[0] + lengths[1];
    if (reader->length < whole) {
        return 0;
    }
    /* Both ends are ours, so the strict reading of strangers' JSON is left out. */
    packet.json =
        cJSON_ParseWithLength((const char *)reader->bytes + HEAD_BYTES, (size_t)lengths[0]);
    if (!cJSON_IsObject(packet.json)) {
        cJSON_Delete(packet.json);
        return -1;
    }
    if (lengths[1] > 0) {
        packet.payload = memory_alloc(lengths[1], 1);
        memcpy(packet.payload, reader->bytes + HEAD_BYTES + lengths[0], lengths[1]);
        packet.payload_length = lengths[1];
    }
    take(reader, whole);
    *out = packet;
    return 1;
}
