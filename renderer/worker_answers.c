/* SPDX-License-Identifier: MIT */
/* What the render process says, and how it leaves. */
#include <errno.h>
#include <inttypes.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#include "protocol/memory.h"
#include "protocol/messages.h"
#include "worker_parts.h"

enum { OUT_KEEPS = 1 << 22 }; /* capacity kept between pictures */

void worker_flush(struct worker *w)
{
    while (w->out_sent < w->out_length) {
        const ssize_t sent = send(w->fd, w->out + w->out_sent, w->out_length - w->out_sent,
                                  MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0) {
            if (errno != EAGAIN && errno != EINTR) {
                w->status = 0;
            }
            return;
        }
        w->out_sent += (size_t)sent;
    }
    if (w->out_capacity > OUT_KEEPS) {
        free(w->out);
        w->out = NULL;
        w->out_sent = w->out_length = w->out_capacity = 0;
    }
}

void worker_flush_all(struct worker *w)
{
    worker_flush(w);
    while (w->status < 0 && w->out_sent < w->out_length) {
        struct pollfd fd = {.fd = w->fd, .events = POLLOUT};

        poll(&fd, 1, -1);
        worker_flush(w);
    }
}

cJSON *worker_answer(const char *type)
{
    cJSON *json = cJSON_CreateObject();

    cJSON_AddStringToObject(json, "type", type);
    return json;
}

void worker_send(struct worker *w, cJSON *json, const void *payload, size_t payload_length)
{
    size_t length;
    uint8_t *bytes = packet_pack(json, payload, payload_length, &length);

    if (w->out_sent > 0) {
        memmove(w->out, w->out + w->out_sent, w->out_length - w->out_sent);
        w->out_length -= w->out_sent;
        w->out_sent = 0;
    }
    if (w->out_length + length > w->out_capacity) {
        w->out_capacity = 2 * (w->out_length + length);
        w->out = memory_resize(w->out, w->out_capacity, 1);
    }
    memcpy(w->out + w->out_length, bytes, length);
    w->out_length += length;
    free(bytes);
    cJSON_Delete(json);
}

static void add_error(cJSON *json, const struct error *err)
{
    cJSON_AddStringToObject(json, "code", error_kind_name(err->kind));
    cJSON_AddStringToObject(json, "place", err->place);
    cJSON_AddStringToObject(json, "message", err->message);
    if (err->line > 0) {
        cJSON_AddNumberToObject(json, "line", err->line);
        cJSON_AddNumberToObject(json, "column", err->column);
    }
    if (err->limit_ms > 0) {
        cJSON_AddNumberToObject(json, "measured", err->measured_ms);
        cJSON_AddNumberToObject(json, "limit", err->limit_ms);
    }
}

/* No double holds it. */
static void add_shape(cJSON *json, uint64_t shape)
{
    char text[17];

    snprintf(text, sizeof text, "%016" PRIx64, shape);
    cJSON_AddStringToObject(json, "shape", text);
}

static cJSON *failed(uint64_t job, const struct error *err)
{
    cJSON *json = worker_answer("failed");

    cJSON_AddNumberToObject(json, "job", (double)job);
    add_error(json, err);
    return json;
}

void worker_send_failed(struct worker *w, uint64_t job, const struct error *err)
{
    worker_send(w, failed(job, err), NULL, 0);
}

void worker_send_undrawn(struct worker *w, uint64_t job, const struct error *err)
{
    cJSON *json = failed(job, err);

    cJSON_AddBoolToObject(json, "begun", true);
    worker_send(w, json, NULL, 0);
}

void worker_send_fault(struct worker *w, const char *type, const char *scene, uint64_t revision,
                       const struct error *err, uint64_t shape)
{
    cJSON *json = worker_answer(type);

    cJSON_AddStringToObject(json, "scene", scene);
    cJSON_AddNumberToObject(json, "revision", (double)revision);
    add_error(json, err);
    if (shape) {
        add_shape(json, shape);
    }
    worker_send(w, json, NULL, 0);
}

void worker_send_compiling(struct worker *w, const char *scene, uint64_t revision, uint64_t shape)
{
    cJSON *json = worker_answer("compiling");

    cJSON_AddStringToObject(json, "scene", scene);
    cJSON_AddNumberToObject(json, "revision", (double)revision);
    if (shape) {
        add_shape(json, shape);
    }
    worker_send(w, json, NULL, 0);
}

void worker_send_reading(struct worker *w, const struct held *held, const char *image)
{
    cJSON *json = worker_answer("reading");

    cJSON_AddStringToObject(json, "scene", held ? held->name : "");
    cJSON_AddNumberToObject(json, "revision", held ? (double)resident_revision(held->resident) : 0);
    cJSON_AddStringToObject(json, "asset", image);
    worker_send(w, json, NULL, 0);
}

void worker_send_drawing(struct worker *w, const struct task *task)
{
    cJSON *json = worker_answer("drawing");

    cJSON_AddStringToObject(json, "scene", task ? task->scene : "");
    cJSON_AddNumberToObject(json, "job", task ? (double)task->number : 0);
    worker_send(w, json, NULL, 0);
}

void worker_send_slow(struct worker *w, const struct renderer_stuck *stuck)
{
    const struct held *held =
        *stuck->image ? worker_find_image(w, stuck->image) : worker_find_shape(w, stuck->shape);
    cJSON *json = worker_answer("slow");

    cJSON_AddStringToObject(json, "scene", held ? held->name : "");
    cJSON_AddNumberToObject(json, "revision", held ? (double)resident_revision(held->resident) : 0);
    if (*stuck->image) {
        cJSON_AddStringToObject(json, "asset", stuck->image);
    } else {
        add_shape(json, stuck->shape);
    }
    cJSON_AddBoolToObject(json, "still", stuck->still);
    cJSON_AddNumberToObject(json, "measured", stuck->measured_ms);
    cJSON_AddNumberToObject(json, "limit", stuck->limit_ms);
    worker_send(w, json, NULL, 0);
}

void worker_send_ready(struct worker *w)
{
    const struct renderer_info *info = renderer_info(w->renderer);
    cJSON *json = worker_answer("ready");
    cJSON *renderer = cJSON_AddObjectToObject(json, "renderer");

    cJSON_AddStringToObject(renderer, "name", info->name);
    cJSON_AddStringToObject(renderer, "version", info->version);
    cJSON_AddStringToObject(renderer, "device", info->device);
    cJSON_AddBoolToObject(renderer, "software", info->software);
    cJSON *confined = cJSON_AddObjectToObject(json, "confined");
    cJSON_AddBoolToObject(confined, "files", w->confined.files);
    cJSON_AddBoolToObject(confined, "calls", w->confined.calls);
    cJSON_AddStringToObject(confined, "why", w->confined.why);
    worker_send(w, json, NULL, 0);
}

void worker_send_progress(struct worker *w, const struct task *task)
{
    cJSON *json = worker_answer("progress");

    cJSON_AddNumberToObject(json, "job", (double)task->number);
    worker_send(w, json, NULL, 0);
}

void worker_send_frame(struct worker *w, const struct task *task)
{
    const struct encoding *encoding = task->encoding;
    cJSON *json = worker_answer("frame");

    cJSON_AddNumberToObject(json, "job", (double)task->number);
    cJSON_AddNumberToObject(json, "revision", (double)task->revision);
    cJSON_AddBoolToObject(json, "newest", task->newest);
    cJSON_AddNumberToObject(json, "width", task->width);
    cJSON_AddNumberToObject(json, "height", task->height);
    cJSON_AddStringToObject(json, "mime", encoding->mime);
    cJSON_AddBoolToObject(json, "more", task->between);
    cJSON_AddNumberToObject(json, "round", task->rounds.done);
    cJSON_AddNumberToObject(json, "rounds", task->rounds.count);
    for (int i = 0; i < FRAME_STAGES; i++) {
        char name[STAGE_MEMBER_BYTES];

        stage_member((enum frame_stage)i, name);
        cJSON_AddNumberToObject(json, name, task->times.us[i]);
    }
    worker_send(w, json, encoding->bytes, encoding->length);
}
