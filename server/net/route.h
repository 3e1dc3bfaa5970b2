/* SPDX-License-Identifier: MIT */
/* A table of what HTTP offers: method, path, handler. Its rows are handed in. */
#ifndef SERVER_ROUTE_H
#define SERVER_ROUTE_H

#include "request.h"

enum route_body { BODY_NONE, BODY_JSON, BODY_FILE };

enum route_access {
    GUARDED, /* by the token, if there is one */
    OPEN,    /* to everybody */
    PAGE,    /* open, and pages of other sites may lead here */
};

/* The scene that a handler works on. Then it runs on a thread of the tasks. */
enum route_scene {
    SCENE_NONE,
    SCENE_NEW,   /* none that is there, or named in the body */
    SCENE_NAMED, /* by the first capture */
};

struct route {
    const char *method;  /* GET serves HEAD too */
    const char *pattern; /* "{}" matches an id, or what is left of one path segment */
    void (*handle)(struct request *request); /* replies now or later */
    enum route_body body;
    enum route_access access;
    enum route_scene scene;
};

struct route_table {
    const struct route *rows;
    size_t count;
    const struct route *file; /* of everything else that can be read outside of /v1/ */
};

/* The route of a request, whose captures are filled in. NULL: none, and `*out` says 404 or 405. */
const struct route *route_find(const struct route_table *table, struct request *request,
                               struct response *out);

#endif
