/* SPDX-License-Identifier: MIT */
/* Fractals, minimal surfaces, landscapes: what has loops in it. */
#include <stdbool.h>
#include <stdint.h>

#include "tools.h"

#define PI 3.141592653589793

static double box(const double p[3], double x, double y, double z)
{
    double q[3] = {fabs(p[0]) - x / 2, fabs(p[1]) - y / 2, fabs(p[2]) - z / 2};

    return length3(fmax(q[0], 0), fmax(q[1], 0), fmax(q[2], 0)) +
           fmin(fmax(q[0], fmax(q[1], q[2])), 0);
}

/* --- gyroid --- */

static double gyroid(const double p[3], const double *n)
{
    double s[3], c[3];

    for (int i = 0; i < 3; i++) {
        const double turns = p[i] / n[0];
        s[i] = sin(2 * PI * (turns - round(turns)));
        c[i] = cos(2 * PI * (turns - round(turns)));
    }
    const double g = s[0] * c[1] + s[1] * c[2] + s[2] * c[0];
    return fmax(box(p, n[2], n[3], n[4]), fabs(g) * n[0] / (2 * PI * sqrt(3)) - n[1] / 2);
}

static struct bounds gyroid_box(const double *n)
{
    return bounds_centred(n[2] / 2, n[3] / 2, n[4] / 2);
}

/* --- menger --- */

/* Of each level, bars along the three axes through the middle of every cell are taken out. A point
 * is in one of them as deep as the middle one of its three coordinates; the nearest cell is the
 * own one, as all is symmetric to the walls. */
static double menger(const double p[3], const double *n)
{
    double d = box(p, n[0], n[0], n[0]), cell = n[0], q[3] = {p[0], p[1], p[2]};

    for (int level = 0; level < (int)n[1]; level++, cell /= 3) {
        double a[3];
        for (int i = 0; i < 3; i++) {
            q[i] -= cell * round(q[i] / cell);
            a[i] = fabs(q[i]);
        }
        const double middle = fmax(fmin(a[0], a[1]), fmin(fmax(a[0], a[1]), a[2]));
        d = fmax(d, cell / 6 - middle);
    }
    return d;
}

static struct bounds menger_box(const double *n)
{
    return bounds_centred(n[0] / 2, n[0] / 2, n[0] / 2);
}

static int menger_trips(const double *n)
{
    return (int)n[1];
}

/* --- fractals of orbits ---
 *
 * Solid is where an orbit of N steps has not left the ball around the origin out of which there is
 * no way back. For the distance, not one point but a ball of radius e_0 around it is followed: step
 * by step it lies in a ball around the orbit, whose radius e_k comes from the greatest slope of the
 * step in the ball before. The field is the largest e_0 such that the ball, in some step, lies
 * outside of that no-return ball as a whole (or inside of it in the last step, for a point inside).
 * Thus it never exceeds the distance. Of smaller balls inside of others the same holds in every
 * step, so it also changes no faster than the distance. */

enum { JULIA_ITERATIONS = 20, BULB_ITERATIONS = 12, BULB_TRIALS = 16 };

/* |(q + e)^2 - q^2| <= (|q| + e)^2 - |q|^2, which can be solved for e: from the last step back to
 * the first. Steps after |q| has passed twice the edge can only lower the result. */
static double julia(const double p[3], const double *n)
{
    const double edge = (1 + sqrt(1 + 4 * hypot(hypot(n[0], n[1]), hypot(n[2], n[3])))) / 2;
    double radius[JULIA_ITERATIONS + 1], q[4] = {p[0], p[1], p[2], 0};
    int last = 0;

    radius[0] = length3(p[0], p[1], p[2]);
    while (last < (int)n[4] && radius[last] < 2 * edge) {
        const double real = 2 * q[0];
        q[0] = q[0] * q[0] - q[1] * q[1] - q[2] * q[2] - q[3] * q[3] + n[0];
        for (int i = 1; i < 4; i++) {
            q[i] = real * q[i] + n[i];
        }
        radius[++last] = hypot(hypot(q[0], q[1]), hypot(q[2], q[3]));
    }
    double e = radius[last] - edge;
    while (last-- > 0) {
        const double r = radius[last];
        e = fmax(e / fmax(sqrt(r * r + fabs(e)) + r, 1e-15), r - edge);
    }
    return e;
}

static struct bounds julia_box(const double *n)
{
    const double edge = (1 + sqrt(1 + 4 * hypot(hypot(n[0], n[1]), hypot(n[2], n[3])))) / 2;

    return bounds_centred(edge, edge, edge);
}

static int julia_trips(const double *n)
{
    return 2 * (int)n[4];
}

struct orbit {
    double power, edge;
    int last;
    /* Of each step: distance from the origin, from the Y axis, and half of the slope there. */
    double radius[BULB_ITERATIONS + 1], axis[BULB_ITERATIONS + 1], slope[BULB_ITERATIONS + 1];
};

/* z^power, turned in latitude and longitude around Y by `power` times their angles. */
static void bulb_power(double z[3], double r, double a, int power)
{
    double axis = fmax(a, 1e-30), turn[2] = {1, 0}, around[2] = {1, 0};

    for (int i = 0; i < power; i++) {
        const double t = turn[0] * z[1] - turn[1] * a, s = around[0] * z[2] - around[1] * z[0];
        turn[1] = (turn[1] * z[1] + turn[0] * a) / fmax(r, 1e-30);
        turn[0] = t / fmax(r, 1e-30);
        around[1] = (around[1] * z[2] + around[0] * z[0]) / axis;
        around[0] = s / axis;
    }
    const double length = pow(r, power);
    z[0] = length * turn[1] * around[1];
    z[1] = length * turn[0];
    z[2] = length * turn[1] * around[0];
}

static void follow(struct orbit *orbit, const double p[3], int iterations)
{
    double z[3] = {p[0], p[1], p[2]};

    for (int i = 0;; i++) {
        const double r = length3(z[0], z[1], z[2]), a = hypot(z[0], z[2]);
        orbit->last = i;
        orbit->radius[i] = r;
        orbit->axis[i] = a;
        orbit->slope[i] = orbit->power / 2 * pow(r, orbit->power - 1);
        if (i == iterations || r >= 2 * orbit->edge) {
            return;
        }
        bulb_power(z, r, a, (int)orbit->power);
        for (int j = 0; j < 3; j++) {
            z[j] += p[j];
        }
    }
}

/* How large the ball around the point may be if in each step its image grew as that of a ball of
 * radius `ball` does. This falls with `ball`, so the two enclose the answer.
 *
 * The slope of z^power is power r^(power - 1), and across the axis up to `power` times that: as
 * much as |sin(power t) / sin t| <= 1 / sin t, where t is the angle to the axis. It is convex along
 * a radius, so the mean of both ends bounds it on the way between them. */
static double reach(const struct orbit *orbit, double ball)
{
    const bool inside = orbit->radius[orbit->last] <= orbit->edge;
    double grown = 1, best = 0; /* how much larger the ball is than at first */

    for (int i = 0; i <= orbit->last; i++) {
        const double r = orbit->radius[i], room = inside ? orbit->edge - r : r - orbit->edge;
        best = !inside || i == orbit->last ? fmax(best, room / grown) : 0;
        const double e = ball * grown;
        const double stretch = fmin((r + e) / fmax(orbit->axis[i] - e, 1e-30), orbit->power);
        const double far = orbit->power / 2 * pow(r + e, orbit->power - 1);
        grown = fmin(stretch * (orbit->slope[i] + far) * grown + 1, 1e30);
    }
    return best;
}

/* The ball that equals its reach, between bounds that close on it, by the secant of logarithms: the
 * last trials of many are as near as numbers are. What is returned is always a lower bound. */
static double mandelbulb(const double p[3], const double *n)
{
    struct orbit orbit = {.power = n[0], .edge = exp2(1 / (n[0] - 1))};

    follow(&orbit, p, (int)n[1]);
    /* Where |p| <= r - r^power for some r, orbits stay below that r. */
    const double core = (n[0] - 1) * pow(n[0], n[0] / (1 - n[0])) - orbit.radius[0];
    double ball = reach(&orbit, 0), low = fmax(core, 0), high = ball, before = 0, step = 0;
    for (int i = 0; i < BULB_TRIALS && low < high; i++) {
        double found = reach(&orbit, ball), error = log(fmax(found, 1e-30) / ball);
        low = fmax(low, fmin(found, ball));
        high = fmin(high, fmax(found, ball));
        if (fabs(error) < 1e-12) {
            break;
        }
        error = error < 0 ? -log(1 - error) : error; /* far off it is exponential */
        step = i > 0 && error != before ? error * step / (before - error) : error / 2;
        step = clamp(step, -1.5, 1.5);
        before = error;
        const double next = clamp(ball * exp(step), low, high);
        step = log(next / ball);
        ball = next;
    }
    return orbit.radius[orbit.last] <= orbit.edge ? -low : low;
}

/* |z^power| - |p| > |z| outside of the edge, where |z| >= |p|. */
static struct bounds mandelbulb_box(const double *n)
{
    const double edge = exp2(1 / (n[0] - 1));

    return bounds_centred(edge, edge, edge);
}

static int mandelbulb_trips(const double *n)
{
    return (int)(n[1] + 1) * (BULB_TRIALS + 2) + BULB_TRIALS;
}

/* --- terrain --- */

/* A number from 0 to 1 for each corner of a lattice; the same bits in GLSL. The mixing is that of
 * Chris Wellons, Prospecting for hash functions, nullprogram.com/blog/2018/07/31. */
static double corner_height(int32_t x, int32_t z, uint32_t seed)
{
    uint32_t h = (uint32_t)x * 0x9e3779b1u + (uint32_t)z * 0x85ebca77u + seed * 0xc2b2ae3du;

    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return (double)((h ^ h >> 16) >> 8) / 16777215;
}

/* Heights between the corners of a lattice of cells of length 1. The slope is less than 1.6: with
 * heights in [0, 1] it is greatest for heights of 0 and 1, as it is convex in them. Two equal sides
 * give 1.5 at most, which is the slope of the smooth step s(t). With one corner apart, the square
 * is s'(x)^2 a^2 + s'(z)^2 b^2 for b = 1 - s(x), a = 1 - s(z), and s'(x)^2 <= 12 b (1 - b): at most
 * 24 (3/4)^3 / 4. With two opposite corners apart, it is at most 1.5 again. */
static double value_noise(double x, double z, uint32_t seed)
{
    double i = floor(x), j = floor(z), u = x - i, v = z - j;

    u *= u * (3 - 2 * u);
    v *= v * (3 - 2 * v);
    const double near_left = corner_height((int32_t)i, (int32_t)j, seed);
    const double near_right = corner_height((int32_t)i + 1, (int32_t)j, seed);
    const double far_left = corner_height((int32_t)i, (int32_t)j + 1, seed);
    const double far_right = corner_height((int32_t)i + 1, (int32_t)j + 1, seed);
    const double near_mix = near_left + (near_right - near_left) * u;
    return near_mix + (far_left + (far_right - far_left) * u - near_mix) * v;
}

/* Height over the ground divided by the greatest slope of that, and the box. Each octave is half as
 * wide and half as high as the one before, so its slope is the same. */
static double terrain(const double p[3], const double *n)
{
    const double cell = fmax(n[0], n[2]) / 4, whole = 2 - exp2(1 - n[3]);
    const double steepness = hypot(1, 1.6 * n[3] * n[1] / (whole * cell));
    const double d = box(p, n[0], n[1], n[2]), low = (p[1] + n[1] / 2) / steepness;

    if (low <= d) {
        return d; /* so also over the lowest ground */
    }
    double x = clamp(p[0], -n[0] / 2, n[0] / 2) / cell, z = clamp(p[2], -n[2] / 2, n[2] / 2) / cell;
    double height = 0, weight = n[1] / whole;
    for (int i = 0; i < (int)n[3]; i++) {
        height += weight * value_noise(x, z, (uint32_t)n[4] + 65536u * (uint32_t)i);
        x = 2 * x + 0.37; /* no corners of all lattices in one place */
        z = 2 * z + 0.61;
        weight /= 2;
    }
    return fmax(low - height / steepness, d);
}

static struct bounds terrain_box(const double *n)
{
    return bounds_centred(n[0] / 2, n[1] / 2, n[2] / 2);
}

static int terrain_trips(const double *n)
{
    return (int)n[3];
}

const struct sdf sdf_fractals[] = {
    {"gyroid", .shape = gyroid, .box = gyroid_box},
    {"mandelbulb", .shape = mandelbulb, .box = mandelbulb_box, .trips = mandelbulb_trips},
    {"menger", .shape = menger, .box = menger_box, .trips = menger_trips},
    {"julia", .shape = julia, .box = julia_box, .trips = julia_trips},
    {"terrain", .shape = terrain, .box = terrain_box, .trips = terrain_trips},
    {.type = NULL},
};
