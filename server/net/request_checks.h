/* SPDX-License-Identifier: MIT */
/* The checks of a request before its handler runs: framing, target, access, announced body. They
 * only judge; the caller sends the answer. Called on the thread of http alone. */
#ifndef SERVER_REQUEST_CHECKS_H
#define SERVER_REQUEST_CHECKS_H

#include <stdint.h>

#include "request.h"

struct MHD_Connection;
struct http_app;
struct route;

/* Both return false where the request is refused; `*out` is the answer then. */
bool request_checks_framing(const struct request *request, struct MHD_Connection *connection,
                            const char *version, struct response *out);
/* A `target` of NULL is refused. `*out_route` is set for refused requests too, because the length
 * of a body that is discarded depends on it; NULL: no route. */
bool request_checks_pass(const struct http_app *app, struct request *request, const char *target,
                         const struct route **out_route, struct response *out);

/* `route` may be NULL. */
size_t request_checks_body_limit(const struct route *route);
/* 0 where the request announces no length. */
uint64_t request_checks_announced_bytes(const struct request *request);
bool request_checks_has_body(const struct request *request);

#endif
