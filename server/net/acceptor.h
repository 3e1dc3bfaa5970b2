/* SPDX-License-Identifier: MIT */
/* The listening socket. It reads ahead each connection's first request head and refuses malformed,
 * late and surplus connections. Others go to the WebSocket or the HTTP side, which it does not
 * know.
 * accept -> [head complete within 5 s?] -> well formed? -> upgrade accepted? -> ws
 *                  | 408, 431                  | 400, 505         `-----------> http */
#ifndef SERVER_ACCEPTOR_H
#define SERVER_ACCEPTOR_H

#include <sys/socket.h>

#include "http_head.h"
#include "protocol/error.h"
#include "server/metrics.h"

struct acceptor;

/* All are called on the acceptor's thread. */
struct acceptor_events {
    void *data;
    /* True: takes `fd`, from which the head has been read. False: `http` gets it. */
    bool (*upgrade)(void *data, int fd, const struct http_head *head);
    /* Takes `fd`, from which nothing has been read. */
    void (*http)(void *data, int fd, const struct sockaddr *address, socklen_t length);
    /* Number of HTTP connections now; above `http_limit` new ones get 503. */
    int (*http_count)(void *data);
    int http_limit;
    /* Called when `watch_fd` becomes readable; -1: there is none. */
    int watch_fd;
    void (*watch)(void *data);
};

/* Listens and starts the thread. `address` is numeric. */
struct acceptor *acceptor_create(const char *address, int port,
                                 const struct acceptor_events *events, struct metrics *metrics,
                                 struct error *err);
int acceptor_port(const struct acceptor *acceptor);
/* Ends the thread; closes the listening socket and all connections that are still here. */
void acceptor_stop(struct acceptor *acceptor);
void acceptor_destroy(struct acceptor *acceptor);

#endif
