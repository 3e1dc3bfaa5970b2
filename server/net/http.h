/* SPDX-License-Identifier: MIT */
/* The HTTP side: an adapter to libmicrohttpd, with one thread of its own. Turns its callbacks into
 * requests and replies, checks framing and access of every request, bounds bodies in size and
 * time. Knows no route but by the table. */
#ifndef SERVER_HTTP_H
#define SERVER_HTTP_H

#include <stdatomic.h>
#include <sys/socket.h>

#include "protocol/error.h"

enum {
    HTTP_CONNECTIONS = 512,
    HTTP_IDLE_SECONDS = 15,
    HTTP_BODY_MS = 30000, /* for a whole body, however it trickles */
};

struct access;
struct hub;
struct http;
struct metrics;
struct route_table;
struct tasks;

/* Who answers the requests; all of it outlives the http. */
struct http_app {
    const struct route_table *routes;
    const struct access *access;
    struct metrics *metrics;
    struct tasks *tasks;
    const atomic_bool *draining;   /* what is guarded is refused */
    struct hub *hub;               /* that handlers get with a request; nothing is known of it */
    void (*lock)(struct hub *hub); /* under it the requests with a `gone` are answered */
    void (*unlock)(struct hub *hub);
    bool (*scene_is_heavy)(struct hub *hub, const char *id); /* to read, print or copy */
};

struct http *http_create(const struct http_app *app, struct error *err);
/* Any thread; takes `fd`, from which nothing has been read. */
void http_adopt(struct http *http, int fd, const struct sockaddr *address, socklen_t length);
int http_count(const struct http *http);
/* Readable when a client that waits for an answer has left; then call http_check_gone. */
int http_gone_fd(const struct http *http);
void http_check_gone(struct http *http);
/* Waits at most `wait_ms` for requests under way. */
void http_drain(struct http *http, int wait_ms);
void http_destroy(struct http *http);

#endif
