/* SPDX-License-Identifier: MIT */
/* Value noise: random numbers from -1 to 1 at the points with whole coordinates, and between them a
 * smooth mixture of the nearest eight. The same bits as in renderer/glsl/noise.glsl. It repeats
 * after 65536 units. */
#ifndef RENDERER_NOISE_H
#define RENDERER_NOISE_H

#include <stdint.h>

/* The number at a whole point, each coordinate from 0 to 65535. */
double noise_lattice(uint32_t x, uint32_t y, uint32_t z, uint32_t seed);
double noise_value(const double p[3], uint32_t seed);
/* Sum of octaves, each with twice the frequency and half of the height of the one before. */
double noise_octaves(const double p[3], int octaves, uint32_t seed);

/* The greatest magnitude and slope that noise_octaves can have. */
double noise_greatest(double octaves);
double noise_slope(double octaves);

#endif
