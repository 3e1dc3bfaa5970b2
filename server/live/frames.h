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
#ifndef SERVER_FRAMES_H
#define SERVER_FRAMES_H

#include <stdbool.h>
#include <stdint.h>

#include <cjson/cJSON.h>

#include "protocol/limits.h"
#include "protocol/render_request.h"

struct session;

enum frames_level { FRAMES_NOTHING, FRAMES_MOVING, FRAMES_LARGER, FRAMES_STILL, FRAMES_LOSSLESS };
enum frames_quality { QUALITY_AUTO, QUALITY_SMOOTH, QUALITY_SHARP };

enum {
    FRAMES_STILL_MS = 100,
    FRAMES_LOSSLESS_MS = 300,
    FRAMES_LARGER_MS = 300, /* what the larger picture in between may take */
    FRAMES_STALL_MS = 2000, /* without an acknowledgement for so long nothing is rendered */
    FRAMES_VIEWS = 8,       /* older views that a pick may mean */
};

struct frames_view {
    uint32_t seq;                  /* `picture.values` NULL: there was none yet */
    struct render_request picture; /* the whole view: its size, camera, output, what it isolates */
    enum frames_quality quality;
    bool visible;
};

struct frames {
    struct frames_view views[FRAMES_VIEWS]; /* ring, the newest at `newest` */
    int newest;
    bool has_view;

    int64_t changed_at;     /* clock_ms of the last change that shows */
    enum frames_level done; /* best picture asked for since then */
    bool stale;             /* the newest picture is older than the document */
    uint64_t revision;      /* of the newest picture */

    uint32_t job; /* asked of the worker; 0: none */
    enum frames_level job_level;
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

void frames_init(struct frames *frames);
void frames_finish(struct session *session);
/* No picture is wanted any more, for now. */
void frames_stop(struct session *session);
/* The checked `view` message. False and `err`: the camera is wrong. */
bool frames_set_view(struct session *session, const cJSON *message, struct error *err);
/* The view that a pick means, or the newest; NULL: none yet. */
const struct frames_view *frames_find_view(const struct frames *frames, uint32_t seq);
void frames_acknowledge(struct session *session, uint32_t number);
/* The document or the view changed. */
void frames_changed(struct session *session);
/* The worker can draw a newer revision than before. */
void frames_shown(struct session *session);
/* Somebody waits for a picture, or for a better one. */
bool frames_is_waiting(const struct frames *frames);
/* Asks for a picture if one is due; returns when to look again, clock_ms or 0. */
int64_t frames_pump(struct session *session, int64_t now_ms);

#endif
