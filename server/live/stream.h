/* SPDX-License-Identifier: MIT */
/* When a session gets a picture, and how good a one. One picture of a session is asked of the
 * worker at a time, always of the newest view; at most LIMIT_FRAMES_IN_FLIGHT are on their way
 * without an acknowledgement, one until the first comes.
 *
 *   changed --> moving pictures, scaled so that each takes about 50 ms
 *           --100 ms rest--> one larger, where full size takes long, then one still in full size
 *           --300 ms rest--> one lossless, shown after 4 and 16 samples too --> nothing
 *
 * Every function is called under the hub's lock. */
#ifndef SERVER_STREAM_H
#define SERVER_STREAM_H

#include <stdbool.h>
#include <stdint.h>

#include <cjson/cJSON.h>

#include "protocol/limits.h"
#include "protocol/render_request.h"

struct session;

enum stream_stage { STREAM_NOTHING, STREAM_MOVING, STREAM_LARGER, STREAM_STILL, STREAM_LOSSLESS };
enum stream_preference { PREFER_AUTO, PREFER_SMOOTH, PREFER_SHARP };

enum {
    STREAM_STILL_MS = 100,
    STREAM_LOSSLESS_MS = 300,
    STREAM_LARGER_MS = 300, /* what the larger picture in between may take */
    STREAM_STALL_MS = 2000, /* without an acknowledgement for so long nothing is rendered */
    STREAM_VIEWS = 8,       /* older views that a pick may mean */
};

struct stream_view {
    uint32_t seq;                  /* `picture.values` NULL: there was none yet */
    struct render_request picture; /* the whole view: its size, camera, output, what it isolates */
    enum stream_preference preference;
    bool visible;
};

struct stream {
    struct stream_view views[STREAM_VIEWS]; /* ring, the newest at `newest` */
    int newest;
    bool has_view;

    int64_t changed_at;     /* clock_ms of the last change that shows */
    enum stream_stage done; /* best picture asked for since then */
    bool stale;             /* the newest picture is older than the document */
    uint64_t revision;      /* of the newest picture */

    uint32_t job; /* asked of the worker; 0: none */
    enum stream_stage job_stage;
    int64_t job_asked_us;
    uint32_t job_seq;
    int job_view_width, job_view_height;
    int64_t job_pixels;

    uint32_t last_number;
    bool reads; /* has acknowledged a frame */
    struct {
        uint32_t number; /* 0: free */
        int64_t sent_ms;
    } flight[LIMIT_FRAMES_IN_FLIGHT];

    int step;            /* index into the scales */
    double ns_per_pixel; /* running mean over moving pictures; 0: none yet */
};

void stream_init(struct stream *stream);
void stream_finish(struct session *session);
/* No picture is wanted any more, for now. */
void stream_stop(struct session *session);
/* The checked `view` message. False and `err`: the camera is wrong. */
bool stream_set_view(struct session *session, const cJSON *message, struct error *err);
/* The view that a pick means, or the newest; NULL: none yet. */
const struct stream_view *stream_find_view(const struct stream *stream, uint32_t seq);
void stream_acknowledge(struct session *session, uint32_t number);
/* The document or the view changed. */
void stream_changed(struct session *session);
/* The worker can draw a newer revision than before. */
void stream_shown(struct session *session);
/* Somebody waits for a picture, or for a better one. */
bool stream_is_waiting(const struct stream *stream);
/* Asks for a picture if one is due; returns when to look again, clock_ms or 0. */
int64_t stream_pump(struct session *session, int64_t now_ms);

#endif
