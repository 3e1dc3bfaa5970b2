/* SPDX-License-Identifier: MIT */
/* What client and server say on a live connection: a table of client messages, checked the same
 * way as documents, and the binary header of a frame. The wire form is in README.md. */
#ifndef PROTOCOL_MESSAGES_H
#define PROTOCOL_MESSAGES_H

#include <stdint.h>

#include "codec.h"
#include "limits.h"
#include "picture.h"
#include "render_request.h"

enum message_kind {
    MESSAGE_HELLO,
    MESSAGE_VIEW,
    MESSAGE_EDIT,
    MESSAGE_UNDO,
    MESSAGE_REDO,
    MESSAGE_PICK,
    MESSAGE_BOUNDS,
    MESSAGE_ACK,
    MESSAGE_RETRY,
    MESSAGE_THUMBNAILS,
    MESSAGE_ACK_THUMBNAILS,
    MESSAGE_COUNT
};

enum { MESSAGE_KEY_CHARACTERS = 32 }; /* of a client: 128 random bits */

struct message {
    enum message_kind kind;
    cJSON *json; /* the whole object, checked: members known, types and ranges right */
    bool plain;  /* MESSAGE_EDIT: its operations hold no code */
    /* Its records and lists of ids: */
    struct render_request view;            /* MESSAGE_VIEW: camera, section and isolate alone */
    struct id_set nodes, large, materials; /* MESSAGE_THUMBNAILS; MESSAGE_BOUNDS: nodes */
};

/* Reads one client message; pre-scan included. On success the caller calls message_finish. */
bool message_read(const char *text, size_t length, struct message *out, struct error *err);
void message_finish(struct message *message);
const char *message_name(enum message_kind kind);
/* Descriptions of all messages, both directions, for the schema. */
cJSON *messages_describe(void);

/* Members of a checked object; the fallback where absent. */
double json_member_number(const cJSON *object, const char *name, double fallback);
const char *json_member_text(const cJSON *object, const char *name, const char *fallback);
bool json_member_bool(const cJSON *object, const char *name, bool fallback);

/* --- frames --- */

enum { FRAME_HEADER_BYTES = 40 + 4 * FRAME_STAGES, FRAME_PART_HEADER_BYTES = 8 };

enum frame_flag {
    FRAME_KEY = 1,      /* decodes without earlier frames */
    FRAME_STILL = 2,    /* full resolution, the view rests */
    FRAME_LOSSLESS = 4, /* these are the pixels of image.png at this revision and view */
    FRAME_STALE = 8,    /* the scene is already newer than the picture: its shader compiles */
    FRAME_DEPTHS = 16,  /* depths of its blocks follow the picture */
    FRAME_DELTA = 32,   /* it is what differs from the last picture of its chain */
};

struct frame_header {
    enum codec codec;
    uint8_t flags;
    uint32_t number;        /* 1, 2, 3... on this connection */
    uint32_t payload_bytes; /* of the whole frame, over all its parts */
    uint64_t revision;
    uint32_t input;                   /* `seq` of the newest view message that the picture shows */
    uint16_t width, height;           /* of the picture */
    uint16_t view_width, view_height; /* of the view that it fills */
    uint8_t round, rounds;            /* which of how many rounds of samples it is, from 1 */
    uint8_t chain;                    /* a delta is of the last picture of its chain; 0: of none */
    uint8_t link;                     /* counts the deltas since the chain's last key, modulo 256 */
    uint32_t stage_us[FRAME_STAGES];
};

void frame_header_pack(const struct frame_header *header, uint8_t out[FRAME_HEADER_BYTES]);
bool frame_header_unpack(const uint8_t *bytes, size_t length, struct frame_header *out);
void frame_part_pack(uint32_t number, uint8_t out[FRAME_PART_HEADER_BYTES]);

/* --- thumbnails --- */

enum {
    THUMBNAIL_WIDTH = 96,
    THUMBNAIL_LEAST = 12, /* width of the smallest */
    THUMBNAIL_LARGEST = 8 * LIMIT_THUMBNAIL_WIDTH / 3,
    THUMBNAIL_HEADER_BYTES = 24,
    THUMBNAIL_ROW_BYTES = 12
};

enum thumbnail_kind { THUMBNAIL_NODE, THUMBNAIL_MATERIAL };

struct thumbnail_header {
    uint16_t count;    /* rows that follow, each with its id and its picture behind it */
    uint32_t number;   /* 1, 2, 3... on this connection */
    uint64_t revision; /* of the scene whose parts look so */
};

struct thumbnail_row {
    enum thumbnail_kind kind;
    size_t id_bytes;
    int width, height;
    size_t bytes; /* of the PNG; 0: it cannot be drawn */
};

/* The height of a thumbnail. */
int thumbnail_height(int width);
void thumbnail_header_pack(const struct thumbnail_header *header,
                           uint8_t out[THUMBNAIL_HEADER_BYTES]);
void thumbnail_row_pack(const struct thumbnail_row *row, uint8_t out[THUMBNAIL_ROW_BYTES]);

#endif
