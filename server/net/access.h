/* SPDX-License-Identifier: MIT */
/* Access control by header values: Host (against DNS rebinding), Origin (against other pages),
 * token. Pure. */
#ifndef SERVER_ACCESS_H
#define SERVER_ACCESS_H

#include <stdbool.h>

#include "protocol/error.h"

struct access {
    bool loopback;     /* bound to loopback: Host must name this machine */
    const char *token; /* NULL: no token is needed */
    const char *const *allowed_origins, *const *allowed_hosts; /* end with NULL; may be NULL */
};

/* Header values, NULL where absent. */
struct access_request {
    const char *host, *origin, *authorization;
    const char *protocols; /* subprotocols offered by a WebSocket handshake */
    const char *site;      /* Sec-Fetch-Site: relation to the page that asks */
    bool to_page;          /* a browser follows a link to the page */
};

/* 0, or the HTTP status of the refusal (401, 403) with `err` filled. `open`: a resource that needs
 * no token (the page itself, health). */
int access_check(const struct access *access, const struct access_request *request, bool open,
                 struct error *err);
/* Whether an address such as "127.0.0.1" or "::1" is this machine's own. */
bool access_is_loopback(const char *address);

#endif
