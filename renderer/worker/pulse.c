/* SPDX-License-Identifier: MIT */
#include "pulse.h"

#include <poll.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "worker.h"

struct pulse {
    int fd, stop_fd;
    pthread_t thread;
    struct packet_reader in;

    pthread_mutex_t lock; /* guards what follows */
    struct pulse_news news;
    uint64_t steps; /* of the drawing thread */
};

static uint64_t resident_bytes(void)
{
    unsigned long pages = 0;
    FILE *statm = fopen("/proc/self/statm", "r");

    if (statm) {
        if (fscanf(statm, "%*u %lu", &pages) != 1) {
            pages = 0;
        }
        fclose(statm);
    }
    return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

/* Waits until it is sent; the front reads all the time. */
static void answer(struct pulse *pulse, int64_t ping)
{
    struct packet pong = {.kind = TO_FRONT_PONG, .pong = {.ping = ping}};
    size_t length, sent = 0;
    ssize_t got = 0;

    pthread_mutex_lock(&pulse->lock);
    pong.pong.steps = pulse->steps;
    pong.pong.idle = pulse->news.idle;
    pong.pong.counters = pulse->news.counters;
    pong.pong.pace = pulse->news.pace;
    pthread_mutex_unlock(&pulse->lock);
    pong.pong.resident_bytes = resident_bytes();
    uint8_t *bytes = packet_pack(PACKET_TO_FRONT, &pong, &length);
    while (sent < length && got >= 0) {
        got = send(pulse->fd, bytes + sent, length - sent, MSG_NOSIGNAL);
        sent += got > 0 ? (size_t)got : 0;
    }
    free(bytes);
}

/* False: the front is gone, or talks nonsense. */
static bool receive(struct pulse *pulse)
{
    uint8_t bytes[4096];
    const ssize_t got = recv(pulse->fd, bytes, sizeof bytes, 0);
    struct packet packet;
    int state;

    if (got <= 0) {
        return false;
    }
    packet_reader_add(&pulse->in, bytes, (size_t)got);
    while ((state = packet_reader_next(&pulse->in, PACKET_TO_WORKER, &packet)) == 1) {
        answer(pulse, packet.ping.ping);
        packet_finish(&packet);
    }
    return state == 0;
}

static void *run(void *data)
{
    struct pulse *pulse = data;
    struct pollfd fds[2] = {{.fd = pulse->fd, .events = POLLIN},
                            {.fd = pulse->stop_fd, .events = POLLIN}};

    while (!fds[1].revents) {
        if (poll(fds, 2, -1) > 0 && fds[0].revents && !receive(pulse)) {
            fds[0].fd = -1; /* the drawing thread notices it too */
        }
    }
    return NULL;
}

struct pulse *pulse_create(int fd)
{
    struct pulse *pulse = memory_alloc(1, sizeof *pulse);

    pulse->fd = fd;
    pulse->stop_fd = eventfd(0, EFD_CLOEXEC);
    pthread_mutex_init(&pulse->lock, NULL);
    if (fd >= 0 && (pulse->stop_fd < 0 || pthread_create(&pulse->thread, NULL, run, pulse) != 0)) {
        abort();
    }
    return pulse;
}

void pulse_destroy(struct pulse *pulse)
{
    if (!pulse) {
        return;
    }
    if (pulse->fd >= 0) {
        eventfd_write(pulse->stop_fd, 1);
        pthread_join(pulse->thread, NULL);
    }
    close(pulse->stop_fd);
    pthread_mutex_destroy(&pulse->lock);
    packet_reader_finish(&pulse->in);
    free(pulse);
}

void pulse_tell(struct pulse *pulse, const struct pulse_news *news)
{
    pthread_mutex_lock(&pulse->lock);
    pulse->news = *news;
    pulse->steps++;
    pthread_mutex_unlock(&pulse->lock);
}

void pulse_wake(struct pulse *pulse)
{
    pthread_mutex_lock(&pulse->lock);
    pulse->news.idle = false;
    pulse->steps++;
    pthread_mutex_unlock(&pulse->lock);
}
