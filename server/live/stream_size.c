/* SPDX-License-Identifier: MIT */
#include "stream_size.h"

#include <math.h>

#include "hub.h"
#include "render_queue.h"
#include "room_state.h"
#include "server/clock.h"
#include "session.h"

/* Side lengths of moving pictures, relative to the view. */
static const double scales[] = {1, 0.75, 0.5, 0.375, 0.25, 0.1875, 0.125, 0.09375, 0.0625};
static const double MOST = 0.5; /* of a picture */
enum {
    SCALE_COUNT = sizeof scales / sizeof *scales,
    USUAL_STEPS = 5,      /* scales for all views; the others are for large ones */
    FIRST_PIXELS = 57600, /* of a moving picture at most, where nothing is known of the scene */
    LEAST_PIXELS = 10000, /* of a moving picture with one of the other scales */
};

struct preference_rule {
    double target_ms; /* what a moving picture may take */
    int last_step;    /* how far it may shrink */
};

static const struct preference_rule preference_rules[] = {
    [PREFER_AUTO] = {50, SCALE_COUNT - 1},
    [PREFER_SMOOTH] = {25, SCALE_COUNT - 1},
    [PREFER_SHARP] = {120, 2},
};

/* Where what the view takes is counted. */
static struct stream_rate *own_rate(struct stream *stream, const struct stream_view *view)
{
    return view->picture.isolate.count > 0 ? &stream->isolated : &stream->rate;
}

/* What is known of the view, or of the whole scene, by this session or by others; 0: nothing. */
static const struct stream_rate *rate_of(const struct session *session,
                                         const struct stream_view *view)
{
    const struct stream_rate *own = own_rate(session->stream, view);
    const struct stream_rate *whole = &session->stream->rate;

    return own->all > 0 ? own : whole->all > 0 ? whole : &session->room->rate;
}

static double pixels_of(const struct stream_view *view, int step)
{
    const struct record *picture = &view->picture.picture;

    return record_number(picture, "width") * record_number(picture, "height") * scales[step] *
           scales[step];
}

static double predicted_ms(const struct session *session, const struct stream_view *view, int step)
{
    const struct stream_rate *rate = rate_of(session, view);
    const bool whole = step < session->stream->step || own_rate(session->stream, view)->all == 0;

    return (whole ? fmax(rate->all, rate->whole) : rate->all) * pixels_of(view, step) * 1e-6;
}

static int last_step(const struct stream_view *view)
{
    int step = preference_rules[view->preference].last_step;

    while (step >= USUAL_STEPS && pixels_of(view, step) < LEAST_PIXELS) {
        step--;
    }
    return step;
}

static bool is_too_large(const struct session *session, const struct stream_view *view, int step)
{
    const double target_ms = preference_rules[view->preference].target_ms;

    if (rate_of(session, view)->all == 0) { /* those who wait share the machine with this one */
        const int sharing = 1 + render_queue_moving(session->hub->render_queue);
        return pixels_of(view, step) > (double)FIRST_PIXELS / sharing;
    }
    /* Only a clear gain makes it larger again, lest the size jumps to and fro. */
    return predicted_ms(session, view, step) >
           target_ms * (step < session->stream->step ? 0.8 : 1.1);
}

void stream_size_isolate(struct stream *stream)
{
    stream->isolated = (struct stream_rate){0};
    stream->step = SCALE_COUNT - 1;
    if (stream->job_rate == &stream->isolated) {
        stream->job_rate = NULL;
    }
}

void stream_size_choose(struct session *session, const struct stream_view *view)
{
    int step = 0;

    while (step < last_step(view) && is_too_large(session, view, step)) {
        step++;
    }
    session->stream->step = step;
    session->stream->job_rate = own_rate(session->stream, view);
}

/* The step of the picture between moving and still ones; the current one: none is worth while. */
static int larger_step(const struct session *session, const struct stream_view *view)
{
    const int moving = session->stream->step;
    int step = 0;

    while (step < moving && predicted_ms(session, view, step) > STREAM_LARGER_MS) {
        step++;
    }
    return step ? step : moving; /* 0: the still picture itself comes as soon */
}

bool stream_size_has_larger(const struct session *session, const struct stream_view *view)
{
    return larger_step(session, view) != session->stream->step;
}

double stream_size_scale(const struct session *session, const struct stream_view *view,
                         enum stream_stage stage)
{
    return stage == STREAM_GUIDE    ? fmin(1, sqrt(LIMIT_GUIDE_PIXELS / pixels_of(view, 0)))
           : stage >= STREAM_STILL  ? 1
           : stage == STREAM_MOVING ? scales[session->stream->step]
                                    : scales[larger_step(session, view)];
}

static double mixed(double known, double took)
{
    return known > 0 ? known + 0.3 * (took - known) : took;
}

static void learn(struct stream_rate *rate, double took, double drawn_part)
{
    rate->all = mixed(rate->all, took);
    if (drawn_part > MOST) {
        rate->whole = mixed(rate->whole, took / drawn_part);
    }
}

void stream_size_learn(struct session *session, double drawn_part)
{
    struct stream *stream = session->stream;
    const double took =
        (double)(clock_us() - stream->job_asked_us) * 1e3 / (double)stream->job_pixels;

    if (stream->job_rate) {
        learn(stream->job_rate, took, drawn_part);
    }
    if (stream->job_rate == &stream->rate) {
        learn(&session->room->rate, took, drawn_part);
    }
}
