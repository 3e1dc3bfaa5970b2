/* SPDX-License-Identifier: MIT */
/* The state of a stream of pictures (stream.h). */
#ifndef SERVER_STREAM_STATE_H
#define SERVER_STREAM_STATE_H

#include <stdbool.h>
#include <stdint.h>

#include "protocol/limits.h"
#include "protocol/render_request.h"

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

/* Nanoseconds for each pixel of moving pictures, as running means; 0: none was measured. */
struct stream_rate {
    double all;   /* also of pictures after an edit, most of which may be copied */
    double whole; /* of those of which most was drawn, as all of one of another size is */
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

    int step;                     /* index into the scales */
    struct stream_rate rate;      /* of the whole scene */
    struct stream_rate isolated;  /* of what is isolated now */
    struct stream_rate *job_rate; /* the one that the order is counted in; NULL: none */
};

#endif
