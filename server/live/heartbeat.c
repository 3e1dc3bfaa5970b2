/* SPDX-License-Identifier: MIT */
#include "heartbeat.h"

#include <errno.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

#include "protocol/messages.h"

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
    cJSON *packet = cJSON_CreateObject();
    size_t length;
    uint8_t *bytes;
    ssize_t sent = 0;

    cJSON_AddStringToObject(packet, "type", "ping");
    cJSON_AddNumberToObject(packet, "ping", (double)now_ms);
    bytes = packet_pack(packet, NULL, 0, &length);
    if (heartbeat->fd >= 0) {
        sent = send(heartbeat->fd, bytes, length, MSG_DONTWAIT | MSG_NOSIGNAL);
    }
    /* One that does not fit is not needed, one that is cut off would spoil all that follow. */
    if (sent > 0 && (size_t)sent < length) {
        heartbeat_finish(heartbeat);
    }
    free(bytes);
    cJSON_Delete(packet);
}

/* A line that ends says nothing: the worker's other one does. */
void heartbeat_receive(struct heartbeat *heartbeat)
{
    uint8_t bytes[4096];
    const ssize_t got = recv(heartbeat->fd, bytes, sizeof(bytes), MSG_DONTWAIT);

    if (got > 0) {
        packet_reader_add(&heartbeat->reader, bytes, (size_t)got);
    } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        heartbeat_finish(heartbeat);
    }
}

bool heartbeat_next(struct heartbeat *heartbeat, struct packet *out, bool *out_alive)
{
    int64_t steps;

    if (packet_reader_next(&heartbeat->reader, out) != 1) {
        return false;
    }
    steps = (int64_t)json_member_number(out->json, "steps", 0);
    *out_alive = steps != heartbeat->steps || json_member_bool(out->json, "idle", false);
    heartbeat->steps = steps;
    return true;
}
