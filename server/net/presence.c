/* SPDX-License-Identifier: MIT */
#include "presence.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stddef.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include "protocol/limits.h"

/* Probes of the kernel find a dead line only if no data waits for its acknowledgement; this limit
 * finds the others. It would close slow readers too, so it is lifted before an answer. */
static void limit_silence(int fd, unsigned seconds)
{
    const unsigned ms = 1000 * seconds;

    setsockopt(fd, IPPROTO_TCP, TCP_USER_TIMEOUT, &ms, sizeof ms);
}

bool presence_watch(int epoll, const struct presence *presence, void *data)
{
    struct epoll_event event = {.events = EPOLLRDHUP | EPOLLONESHOT, .data.ptr = data};

    limit_silence(presence->fd, LIMIT_LIVE_SILENCE);
    return epoll_ctl(epoll, EPOLL_CTL_ADD, presence->fd, &event) == 0;
}

void presence_unwatch(int epoll, const struct presence *presence)
{
    epoll_ctl(epoll, EPOLL_CTL_DEL, presence->fd, NULL);
    limit_silence(presence->fd, 0);
}

/* The line is free: all earlier answers were written before this request was read. */
static bool send_word(int fd)
{
    static const char word[] = "HTTP/1.1 100 Continue\r\n\r\n";
    const size_t length = sizeof word - 1;

    return send(fd, word, length, MSG_DONTWAIT | MSG_NOSIGNAL) == (ssize_t)length;
}

bool presence_has_left(int epoll, const struct presence *presence, uint32_t events, void *data)
{
    struct epoll_event resets = {.events = EPOLLONESHOT, .data.ptr = data};

    if ((events & (EPOLLERR | EPOLLHUP)) || !presence->reads_interim || !send_word(presence->fd)) {
        return true;
    }
    return epoll_ctl(epoll, EPOLL_CTL_MOD, presence->fd, &resets) != 0;
}
