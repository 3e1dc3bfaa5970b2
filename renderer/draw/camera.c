/* SPDX-License-Identifier: MIT */
/* From position, target, up to a basis; degenerate inputs get some basis, never NaN. */
#include "camera.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* False for what has no direction. */
static bool normalize(double v[3])
{
    const double length = sqrt(dot(v, v));

    if (!(length > 1e-12)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
    return true;
}

/* From the eye to the target, or 1. */
static double target_distance(const struct record *record)
{
    const double *a = record_vector(record, "position"), *b = record_vector(record, "target");
    const double way[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double distance = sqrt(dot(way, way));

    return distance > 1e-6 ? distance : 1;
}

/* Right-handed: right, up, -forward. */
static void make_basis(const struct record *record, double forward[3], double right[3],
                       double up[3])
{
    const double *position = record_vector(record, "position");
    const double *target = record_vector(record, "target");
    const double *wanted = record_vector(record, "up");
    const double ways[3][3] = {
        {wanted[0], wanted[1], wanted[2]}, {0, 0, -1}, {1, 0, 0}}; /* looking along `up` */

    for (int i = 0; i < 3; i++) {
        forward[i] = target[i] - position[i];
    }
    if (!normalize(forward)) {
        forward[0] = forward[1] = 0;
        forward[2] = -1;
    }
    for (int i = 0; i < 3; i++) {
        cross(forward, ways[i], right);
        if (sqrt(dot(right, right)) > 1e-6 * sqrt(dot(ways[i], ways[i])) && normalize(right)) {
            break;
        }
    }
    cross(right, forward, up);
}

struct camera camera_from_record(const struct record *record, int width, int height)
{
    struct camera camera = {0};
    double half;

    camera.orthographic = record_is(record, "type", "orthographic");
    half = camera.orthographic ? record_number(record, "height") / 2
                               : tan(record_number(record, "fov") * M_PI / 360);
    memcpy(camera.eye, record_vector(record, "position"), sizeof camera.eye);
    make_basis(record, camera.forward, camera.right, camera.up);
    for (int i = 0; i < 3; i++) {
        camera.right[i] *= half * width / height;
        camera.up[i] *= half;
    }
    camera.pixel_radius = half / height;
    camera.lens = record_number(record, "aperture");
    camera.focus = record_number(record, "focus");
    camera.focus = camera.focus > 0 ? camera.focus : target_distance(record);
    return camera;
}

void camera_ray(const struct camera *camera, int width, int height, double x, double y,
                double out_origin[3], double out_direction[3])
{
    const double u = 2 * x / width - 1, v = 1 - 2 * y / height;

    for (int i = 0; i < 3; i++) {
        const double aside = camera->right[i] * u + camera->up[i] * v;
        out_origin[i] = camera->eye[i] + (camera->orthographic ? aside : 0);
        out_direction[i] = camera->forward[i] + (camera->orthographic ? 0 : aside);
    }
    normalize(out_direction);
}
