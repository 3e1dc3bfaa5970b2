/* SPDX-License-Identifier: MIT */
#include "stream.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hub.h"
#include "poster.h"
#include "protocol/messages.h"
#include "render_queue.h"
#include "renderer/worker/worker.h"
#include "room_state.h"
#include "server/clock.h"
#include "session.h"
#include "stream_size.h"

/* How each picture is drawn and encoded. */
struct stage_rule {
    int level; /* of quality; -1: the scene's */
    enum codec codec;
    int priority, quality;
    bool chroma_halved, exact, sparse;
    int after_ms; /* rest of the view before it is due */
    uint8_t flags;
};

static const struct stage_rule stage_rules[] = {
    [STREAM_MOVING] = {QUALITY_INTERACTIVE, CODEC_JPEG, RENDER_MOVING, 60, true, false, true, 0, 0},
    [STREAM_LARGER] = {QUALITY_INTERACTIVE, CODEC_JPEG, RENDER_STILL, 80, true, false, true,
                       STREAM_STILL_MS, 0},
    [STREAM_STILL] = {QUALITY_INTERACTIVE, CODEC_JPEG, RENDER_STILL, 88, false, false, false,
                      STREAM_STILL_MS, FRAME_STILL},
    [STREAM_GUIDE] = {QUALITY_INTERACTIVE, CODEC_NPY, RENDER_STILL, 90, false, false, false,
                      STREAM_STILL_MS, FRAME_STILL},
    [STREAM_LOSSLESS] = {-1, CODEC_PNG, RENDER_LOSSLESS, 90, false, true, false, STREAM_LOSSLESS_MS,
                         FRAME_STILL | FRAME_LOSSLESS},
};

void stream_init(struct stream *stream)
{
    memset(stream, 0, sizeof *stream);
}

void stream_stop(struct session *session)
{
    if (session->stream->job) {
        render_queue_cancel(session->hub, session->stream->job);
        session->stream->job = 0;
    }
}

void stream_finish(struct session *session)
{
    stream_stop(session);
    for (int i = 0; i < STREAM_VIEWS; i++) {
        render_request_finish(&session->stream->views[i].picture);
    }
}

/* --- views --- */

static struct stream_view *newest_view(struct stream *stream)
{
    return stream->has_view ? &stream->views[stream->newest] : NULL;
}

const struct stream_view *stream_find_view(const struct stream *stream, uint32_t seq)
{
    if (!stream->has_view) {
        return NULL;
    }
    for (int i = 0; i < STREAM_VIEWS; i++) {
        if (stream->views[i].seq == seq && stream->views[i].picture.picture.values) {
            return &stream->views[i];
        }
    }
    return &stream->views[stream->newest];
}

static enum stream_preference find_preference(const char *name)
{
    return strcmp(name, "smooth") == 0  ? PREFER_SMOOTH
           : strcmp(name, "sharp") == 0 ? PREFER_SHARP
                                        : PREFER_AUTO;
}

static bool same_picture(const struct stream_view *a, const struct stream_view *b)
{
    return a->preference == b->preference && a->visible == b->visible && a->guides == b->guides &&
           a->deltas == b->deltas && render_request_equal(&a->picture, &b->picture);
}

void stream_set_view(struct session *session, const struct message *message)
{
    const cJSON *json = message->json;
    struct stream *stream = session->stream;
    struct stream_view *old = newest_view(stream);
    struct stream_view view = {
        .seq = (uint32_t)json_member_number(json, "seq", 0),
        .preference = find_preference(json_member_text(json, "quality", "auto")),
        .visible = json_member_bool(json, "visible", true),
        .guides = json_member_bool(json, "guides", false),
        .depths = json_member_bool(json, "depths", false),
        .deltas = json_member_bool(json, "deltas", false),
    };
    struct record *picture = &view.picture.picture;

    render_request_copy(&view.picture, &message->view);
    record_put(picture, "width", json_member_number(json, "width", 0));
    record_put(picture, "height", json_member_number(json, "height", 0));
    record_put_text(picture, "aov", json_member_text(json, "aov", aov_name(AOV_COLOR)));
    if (old && same_picture(old, &view)) {
        old->seq = view.seq;
        old->depths = view.depths;
        render_request_finish(&view.picture);
        return;
    }
    if (old && !id_set_equal(&old->picture.isolate, &view.picture.isolate)) {
        stream_size_isolate(stream);
    }
    stream->newest = old ? (stream->newest + 1) % STREAM_VIEWS : 0;
    render_request_finish(&stream->views[stream->newest].picture);
    stream->views[stream->newest] = view;
    stream->has_view = true;
    stream->looks++;
    stream_changed(session);
}

void stream_changed(struct session *session)
{
    struct stream *stream = session->stream;

    stream->changed_at = clock_ms();
    stream->done = STREAM_NOTHING;
    if (stream->job_stage > STREAM_MOVING) {
        stream_stop(session);
    }
    supervisor_wake(session->hub->supervisor);
}

/* --- flow --- */

static int flight_slot(const struct stream *stream, uint32_t number)
{
    for (int i = 0; i < LIMIT_FRAMES_IN_FLIGHT; i++) {
        if (stream->flight[i].number == number) {
            return i;
        }
    }
    return -1;
}

/* Frames arrive in order: what is before the acknowledged one was shown or skipped. */
void stream_acknowledge(struct session *session, uint32_t number)
{
    struct stream *stream = session->stream;

    for (int i = 0; i < LIMIT_FRAMES_IN_FLIGHT; i++) {
        if (stream->flight[i].number && stream->flight[i].number <= number) {
            stream->flight[i].number = 0;
            stream->reads = true;
        }
    }
    supervisor_wake(session->hub->supervisor);
}

/* Who never acknowledged a frame may be one who reads none. */
static bool has_credit(const struct stream *stream, int64_t now_ms)
{
    int left = stream->reads ? LIMIT_FRAMES_IN_FLIGHT : 1;

    for (int i = 0; i < LIMIT_FRAMES_IN_FLIGHT; i++) {
        if (stream->flight[i].number) {
            left--;
            if (now_ms - stream->flight[i].sent_ms > STREAM_STALL_MS) {
                return false;
            }
        }
    }
    return left > 0;
}

/* While a frame waits to be written, only a moving picture in its place is worth its time: a
 * better one would be drawn at the cost of others and wait. */
static bool line_is_free(const struct session *session, enum stream_stage stage)
{
    bool precious;

    return !send_queue_has_frame(&session->send_queue, &precious) ||
           (stage == STREAM_MOVING && !precious);
}

/* --- asking and receiving --- */

/* The room of a frame that is shown, or given up, is free. */
static void free_flight(struct stream *stream, uint32_t number)
{
    const int slot = flight_slot(stream, number);

    if (slot >= 0) {
        stream->flight[slot].number = 0;
    }
}

static void take_flight(struct stream *stream, uint32_t number)
{
    const int slot = flight_slot(stream, 0);

    if (slot >= 0) {
        stream->flight[slot].number = number;
        stream->flight[slot].sent_ms = clock_ms();
    }
}

static uint8_t flags_of(const struct stream *stream, const struct packet_frame *frame, bool newest)
{
    const uint8_t flags = stage_rules[stream->job_stage].flags;

    return (frame->more ? flags & ~FRAME_LOSSLESS : flags) | (frame->key ? FRAME_KEY : 0) |
           (newest ? 0 : FRAME_STALE) | (stream->job_depths ? FRAME_DEPTHS : 0) |
           (frame->key ? 0 : FRAME_DELTA);
}

/* Of rounds the client keeps the last one. */
static void put_into_chain(struct stream *stream, const struct packet_frame *frame,
                           struct frame_header *header)
{
    struct stream_chain *chain = &stream->chains[stream->job_stage];

    if (!stream->job_deltas || frame->more) {
        return;
    }
    chain->order = frame->job;
    chain->looks = stream->job_looks;
    chain->delta = !frame->key;
    chain->link = frame->key ? 0 : (uint8_t)(chain->link + 1);
    header->chain = (uint8_t)stream->job_stage;
    header->link = chain->link;
}

static struct frame_header header_of(struct session *session, const struct picture_answer *answer,
                                     bool newest)
{
    struct stream *stream = session->stream;
    const struct packet_frame *frame = answer->frame;
    struct frame_header header = {
        .codec = frame->codec,
        .flags = flags_of(stream, frame, newest),
        .number = ++stream->last_number,
        .payload_bytes = (uint32_t)answer->length - frame->whole_bytes,
        .revision = frame->revision,
        .input = stream->job_seq,
        .width = (uint16_t)frame->width,
        .height = (uint16_t)frame->height,
        .view_width = (uint16_t)stream->job_view_width,
        .view_height = (uint16_t)stream->job_view_height,
        .round = (uint8_t)frame->rounds.done,
        .rounds = (uint8_t)frame->rounds.count,
    };

    memcpy(header.stage_us, frame->times.us, sizeof header.stage_us);
    put_into_chain(stream, frame, &header);
    return header;
}

/* Nothing of the scene is left out for this client alone. */
static bool shows_all(const struct render_request *picture)
{
    return picture->isolate.count == 0 && record_is_empty(&picture->section);
}

static bool becomes_poster(const struct session *session, enum stream_stage stage, enum codec codec)
{
    return stage == STREAM_STILL && codec == CODEC_JPEG &&
           shows_all(&newest_view(session->stream)->picture);
}

/* The whole picture, which may not be what is sent. */
static void set_poster(struct session *session, const struct picture_answer *answer,
                       struct shared_buffer *payload)
{
    const size_t bytes = answer->frame->whole_bytes;
    struct shared_buffer *whole =
        bytes ? shared_buffer_create((const uint8_t *)answer->bytes + answer->length - bytes, bytes)
              : shared_buffer_ref(payload);

    if (bytes || answer->frame->key) {
        poster_set(session->room, whole);
    }
    shared_buffer_unref(whole);
}

static void send_frame(struct session *session, const struct picture_answer *answer)
{
    struct stream *stream = session->stream;
    const struct room *room = session->room;
    const uint64_t revision = answer->frame->revision;
    const bool newest = answer->frame->newest && !(room->scene_error.kind != ERROR_NONE &&
                                                   revision < room->scene_error_revision);
    const struct frame_header header = header_of(session, answer, newest);
    struct shared_buffer *payload = shared_buffer_create(answer->bytes, header.payload_bytes);
    const uint32_t given_up = send_queue_frame(&session->send_queue, &header, payload);

    if (newest && becomes_poster(session, stream->job_stage, header.codec)) {
        set_poster(session, answer, payload);
    }
    shared_buffer_unref(payload);
    if (given_up) {
        free_flight(stream, given_up);
        metric_add(&session->hub->metrics, METRIC_FRAMES_DROPPED, 1);
    }
    if (given_up != header.number) {
        take_flight(stream, header.number);
    }
    stream->stale = !newest;
    stream->revision = revision;
    session->wake(session->connection);
}

static void on_picture(void *data, const struct picture_answer *answer, const struct error *err)
{
    struct session *session = data;
    struct stream *stream = session->stream;

    stream->job = 0;
    if (!answer) {
        /* Another worker is asked again; a refusal would only be repeated. */
        if (err->kind == ERROR_UNAVAILABLE) {
            stream->done = STREAM_NOTHING;
        }
        return;
    }
    if (stream->job_stage == STREAM_MOVING) {
        stream_size_learn(session, answer->frame->drawn_part);
    }
    send_frame(session, answer);
    if (stream->stale && session->room->shown > stream->revision) {
        stream_changed(session);
    }
}

/* Some of its samples, where there is room on the way. */
static void on_round(void *data, const struct picture_answer *answer)
{
    struct session *session = data;

    if (has_credit(session->stream, clock_ms()) &&
        line_is_free(session, session->stream->job_stage)) {
        send_frame(session, answer);
    } else {
        send_queue_skip(&session->send_queue, 0);
    }
}

void stream_shown(struct session *session)
{
    if (session->stream->stale) {
        session->stream->stale = false;
        stream_changed(session);
    }
}

/* JPEG would spoil what is no colour, and has no alpha. */
static bool may_be_jpeg(const struct session *session, const struct record *picture)
{
    return strcmp(record_text(picture, "aov"), aov_name(AOV_COLOR)) == 0 &&
           record_number(&session->room->scene->render, "transparent") == 0;
}

static void put_depth_beside(struct record *picture, enum aov other)
{
    bool outputs[AOV_COUNT] = {[AOV_DEPTH] = true};
    char text[AOVS_TEXT_BYTES];

    outputs[other] = true;
    aovs_print(outputs, text);
    record_put_text(picture, "aov", text);
}

/* By the still picture, which comes before the last one: then most of that is copied, and all
 * samples of the rest come soon. */
static bool little_changed(const struct stream *stream)
{
    const struct stream_chain *still = &stream->chains[STREAM_STILL];

    return still->delta && still->looks == stream->looks;
}

/* As what differs from the last picture of the stage, where the client has it and the view is the
 * same. What that was sent as and lost is in the queue. */
static void put_stream(const struct session *session, const struct stream_view *view,
                       enum stream_stage stage, struct render_request *out)
{
    const struct stream_chain *chain = &session->stream->chains[stage];
    const bool follows = chain->looks == session->stream->looks &&
                         !send_queue_wants_key(&session->send_queue, (uint8_t)stage);
    char name[LIMIT_ID_BYTES];

    if (!view->deltas || stage == STREAM_GUIDE) {
        return;
    }
    snprintf(name, sizeof name, "%s %d%s", session->id, (int)stage,
             render_request_is(out, "depths") ? " depths" : "");
    record_put_text(&out->delivery, "stream", name);
    record_put(&out->delivery, "base", follows ? chain->order : 0);
    record_put(&out->delivery, "whole", follows && becomes_poster(session, stage, out->codec));
    if (follows && little_changed(session->stream)) {
        record_put(&out->delivery, "in_rounds", false);
    }
}

/* The view as a picture of this stage. */
static void make_request(struct session *session, const struct stream_view *view,
                         enum stream_stage stage, struct render_request *out)
{
    const struct stage_rule *rule = &stage_rules[stage];
    const double scale = stream_size_scale(session, view, stage);
    struct record *picture = &out->picture, *delivery = &out->delivery;

    render_request_copy(out, &view->picture);
    render_request_see_from(out, &session->room->scene->camera);
    record_put(picture, "width", fmax(1, round(scale * record_number(picture, "width"))));
    record_put(picture, "height", fmax(1, round(scale * record_number(picture, "height"))));
    record_put(picture, "quality", rule->quality);
    if (rule->level >= 0) {
        record_put(picture, "level", rule->level);
    }
    record_put(delivery, "chroma_halved", rule->chroma_halved);
    record_put(delivery, "fast", true);
    record_put(delivery, "exact", rule->exact);
    record_put(delivery, "sparse", rule->sparse);
    record_put(delivery, "in_rounds", stage == STREAM_LOSSLESS);
    record_put(delivery, "guide", stage == STREAM_GUIDE);
    out->codec =
        rule->codec == CODEC_JPEG && !may_be_jpeg(session, picture) ? CODEC_PNG : rule->codec;
    const bool depths = view->depths && stage == STREAM_MOVING && out->codec == CODEC_JPEG;
    record_put(delivery, "depths", depths);
    if (stage == STREAM_GUIDE || depths) {
        put_depth_beside(picture, depths ? AOV_COLOR : AOV_ID);
    }
    put_stream(session, view, stage, out);
}

static void ask(struct session *session, enum stream_stage stage)
{
    struct stream *stream = session->stream;
    const struct stream_view *view = newest_view(stream);

    stream_size_choose(session, view);
    struct render_order order = {
        .room = session->room,
        .priority = stage_rules[stage].priority,
        .account =
            stream->reads ? session->id : ACCOUNT_NEWCOMERS, /* until a frame is acknowledged */
        .on_done = on_picture,
        .on_more = on_round,
        .data = session,
    };
    make_request(session, view, stage, &order.request);
    stream->done = stage;
    stream->job_stage = stage;
    stream->job_pixels = render_request_pixels(&order.request);
    stream->job_depths = render_request_is(&order.request, "depths");
    stream->job_deltas = *record_text(&order.request.delivery, "stream");
    stream->job_looks = stream->looks;
    stream->job_seq = view->seq;
    stream->job_view_width = render_request_int(&view->picture, "width");
    stream->job_view_height = render_request_int(&view->picture, "height");
    stream->job_asked_us = clock_us();
    stream->job = render_queue_submit(session->hub, &order, NULL);
}

bool stream_is_waiting(const struct stream *stream)
{
    return stream->has_view && stream->views[stream->newest].visible &&
           (stream->job || stream->stale || stream->done < STREAM_LOSSLESS);
}

static enum stream_stage next_stage(const struct session *session, const struct stream_view *view)
{
    const enum stream_stage next = session->stream->done + 1;

    if (next == STREAM_LARGER && !stream_size_has_larger(session, view)) {
        return STREAM_STILL;
    }
    return next == STREAM_GUIDE && !view->guides ? STREAM_LOSSLESS : next;
}

int64_t stream_pump(struct session *session, int64_t now_ms)
{
    struct stream *stream = session->stream;
    const struct stream_view *view = newest_view(stream);

    if (!view || !view->visible || !session->room || session->room->suspended.kind != ERROR_NONE ||
        session->close_code || !session->hub->render_queue->ready || stream->job ||
        stream->done >= STREAM_LOSSLESS || !has_credit(stream, now_ms)) {
        return 0;
    }
    const enum stream_stage stage = next_stage(session, view);
    if (!line_is_free(session, stage)) {
        return 0; /* session_next wakes */
    }
    const int64_t due = stream->changed_at + stage_rules[stage].after_ms;
    if (now_ms < due) {
        return due;
    }
    ask(session, stage);
    return 0;
}
