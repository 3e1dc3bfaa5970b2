/* SPDX-License-Identifier: MIT */
/* What the render process says, and how it leaves. */
#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#include "protocol/memory.h"
#include "worker_internal.h"

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

void worker_send(struct worker *w, const struct packet *packet)
{
    size_t length;
    uint8_t *bytes = packet_pack(PACKET_TO_FRONT, packet, &length);

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
}

void worker_send_failed(struct worker *w, uint32_t job, const struct error *err, bool begun)
{
    worker_send(w, &(struct packet){.kind = TO_FRONT_FAILED,
                                    .failed = {.job = job, .begun = begun, .error = *err}});
}

void worker_send_broken(struct worker *w, const char *scene, uint64_t revision,
                        const struct error *err, uint64_t structure_hash)
{
    worker_send(w, &(struct packet){.kind = TO_FRONT_BROKEN,
                                    .state = {.scene = scene,
                                              .revision = revision,
                                              .error = *err,
                                              .structure_hash = structure_hash}});
}

void worker_send_suspect(struct worker *w, enum packet_to_front kind,
                         const struct packet_suspect *suspect)
{
    worker_send(w, &(struct packet){.kind = (int)kind, .suspect = *suspect});
}

void worker_send_slow(struct worker *w, const struct renderer_stuck *stuck)
{
    const struct worker_scene *entry = *stuck->image
                                           ? worker_find_image(w, stuck->image)
                                           : worker_find_structure(w, stuck->structure_hash);

    worker_send_suspect(
        w, TO_FRONT_SLOW,
        &(struct packet_suspect){.scene = entry ? entry->name : "",
                                 .revision = entry ? resident_revision(entry->resident) : 0,
                                 .structure_hash = *stuck->image ? 0 : stuck->structure_hash,
                                 .asset = stuck->image,
                                 .still = stuck->still,
                                 .measured_ms = stuck->measured_ms,
                                 .limit_ms = stuck->limit_ms});
}

void worker_send_ready(struct worker *w)
{
    const struct renderer_info *info = renderer_info(w->renderer);

    worker_send(w, &(struct packet){.kind = TO_FRONT_READY,
                                    .ready = {.name = info->name,
                                              .version = info->version,
                                              .device = info->device,
                                              .software = info->software,
                                              .stage = info->stage,
                                              .files = w->confined.files,
                                              .calls = w->confined.calls,
                                              .why = w->confined.why}});
}

void worker_send_frame(struct worker *w, const struct worker_job *job)
{
    const struct encoding *encoding = job->encoding;

    worker_send(w, &(struct packet){.kind = TO_FRONT_FRAME,
                                    .frame = {.job = job->number,
                                              .revision = job->revision,
                                              .newest = job->newest,
                                              .more = job->between,
                                              .rounds = job->rounds,
                                              .width = job->width,
                                              .height = job->height,
                                              .codec = encoding->packet.codec,
                                              .key = encoding->packet.key,
                                              .whole_bytes = (uint32_t)encoding->packet.whole_bytes,
                                              .drawn_part = job->drawn_part,
                                              .times = job->times},
                                    .payload = encoding->bytes,
                                    .payload_length = encoding->length});
}
