/* SPDX-License-Identifier: MIT */
/* What the HTTP side is handed of those who answer. */
#ifndef SERVER_HTTP_APP_H
#define SERVER_HTTP_APP_H

#include <stdatomic.h>
#include <stdbool.h>

struct access;
struct hub;
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

#endif
