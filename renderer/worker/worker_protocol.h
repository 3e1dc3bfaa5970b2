/* SPDX-License-Identifier: MIT */
/* The protocol between front and worker. Each direction has an enum of packets, a struct for the
 * members of each packet, and a table (worker_protocol.c) by which they are packed and unpacked.
 * Both ends are the same program.
 *
 * A packet is: u32 kind, u32 json_length, u32 payload_length (native byte order, same machine), the
 * JSON object, the payload (a file, a document, or an encoded picture). Bytes go through the socket
 * instead of shared memory. A copy of 200 kB costs tens of microseconds, and a worker that is
 * killed leaves nothing behind.
 *
 * Packets of a scene are handled in order, after its document has been read. Another thread reads a
 * large document. After a structural edit of a large scene it also compiles the field. Packets of
 * other scenes do not wait for that.
 *
 * The worker reports the subject of each dangerous step before it begins, and an empty one
 * afterwards. These steps are: compilation of users' code, reading the picture of an environment or
 * a large document, and drawing. The worker waits until the front has received the report. When a
 * worker ends, the front therefore knows the code, file or document that was at work. A compiler
 * that may never end (limits.h) ends the worker, and so does a picture that takes too long to read.
 * The worker reports this first (`slow`). The front sends its verdict on such a structure or file
 * to the next worker (`judge`).
 *
 * A request in rounds is answered by a frame for each round of samples. `more` is false in the last
 * one. A request for an unknown scene, or a malformed packet, is answered by `failed`.
 *
 * A second socketpair carries ping and pong. A thread that does not draw answers (pulse.h). A pong
 * describes the drawing thread, and only this description counts. The drawing thread hangs if
 * `steps` does not increase and `idle` is false. */
#ifndef RENDERER_WORKER_PROTOCOL_H
#define RENDERER_WORKER_PROTOCOL_H

#include <cjson/cJSON.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/error.h"
#include "protocol/render_request.h"
#include "renderer/renderer.h"

enum packet_way { PACKET_TO_WORKER, PACKET_TO_FRONT };

enum packet_to_worker {
    TO_WORKER_ASSET, /* the payload is a file; before a scene names it */
    TO_WORKER_SCENE, /* the payload is its document */
    TO_WORKER_EDIT,
    TO_WORKER_DROP, /* the scene */
    TO_WORKER_JUDGE,
    TO_WORKER_PACE,
    TO_WORKER_RENDER,
    TO_WORKER_CANCEL,
    TO_WORKER_STOP,
    TO_WORKER_PING,
    TO_WORKER_COUNT
};

enum packet_to_front {
    TO_FRONT_READY,
    TO_FRONT_SHOWN,  /* the revision can be drawn */
    TO_FRONT_BROKEN, /* it cannot */
    TO_FRONT_WARNED,
    TO_FRONT_COMPILING, /* from here on this is compiled, read (a file, a document), drawn */
    TO_FRONT_READING,
    TO_FRONT_OPENING,
    TO_FRONT_DRAWING,
    TO_FRONT_SLOW,
    TO_FRONT_FRAME, /* the payload is the picture */
    TO_FRONT_PROGRESS,
    TO_FRONT_FAILED,
    TO_FRONT_PONG,
    TO_FRONT_COUNT
};

/* --- members; pointers are borrowed, in a packet that was read from it --- */

struct packet_asset {
    const char *asset; /* its id */
};

struct packet_scene {
    const char *scene;
    uint64_t revision;
    bool portrait; /* only its nodes count: portrait.h does the rest */
};

struct packet_edit {
    const char *scene;
    uint64_t revision;
    cJSON *ops;
};

/* Of a structure or a file: how many times the usual time it may take, or that it is refused. */
struct packet_judge {
    uint64_t structure_hash; /* 0: of a file */
    const char *asset;
    enum error_kind refused;
    int measured_ms, limit_ms, times;
};

struct packet_pace {
    double pace; /* how slow this machine compiles, as measured so far */
};

/* The account that has as much as all others together. No scene or session can have this name. */
#define ACCOUNT_NEWCOMERS "*newcomers"

/* Pictures run tile by tile. Accounts take turns by drawing time (turns.h); of one account the
 * lowest priority number goes first, so a viewer's frame interrupts a long picture. */
struct packet_render {
    uint32_t job;
    const char *scene, *account;
    int priority, patience;
    bool careful;
    const struct render_request *request;
};

struct packet_job {
    uint32_t job;
};

struct packet_ready {
    const char *name, *version, *device; /* struct renderer_info */
    bool software;
    uint32_t stage;    /* enum render_stage */
    bool files, calls; /* struct confinement */
    const char *why;
};

struct packet_state {
    const char *scene;
    uint64_t revision;
    enum warning_kind warning; /* of `warned` */
    struct error error;        /* of `broken` and `warned` */
    uint64_t structure_hash;   /* that is refused; 0: none */
};

/* What may end the worker. scene "": nothing any more. */
struct packet_suspect {
    const char *scene;
    uint64_t revision;
    uint64_t structure_hash; /* 0: it is a file, or is drawn */
    const char *asset;       /* "": it is none */
    uint32_t job;
    bool still;
    int measured_ms, limit_ms; /* of `slow` */
};

struct packet_frame {
    uint32_t job;
    uint64_t revision;
    bool newest; /* the picture is no older than the scene */
    bool more;   /* another round comes */
    struct picture_rounds rounds;
    int width, height;
    enum codec codec;
    bool key;             /* it decodes without earlier ones */
    uint32_t whole_bytes; /* of the payload, the last ones: the file of the whole picture */
    double drawn_part;    /* job_drawn_part() */
    struct job_times times;
};

struct packet_failed {
    uint32_t job;
    bool begun; /* some of it was drawn */
    struct error error;
};

struct packet_ping {
    int64_t ping;
};

struct packet_pong {
    int64_t ping;
    uint64_t steps;
    bool idle;
    struct renderer_counters counters;
    uint64_t resident_bytes;
    double pace;
};

/* --- packets --- */

struct packet {
    int kind; /* enum packet_to_worker or enum packet_to_front */
    union {
        struct packet_asset asset;
        struct packet_scene scene;
        struct packet_edit edit;
        struct packet_state state; /* shown, broken, warned; of `drop` the scene alone */
        struct packet_judge judge;
        struct packet_pace pace;
        struct packet_render render;
        struct packet_job job; /* cancel, progress */
        struct packet_ready ready;
        struct packet_suspect suspect; /* compiling, reading, opening, drawing, slow */
        struct packet_frame frame;
        struct packet_failed failed;
        struct packet_ping ping;
        struct packet_pong pong;
    };
    uint8_t *payload;
    size_t payload_length;
    /* Of one that was read: */
    size_t length;          /* of all its bytes */
    struct error malformed; /* a member is not what it has to be */
    cJSON *json;
    struct render_request *request;
};

/* Of a packet that was read. */
void packet_finish(struct packet *packet);
/* Bytes of a packet, ready to send; caller frees. Where `payload` is NULL, the bytes of its length
 * are to follow them. */
uint8_t *packet_pack(enum packet_way way, const struct packet *packet, size_t *out_length);
/* The object of its members. Caller frees. */
cJSON *packet_print(enum packet_way way, const struct packet *packet);
/* Fills the members from `packet->json`. False: there is no such kind. */
bool packet_unpack(enum packet_way way, struct packet *packet);
bool packet_has_payload(enum packet_way way, int kind);

/* Collects bytes from a stream and gives out whole packets. */
struct packet_reader {
    uint8_t *bytes;
    size_t length, capacity;
};
void packet_reader_finish(struct packet_reader *reader);
void packet_reader_add(struct packet_reader *reader, const void *bytes, size_t length);
/* 1: `*out` holds a packet. 0: more bytes needed. -1: the stream is broken. */
int packet_reader_next(struct packet_reader *reader, enum packet_way way, struct packet *out);

#endif
