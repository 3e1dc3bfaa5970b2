/* SPDX-License-Identifier: MIT */
#include "heartbeat.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

void heartbeat_init(struct heartbeat *heartbeat, int fd)
{
    *heartbeat = (struct heartbeat){.fd = fd};
}

void heartbeat_finish(struct heartbeat *heartbeat)
{
    if (heartbeat->fd >= 0) {
        close(heartbeat->fd);
    }
    packet_reader_finish(&heartbeat->reader);
    heartbeat_init(heartbeat, -1);
}

void heartbeat_ask(struct heartbeat *heartbeat, int64_t now_ms)
{
    const struct packet packet = {.kind = TO_WORKER_PING, .ping = {now_ms}};
    size_t length;
    uint8_t *bytes = packet_pack(PACKET_TO_WORKER, &packet, &length);
    ssize_t sent = 0;

    if (heartbeat->fd >= 0) {
        sent = send(heartbeat->fd, bytes, length, MSG_DONTWAIT | MSG_NOSIGNAL);
    }
    /* One that does not fit is not needed, one that is cut off would spoil all that follow. */
    if (sent > 0 && (size_t)sent < length) {
        heartbeat_finish(heartbeat);
    }
    free(bytes);
}

/* A line that ends says nothing: the worker's other one does. */
void heartbeat_receive(struct heartbeat *heartbeat)
{
    uint8_t bytes[4096];
    const ssize_t got = recv(heartbeat->fd, bytes, sizeof bytes, MSG_DONTWAIT);

    if (got > 0) {
        packet_reader_add(&heartbeat->reader, bytes, (size_t)got);
    } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        heartbeat_finish(heartbeat);
    }
}

bool heartbeat_next(struct heartbeat *heartbeat, struct packet_pong *out, bool *out_alive)
{
    struct packet packet;

    if (packet_reader_next(&heartbeat->reader, PACKET_TO_FRONT, &packet) != 1) {
        return false;
    }
    *out = packet.pong;
    packet_finish(&packet);
    *out_alive = out->steps != heartbeat->steps || out->idle;
    heartbeat->steps = out->steps;
    return true;
}
