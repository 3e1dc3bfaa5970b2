/* SPDX-License-Identifier: MIT */
/* What the HTTP side gets from the layers that answer requests. */
#ifndef SERVER_HTTP_APP_H
#define SERVER_HTTP_APP_H

#include <stdatomic.h>
#include <stdbool.h>

struct access;
struct hub;
struct metrics;
struct route_table;
struct tasks;

/* All members outlive the http. */
struct http_app {
    const struct route_table *routes;
    const struct access *access;
    struct metrics *metrics;
    struct tasks *tasks;
    const atomic_bool *draining;   /* while true, guarded routes are refused */
    struct hub *hub;               /* opaque; passed to handlers with a request */
    void (*lock)(struct hub *hub); /* held when requests with `gone` are answered */
    void (*unlock)(struct hub *hub);
    bool (*scene_is_heavy)(struct hub *hub, const char *id); /* takes long to read, print or copy */
};

#endif
