/* SPDX-License-Identifier: MIT */
/* The stream of pictures of a session: when a picture is drawn, and in which quality. The worker
 * draws one picture of a session at a time, always of the newest view. At most
 * LIMIT_FRAMES_IN_FLIGHT frames are on their way without an acknowledgement; before the first
 * acknowledgement it is one.
 *
 *   changed --> moving pictures, scaled so that each takes about 50 ms
 *
 *           --100 ms rest--> one larger, where full size takes long, then one still in full size,
 *                            then a guide for who wants it
 *
 *           --300 ms rest--> one lossless, shown after 4 and 16 samples too --> nothing
 *
 * Every function is called under the hub's lock. */
#ifndef SERVER_STREAM_H
#define SERVER_STREAM_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/limits.h"
#include "protocol/render_request.h"

struct message;
struct session;

enum stream_stage {
    STREAM_NOTHING,
    STREAM_MOVING,
    STREAM_LARGER,
    STREAM_STILL,
    STREAM_GUIDE,
    STREAM_LOSSLESS,
    STREAM_STAGES
};
enum stream_preference { PREFER_AUTO, PREFER_SMOOTH, PREFER_SHARP };

enum {
    STREAM_STILL_MS = 100,
    STREAM_LOSSLESS_MS = 300,
    STREAM_LARGER_MS = 300, /* time limit of the larger picture in between */
    STREAM_STALL_MS = 2000, /* without an acknowledgement for so long, nothing is drawn */
    STREAM_VIEWS = 8,       /* older views that a pick may refer to */
};

/* The pictures of a stage, of which the client keeps the last one. */
struct stream_chain {
    uint32_t order; /* of the last one that was sent; 0: none */
    uint32_t looks; /* the view that it shows */
    uint8_t link;   /* deltas sent since the key */
    bool delta;     /* the last one is what differs */
};

struct stream_view {
    uint32_t seq;                  /* `picture.values` is NULL: there was no view yet */
    struct render_request picture; /* the whole view, with what it leaves out */
    enum stream_preference preference;
    bool visible;
    bool guides; /* wants to know which node each pixel shows, and how far */
    bool depths; /* wants to know how far a moving picture's pixels are */
    bool deltas; /* takes what differs from earlier pictures */
};

struct stream {
    struct stream_view views[STREAM_VIEWS]; /* ring, the newest at `newest` */
    int newest;
    bool has_view;
    uint32_t looks; /* counts views that look different */

    int64_t changed_at;     /* clock_ms of the last visible change */
    enum stream_stage done; /* best picture ordered since then */
    bool stale;             /* the newest picture is older than the document */
    uint64_t revision;      /* of the newest picture */

    uint32_t job; /* the order at the worker; 0: none */
    enum stream_stage job_stage;
    int64_t job_asked_us;
    uint32_t job_seq;
    int job_view_width, job_view_height;
    int64_t job_pixels;
    bool job_depths; /* it has depths */
    bool job_deltas; /* it belongs to the chain of its stage */
    uint32_t job_looks;
    struct stream_chain chains[STREAM_STAGES];

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
/* Cancels the order. A new view or change starts the stream again. */
void stream_stop(struct session *session);
/* Sets the view of a `view` message. */
void stream_set_view(struct session *session, const struct message *message);
/* The view with this number, else the newest; NULL: there is none yet. */
const struct stream_view *stream_find_view(const struct stream *stream, uint32_t seq);
void stream_acknowledge(struct session *session, uint32_t number);
/* Call it when the document or the view has changed. */
void stream_changed(struct session *session);
/* Call it when the worker can draw a newer revision. */
void stream_shown(struct session *session);
/* Whether the client waits for a picture, or for a better one. */
bool stream_is_waiting(const struct stream *stream);
/* Orders a picture if one is due. Returns the time of the next call (clock_ms), or 0. */
int64_t stream_pump(struct session *session, int64_t now_ms);

#endif
