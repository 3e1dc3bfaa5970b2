/* SPDX-License-Identifier: MIT */
/* Patterns out of noise and cells. */
#include "patterns.h"

#include <math.h>
#include <stdbool.h>

#include "renderer/sdf/noise.h"

#define TINY 1e-30
#define PERIOD 65536.0 /* of noise */

static double wrap(double x, double period)
{
    return x - period * floor(x / period);
}

static double between_walls(double x)
{
    return x - copysign(PATTERN_WALL, x - 0.5);
}

/* Whether it is in a float; of others noise has no number. */
static bool is_place(const double *p)
{
    return fabs(p[0]) < 1e30 && fabs(p[1]) < 1e30 && fabs(p[2]) < 1e30;
}

/* There is a wall at 0.5, too. */
double pattern_stripes(double x)
{
    return wrap(x - copysign(PATTERN_WALL, x - 0.25), 1) < 0.5 ? 0 : 1;
}

void pattern_noise(double *out, const double *const in[], int n)
{
    (void)n;
    out[0] = is_place(in[0]) ? noise_value(in[0], 0) : NAN;
}

void pattern_fbm(double *out, const double *const in[], int n)
{
    (void)n;
    const int octaves = (int)fmin(fmax(in[1][0], 0), PATTERN_OCTAVES);

    out[0] = is_place(in[0]) ? noise_octaves(in[0], octaves, 0) : NAN;
}

void pattern_hash(double *out, const double *const in[], int n)
{
    uint32_t at[3] = {0};
    const bool is = is_place(in[0]);

    for (int i = 0; i < n && is; i++) {
        at[i] = (uint32_t)wrap(floor(between_walls(in[0][i])), PERIOD);
    }
    out[0] = is ? 0.5 + 0.5 * noise_lattice(at[0], at[1], at[2], 0) : NAN;
}

void pattern_checker(double *out, const double *const in[], int n)
{
    double sum = 0;

    for (int i = 0; i < n; i++) {
        sum += floor(between_walls(in[0][i]));
    }
    out[0] = wrap(sum, 2);
}

void pattern_triplanar(double *out, const double *const in[], int n)
{
    double greatest = TINY, sum = 0;

    for (int i = 0; i < n; i++) {
        greatest = fmax(greatest, fabs(in[0][i]));
    }
    for (int i = 0; i < n; i++) {
        const double x = in[0][i] / greatest;
        out[i] = x * x * x * x + TINY;
        sum += out[i];
    }
    for (int i = 0; i < n; i++) {
        out[i] /= sum;
    }
}
