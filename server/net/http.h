/* SPDX-License-Identifier: MIT */
/* The HTTP side: an adapter to libmicrohttpd with one thread of its own. It turns callbacks into
 * requests and replies, checks framing and access of every request, and bounds bodies in size and
 * time. Routes come from a table. */
#ifndef SERVER_HTTP_H
#define SERVER_HTTP_H

#include <sys/socket.h>

#include "http_app.h"
#include "protocol/error.h"

enum {
    HTTP_CONNECTIONS = 512,
    HTTP_IDLE_SECONDS = 15,
    HTTP_BODY_MS = 30000, /* for a whole body */
};

struct http;

struct http *http_create(const struct http_app *app, struct error *err);
/* Any thread; takes `fd`, from which nothing has been read. */
void http_adopt(struct http *http, int fd, const struct sockaddr *address, socklen_t length);
int http_count(const struct http *http);
/* Becomes readable when a waiting client may have left; then call http_check_gone. */
int http_gone_fd(const struct http *http);
void http_check_gone(struct http *http);
/* Waits at most `wait_ms` for running requests. */
void http_drain(struct http *http, int wait_ms);
void http_destroy(struct http *http);

#endif
