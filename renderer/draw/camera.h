/* SPDX-License-Identifier: MIT */
/* A camera record as vectors: the same rays for the shaders (glsl/camera.glsl) and for picking. */
#ifndef RENDERER_CAMERA_H
#define RENDERER_CAMERA_H

#include <stdbool.h>

#include "protocol/scene.h"

struct camera {
    double eye[3], forward[3];
    double right[3], up[3]; /* half the width and height of the picture, at distance 1 if
                               perspective */
    double pixel_radius;    /* per unit of distance, or absolute if orthographic */
    double lens, focus;     /* radius; distance along `forward` that is in focus */
    bool orthographic;
};

struct camera camera_from_record(const struct record *record, int width, int height);
/* The ray through a place of the picture, in pixels from its left top. */
void camera_ray(const struct camera *camera, int width, int height, double x, double y,
                double out_origin[3], double out_direction[3]);

#endif
