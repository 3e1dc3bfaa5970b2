/* SPDX-License-Identifier: MIT */
#include "presence.h"

#include <stddef.h>
#include <sys/epoll.h>
#include <sys/socket.h>

bool presence_watch(int epoll, const struct presence *presence, void *data)
{
    struct epoll_event event = {.events = EPOLLRDHUP | EPOLLONESHOT, .data.ptr = data};

    return epoll_ctl(epoll, EPOLL_CTL_ADD, presence->fd, &event) == 0;
}

void presence_unwatch(int epoll, const struct presence *presence)
{
    epoll_ctl(epoll, EPOLL_CTL_DEL, presence->fd, NULL);
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
