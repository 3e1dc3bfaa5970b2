/* SPDX-License-Identifier: MIT */
/* The table of what HTTP offers: method, path, handler. */
#ifndef SERVER_ROUTES_H
#define SERVER_ROUTES_H

#include "server/net/request.h"

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

/* The route of a request, whose captures are filled in. NULL: none, and `*out` says 404 or 405. */
const struct route *routes_find(struct request *request, struct response *out);

/* Handlers; each file knows one subject. */
void scenes_list(struct request *request);
void scenes_create(struct request *request);
void scenes_import(struct request *request);
void scenes_read(struct request *request);
void scenes_replace(struct request *request);
void scenes_edit(struct request *request);
void scenes_delete(struct request *request);
void scenes_live(struct request *request);
void scenes_poster(struct request *request);
void assets_list(struct request *request);
void assets_create(struct request *request);
void assets_read(struct request *request);
void assets_delete(struct request *request);
void images_of_scene(struct request *request);
void images_of_example(struct request *request);
void images_render(struct request *request);
void images_queue(struct request *request);
void pages_app(struct request *request);
void pages_asset(struct request *request);
void pages_examples(struct request *request);
void pages_example(struct request *request);
void pages_card(struct request *request);
void pages_reference(struct request *request);
void pages_schema(struct request *request);
void pages_health(struct request *request);
void pages_ready(struct request *request);
void pages_metrics(struct request *request);

#endif
