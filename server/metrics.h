/* SPDX-License-Identifier: MIT */
/* Counters and gauges, and their Prometheus text. Any thread. */
#ifndef SERVER_METRICS_H
#define SERVER_METRICS_H

#include <stdatomic.h>
#include <stdint.h>

#include "protocol/picture.h"

/* X(NAME, "name after fieldcast_", "type", "help") */
#define METRICS(X)                                                                                 \
    X(HTTP_REQUESTS, "http_requests_total", "counter", "HTTP requests answered")                   \
    X(HTTP_ERRORS, "http_errors_total", "counter", "HTTP requests answered with 4xx or 5xx")       \
    X(CONNECTIONS_MALFORMED, "connections_malformed_total", "counter",                             \
      "Connections refused because their first head was malformed or too long")                    \
    X(CONNECTIONS_LATE, "connections_late_total", "counter",                                       \
      "Connections refused because their first head took too long")                                \
    X(CONNECTIONS_OVER_LIMIT, "connections_over_limit_total", "counter",                           \
      "Connections refused because too many were open")                                            \
    X(CONNECTIONS_OVER_WAITING, "connections_over_waiting_total", "counter",                       \
      "Connections refused because too many waited for their first head")                          \
    X(CONNECTIONS_OVER_DESCRIPTORS, "connections_over_descriptors_total", "counter",               \
      "Connections refused because no descriptor was free")                                        \
    X(SESSIONS_OVER_LIMIT, "sessions_over_limit_total", "counter",                                 \
      "Live connections refused because too many were open")                                       \
    X(BODIES_OVER_LIMIT, "bodies_over_limit_total", "counter",                                     \
      "Bodies of requests refused because all of them would have taken too much memory")           \
    X(ANSWERS_OVER_LIMIT, "answers_over_limit_total", "counter",                                   \
      "Answers refused because those that clients had not read took too much memory")              \
    X(SESSIONS, "sessions", "gauge", "Live connections")                                           \
    X(SESSIONS_TOTAL, "sessions_total", "counter", "Live connections since the start")             \
    X(ROOMS, "rooms", "gauge", "Open scenes")                                                      \
    X(SCENES, "scenes", "gauge", "Scenes in the store")                                            \
    X(SCENES_UNREADABLE, "scene_reads_failed_total", "counter",                                    \
      "Scenes that the store could not give back")                                                 \
    X(EDITS, "edits_total", "counter", "Edits accepted")                                           \
    X(EDITS_REJECTED, "edits_rejected_total", "counter", "Edits refused")                          \
    X(EDITS_DURABLE, "edits_durable_total", "counter", "Edits committed to the store")             \
    X(COMMITS, "store_commits_total", "counter", "Transactions committed")                         \
    X(COMMIT_US, "store_commit_microseconds_total", "counter", "Time spent in commits")            \
    X(RENDERS, "renders_total", "counter", "Pictures asked of the worker")                         \
    X(RENDERS_FAILED, "renders_failed_total", "counter", "Pictures that the worker refused")       \
    X(RENDER_QUEUE, "render_queue", "gauge", "Pictures asked and not yet there")                   \
    X(IMAGES_WAITING, "images_waiting", "gauge", "Pictures of REST asked and not yet there")       \
    X(DOCUMENTS_WAITING, "documents_waiting", "gauge",                                             \
      "Requests and live messages about documents that wait or are worked on")                     \
    X(DOCUMENTS_OVER_SHARE, "documents_over_share_total", "counter",                               \
      "Requests refused because their client had its share of large documents waiting")            \
    X(DOCUMENTS_OVER_QUEUE, "documents_over_queue_total", "counter",                               \
      "Requests refused because too many large documents waited")                                  \
    X(LOCK_LONGEST, "lock_longest_microseconds", "gauge",                                          \
      "The most processor time that a thread has used while it held the lock of all scenes")       \
    X(PICKS_GIVEN_UP, "picks_given_up_total", "counter",                                           \
      "Picks not answered because their client asked for more")                                    \
    X(PICK_RESTS, "pick_rests_total", "counter",                                                   \
      "Times that a session had to rest because its picks took much of the front's time")          \
    X(IMAGES_OVER_SHARE, "images_over_share_total", "counter",                                     \
      "Pictures refused because their client had its share of the queue")                          \
    X(IMAGES_OVER_QUEUE, "images_over_queue_total", "counter",                                     \
      "Pictures refused because the queue was full")                                               \
    X(RESTS, "connection_rests_total", "counter",                                                  \
      "Times that a live connection had to rest because it took much of the front's time")         \
    X(PICTURES_REUSED, "pictures_reused_total", "counter", "Pictures answered from memory")        \
    X(FRAMES_SENT, "frames_sent_total", "counter", "Frames sent completely")                       \
    X(FRAMES_DROPPED, "frames_dropped_total", "counter", "Frames given up for newer ones")         \
    X(FRAME_BYTES, "frame_bytes_total", "counter", "Payload bytes of frames sent")                 \
    X(THUMBNAILS_DRAWN, "thumbnails_drawn_total", "counter", "Thumbnails drawn, or tried")         \
    X(THUMBNAILS_REUSED, "thumbnails_reused_total", "counter", "Thumbnails found in the cache")    \
    X(THUMBNAILS_CANCELLED, "thumbnails_cancelled_total", "counter",                               \
      "Thumbnails given up because something moved or nobody wanted them any more")                \
    X(THUMBNAILS_SENT, "thumbnails_sent_total", "counter", "Thumbnails sent")                      \
    X(THUMBNAIL_BYTES, "thumbnail_bytes_total", "counter", "Bytes of thumbnails sent")             \
    X(THUMBNAIL_RESTS, "thumbnail_rests_total", "counter",                                         \
      "Times that a session had to rest because its thumbnails took much of the front's time")     \
    X(WORKER_UP, "worker_up", "gauge", "1 while the worker is ready")                              \
    X(WORKER_FILES_CONFINED, "worker_files_confined", "gauge",                                     \
      "1 where the kernel keeps the worker from files that are not its own")                       \
    X(WORKER_CALLS_CONFINED, "worker_calls_confined", "gauge",                                     \
      "1 where the kernel keeps the worker from sockets, programs and processes")                  \
    X(WORKER_RESTARTS, "worker_restarts_total", "counter", "Workers replaced")                     \
    X(COMPILATIONS, "shader_compilations_total", "counter", "Shader programs compiled")            \
    X(CACHE_HITS, "shader_cache_hits_total", "counter", "Scenes whose program was there already")  \
    X(TILES, "tiles_total", "counter", "Tiles drawn")                                              \
    X(PICTURES, "pictures_total", "counter", "Pictures drawn")                                     \
    X(RESIDENT_BYTES, "worker_resident_bytes", "gauge", "Memory of the worker")

enum metric {
#define X(name, text, type, help) METRIC_##name,
    METRICS(X)
#undef X
        METRIC_COUNT
};

struct metrics {
    _Atomic int64_t value[METRIC_COUNT];
    _Atomic int64_t stage_us[FRAME_STAGES]; /* of pictures */
};

static inline void metric_add(struct metrics *metrics, enum metric metric, int64_t amount)
{
    atomic_fetch_add_explicit(&metrics->value[metric], amount, memory_order_relaxed);
}

static inline void metric_set(struct metrics *metrics, enum metric metric, int64_t value)
{
    atomic_store_explicit(&metrics->value[metric], value, memory_order_relaxed);
}

static inline int64_t metric_get(const struct metrics *metrics, enum metric metric)
{
    return atomic_load_explicit(&metrics->value[metric], memory_order_relaxed);
}

static inline void metric_add_stage(struct metrics *metrics, enum frame_stage stage, int64_t us)
{
    atomic_fetch_add_explicit(&metrics->stage_us[stage], us, memory_order_relaxed);
}

/* Prometheus text format 0.0.4; caller frees. */
char *metrics_print(const struct metrics *metrics);

#endif
