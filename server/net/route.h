/* SPDX-License-Identifier: MIT */
/* A table of routes: method, path, handler. The layer above supplies its rows. */
#ifndef SERVER_ROUTE_H
#define SERVER_ROUTE_H

#include "request.h"

enum route_body { BODY_NONE, BODY_JSON, BODY_QUESTION /* JSON for the algebra */, BODY_FILE };

enum route_access {
    GUARDED, /* needs the token, if there is one */
    OPEN,    /* to everybody */
    PAGE,    /* open, also to links from pages of other sites */
};

/* The scene of a handler. With a scene, the handler runs on a thread of the tasks. */
enum route_scene {
    SCENE_NONE,
    SCENE_NEW,    /* a new one, one named in the body, or none: what is long to read */
    SCENE_NAMED,  /* named by the first capture */
    SCENE_ALL,    /* all of them: a heavy task */
    SCENE_JUDGED, /* named by the first capture and read alone: a heavy task, in no order */
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
    const struct route *file; /* for all other readable paths outside of /v1/ */
};

/* Finds the route of a request and fills in its captures. NULL: none; `*out` is a 404 or 405. */
const struct route *route_find(const struct route_table *table, struct request *request,
                               struct response *out);

#endif
