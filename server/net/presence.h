/* SPDX-License-Identifier: MIT */
/* Whether a client that waits for its answer is still connected. Two kinds of clients show the end
 * of input: one has left, the other has closed its half and waits. The server sends "100 Continue"
 * to tell them apart. A client that has left answers with a reset; a waiting client of HTTP/1.1 has
 * to skip it (RFC 9110, 15.2). A client of HTTP/1.0 counts as gone. */
#ifndef SERVER_PRESENCE_H
#define SERVER_PRESENCE_H

#include <stdbool.h>
#include <stdint.h>

struct presence {
    int fd;
    bool reads_interim; /* the client speaks HTTP/1.1 */
};

/* Adds the client to `epoll` with `data`. Nobody else may write to `fd` meanwhile. */
bool presence_watch(int epoll, const struct presence *presence, void *data);
void presence_unwatch(int epoll, const struct presence *presence);
/* Handles an event of `epoll`. True: the client has left. False: it is still watched. */
bool presence_has_left(int epoll, const struct presence *presence, uint32_t events, void *data);

#endif
