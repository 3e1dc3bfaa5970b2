/* SPDX-License-Identifier: MIT */
/* The inside of the render process, for the files worker*.c. */
#ifndef RENDERER_WORKER_INTERNAL_H
#define RENDERER_WORKER_INTERNAL_H

#include "encode_thread.h"
#include "kept_streams.h"
#include "pulse.h"
#include "scene_reader.h"
#include "turns.h"
#include "worker.h"

/* A scene, and the last state of it that was sent to the front. */
struct worker_scene {
    char *name;
    struct resident *resident;
    uint64_t told_shown, told_broken;
    struct error told_warning;
    struct worker_scene *next;
};

/* A document for the reading thread, or a large scene whose field that thread compiles. It holds
 * the packets of the scene that came later, in their order. */
struct worker_document {
    struct packet packet; /* by which it came: TO_WORKER_SCENE, or TO_WORKER_EDIT */
    size_t size;          /* about in proportion to the time that it takes */
    struct worker_waiting *first, **end;
    struct worker_document *next; /* in order of arrival */
};
struct worker_waiting {
    struct packet packet;
    struct worker_waiting *next;
};

/* A picture that was asked for. */
struct worker_job {
    uint32_t number; /* the front's */
    char *scene;
    int priority;
    struct turn *turn;   /* its account's */
    struct job *drawing; /* NULL once it is drawn, or given up */
    struct encode_params encode;
    struct kept_stream *kept;      /* that goes on with it; NULL: none */
    struct stream_encoder *stream; /* of its rounds; of `kept` or its own */
    uint32_t base;                 /* the order whose picture it may be a difference from */
    struct encoding *encoding;
    bool between; /* a round is drawn and being encoded; there are more */
    bool newest;
    bool answered; /* failed or cancelled: its encoded bytes are dropped */
    uint64_t received_us, begun_us, told_us;
    uint64_t revision;
    int width, height;
    struct job_times times;
    double drawn_part;
    struct picture_rounds rounds;
    struct worker_job *next; /* in order of arrival */
};

struct worker {
    int fd, wake_fd;
    struct renderer *renderer;
    struct encode_thread *encode_thread;
    struct pulse *pulse;
    struct packet_reader in;
    uint8_t *out; /* bytes from out_sent to out_length are still to be sent */
    size_t out_sent, out_length, out_capacity;
    struct worker_scene *scenes;
    struct scene_reader *scene_reader;
    struct worker_document *documents;
    struct worker_document *opening; /* the one that is being read */
    struct field *opening_drawn;     /* held for it; NULL: none */
    uint64_t openings;               /* begun */
    size_t waiting_bytes;            /* of documents, and of what waits for them */
    struct worker_job *jobs;
    struct kept_streams streams;
    struct turns turns;
    uint64_t shared_until_us; /* pictures of several clients waited together not long ago */
    uint64_t step_until_us;   /* the step that draws; renderer_params.is_wanted */
    uint32_t told_job;        /* that the front thinks is drawn; 0: none */
    struct confinement confined;
    int status; /* -1 while running */
};

enum { WORKER_DEVICE_LOST = 3, WORKER_STUCK = 4 }; /* exit statuses: the front starts another */

/* --- worker_answers.c --- */

/* Sends what the socket takes. */
void worker_flush(struct worker *w);
/* Waits until the front has all that was answered: what comes next may end the process. */
void worker_flush_all(struct worker *w);
/* Queues a packet. */
void worker_send(struct worker *w, const struct packet *packet);
/* `begun`: some of the picture was drawn. */
void worker_send_failed(struct worker *w, uint32_t job, const struct error *err, bool begun);
/* `structure_hash`: the one that is refused; 0: none. */
void worker_send_broken(struct worker *w, const char *scene, uint64_t revision,
                        const struct error *err, uint64_t structure_hash);
void worker_send_ready(struct worker *w);
void worker_send_frame(struct worker *w, const struct worker_job *job);
/* Reports a compilation or a picture that has used up its time. This process ends then. */
void worker_send_slow(struct worker *w, const struct renderer_stuck *stuck);
/* Reports what is compiled, read or drawn next, because it may end this process. */
void worker_send_suspect(struct worker *w, enum packet_to_front kind,
                         const struct packet_suspect *suspect);

/* --- worker.c --- */

/* Handles a packet that waits for no document. Borrowed. */
void worker_on_packet(struct worker *w, const struct packet *packet);

/* --- worker_documents.c --- */

/* Handles a packet, or keeps it until the document of its scene was read. Takes it. */
void worker_take_packet(struct worker *w, struct packet *packet);
/* Whether so much waits that more would only fill memory. */
bool worker_documents_full(const struct worker *w);
/* Takes over what was read, begins with the next, ends the process where one takes too long. */
void worker_read_documents(struct worker *w);
void worker_drop_documents(struct worker *w);

/* --- worker_scenes.c --- */

struct worker_scene **worker_find_scene(struct worker *w, const char *name);
void worker_drop_scene(struct worker_scene **at);
/* One that needs this structure; NULL: none. */
const struct worker_scene *worker_find_structure(const struct worker *w, uint64_t structure_hash);
/* One whose environment is this file. */
const struct worker_scene *worker_find_image(const struct worker *w, const char *image);
/* Tells the front what has become drawable, or never will. */
void worker_announce(struct worker *w);
/* renderer_params.on_compile; `data` is the worker. */
void worker_on_compile(void *data, uint64_t structure_hash);
/* The same of renderer_params.on_read. */
void worker_on_read(void *data, const char *image);
/* The task of the reading thread for a packet. Borrowed. */
struct scene_document worker_document_of(struct worker *w, const struct packet *packet);
/* Takes a scene that was opened. */
void worker_on_scene(struct worker *w, const struct packet_scene *packet,
                     const struct opened_scene *opened);
/* The same of a scene whose field was recompiled. */
void worker_on_field(struct worker *w, const char *scene, const struct opened_scene *opened);
/* The scene, if the reading thread has to compile its field; else NULL. */
const struct scene *worker_stale_scene(struct worker *w, const char *scene);
void worker_on_edit(struct worker *w, const struct packet_edit *packet);
void worker_on_drop(struct worker *w, const char *scene);
void worker_on_judge(struct worker *w, const struct packet_judge *packet);

/* --- worker_pictures.c --- */

void worker_drop_job(struct worker *w, struct worker_job **at);
/* The picture that has the next turn; NULL: none can go on. */
struct worker_job *worker_choose_job(struct worker *w);
/* Draws a tile of it or some parts of one, or with NULL tells that nothing is drawn. */
void worker_step(struct worker *w, struct worker_job *job);
/* renderer_params.is_wanted: a packet or an encoded picture is there, or others wait for long. */
bool worker_is_wanted(void *data);
void worker_collect_encodings(struct worker *w);
/* `malformed`: what is wrong with its members, if anything. */
void worker_on_render(struct worker *w, const struct packet_render *packet,
                      const struct error *malformed);
void worker_on_cancel(struct worker *w, uint32_t number);

#endif
