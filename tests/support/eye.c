/* SPDX-License-Identifier: MIT */
#include "eye.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void to_unit(double v[3])
{
    const double length = sqrt(dot(v, v));

    for (int i = 0; i < 3; i++) {
        v[i] /= length;
    }
}

struct eye eye_of(const struct record *camera)
{
    struct eye eye = {.parallel = record_is(camera, "type", "orthographic")};
    const double *target = record_vector(camera, "target");

    memcpy(eye.place, record_vector(camera, "position"), sizeof eye.place);
    for (int i = 0; i < 3; i++) {
        eye.forward[i] = target[i] - eye.place[i];
    }
    to_unit(eye.forward);
    cross(eye.forward, record_vector(camera, "up"), eye.right);
    to_unit(eye.right);
    cross(eye.right, eye.forward, eye.up);
    eye.half = eye.parallel ? record_number(camera, "height") / 2
                            : tan(record_number(camera, "fov") / 2 * M_PI / 180);
    return eye;
}

void eye_ray(const struct eye *eye, int width, int height, int x, int y, double origin[3],
             double direction[3])
{
    const double pixel = 2 * eye->half / height;
    const double right = pixel * (x + 0.5 - width / 2.0), up = pixel * (height / 2.0 - y - 0.5);

    for (int i = 0; i < 3; i++) {
        const double aside = right * eye->right[i] + up * eye->up[i];
        origin[i] = eye->place[i] + (eye->parallel ? aside : 0);
        direction[i] = eye->forward[i] + (eye->parallel ? 0 : aside);
    }
    to_unit(direction);
}

double eye_footprint(const struct eye *eye, int height, double t)
{
    return eye->half / height * (eye->parallel ? 1 : t);
}
