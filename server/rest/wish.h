/* SPDX-License-Identifier: MIT */
/* What is asked of a picture over HTTP, as a query or as JSON: members of picture_type, a format,
 * and members of a camera, `camera.fov` in a query and {"camera": {"fov"}} in JSON. */
#ifndef SERVER_WISH_H
#define SERVER_WISH_H

#include "protocol/picture.h"
#include "protocol/scene.h"
#include "server/net/request.h"

struct wish {
    cJSON *picture; /* checked members of picture_type */
    bool aovs[AOV_COUNT];
    int format;    /* enum image_format */
    cJSON *camera; /* members that change the scene's camera; NULL: none */
    bool from_json;
};

/* The caller calls wish_finish also after a failure. */
bool wish_from_query(struct wish *wish, const struct request *request, const char *format,
                     struct error *err);
bool wish_from_json(struct wish *wish, const cJSON *json, struct error *err);
void wish_finish(struct wish *wish);

/* Pixels of the answer. */
void wish_size(const struct wish *wish, int *out_width, int *out_height);
/* The members of the order to the worker, with the scene's camera as changed. NULL and `err` where
 * those members are wrong. */
cJSON *wish_order(const struct wish *wish, const struct scene *scene, struct error *err);

#endif
