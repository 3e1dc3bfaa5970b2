/* SPDX-License-Identifier: MIT */
/* The rays of a camera, made by themselves: no code of the product is asked. */
#ifndef TESTS_SUPPORT_EYE_H
#define TESTS_SUPPORT_EYE_H

#include "protocol/record.h"

/* Where the rays begin. */
struct eye {
    double place[3], forward[3], right[3], up[3]; /* of length 1 */
    double half;                                  /* of the picture's height, at distance 1 */
    bool parallel;
};

struct eye eye_of(const struct record *camera);
/* Through the centre of the pixel in column x and row y. `direction` gets the length 1. */
void eye_ray(const struct eye *eye, int width, int height, int x, int y, double origin[3],
             double direction[3]);
/* Half a pixel in radius, where a ray has come so far. */
double eye_footprint(const struct eye *eye, int height, double t);

#endif
