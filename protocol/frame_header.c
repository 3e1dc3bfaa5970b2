/* SPDX-License-Identifier: MIT */
/* The binary headers of frames and thumbnails; their bytes are listed in README.md. */
#include <string.h>

#include "messages.h"

enum { VERSION = 3, THUMBNAIL_VERSION = 1 };

static void put(uint8_t **at, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        *(*at)++ = (uint8_t)(value >> 8 * i);
    }
}

static uint64_t take(const uint8_t **at, int bytes)
{
    uint64_t value = 0;

    for (int i = 0; i < bytes; i++) {
        value |= (uint64_t) * (*at)++ << 8 * i;
    }
    return value;
}

void frame_header_pack(const struct frame_header *header, uint8_t out[FRAME_HEADER_BYTES])
{
    const uint16_t sides[] = {header->width, header->height, header->view_width,
                              header->view_height};
    uint8_t *at = out + 4;

    memcpy(out, "FCF1", 4);
    put(&at, VERSION, 1);
    put(&at, header->codec, 1);
    put(&at, header->flags, 1);
    put(&at, FRAME_STAGES, 1);
    put(&at, header->number, 4);
    put(&at, header->payload_bytes, 4);
    put(&at, header->revision, 8);
    put(&at, header->input, 4);
    for (int i = 0; i < 4; i++) {
        put(&at, sides[i], 2);
    }
    put(&at, header->round, 1);
    put(&at, header->rounds, 1);
    put(&at, header->chain, 1);
    put(&at, header->link, 1);
    for (int i = 0; i < FRAME_STAGES; i++) {
        put(&at, header->stage_us[i], 4);
    }
}

bool frame_header_unpack(const uint8_t *bytes, size_t length, struct frame_header *out)
{
    if (length < FRAME_HEADER_BYTES || memcmp(bytes, "FCF1", 4) != 0 || bytes[4] != VERSION ||
        bytes[7] != FRAME_STAGES) {
        return false;
    }
    struct frame_header header;
    uint16_t *const sides[] = {&header.width, &header.height, &header.view_width,
                               &header.view_height};
    const uint8_t *at = bytes + 5;
    header.codec = (uint8_t)take(&at, 1);
    header.flags = (uint8_t)take(&at, 1);
    take(&at, 1);
    header.number = (uint32_t)take(&at, 4);
    header.payload_bytes = (uint32_t)take(&at, 4);
    header.revision = take(&at, 8);
    header.input = (uint32_t)take(&at, 4);
    for (int i = 0; i < 4; i++) {
        *sides[i] = (uint16_t)take(&at, 2);
    }
    header.round = (uint8_t)take(&at, 1);
    header.rounds = (uint8_t)take(&at, 1);
    header.chain = (uint8_t)take(&at, 1);
    header.link = (uint8_t)take(&at, 1);
    for (int i = 0; i < FRAME_STAGES; i++) {
        header.stage_us[i] = (uint32_t)take(&at, 4);
    }
    *out = header;
    return true;
}

void frame_part_pack(uint32_t number, uint8_t out[FRAME_PART_HEADER_BYTES])
{
    uint8_t *at = out + 4;

    memcpy(out, "FCFP", 4);
    put(&at, number, 4);
}

int thumbnail_height(int width)
{
    return (2 * width + 1) / 3;
}

void thumbnail_header_pack(const struct thumbnail_header *header,
                           uint8_t out[THUMBNAIL_HEADER_BYTES])
{
    uint8_t *at = out + 4;

    memcpy(out, "FCT1", 4);
    put(&at, THUMBNAIL_VERSION, 1);
    put(&at, CODEC_PNG, 1);
    put(&at, header->count, 2);
    put(&at, header->number, 4);
    put(&at, 0, 4);
    put(&at, header->revision, 8);
}

void thumbnail_row_pack(const struct thumbnail_row *row, uint8_t out[THUMBNAIL_ROW_BYTES])
{
    put(&out, (uint64_t)row->kind, 1);
    put(&out, row->id_bytes, 1);
    put(&out, (uint64_t)row->width, 2);
    put(&out, (uint64_t)row->height, 2);
    put(&out, 0, 2);
    put(&out, row->bytes, 4);
}
