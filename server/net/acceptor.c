/* SPDX-License-Identifier: MIT */
/* Edge-triggered: with level triggering every peeked but incomplete head would spin. */
#include "acceptor.h"

#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "protocol/memory.h"
#include "safety.h"
#include "server/clock.h"
#include "server/log.h"

enum {
    HEAD_MS = 5000,
    LINGER_MS = 1000, /* reading on after a refusal, so that the reply is not lost to a reset */
    UNDECIDED_MAX = 512,
    SEND_BUFFER_LOW = 131072, /* unsent bytes stay with us, where they can be replaced */
    PROBE_AFTER = 5,          /* seconds of silence */
    PROBES = 3,
};

/* A socket not yet handed on. Each state has one constant time limit, so that its list is sorted
 * by deadline. */
enum client_state { WAITING, LINGERING, STATE_COUNT };

struct client {
    int fd;
    enum client_state state;
    size_t seen;
    int64_t deadline;
    struct sockaddr_storage address;
    socklen_t address_length;
    struct client *before, *after;
};

struct client_list {
    struct client *first, *last;
    int count;
};

struct acceptor {
    struct acceptor_events events;
    struct metrics *metrics;
    int listener, epoll, stop_fd, reserve_fd, port;
    pthread_t thread;
    bool running;
    struct client_list lists[STATE_COUNT];
    char bytes[LIMIT_HEAD_BYTES + 1];
    struct http_head head;
};

/* What epoll hands back for the descriptors that are no clients. */
static char listener_mark, stop_mark, watch_mark;

static void list_remove(struct client_list *list, struct client *client)
{
    *(client->before ? &client->before->after : &list->first) = client->after;
    *(client->after ? &client->after->before : &list->last) = client->before;
    list->count--;
}

static void list_append(struct client_list *list, struct client *client)
{
    client->before = list->last;
    client->after = NULL;
    *(list->last ? &list->last->after : &list->first) = client;
    list->last = client;
    list->count++;
}

/* Forgets the client; its descriptor stays open. */
static int release(struct acceptor *acceptor, struct client *client)
{
    const int fd = client->fd;

    epoll_ctl(acceptor->epoll, EPOLL_CTL_DEL, fd, NULL);
    list_remove(&acceptor->lists[client->state], client);
    free(client);
    return fd;
}

static const char *status_title(int status)
{
    switch (status) {
    case 408:
        return "Request Timeout";
    case 431:
        return "Request Header Fields Too Large";
    case 503:
        return "Service Unavailable";
    case 505:
        return "HTTP Version Not Supported";
    default:
        return "Bad Request";
    }
}

static void send_refusal(int fd, int status, const char *message)
{
#define LINE(name, value) name ": " value "\r\n"
    static const char safety[] = SAFETY_HEADERS(LINE);
#undef LINE
    char body[512], reply[1024];

    int body_length =
        snprintf(body, sizeof body,
                 "{\"type\":\"about:blank\",\"title\":\"%s\",\"status\":%d,"
                 "\"detail\":\"%s\",\"code\":\"%s\",\"place\":\"\"}\n",
                 status_title(status), status, message, status == 503 ? "unavailable" : "syntax");
    const int length = snprintf(reply, sizeof reply,
                                "HTTP/1.1 %d %s\r\nContent-Type: application/problem+json\r\n"
                                "Content-Length: %d\r\n%s%sConnection: close\r\n\r\n%s",
                                status, status_title(status), body_length, safety,
                                status == 503 ? "Retry-After: 1\r\n" : "", body);
    if (send(fd, reply, (size_t)length, MSG_DONTWAIT | MSG_NOSIGNAL) < 0) {
        log_debug("acceptor", "a refusal could not be sent: %s", strerror(errno));
    }
    shutdown(fd, SHUT_WR);
}

/* True: the other side has closed, or gone. */
static bool discard_input(struct acceptor *acceptor, int fd)
{
    for (int i = 0; i < 16; i++) {
        const ssize_t got = recv(fd, acceptor->bytes, sizeof acceptor->bytes, MSG_DONTWAIT);

        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
            return true;
        }
        if (got < 0) {
            return false;
        }
    }
    return true; /* it does not stop talking */
}

static void refuse(struct acceptor *acceptor, struct client *client, enum metric reason, int status,
                   const char *message)
{
    metric_add(acceptor->metrics, reason, 1);
    log_debug("acceptor", "refused with %d: %s", status, message);
    send_refusal(client->fd, status, message);
    if (discard_input(acceptor, client->fd)) {
        close(release(acceptor, client));
        return;
    }
    list_remove(&acceptor->lists[client->state], client);
    client->state = LINGERING;
    client->deadline = clock_ms() + LINGER_MS;
    list_append(&acceptor->lists[LINGERING], client);
}

static void hand_over(struct acceptor *acceptor, struct client *client)
{
    struct sockaddr_storage address = client->address;
    const socklen_t length = client->address_length;
    const int fd = release(acceptor, client);

    if (acceptor->events.upgrade(acceptor->events.data, fd, &acceptor->head)) {
        return;
    }
    acceptor->events.http(acceptor->events.data, fd, (struct sockaddr *)&address, length);
}

static void decide(struct acceptor *acceptor, struct client *client, size_t length)
{
    struct http_head_fault fault;

    if (!http_head_read(acceptor->bytes, length, &acceptor->head, &fault)) {
        refuse(acceptor, client, METRIC_CONNECTIONS_MALFORMED, fault.status, fault.message);
    } else if (acceptor->events.http_count(acceptor->events.data) >= acceptor->events.http_limit) {
        refuse(acceptor, client, METRIC_CONNECTIONS_OVER_LIMIT, 503,
               "too many connections are open");
    } else {
        hand_over(acceptor, client);
    }
}

/* RFC 9112, 2.2: empty lines in front of a request are skipped. */
static bool skip_empty_lines(struct acceptor *acceptor, struct client *client, ssize_t *length)
{
    ssize_t skip = 0;

    while (skip + 1 < *length && memcmp(acceptor->bytes + skip, "\r\n", 2) == 0) {
        skip += 2;
    }
    if (skip && recv(client->fd, acceptor->bytes, (size_t)skip, MSG_DONTWAIT) == skip) {
        *length = recv(client->fd, acceptor->bytes, LIMIT_HEAD_BYTES, MSG_PEEK | MSG_DONTWAIT);
        client->seen = 0;
    }
    return *length > 0;
}

static void look(struct acceptor *acceptor, struct client *client, bool ended)
{
    ssize_t length = recv(client->fd, acceptor->bytes, LIMIT_HEAD_BYTES, MSG_PEEK | MSG_DONTWAIT);

    if (length > 0 && !skip_empty_lines(acceptor, client, &length)) {
        length = -1;
        errno = EAGAIN;
    }
    if (length <= 0) {
        if (ended || length == 0 || errno != EAGAIN) {
            close(release(acceptor, client));
        }
        return;
    }
    const long head = http_head_end(acceptor->bytes, (size_t)length, client->seen);
    client->seen = (size_t)length;
    if (head > 0) {
        decide(acceptor, client, (size_t)head);
    } else if (head < 0) {
        refuse(acceptor, client, METRIC_CONNECTIONS_MALFORMED, 400,
               "the request head holds NUL, or CR or LF alone");
    } else if (length >= LIMIT_HEAD_BYTES) {
        refuse(acceptor, client, METRIC_CONNECTIONS_MALFORMED, 431, "the request head is too long");
    } else if (ended) {
        close(release(acceptor, client));
    }
}

/* Without a free descriptor: give up the reserve, so that the client gets an answer. */
static void refuse_for_descriptors(struct acceptor *acceptor)
{
    close(acceptor->reserve_fd);
    const int fd = accept4(acceptor->listener, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd >= 0) {
        metric_add(acceptor->metrics, METRIC_CONNECTIONS_OVER_DESCRIPTORS, 1);
        send_refusal(fd, 503, "no descriptor is free");
        discard_input(acceptor, fd);
        close(fd);
    }
    acceptor->reserve_fd = open("/dev/null", O_RDONLY | O_CLOEXEC);
}

/* Whose line is dead while nothing is to be written shows by probes alone: within the time that a
 * live connection may be silent. */
static void set_options(int fd)
{
    int one = 1, low = SEND_BUFFER_LOW, after = PROBE_AFTER, probes = PROBES;
    int every = (LIMIT_LIVE_SILENCE - PROBE_AFTER) / PROBES;

    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
    setsockopt(fd, SOL_SOCKET, SO_KEEPALIVE, &one, sizeof one);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPIDLE, &after, sizeof after);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPINTVL, &every, sizeof every);
    setsockopt(fd, IPPROTO_TCP, TCP_KEEPCNT, &probes, sizeof probes);
    setsockopt(fd, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &low, sizeof low);
}

static void admit(struct acceptor *acceptor, int fd, const struct sockaddr_storage *address,
                  socklen_t length)
{
    struct client *client = memory_alloc(1, sizeof *client);
    struct epoll_event event = {.events = EPOLLIN | EPOLLRDHUP | EPOLLET, .data.ptr = client};

    set_options(fd);
    client->fd = fd;
    client->address = *address;
    client->address_length = length;
    client->deadline = clock_ms() + HEAD_MS;
    list_append(&acceptor->lists[WAITING], client);
    if (epoll_ctl(acceptor->epoll, EPOLL_CTL_ADD, fd, &event) != 0) {
        refuse(acceptor, client, METRIC_CONNECTIONS_OVER_LIMIT, 503, "no event can be waited for");
    }
}

static void accept_clients(struct acceptor *acceptor)
{
    for (int i = 0; i < 64; i++) {
        struct sockaddr_storage address;
        socklen_t length = sizeof address;
        const int fd = accept4(acceptor->listener, (struct sockaddr *)&address, &length,
                               SOCK_NONBLOCK | SOCK_CLOEXEC);

        if (fd >= 0) {
            admit(acceptor, fd, &address, length);
        } else if (errno == EMFILE || errno == ENFILE) {
            refuse_for_descriptors(acceptor);
        } else if (errno != ECONNABORTED && errno != EINTR) {
            return;
        }
    }
}

static void expire(struct acceptor *acceptor)
{
    const int64_t now = clock_ms();
    struct client *client;

    while ((client = acceptor->lists[WAITING].first) && client->deadline <= now) {
        refuse(acceptor, client, METRIC_CONNECTIONS_LATE, 408,
               "the request head took longer than 5 seconds");
    }
    while ((client = acceptor->lists[LINGERING].first) && client->deadline <= now) {
        close(release(acceptor, client));
    }
}

/* Who is there to be served says what it wants within milliseconds; so those go that have waited
 * longest, never who has just come. Behind the events of a turn, which name clients. */
static void make_room(struct acceptor *acceptor)
{
    while (acceptor->lists[WAITING].count > UNDECIDED_MAX) {
        refuse(acceptor, acceptor->lists[WAITING].first, METRIC_CONNECTIONS_OVER_WAITING, 503,
               "too many connections wait for their request");
    }
    while (acceptor->lists[LINGERING].count > UNDECIDED_MAX) {
        close(release(acceptor, acceptor->lists[LINGERING].first));
    }
}

static int wait_ms(const struct acceptor *acceptor)
{
    int64_t next = 0, now = clock_ms();

    for (int i = 0; i < STATE_COUNT; i++) {
        if (acceptor->lists[i].first) {
            next = clock_earlier(next, acceptor->lists[i].first->deadline);
        }
    }
    return !next ? -1 : next <= now ? 0 : (int)(next - now);
}

static void handle(struct acceptor *acceptor, const struct epoll_event *event)
{
    const bool ended = event->events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR);

    if (event->data.ptr == &listener_mark) {
        accept_clients(acceptor);
    } else if (event->data.ptr == &watch_mark) {
        acceptor->events.watch(acceptor->events.data);
    } else {
        struct client *client = event->data.ptr;

        if (client->state == WAITING) {
            look(acceptor, client, ended);
        } else if (discard_input(acceptor, client->fd)) {
            close(release(acceptor, client));
        }
    }
}

static void *run(void *data)
{
    struct acceptor *acceptor = data;
    struct epoll_event events[64];

    for (;;) {
        const int count = epoll_wait(acceptor->epoll, events, 64, wait_ms(acceptor));

        for (int i = 0; i < count; i++) {
            if (events[i].data.ptr == &stop_mark) {
                return NULL;
            }
            handle(acceptor, &events[i]);
        }
        expire(acceptor);
        make_room(acceptor);
    }
}

static bool listen_on(struct acceptor *acceptor, const char *address, int port, struct error *err)
{
    struct addrinfo hints = {.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE,
                             .ai_socktype = SOCK_STREAM};
    struct addrinfo *info = NULL;
    struct sockaddr_storage bound;
    socklen_t length = sizeof bound;
    char service[16];
    int one = 1;

    snprintf(service, sizeof service, "%d", port);
    if (getaddrinfo(address, service, &hints, &info) != 0) {
        return error_set(err, ERROR_INVALID, address, "not an IPv4 or IPv6 address");
    }
    acceptor->listener = socket(info->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    const bool ok =
        acceptor->listener >= 0 &&
        setsockopt(acceptor->listener, SOL_SOCKET, SO_REUSEADDR, &one, sizeof one) == 0 &&
        bind(acceptor->listener, info->ai_addr, info->ai_addrlen) == 0 &&
        listen(acceptor->listener, 1024) == 0 &&
        getsockname(acceptor->listener, (struct sockaddr *)&bound, &length) == 0;
    freeaddrinfo(info);
    if (!ok) {
        return error_set(err, ERROR_UNAVAILABLE, address, "port %d cannot be listened on: %s", port,
                         strerror(errno));
    }
    acceptor->port = ntohs(bound.ss_family == AF_INET6 ? ((struct sockaddr_in6 *)&bound)->sin6_port
                                                       : ((struct sockaddr_in *)&bound)->sin_port);
    return true;
}

static bool epoll_add(struct acceptor *acceptor, int fd, void *mark)
{
    struct epoll_event event = {.events = EPOLLIN, .data.ptr = mark};

    return fd < 0 || epoll_ctl(acceptor->epoll, EPOLL_CTL_ADD, fd, &event) == 0;
}

struct acceptor *acceptor_create(const char *address, int port,
                                 const struct acceptor_events *events, struct metrics *metrics,
                                 struct error *err)
{
    struct acceptor *acceptor = memory_alloc(1, sizeof *acceptor);

    acceptor->events = *events;
    acceptor->metrics = metrics;
    acceptor->listener = -1;
    acceptor->epoll = epoll_create1(EPOLL_CLOEXEC);
    acceptor->stop_fd = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    acceptor->reserve_fd = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (!listen_on(acceptor, address, port, err)) {
        goto fail;
    }
    if (acceptor->epoll < 0 || acceptor->stop_fd < 0 ||
        !epoll_add(acceptor, acceptor->listener, &listener_mark) ||
        !epoll_add(acceptor, acceptor->stop_fd, &stop_mark) ||
        !epoll_add(acceptor, events->watch_fd, &watch_mark) ||
        pthread_create(&acceptor->thread, NULL, run, acceptor) != 0) {
        error_set(err, ERROR_INTERNAL, "acceptor", "cannot start: %s", strerror(errno));
        goto fail;
    }
    acceptor->running = true;
    return acceptor;
fail:
    acceptor_destroy(acceptor);
    return NULL;
}

int acceptor_port(const struct acceptor *acceptor)
{
    return acceptor->port;
}

static void close_fd(int *fd)
{
    if (*fd >= 0) {
        close(*fd);
    }
    *fd = -1;
}

void acceptor_stop(struct acceptor *acceptor)
{
    if (!acceptor || !acceptor->running) {
        return;
    }
    eventfd_write(acceptor->stop_fd, 1);
    pthread_join(acceptor->thread, NULL);
    acceptor->running = false;
    for (int i = 0; i < STATE_COUNT; i++) {
        while (acceptor->lists[i].first) {
            close(release(acceptor, acceptor->lists[i].first));
        }
    }
    close_fd(&acceptor->listener);
}

void acceptor_destroy(struct acceptor *acceptor)
{
    if (!acceptor) {
        return;
    }
    acceptor_stop(acceptor);
    close_fd(&acceptor->listener);
    close_fd(&acceptor->epoll);
    close_fd(&acceptor->stop_fd);
    close_fd(&acceptor->reserve_fd);
    free(acceptor);
}
