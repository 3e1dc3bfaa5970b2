/* SPDX-License-Identifier: MIT */
/* The render process and how the front speaks with it, over one Unix socketpair.
 *
 * A packet is: u32 json_length, u32 payload_length (native byte order, same machine), the JSON
 * object, the payload (encoded picture). Bytes go through the socket rather than through shared
 * memory: a copy of 200 kB costs tens of microseconds, and nothing is left behind when a worker is
 * killed in the middle.
 *
 * front -> worker                                     worker -> front
 *   asset  {asset} + payload, before a scene names it
 *   scene  {scene, revision, document}                  ready    {renderer{...}, confined{...}}
 *   edit   {scene, revision, ops}                       shown    {scene, revision}  (compiled)
 *   drop   {scene}                                      broken   {scene, revision, ERROR}
 *   judge  {shapes: [{shape | asset, code?, measured?,  warned   {scene, revision, ERROR}
 *           limit?, times}], pace?}                     slow     {scene, revision, shape | asset,
 *                                                                 still, measured, limit}
 *   render {job, scene, priority, width, height,        frame    {job, revision, newest, more,
 *           camera?, region? [x, y, width, height],               round, rounds, width, height,
 *           aov, level?, samples, transparent?,                   mime, STAGE_us...} + payload
 *           format, quality, chroma_halved, fast,       progress {job}  (now and then)
 *           zipped, exact, in_rounds, careful,          failed   {job, ERROR, begun?}
 *           patience, isolate? [node, ...]}
 *   cancel {job}
 *   stop   {}                                           compiling, drawing {scene, revision,
 *                                                                 shape}
 *                                                       reading  {scene, revision, asset}
 *
 * A second socketpair carries ping {ping} and pong {ping, steps, idle, compilations, cache_hits,
 * tiles, pictures, resident_bytes, pace}. A thread that does not draw answers there (pulse.h). What
 * it says of the drawing thread is what counts: one that neither goes on (`steps`) nor has nothing
 * to do (`idle`) hangs, however fast the pongs come.
 *
 * ERROR is code, place, message, line and column where there are any, measured and limit of what
 * was too slow, and the shape of what is refused. STAGE is each of the
 * stages of protocol/picture.h. Several outputs (aov: names with commas) come as one ZIP.
 *
 * Before code of users is compiled, the picture of an environment read, or any scene drawn, the
 * worker names it, and an empty one afterwards; it waits until the front has that. So it is known
 * whose code or file ended it. A compiler that may never end (limits.h) ends the worker, which says
 * so first (`slow`), as does reading that takes too long. The front tells the next worker what to
 * make of such a shape or file (`judge`): it may take so many times the usual time, or it is
 * refused (`code`). `pace`: how slow this machine compiles, as measured so far.
 *
 * A render `in_rounds` is answered by a frame for each round of samples; the last one's `more` is
 * false. A render of a scene that is not known, or a malformed packet, is answered by `failed`.
 * `newest` is false where the picture is older than the scene because its shader still compiles.
 * `confined` is struct confinement.
 * Jobs run tile by tile. Scenes take turns by drawing time (turns.h); in one scene the lowest
 * priority number goes first, so a viewer's frame interrupts a long picture between two tiles. */
#ifndef RENDERER_WORKER_H
#define RENDERER_WORKER_H

#include <cjson/cJSON.h>
#include <stdint.h>

#include "confine.h"
#include "renderer.h"
#include "vigil.h"

enum { WORKER_FD = 3, WORKER_PULSE_FD = 4 }; /* where the front leaves its child's sockets */

struct worker_params {
    struct renderer_params renderer;
    int pulse_fd;              /* for pings; -1: there are none */
    size_t memory_limit_bytes; /* RLIMIT_AS above what the driver needs; 0: none */
    enum confine_mode confine;
};

/* The whole life of the render process; returns its exit status. */
int worker_run(int fd, const struct worker_params *params);

/* Loads the driver in a process of its own, confined as the render process is. False: it cannot
 * draw there, and `err` says why. Before any other thread runs. */
bool worker_try(const struct worker_params *params, struct confinement *out, struct error *err);

/* --- packets, used by both ends --- */

struct packet {
    cJSON *json;
    uint8_t *payload;
    size_t payload_length;
};
void packet_finish(struct packet *packet);
/* Bytes of a packet, ready to send; caller frees. `payload` may be NULL. */
uint8_t *packet_pack(const cJSON *json, const void *payload, size_t payload_length,
                     size_t *out_length);
/* Collects bytes from a stream and gives out whole packets. */
struct packet_reader {
    uint8_t *bytes;
    size_t length, capacity;
};
void packet_reader_finish(struct packet_reader *reader);
void packet_reader_add(struct packet_reader *reader, const void *bytes, size_t length);
/* 1: `*out` holds a packet. 0: more bytes needed. -1: the stream is broken. */
int packet_reader_next(struct packet_reader *reader, struct packet *out);

#endif
