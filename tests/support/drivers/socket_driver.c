/* SPDX-License-Identifier: MIT */
/* A line that takes a little at a time: loaded in front of libc (LD_PRELOAD), it gives all sockets
 * the smallest buffers that the kernel has, so that writes are short as on a slow line. Every so
 * many-th wait (SOCKET_EVERY) is interrupted as by a signal. */
#include <dlfcn.h>
#include <errno.h>
#include <poll.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#define REAL(name) ((typeof(&name))dlsym(RTLD_NEXT, #name))

static bool is_interrupted(void)
{
    static int every, count;

    if (every == 0) {
        const char *text = getenv("SOCKET_EVERY");
        every = text ? atoi(text) : -1;
    }
    if (every <= 0 || __atomic_add_fetch(&count, 1, __ATOMIC_RELAXED) % every != 0) {
        return false;
    }
    errno = EINTR;
    return true;
}

static int made_small(int fd)
{
    const int least = 1;

    if (fd >= 0) {
        setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &least, sizeof least);
        setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &least, sizeof least);
    }
    return fd;
}

int accept(int fd, struct sockaddr *restrict address, socklen_t *restrict length)
{
    return made_small(REAL(accept)(fd, address, length));
}

int accept4(int fd, struct sockaddr *restrict address, socklen_t *restrict length, int flags)
{
    return made_small(REAL(accept4)(fd, address, length, flags));
}

int socketpair(int domain, int type, int protocol, int ends[2])
{
    const int result = REAL(socketpair)(domain, type, protocol, ends);

    if (result == 0) {
        made_small(ends[0]);
        made_small(ends[1]);
    }
    return result;
}

int poll(struct pollfd *fds, nfds_t count, int timeout_ms)
{
    return is_interrupted() ? -1 : REAL(poll)(fds, count, timeout_ms);
}

int epoll_wait(int fd, struct epoll_event *events, int most, int timeout_ms)
{
    return is_interrupted() ? -1 : REAL(epoll_wait)(fd, events, most, timeout_ms);
}
