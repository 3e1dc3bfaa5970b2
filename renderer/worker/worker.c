/* SPDX-License-Identifier: MIT */
/* The render process: one loop that reads packets, draws one tile of the most urgent picture, and
 * answers. Nothing in it waits but poll(). */
#include "worker.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "renderer/crash.h"
#include "renderer/patient.h"
#include "renderer/slice.h"
#include "worker_internal.h"

enum {
    READ_BYTES = 65536,
    OUT_FULL = 64 << 20, /* nothing is drawn while the front has so much to read */
    COMPILE_POLL_MS = 4,
};

/* Whether somebody waits for the compiler, or a picture or a document is read. */
static bool is_compiling(const struct worker *w)
{
    for (const struct worker_scene *entry = w->scenes; entry; entry = entry->next) {
        if (resident_shown_revision(entry->resident) != resident_revision(entry->resident) &&
            resident_error(entry->resident)->kind == ERROR_NONE) {
            return true;
        }
    }
    for (const struct worker_job *job = w->jobs; job; job = job->next) {
        if (job->drawing && !job_step_possible(job->drawing)) {
            return true;
        }
    }
    return renderer_is_reading(w->renderer) || w->documents;
}

/* Until the loop has something to do without a packet. */
static int timeout_of(const struct worker *w, const struct worker_job *job)
{
    return job || renderer_is_trying(w->renderer) ? 0 : is_compiling(w) ? COMPILE_POLL_MS : -1;
}

/* A document that waits to be read may name any file that came before it. */
static void on_asset(struct worker *w, const struct packet *packet)
{
    renderer_hold_assets(w->renderer, w->documents != NULL);
    if (packet->payload) {
        renderer_asset(w->renderer, packet->asset.asset, packet->payload, packet->payload_length);
    }
}

/* A small document is read at once. */
static void on_scene(struct worker *w, const struct packet *packet)
{
    const struct scene_document document = worker_document_of(w, packet);
    const struct opened_scene opened = scene_document_open(&document);

    worker_on_scene(w, &packet->scene, &opened);
}

void worker_on_packet(struct worker *w, const struct packet *packet)
{
    switch ((enum packet_to_worker)packet->kind) {
    case TO_WORKER_ASSET:
        on_asset(w, packet);
        break;
    case TO_WORKER_SCENE:
        on_scene(w, packet);
        break;
    case TO_WORKER_EDIT:
        worker_on_edit(w, &packet->edit);
        break;
    case TO_WORKER_DROP:
        worker_on_drop(w, packet->state.scene);
        break;
    case TO_WORKER_JUDGE:
        worker_on_judge(w, &packet->judge);
        break;
    case TO_WORKER_PACE:
        renderer_set_pace(w->renderer, packet->pace.pace);
        break;
    case TO_WORKER_RENDER:
        worker_on_render(w, &packet->render, &packet->malformed);
        break;
    case TO_WORKER_CANCEL:
        worker_on_cancel(w, packet->job.job);
        break;
    case TO_WORKER_STOP:
        w->status = 0;
        break;
    case TO_WORKER_PING: /* pulse.h */
    case TO_WORKER_COUNT:
        break;
    }
}

static void receive(struct worker *w)
{
    uint8_t bytes[READ_BYTES];
    struct packet packet;
    ssize_t got;
    int state;

    while ((got = recv(w->fd, bytes, sizeof bytes, MSG_DONTWAIT)) > 0) {
        packet_reader_add(&w->in, bytes, (size_t)got);
    }
    if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        w->status = 0; /* the front is gone */
        return;
    }
    while (w->status < 0 && (state = packet_reader_next(&w->in, PACKET_TO_WORKER, &packet)) != 0) {
        if (state < 0) {
            struct error err = {0};
            error_set(&err, ERROR_SYNTAX, "", "a malformed packet");
            worker_send_failed(w, 0, &err, false);
            w->status = 1; /* where the next packet begins is not known */
            return;
        }
        worker_take_packet(w, &packet);
    }
}

/* False: the sockets are no good. */
static bool wait(struct worker *w, struct pollfd fds[2], int timeout_ms)
{
    bool ok;

    pulse_tell(w->pulse, &(struct pulse_news){renderer_counters(w->renderer),
                                              renderer_pace(w->renderer), timeout_ms < 0});
    ok = poll(fds, 2, timeout_ms) >= 0 || errno == EINTR;
    if (timeout_ms < 0) {
        pulse_wake(w->pulse);
    }
    return ok;
}

static void run(struct worker *w)
{
    struct renderer_stuck stuck;

    while (w->status < 0) {
        struct pollfd fds[2] = {{.fd = w->fd, .events = worker_documents_full(w) ? 0 : POLLIN},
                                {.fd = w->wake_fd, .events = POLLIN}};
        const bool full = w->out_length - w->out_sent > OUT_FULL;
        const struct worker_job *job = full ? NULL : worker_choose_job(w);

        if (w->out_sent < w->out_length) {
            fds[0].events |= POLLOUT;
        }
        if (!job) {
            patient_draws(PATIENT_FREE);
        }
        if (!wait(w, fds, timeout_of(w, job))) {
            w->status = 1;
            return;
        }
        if (fds[0].revents & (POLLIN | POLLHUP | POLLERR)) {
            receive(w);
        }
        if (fds[1].revents) {
            worker_collect_encodings(w);
        }
        worker_read_documents(w);
        renderer_poll(w->renderer, 0);
        if (renderer_stuck(w->renderer, &stuck)) {
            worker_send_slow(w, &stuck);
            worker_flush_all(w);
            _exit(WORKER_STUCK); /* its threads cannot be joined */
        }
        worker_announce(w);
        worker_flush(w);
        worker_step(w, full || w->status >= 0 ? NULL : worker_choose_job(w));
    }
}

/* Address space beyond what the process has now. GPU drivers reserve any amount of it, so there it
 * bounds nothing that is scarce. */
static void limit_memory(const struct worker *w, size_t bytes)
{
    unsigned long pages = 0;
    FILE *statm =
        bytes > 0 && renderer_info(w->renderer)->software ? fopen("/proc/self/statm", "r") : NULL;

    if (!statm) {
        return;
    }
    if (fscanf(statm, "%lu", &pages) == 1) {
        const rlim_t most = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + bytes;
        setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
    }
    fclose(statm);
}

static void finish(struct worker *w)
{
    worker_drop_documents(w);
    while (w->scenes) {
        worker_drop_scene(&w->scenes);
    }
    pulse_destroy(w->pulse);
    encode_thread_destroy(w->encode_thread);
    while (w->jobs) {
        worker_drop_job(w, &w->jobs);
    }
    kept_streams_finish(&w->streams);
    turns_finish(&w->turns);
    renderer_destroy(w->renderer);
    packet_reader_finish(&w->in);
    free(w->out);
    if (w->wake_fd >= 0) {
        close(w->wake_fd);
    }
}

/* Threads that the driver and `w` have by now are confined too. */
static bool seal(struct worker *w, enum confine_mode mode, struct error *err)
{
    if (mode != CONFINE_OFF) {
        confine_calls(&w->confined);
    }
    return mode != CONFINE_STRICT || (w->confined.files && w->confined.calls) ||
           error_set(err, ERROR_INTERNAL, "", "the render process cannot be confined: %s",
                     w->confined.why);
}

int worker_run(int fd, const struct worker_params *params)
{
    struct worker w = {.fd = fd, .status = -1};
    struct renderer_params renderer = params->renderer;
    struct error err = {0};

    prctl(PR_SET_PDEATHSIG, SIGKILL);
    slice_drawing(); /* the front that started it has short ones */
    crash_watch();
    confine_privileges();
    if (params->confine != CONFINE_OFF) {
        confine_files(&w.confined, renderer.device.cache_dir);
    }
    signal(SIGINT, SIG_IGN); /* a Ctrl-C at the terminal is for the front */
    w.wake_fd = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    renderer.on_compile = worker_on_compile;
    renderer.on_read = worker_on_read;
    renderer.on_compile_data = &w;
    renderer.is_wanted = worker_is_wanted;
    renderer.is_wanted_data = &w;
    w.renderer = renderer_create(&renderer, &err);
    w.encode_thread = w.renderer ? encode_thread_create(w.wake_fd, &err) : NULL;
    w.scene_reader = scene_reader_create();
    if (w.wake_fd < 0 || !w.encode_thread || !seal(&w, params->confine, &err)) {
        if (params->renderer.log) {
            params->renderer.log(params->renderer.log_data, err.message);
        }
        finish(&w);
        return 1;
    }
    limit_memory(&w, params->memory_limit_bytes);
    w.pulse = pulse_create(params->pulse_fd);
    worker_send_ready(&w);
    run(&w);
    worker_flush(&w);
    finish(&w);
    return w.status;
}
