/* SPDX-License-Identifier: MIT */
/* One thread polls the socket of the worker. Packets that the socket does not take at once wait in
 * a queue, so that nobody who holds a lock ever waits for the worker. */
#include "supervisor.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "heartbeat.h"
#include "protocol/memory.h"
#include "server/clock.h"
#include "server/doorbell.h"
#include "server/log.h"
#include "server/net/shared_buffer.h"

enum {
    SPARE_PAIRS = 2, /* its packets, its pulse */
    COUNTERS = 4,    /* of a pong */
    PING_MS = 250,
    START_MS = 60000,       /* one that is not ready yet may be still, or at work, for so long */
    WATCH_AFTER_MS = 500,   /* of silence it is looked at */
    STEADY_MS = 2000,       /* one that lived longer is replaced at once */
    BACKOFF_FIRST_MS = 100, /* else after a pause, doubled each time */
    BACKOFF_MAX_MS = 5000,
    DYING_MS = 500, /* that a killed worker is waited for at the end of the daemon */
};

struct chunk {
    struct chunk *next;
    size_t length, sent;
    uint8_t *bytes;
    struct shared_buffer *shared; /* holds `bytes`; NULL: they are the chunk's own */
    char *asset;                  /* a file that is still to be read; `bytes` is NULL so long */
};

struct supervisor {
    struct supervisor_params params;
    pthread_t thread;
    int wake_fd;
    struct doorbell bell, post; /* wakes its thread; writes the chunks */
    atomic_bool stopping;
    atomic_int patience; /* times busy_ms */

    pthread_mutex_t lock; /* guards fd, ready, chunks */
    int fd;               /* -1: no worker */
    bool ready;
    struct chunk *first, **end;

    /* The thread's own. */
    pid_t pid;
    int spare[SPARE_PAIRS]
             [2]; /* of the next worker: it starts where no descriptor is free; or -1 */
    struct packet_reader reader;
    struct heartbeat heartbeat;
    int64_t started, heard, next_ping, next_start;
    struct vigil vigil; /* since `heard` */
    int backoff_ms;
    bool ever_ready;
    int64_t counted[COUNTERS]; /* the last pong's counters */
};

/* --- sending --- */

static void chunk_destroy(struct chunk *chunk)
{
    free(chunk->asset);
    if (chunk->shared) {
        shared_buffer_unref(chunk->shared);
    } else {
        free(chunk->bytes);
    }
    free(chunk);
}

static void chunks_clear(struct supervisor *supervisor)
{
    while (supervisor->first) {
        struct chunk *chunk = supervisor->first;

        supervisor->first = chunk->next;
        chunk_destroy(chunk);
    }
    supervisor->end = &supervisor->first;
}

/* Under the lock: writes what the socket takes, up to a file that is not read yet. */
static void chunks_write(struct supervisor *supervisor)
{
    struct chunk *chunk;

    while ((chunk = supervisor->first) != NULL && chunk->bytes) {
        ssize_t sent = send(supervisor->fd, chunk->bytes + chunk->sent, chunk->length - chunk->sent,
                            MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0) {
            return; /* full, or dead: then the reading side notices */
        }
        chunk->sent += (size_t)sent;
        if (chunk->sent < chunk->length) {
            continue;
        }
        supervisor->first = chunk->next;
        if (!supervisor->first) {
            supervisor->end = &supervisor->first;
        }
        chunk_destroy(chunk);
    }
}

/* On the supervisor's thread: the others leave a file alone that is first in the queue. */
static void load_first(struct supervisor *supervisor)
{
    struct chunk *chunk;
    size_t length = 0;
    void *bytes;

    pthread_mutex_lock(&supervisor->lock);
    chunk = supervisor->first && !supervisor->first->bytes ? supervisor->first : NULL;
    pthread_mutex_unlock(&supervisor->lock);
    if (!chunk) {
        return;
    }
    bytes = supervisor->params.load_file(supervisor->params.data, chunk->asset, &length);
    pthread_mutex_lock(&supervisor->lock);
    chunk->bytes = packet_pack(PACKET_TO_WORKER,
                               &(struct packet){.kind = TO_WORKER_ASSET,
                                                .asset = {chunk->asset},
                                                .payload = bytes,
                                                .payload_length = length},
                               &chunk->length);
    pthread_mutex_unlock(&supervisor->lock);
    free(bytes);
}

static void ring(void *data)
{
    const struct supervisor *supervisor = data;

    eventfd_write(supervisor->wake_fd, 1);
}

void supervisor_wake(struct supervisor *supervisor)
{
    doorbell_ring(&supervisor->bell);
}

/* What the socket does not take is left to the supervisor's thread. */
static void write_or_wake(void *data)
{
    struct supervisor *supervisor = data;

    pthread_mutex_lock(&supervisor->lock);
    chunks_write(supervisor);
    const bool rest = supervisor->first != NULL;
    pthread_mutex_unlock(&supervisor->lock);
    if (rest) {
        supervisor_wake(supervisor);
    }
}

/* Takes `chunk`, and `next`, which goes behind it and may be NULL. */
static void send_chunks(struct supervisor *supervisor, struct chunk *chunk, struct chunk *next)
{
    pthread_mutex_lock(&supervisor->lock);
    if (!supervisor->ready) {
        pthread_mutex_unlock(&supervisor->lock);
        chunk_destroy(chunk);
        if (next) {
            chunk_destroy(next);
        }
        return;
    }
    chunk->next = next;
    *supervisor->end = chunk;
    supervisor->end = next ? &next->next : &chunk->next;
    pthread_mutex_unlock(&supervisor->lock);
    doorbell_ring(&supervisor->post);
}

void supervisor_send(struct supervisor *supervisor, const struct packet *packet)
{
    struct chunk *chunk = memory_alloc(1, sizeof *chunk);

    chunk->bytes = packet_pack(PACKET_TO_WORKER, packet, &chunk->length);
    send_chunks(supervisor, chunk, NULL);
}

void supervisor_send_shared(struct supervisor *supervisor, const struct packet *packet,
                            struct shared_buffer *payload)
{
    struct chunk *chunk = memory_alloc(1, sizeof *chunk), *rest = memory_alloc(1, sizeof *rest);

    chunk->bytes = packet_pack(PACKET_TO_WORKER, packet, &chunk->length);
    rest->shared = shared_buffer_ref(payload);
    rest->bytes = payload->bytes;
    rest->length = packet->payload_length;
    send_chunks(supervisor, chunk, rest);
}

void supervisor_send_asset(struct supervisor *supervisor, const char *id)
{
    struct chunk *chunk = memory_alloc(1, sizeof *chunk);

    chunk->asset = memory_text(id);
    send_chunks(supervisor, chunk, NULL);
}

/* --- the process --- */

static bool spawn(struct supervisor *supervisor, int child_fd, int pulse_fd)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, all;

    sigemptyset(&none);
    sigfillset(&all);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, child_fd, WORKER_FD);
    posix_spawn_file_actions_adddup2(&actions, pulse_fd, WORKER_PULSE_FD);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int result = posix_spawn(&supervisor->pid, "/proc/self/exe", &actions, &attributes,
                                   (char *const *)supervisor->params.argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (result != 0) {
        supervisor->pid = 0;
        log_error("worker", "cannot be started: %s", strerror(result));
    }
    return result == 0;
}

static void sign_of_life(struct supervisor *supervisor)
{
    supervisor->heard = clock_ms();
    vigil_restart(&supervisor->vigil);
}

void supervisor_set_patience(struct supervisor *supervisor, int times)
{
    atomic_store(&supervisor->patience, times);
}

static bool make_spare(struct supervisor *supervisor)
{
    bool ok = true;

    for (int i = 0; i < SPARE_PAIRS; i++) {
        int pair[2];

        if (supervisor->spare[i][0] < 0 &&
            socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) == 0) {
            memcpy(supervisor->spare[i], pair, sizeof pair);
        }
        ok = ok && supervisor->spare[i][0] >= 0;
    }
    return ok;
}

static void start(struct supervisor *supervisor)
{
    int pair[2], pulse[2];

    supervisor->started = clock_ms();
    supervisor->next_start = 0;
    sign_of_life(supervisor);
    supervisor_set_patience(supervisor, 1);
    if (!make_spare(supervisor)) {
        log_error("worker", "no socket: %s", strerror(errno));
        supervisor->next_start = supervisor->started + BACKOFF_MAX_MS;
        return;
    }
    memcpy(pair, supervisor->spare[0], sizeof pair);
    memcpy(pulse, supervisor->spare[1], sizeof pulse);
    memset(supervisor->spare, -1, sizeof supervisor->spare);
    const bool ok = spawn(supervisor, pair[1], pulse[1]);
    close(pair[1]);
    close(pulse[1]);
    if (!ok) {
        close(pair[0]);
        close(pulse[0]);
        supervisor->next_start = supervisor->started + BACKOFF_MAX_MS;
        return;
    }
    memset(supervisor->counted, 0, sizeof supervisor->counted);
    heartbeat_init(&supervisor->heartbeat, pulse[0]);
    pthread_mutex_lock(&supervisor->lock);
    supervisor->fd = pair[0];
    pthread_mutex_unlock(&supervisor->lock);
    log_info("worker", "started as process %d", (int)supervisor->pid);
}

static void describe_exit(int status, enum crash_work crash, char *out, size_t size)
{
    static const char *const works[CRASH_WORKS] = {[CRASH_COMPILING] = "compiling",
                                                   [CRASH_READING] = "reading a picture",
                                                   [CRASH_OPENING] = "reading a document",
                                                   [CRASH_DRAWING] = "drawing"};

    if (crash != CRASH_ANYWHERE) {
        snprintf(out, size, "crashed %s", works[crash]);
    } else if (WIFSIGNALED(status)) {
        snprintf(out, size, "ended by signal %d (%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
    } else {
        snprintf(out, size, "ended with status %d", WEXITSTATUS(status));
    }
}

static void plan_restart(struct supervisor *supervisor)
{
    const int64_t now = clock_ms();

    if (now - supervisor->started > STEADY_MS) {
        supervisor->backoff_ms = 0;
        supervisor->next_start = now;
        return;
    }
    supervisor->backoff_ms = supervisor->backoff_ms ? supervisor->backoff_ms * 2 : BACKOFF_FIRST_MS;
    if (supervisor->backoff_ms > BACKOFF_MAX_MS) {
        supervisor->backoff_ms = BACKOFF_MAX_MS;
    }
    supervisor->next_start = now + supervisor->backoff_ms;
}

/* Its exit status. Threads of drivers have the least priority, so on a busy machine a killed
 * process may take seconds to die. The daemon's end does not wait for that: init takes it over. */
static int reap(const struct supervisor *supervisor)
{
    const bool last = atomic_load(&supervisor->stopping);
    const int64_t end = clock_ms() + DYING_MS;
    int status = 0;

    while (waitpid(supervisor->pid, &status, last ? WNOHANG : 0) == 0 && clock_ms() < end) {
        usleep(5000);
    }
    return status;
}

/* Kills what is left of the worker and tells why. `why`: NULL where it ended by itself. */
static void take_down(struct supervisor *supervisor, const struct supervisor_end *why)
{
    struct supervisor_end end = why ? *why : (struct supervisor_end){.kind = SUPERVISOR_ENDED};

    pthread_mutex_lock(&supervisor->lock);
    close(supervisor->fd);
    supervisor->fd = -1;
    supervisor->ready = false;
    chunks_clear(supervisor);
    pthread_mutex_unlock(&supervisor->lock);
    packet_reader_finish(&supervisor->reader);
    memset(&supervisor->reader, 0, sizeof supervisor->reader);
    heartbeat_finish(&supervisor->heartbeat);
    kill(supervisor->pid, SIGKILL);
    const int status = reap(supervisor);
    supervisor->pid = 0;
    if (!why) {
        end.crash = WIFEXITED(status) ? crash_of(WEXITSTATUS(status)) : CRASH_ANYWHERE;
        describe_exit(status, end.crash, end.text, sizeof end.text);
    }
    metric_set(supervisor->params.metrics, METRIC_WORKER_UP, 0);
    if (atomic_load(&supervisor->stopping)) {
        return;
    }
    if (!supervisor->ever_ready && !why && WIFEXITED(status) && WEXITSTATUS(status) != 0) {
        log_error("worker", "%s before it could draw anything", end.text);
        supervisor->next_start = INT64_MAX;
        supervisor->params.on_hopeless(supervisor->params.data);
        return;
    }
    metric_add(supervisor->params.metrics, METRIC_WORKER_RESTARTS, 1);
    log_warning("worker", "%s; another one is started", end.text);
    plan_restart(supervisor);
    if (supervisor->params.on_down(supervisor->params.data, &end)) {
        supervisor->backoff_ms = 0;
        supervisor->next_start = clock_ms();
    }
}

/* --- receiving --- */

/* A worker counts from 0; ours go on over restarts. */
static void count_pong(struct supervisor *supervisor, const struct packet_pong *pong)
{
    const struct {
        enum metric metric;
        uint64_t value;
    } counters[COUNTERS] = {{METRIC_COMPILATIONS, pong->counters.compilations},
                            {METRIC_CACHE_HITS, pong->counters.cache_hits},
                            {METRIC_TILES, pong->counters.tiles},
                            {METRIC_PICTURES, pong->counters.pictures}};

    for (int i = 0; i < COUNTERS; i++) {
        const int64_t value = (int64_t)counters[i].value;

        metric_add(supervisor->params.metrics, counters[i].metric, value - supervisor->counted[i]);
        supervisor->counted[i] = value;
    }
    metric_set(supervisor->params.metrics, METRIC_RESIDENT_BYTES, (int64_t)pong->resident_bytes);
    supervisor->params.on_pace(supervisor->params.data, pong->pace);
}

static void receive_pongs(struct supervisor *supervisor)
{
    struct packet_pong pong;
    bool alive;

    heartbeat_receive(&supervisor->heartbeat);
    while (heartbeat_next(&supervisor->heartbeat, &pong, &alive)) {
        if (alive) {
            sign_of_life(supervisor);
        }
        count_pong(supervisor, &pong);
    }
}

static void receive_packet(struct supervisor *supervisor, const struct packet *packet)
{
    sign_of_life(supervisor);
    if (packet->kind == TO_FRONT_READY) {
        pthread_mutex_lock(&supervisor->lock);
        supervisor->ready = supervisor->ever_ready = true;
        pthread_mutex_unlock(&supervisor->lock);
        metric_set(supervisor->params.metrics, METRIC_WORKER_UP, 1);
        supervisor->params.on_ready(supervisor->params.data, &packet->ready);
    } else {
        supervisor->params.on_packet(supervisor->params.data, packet);
    }
}

/* False: the worker is gone or talks nonsense. */
static bool receive(struct supervisor *supervisor)
{
    uint8_t bytes[65536];
    const ssize_t got = recv(supervisor->fd, bytes, sizeof bytes, MSG_DONTWAIT);
    struct packet packet;
    int result;

    if (got <= 0) {
        return got < 0 && (errno == EAGAIN || errno == EINTR);
    }
    sign_of_life(supervisor); /* of a packet that is not whole yet */
    packet_reader_add(&supervisor->reader, bytes, (size_t)got);
    while ((result = packet_reader_next(&supervisor->reader, PACKET_TO_FRONT, &packet)) == 1) {
        receive_packet(supervisor, &packet);
        packet_finish(&packet);
    }
    return result == 0;
}

/* --- the loop --- */

/* Whether the silent worker hangs, and how. */
static bool hangs(struct supervisor *supervisor, int64_t now, struct supervisor_end *out)
{
    const struct supervisor_params *params = &supervisor->params;
    const int64_t busy = (int64_t)params->busy_ms * atomic_load(&supervisor->patience);
    const int64_t still_limit = supervisor->ready ? params->silence_ms : START_MS;
    const int64_t busy_limit = supervisor->ready || busy > START_MS ? busy : START_MS;
    const struct vigil *vigil = &supervisor->vigil;
    struct vigil_use use;

    if (!vigil_use_of(supervisor->pid, 0, &use)) {
        return false; /* its end is noticed by the socket */
    }
    vigil_look(&supervisor->vigil, now, &use);
    if (vigil->still_ms > still_limit) {
        *out = (struct supervisor_end){
            .kind = SUPERVISOR_STILL, .measured_ms = vigil->still_ms, .limit_ms = still_limit};
        snprintf(out->text, sizeof out->text, "silent and still for %lld ms",
                 (long long)vigil->still_ms);
    } else if (vigil->spent_ms > busy_limit) {
        *out = (struct supervisor_end){
            .kind = SUPERVISOR_BUSY, .measured_ms = vigil->spent_ms, .limit_ms = busy_limit};
        snprintf(out->text, sizeof out->text, "silent for %lld ms of the processor",
                 (long long)vigil->spent_ms);
    }
    return out->limit_ms > 0;
}

static void watch_over(struct supervisor *supervisor, int64_t now)
{
    struct supervisor_end end = {0};

    make_spare(supervisor);
    if (supervisor->fd < 0) {
        if (supervisor->next_start <= now) {
            start(supervisor);
        }
    } else if (now - supervisor->heard > WATCH_AFTER_MS && hangs(supervisor, now, &end)) {
        take_down(supervisor, &end);
    } else if (supervisor->ready && supervisor->next_ping <= now) {
        heartbeat_ask(&supervisor->heartbeat, now);
        supervisor->next_ping = now + PING_MS;
    }
}

static int wait_ms(const struct supervisor *supervisor, int64_t tick)
{
    const int64_t next = clock_earlier(tick, supervisor->fd < 0  ? supervisor->next_start
                                             : supervisor->ready ? supervisor->next_ping
                                                                 : clock_ms() + PING_MS);
    const int64_t left = next - clock_ms();

    return left < 0 ? 0 : left > 1000 ? 1000 : (int)left;
}

static void wait_and_receive(struct supervisor *supervisor, int timeout_ms)
{
    struct pollfd fds[3] = {{.fd = supervisor->wake_fd, .events = POLLIN},
                            {.fd = supervisor->fd, .events = POLLIN},
                            {.fd = supervisor->heartbeat.fd, .events = POLLIN}};
    eventfd_t ignored;

    load_first(supervisor);
    pthread_mutex_lock(&supervisor->lock);
    if (supervisor->first) {
        fds[1].events |= POLLOUT;
    }
    pthread_mutex_unlock(&supervisor->lock);
    if (poll(fds, 3, timeout_ms) <= 0) {
        return;
    }
    if (fds[0].revents) {
        eventfd_read(supervisor->wake_fd, &ignored);
    }
    if (fds[1].revents & POLLOUT) {
        pthread_mutex_lock(&supervisor->lock);
        chunks_write(supervisor);
        pthread_mutex_unlock(&supervisor->lock);
    }
    if (fds[2].revents) {
        receive_pongs(supervisor);
    }
    if ((fds[1].revents & (POLLIN | POLLHUP | POLLERR)) && !receive(supervisor)) {
        take_down(supervisor, NULL);
    }
}

static void *run(void *data)
{
    struct supervisor *supervisor = data;

    while (!atomic_load(&supervisor->stopping)) {
        watch_over(supervisor, clock_ms());
        const int64_t tick = supervisor->params.on_tick(supervisor->params.data, clock_ms());

        wait_and_receive(supervisor, wait_ms(supervisor, tick));
    }
    if (supervisor->fd >= 0) {
        take_down(supervisor, &(struct supervisor_end){.text = "stopped"});
    }
    return NULL;
}

struct supervisor *supervisor_create(const struct supervisor_params *params)
{
    struct supervisor *supervisor = memory_alloc(1, sizeof *supervisor);

    supervisor->params = *params;
    supervisor->fd = supervisor->heartbeat.fd = -1;
    memset(supervisor->spare, -1, sizeof supervisor->spare);
    supervisor->end = &supervisor->first;
    supervisor->bell = (struct doorbell){ring, supervisor};
    supervisor->post = (struct doorbell){write_or_wake, supervisor};
    supervisor->wake_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    pthread_mutex_init(&supervisor->lock, NULL);
    if (supervisor->wake_fd < 0 || pthread_create(&supervisor->thread, NULL, run, supervisor)) {
        abort();
    }
    return supervisor;
}

void supervisor_stop(struct supervisor *supervisor)
{
    if (supervisor && !atomic_exchange(&supervisor->stopping, true)) {
        supervisor_wake(supervisor);
        pthread_join(supervisor->thread, NULL);
    }
}

void supervisor_destroy(struct supervisor *supervisor)
{
    if (!supervisor) {
        return;
    }
    supervisor_stop(supervisor);
    close(supervisor->wake_fd);
    for (int i = 0; i < SPARE_PAIRS; i++) {
        if (supervisor->spare[i][0] >= 0) {
            close(supervisor->spare[i][0]);
            close(supervisor->spare[i][1]);
        }
    }
    pthread_mutex_destroy(&supervisor->lock);
    free(supervisor);
}
