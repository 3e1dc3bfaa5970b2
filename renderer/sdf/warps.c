/* SPDX-License-Identifier: MIT */
/* What bends the space of its children, or adds to their distance, and so needs a factor: the
 * largest that there is for the parameters and the children's box. */
#include "noise.h"
#include "tools.h"

/* --- about an axis ---
 *
 * twist and bend: n = rate, radius of the children's cylinder about the axis, 1 / Lipschitz
 * constant, scale. They keep the distance from the axis, so what they make is in the cylinder too.
 * Inside it the norm of the Jacobian bounds the constant (Hart, section 3). Outside, the nearest
 * point of the cylinder stands in: projecting on a convex set lengthens no distance; what is
 * missing is added at a right angle. */
enum { RATE, RADIUS, PER_LIPSCHITZ, SCALE };

static double cylinder_radius(double radius)
{
    return isfinite(radius) ? radius * 1.0001 : SDF_TURN_RADIUS_MAX;
}

static double twist_radius(const struct bounds *child)
{
    return cylinder_radius(bounds_radius_y(child));
}

/* A shear by at most a = |rate| * radius: the greatest singular value of [[1, a], [0, 1]]. */
static double twist_lipschitz(double rate, double radius)
{
    const double a = fabs(rate) * radius;

    return (a + sqrt(a * a + 4)) / 2;
}

static void twist_prepare(const double *params, const struct bounds *child, double scale,
                          double *out_n)
{
    out_n[RATE] = params[0];
    out_n[RADIUS] = twist_radius(child);
    out_n[PER_LIPSCHITZ] = 1 / twist_lipschitz(params[0], out_n[RADIUS]);
    out_n[SCALE] = scale;
}

static struct bounds twist_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    const double radius = twist_radius(child);

    out.low[0] = out.low[2] = -radius;
    out.high[0] = out.high[2] = radius;
    out.stretch *= twist_lipschitz(params[0], radius);
    return out;
}

static void twist_map(const double p[3], const double *n, double out[3])
{
    const double inward = fmin(n[RADIUS] / fmax(hypot(p[0], p[2]), 1e-30), 1);
    const double x = p[0] * inward, z = p[2] * inward;
    const double c = cos(n[RATE] * p[1]), s = sin(n[RATE] * p[1]);

    out[0] = c * x - s * z;
    out[1] = p[1];
    out[2] = s * x + c * z;
}

static double twist_after(double d, const double p[3], const double *n)
{
    return corner(d * n[PER_LIPSCHITZ], (hypot(p[0], p[2]) - n[RADIUS]) * n[SCALE]);
}

static double bend_radius(const struct bounds *child)
{
    return cylinder_radius(bounds_radius_z(child));
}

/* The Jacobian is a rotation times 1 + u v^T, where v is along X and u has the length
 * |rate| * r; its norm is greatest where both point the same way, above or below the axis. */
static double bend_lipschitz(double rate, double radius)
{
    return 1 + fabs(rate) * radius;
}

static void bend_prepare(const double *params, const struct bounds *child, double scale,
                         double *out_n)
{
    out_n[RATE] = params[0];
    out_n[RADIUS] = bend_radius(child);
    out_n[PER_LIPSCHITZ] = 1 / bend_lipschitz(params[0], out_n[RADIUS]);
    out_n[SCALE] = scale;
}

static struct bounds bend_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    const double radius = bend_radius(child);

    out.low[0] = out.low[1] = -radius;
    out.high[0] = out.high[1] = radius;
    out.stretch *= bend_lipschitz(params[0], radius);
    return out;
}

static void bend_map(const double p[3], const double *n, double out[3])
{
    const double inward = fmin(n[RADIUS] / fmax(hypot(p[0], p[1]), 1e-30), 1);
    const double x = p[0] * inward, y = p[1] * inward;
    const double c = cos(n[RATE] * x), s = sin(n[RATE] * x);

    out[0] = c * x + s * y;
    out[1] = c * y - s * x;
    out[2] = p[2];
}

static double bend_after(double d, const double p[3], const double *n)
{
    return corner(d * n[PER_LIPSCHITZ], (hypot(p[0], p[1]) - n[RADIUS]) * n[SCALE]);
}

/* --- waves --- */

/* offset_space: n = amplitude, 1 / Lipschitz constant, frequency. */
enum { AMPLITUDE = 0, PER_FACTOR = 3, FREQUENCY = 4 };

/* The Jacobian is 1 plus a matrix with amplitude times frequency times a cosine at (x, y), (y, z)
 * and (z, x), so its norm is greatest where the cosines are 1 and nothing is below 0: it is that of
 * M. For any x > 0 the greatest ratio of (M^T M x) to x bounds the square of the norm (Collatz and
 * Wielandt); repeating it makes x the vector that is lengthened most. */
static double offset_lipschitz(const double *params)
{
    double a[3], x[3] = {1, 1, 1}, square = 0;

    for (int i = 0; i < 3; i++) {
        a[i] = fabs(params[i] * params[3 + i]);
    }
    for (int round = 0; round < 40; round++) {
        double y[3], z[3], longest = 0;
        for (int i = 0; i < 3; i++) {
            y[i] = x[i] + a[i] * x[(i + 1) % 3];
        }
        square = 0;
        for (int i = 0; i < 3; i++) {
            z[i] = y[i] + a[(i + 2) % 3] * y[(i + 2) % 3];
            square = fmax(square, z[i] / x[i]);
            longest = fmax(longest, z[i]);
        }
        for (int i = 0; i < 3; i++) {
            x[i] = fmax(z[i] / longest, 1e-100);
        }
    }
    return sqrt(square);
}

static void offset_prepare(const double *params, const struct bounds *child, double scale,
                           double *out_n)
{
    (void)child, (void)scale;
    for (int i = 0; i < 3; i++) {
        out_n[AMPLITUDE + i] = params[i];
        out_n[FREQUENCY + i] = params[3 + i];
    }
    out_n[PER_FACTOR] = 1 / offset_lipschitz(params);
}

static struct bounds offset_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;

    for (int i = 0; i < 3; i++) {
        out.low[i] -= fabs(params[i]);
        out.high[i] += fabs(params[i]);
    }
    out.stretch *= offset_lipschitz(params);
    return out;
}

static void offset_map(const double p[3], const double *n, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] + n[AMPLITUDE + i] * sin(n[FREQUENCY + i] * p[(i + 1) % 3]);
    }
}

static double offset_after(double d, const double p[3], const double *n)
{
    (void)p;
    return d * n[PER_FACTOR];
}

/* --- what is added to the distance ---
 *
 * With g added to it, of magnitude at most a and of slope at most s, the distance d becomes the
 * greater of two bounds: (d + g) / (1 + s), which has the surface, and d - a, which is better from
 * some way on. Both are no steeper than d, and where d + g < 0 the other is below 0 too. */

static struct bounds displaced_box(const double *params, const struct bounds *child)
{
    return bounds_grow(*child, params[0]);
}

/* displace: n = frequency, amplitude times scale, 1 / Lipschitz constant. The square of the sines'
 * slope is linear in the square of each sine, so it is greatest where each is 0 or 1: where one is
 * 0 and the others are 1. There it is that axis' frequency times the amplitude. */
static void displace_prepare(const double *params, const struct bounds *child, double scale,
                             double *out_n)
{
    (void)child;
    for (int i = 0; i < 3; i++) {
        out_n[i] = params[1 + i];
    }
    out_n[3] = params[0] * scale;
    out_n[4] = 1 / (1 + params[0] * fmax(params[1], fmax(params[2], params[3])));
}

static double displace_after(double d, const double p[3], const double *n)
{
    const double waves = sin(n[0] * p[0]) * sin(n[1] * p[1]) * sin(n[2] * p[2]);

    return fmax((d + n[3] * waves) * n[4], d - n[3]);
}

/* displace_noise: n = frequency, amplitude of the first octave times scale, octaves, seed, then
 * 1 / Lipschitz constant, amplitude times scale, where noise is of no account. */
enum { NOISE_FREQUENCY, FIRST, OCTAVES, SEED, PER_NOISE, GREATEST, FAR_OFF };

static void noise_prepare(const double *params, const struct bounds *child, double scale,
                          double *out_n)
{
    (void)child;
    const double amplitude = params[0], octaves = params[2],
                 first = amplitude / noise_greatest(octaves);
    const double slope = first * params[1] * noise_slope(octaves);

    out_n[NOISE_FREQUENCY] = params[1];
    out_n[FIRST] = first * scale;
    out_n[OCTAVES] = octaves;
    out_n[SEED] = params[3];
    out_n[PER_NOISE] = 1 / (1 + slope);
    out_n[GREATEST] = amplitude * scale;
    /* From here on d - a is the greater of the two bounds whatever the noise. */
    out_n[FAR_OFF] = amplitude > 0 ? fmin(amplitude * scale * (2 + slope) / slope, 1e30) : 0;
}

static double noise_after(double d, const double p[3], const double *n)
{
    const double q[3] = {n[NOISE_FREQUENCY] * p[0], n[NOISE_FREQUENCY] * p[1],
                         n[NOISE_FREQUENCY] * p[2]};
    const int octaves = d < n[FAR_OFF] ? (int)n[OCTAVES] : 0;
    const double g = n[FIRST] * noise_octaves(q, octaves, (uint32_t)n[SEED]);

    return fmax((d + g) * n[PER_NOISE], d - n[GREATEST]);
}

static int noise_trips(const double *params)
{
    return (int)params[2];
}

static const struct sdf_domain twist = {
    .vec4s = 1, .prepare = twist_prepare, .box = twist_box, .map = twist_map, .after = twist_after};
static const struct sdf_domain bend = {
    .vec4s = 1, .prepare = bend_prepare, .box = bend_box, .map = bend_map, .after = bend_after};
static const struct sdf_domain offset_space = {.vec4s = 2,
                                               .prepare = offset_prepare,
                                               .box = offset_box,
                                               .map = offset_map,
                                               .after = offset_after};
static const struct sdf_domain displace = {
    .vec4s = 2, .prepare = displace_prepare, .box = displaced_box, .after = displace_after};
static const struct sdf_domain displace_noise = {.vec4s = 2,
                                                 .prepare = noise_prepare,
                                                 .box = displaced_box,
                                                 .after = noise_after,
                                                 .trips = noise_trips};

const struct sdf sdf_warps[] = {
    {"twist", .domain = &twist},
    {"bend", .domain = &bend},
    {"offset_space", .domain = &offset_space},
    {"displace", .domain = &displace},
    {"displace_noise", .domain = &displace_noise},
    {.type = NULL},
};
