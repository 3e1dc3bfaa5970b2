/* SPDX-License-Identifier: MIT */
/* A line that takes a little at a time: loaded in front of libc (LD_PRELOAD), it gives all sockets
 * the smallest buffers that the kernel has, so that writes are short as on a slow line. Every so
 * many-th wait (SOCKET_EVERY) is interrupted as by a signal. The file SOCKET_FILE, which processes
 * share, counts what came of it: a number of eight bytes for each of `enum site`. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#define REAL(name) ((typeof(&name))dlsym(RTLD_NEXT, #name))

enum site {
    SMALL_ACCEPTED,
    SMALL_PAIRS,
    SHORT_SENDS,
    INTERRUPTED_POLLS,
    INTERRUPTED_EPOLLS,
    SITES
};

static long numbers[SITES]; /* where there is no file */
static long *counts = numbers;

__attribute__((constructor)) static void open_file(void)
{
    const char *path = getenv("SOCKET_FILE");
    const int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *bytes =
        fd < 0 ? MAP_FAILED : mmap(NULL, sizeof numbers, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);

    if (bytes != MAP_FAILED) {
        counts = bytes;
    }
    if (fd >= 0) {
        close(fd);
    }
}

static void count(enum site site)
{
    __atomic_add_fetch(&counts[site], 1, __ATOMIC_RELAXED);
}

static bool is_interrupted(enum site site)
{
    static int every, waits;

    if (every == 0) {
        const char *text = getenv("SOCKET_EVERY");
        every = text ? atoi(text) : -1;
    }
    if (every <= 0 || __atomic_add_fetch(&waits, 1, __ATOMIC_RELAXED) % every != 0) {
        return false;
    }
    count(site);
    errno = EINTR;
    return true;
}

static int made_small(int fd, enum site site)
{
    const int least = 1;

    if (fd >= 0) {
        count(site);
        setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &least, sizeof least);
        setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &least, sizeof least);
    }
    return fd;
}

int accept(int fd, struct sockaddr *restrict address, socklen_t *restrict length)
{
    return made_small(REAL(accept)(fd, address, length), SMALL_ACCEPTED);
}

int accept4(int fd, struct sockaddr *restrict address, socklen_t *restrict length, int flags)
{
    return made_small(REAL(accept4)(fd, address, length, flags), SMALL_ACCEPTED);
}

int socketpair(int domain, int type, int protocol, int ends[2])
{
    const int result = REAL(socketpair)(domain, type, protocol, ends);

    if (result == 0) {
        made_small(ends[0], SMALL_PAIRS);
        made_small(ends[1], SMALL_PAIRS);
    }
    return result;
}

ssize_t send(int fd, const void *bytes, size_t length, int flags)
{
    const ssize_t sent = REAL(send)(fd, bytes, length, flags);

    if (sent >= 0 && (size_t)sent < length) {
        count(SHORT_SENDS);
    }
    return sent;
}

int poll(struct pollfd *fds, nfds_t count, int timeout_ms)
{
    return is_interrupted(INTERRUPTED_POLLS) ? -1 : REAL(poll)(fds, count, timeout_ms);
}

int epoll_wait(int fd, struct epoll_event *events, int most, int timeout_ms)
{
    return is_interrupted(INTERRUPTED_EPOLLS) ? -1 : REAL(epoll_wait)(fd, events, most, timeout_ms);
}
