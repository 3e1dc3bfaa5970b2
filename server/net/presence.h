/* SPDX-License-Identifier: MIT */
/* Whether a client that waits for its answer is still there. One that has left and one that has
 * closed its half and waits both show as the end of input; a word tells them apart, because who has
 * left answers it by a reset: "100 Continue", which clients of HTTP/1.1 have to read over (RFC
 * 9110, 15.2). One of HTTP/1.0 is taken for gone. */
#ifndef SERVER_PRESENCE_H
#define SERVER_PRESENCE_H

#include <stdbool.h>
#include <stdint.h>

struct presence {
    int fd;
    bool reads_interim; /* the client speaks HTTP/1.1 */
};

/* From now on `epoll` tells of the client by `data`. Nobody else writes to `fd` meanwhile. */
bool presence_watch(int epoll, const struct presence *presence, void *data);
void presence_unwatch(int epoll, const struct presence *presence);
/* What `epoll` told: true when the client has left; otherwise it is watched on. */
bool presence_has_left(int epoll, const struct presence *presence, uint32_t events, void *data);

#endif
