/* SPDX-License-Identifier: MIT */
/* Packets between front and worker as bytes: kind, two lengths, JSON, payload. */
#include <stdlib.h>
#include <string.h>

#include "protocol/json.h"
#include "protocol/memory.h"
#include "worker_protocol.h"

struct head {
    uint32_t kind, json_length, payload_length;
};

enum {
    JSON_MAX = 1 << 20,
    PAYLOAD_MAX = LIMIT_IMAGE_BYTES + 65536, /* a picture, in a ZIP */
    READER_KEEPS = 1 << 20,                  /* capacity kept between packets */
};

void packet_finish(struct packet *packet)
{
    if (packet->request) {
        render_request_finish(packet->request);
        free(packet->request);
    }
    cJSON_Delete(packet->json);
    free(packet->payload);
    *packet = (struct packet){0};
}

uint8_t *packet_pack(enum packet_way way, const struct packet *packet, size_t *out_length)
{
    cJSON *json = packet_print(way, packet);
    char *text = json_print(json, false);
    const struct head head = {(uint32_t)packet->kind, (uint32_t)strlen(text),
                              (uint32_t)packet->payload_length};
    const size_t with = packet->payload ? head.payload_length : 0;
    uint8_t *bytes = memory_alloc(sizeof head + head.json_length + with, 1);

    memcpy(bytes, &head, sizeof head);
    memcpy(bytes + sizeof head, text, head.json_length);
    if (with > 0) {
        memcpy(bytes + sizeof head + head.json_length, packet->payload, with);
    }
    free(text);
    cJSON_Delete(json);
    *out_length = sizeof head + head.json_length + with;
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

/* Both ends are ours, so the strict reading of strangers' JSON is left out. */
static bool read_packet(const struct head *head, const uint8_t *bytes, enum packet_way way,
                        struct packet *out)
{
    *out = (struct packet){.kind = (int)head->kind, .payload_length = head->payload_length};
    out->json = cJSON_ParseWithLength((const char *)bytes, (size_t)head->json_length);
    if (!cJSON_IsObject(out->json) || !packet_unpack(way, out) ||
        (head->payload_length > 0 && !packet_has_payload(way, out->kind))) {
        packet_finish(out);
        return false;
    }
    if (head->payload_length > 0) {
        out->payload = memory_alloc(head->payload_length, 1);
        memcpy(out->payload, bytes + head->json_length, head->payload_length);
    }
    return true;
}

/* Documents and edits go to the worker whole. */
static bool is_too_long(const struct head *head, enum packet_way way)
{
    const bool document = way == PACKET_TO_WORKER && head->kind == TO_WORKER_SCENE;
    const bool edit = way == PACKET_TO_WORKER && head->kind == TO_WORKER_EDIT;

    return (head->json_length > JSON_MAX && !edit) ||
           (head->payload_length > PAYLOAD_MAX && !document);
}

int packet_reader_next(struct packet_reader *reader, enum packet_way way, struct packet *out)
{
    struct head head;
    size_t whole;

    if (reader->length < sizeof head) {
        return 0;
    }
    memcpy(&head, reader->bytes, sizeof head);
    if (is_too_long(&head, way)) {
        return -1;
    }
    whole = sizeof head + head.json_length + head.payload_length;
    if (reader->length < whole) {
        return 0;
    }
    if (!read_packet(&head, reader->bytes + sizeof head, way, out)) {
        return -1;
    }
    out->length = whole;
    take(reader, whole);
    return 1;
}
