/* SPDX-License-Identifier: MIT */
/* Value noise.
 *
 * The mixture goes by u = t^3 (10 - 15 t + 6 t^2) of each coordinate's fraction t (Perlin,
 * Improving noise, 2002), whose first two derivatives are 0 at both ends.
 *
 * How steep is it? Take a corner of the cell by chance, its coordinates by themselves, 1 with the
 * probability u. The noise is the expectation of the corner's number, and its derivative D by u is
 * the covariance with that coordinate, divided by u (1 - u). By Bessel's inequality the sum of
 * u (1 - u) D^2 over the axes is at most the expectation of the number's square, at most 1. The
 * derivative by t is u' D, and u'^2 is at most 225/16 of u (1 - u), most in the middle of the cell:
 * 900 t (1 - t) by (10 - 15 t + 6 t^2) (1 + 3 t + 6 t^2). So the slope is at most 15/4, which it is
 * halfway between two planes of -1 and 1. */
#include "noise.h"

#include <math.h>

#define SLOPE 3.75
#define PERIOD 65536.0

/* The finalizer of MurmurHash3 (Austin Appleby) over a sum of coordinates times odd numbers (primes
 * of xxHash, Yann Collet). */
double noise_lattice(uint32_t x, uint32_t y, uint32_t z, uint32_t seed)
{
    uint32_t h = x * UINT32_C(0x9e3779b1) + y * UINT32_C(0x85ebca77) + z * UINT32_C(0xc2b2ae3d) +
                 seed * UINT32_C(0x27d4eb2f);

    h = (h ^ h >> 16) * UINT32_C(0x85ebca6b);
    h = (h ^ h >> 13) * UINT32_C(0xc2b2ae35);
    h ^= h >> 16;
    return (h >> 8) * 0x1p-23 - 1; /* 24 bits: a float holds them */
}

static double mix(double a, double b, double t)
{
    return a + (b - a) * t;
}

static double row(const uint32_t x[2], uint32_t y, uint32_t z, double u, uint32_t seed)
{
    return mix(noise_lattice(x[0], y, z, seed), noise_lattice(x[1], y, z, seed), u);
}

double noise_value(const double p[3], uint32_t seed)
{
    uint32_t at[3][2];
    double u[3];

    for (int i = 0; i < 3; i++) {
        const double whole = floor(p[i]), t = p[i] - whole;
        at[i][0] = (uint32_t)(whole - PERIOD * floor(whole / PERIOD)) & 0xffff;
        at[i][1] = (at[i][0] + 1) & 0xffff;
        u[i] = t * t * t * (t * (t * 6 - 15) + 10);
    }
    double plane[2];
    for (int k = 0; k < 2; k++) {
        plane[k] = mix(row(at[0], at[1][0], at[2][k], u[0], seed),
                       row(at[0], at[1][1], at[2][k], u[0], seed), u[1]);
    }
    return mix(plane[0], plane[1], u[2]);
}

/* Octaves are shifted, so that their flat spots do not come together. */
double noise_octaves(const double p[3], int octaves, uint32_t seed)
{
    double q[3] = {p[0], p[1], p[2]}, height = 1, sum = 0;

    for (int i = 0; i < octaves; i++) {
        sum += height * noise_value(q, seed + (uint32_t)i);
        height /= 2;
        for (int j = 0; j < 3; j++) {
            q[j] = 2 * q[j] + 0.37;
        }
    }
    return sum;
}

double noise_greatest(double octaves)
{
    return 2 - exp2(1 - octaves);
}

/* Each octave is as steep as the first. */
double noise_slope(double octaves)
{
    return octaves * SLOPE;
}
