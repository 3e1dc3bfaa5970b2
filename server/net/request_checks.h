/* SPDX-License-Identifier: MIT */
/* What a request must pass before a handler sees it: framing, target, access, announced body.
 * Judges only; who calls sends the answer. Called by the thread of http only. */
#ifndef SERVER_REQUEST_CHECKS_H
#define SERVER_REQUEST_CHECKS_H

#include <stdint.h>

#include "request.h"

struct MHD_Connection;
struct http_app;
struct route;

/* Both: false, and `*out` is the answer. */
bool request_checks_framing(const struct request *request, struct MHD_Connection *connection,
                            const char *version, struct response *out);
/* `target` may be NULL, which is refused. `*out_route` is set for refused requests too, NULL where
 * there is none: how much of a body is read away depends on it. */
bool request_checks_pass(const struct http_app *app, struct request *request, const char *target,
                         const struct route **out_route, struct response *out);

/* `route` may be NULL. */
size_t request_checks_body_limit(const struct route *route);
/* 0 where no length is told. */
uint64_t request_checks_announced_bytes(const struct request *request);
bool request_checks_has_body(const struct request *request);

#endif
