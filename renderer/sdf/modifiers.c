/* SPDX-License-Identifier: MIT */
/* What changes the distance or the space of its children. */
#include <string.h>

#include "tools.h"

/* --- of the distance --- */

static double change_round(double d, const double *n)
{
    return d - n[0];
}

static double change_shell(double d, const double *n)
{
    return fabs(d) - n[0];
}

static double whole_lowered(const double *n, size_t count)
{
    (void)count;
    return n[0];
}

/* --- of the space --- */

static void mirror_prepare(const double *params, const struct bounds *child, double scale,
                           double *out_n)
{
    (void)child, (void)scale;
    memcpy(out_n, params, 3 * sizeof *params);
}

static struct bounds mirror_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    for (int i = 0; i < 3; i++) {
        if (params[i] != 0) {
            /* Nothing on the positive side: what grows there by and by lies around the plane. */
            out.high[i] = fabs(out.high[i]);
            out.low[i] = -out.high[i];
        }
    }
    return out;
}

static void mirror_map(const double p[3], const double *n, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = n[i] != 0 ? fabs(p[i]) : p[i];
    }
}

/* twist: n = rate, radius of the children's cylinder, 1 / Lipschitz constant, scale.
 *
 * Inside the cylinder the twist shears by at most a = |rate| * radius, and the greatest singular
 * value of [[1, a], [0, 1]] is (a + sqrt(a^2 + 4)) / 2 (Hart, section 3: the Jacobian's norm bounds
 * the constant). Outside, the nearest point of the cylinder stands in: projecting on a convex set
 * lengthens no distance; what is missing is added at a right angle. */
enum { RATE, RADIUS, PER_LIPSCHITZ, SCALE };

static double twist_radius(const struct bounds *child)
{
    double radius = bounds_radius_y(child);
    return isfinite(radius) ? radius * 1.0001 : SDF_TWIST_RADIUS_MAX;
}

static double twist_lipschitz(double rate, double radius)
{
    double a = fabs(rate) * radius;
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
    double radius = twist_radius(child);
    out.low[0] = out.low[2] = -radius;
    out.high[0] = out.high[2] = radius;
    out.stretch *= twist_lipschitz(params[0], radius);
    return out;
}

static void twist_map(const double p[3], const double *n, double out[3])
{
    double inward = fmin(n[RADIUS] / fmax(hypot(p[0], p[2]), 1e-30), 1);
    double x = p[0] * inward, z = p[2] * inward;
    double c = cos(n[RATE] * p[1]), s = sin(n[RATE] * p[1]);
    out[0] = c * x - s * z;
    out[1] = p[1];
    out[2] = s * x + c * z;
}

static double twist_after(double d, const double p[3], const double *n)
{
    return corner(d * n[PER_LIPSCHITZ], (hypot(p[0], p[2]) - n[RADIUS]) * n[SCALE]);
}

/* extrude: n = half height, scale, rounding times scale. The section, drawn in by the rounding and
 * as much lower, grows back by it: only edges between cap and side become round. */
enum { HALF, EXTRUDE_SCALE, ROUNDING };

static void extrude_prepare(const double *params, const struct bounds *child, double scale,
                            double *out_n)
{
    (void)child;
    out_n[HALF] = params[0] / 2;
    out_n[EXTRUDE_SCALE] = scale;
    out_n[ROUNDING] = fmin(params[1], params[0] / 2) * scale;
}

static struct bounds extrude_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    out.high[2] = params[0] / 2;
    out.low[2] = -out.high[2];
    return out;
}

static void extrude_map(const double p[3], const double *n, double out[3])
{
    (void)n;
    out[0] = p[0], out[1] = p[1], out[2] = 0;
}

/* Distances along the section and across it stand at a right angle, so the gradient stays 1. */
static double extrude_after(double d, const double p[3], const double *n)
{
    double along = (fabs(p[2]) - n[HALF]) * n[EXTRUDE_SCALE];
    return corner(d + n[ROUNDING], along + n[ROUNDING]) - n[ROUNDING];
}

/* revolve: n = offset. The way to the section's point lengthens no distance. */
static void revolve_prepare(const double *params, const struct bounds *child, double scale,
                            double *out_n)
{
    (void)child, (void)scale;
    out_n[0] = params[0];
}

static struct bounds revolve_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    double radius = fmax(child->high[0] + params[0], 0);
    out.low[0] = out.low[2] = -radius;
    out.high[0] = out.high[2] = radius;
    return out;
}

static void revolve_map(const double p[3], const double *n, double out[3])
{
    out[0] = hypot(p[0], p[2]) - n[0];
    out[1] = p[1];
    out[2] = 0;
}

static const struct sdf_domain mirror = {
    .vec4s = 1, .prepare = mirror_prepare, .box = mirror_box, .map = mirror_map};
static const struct sdf_domain extrude = {.vec4s = 1,
                                          .prepare = extrude_prepare,
                                          .box = extrude_box,
                                          .map = extrude_map,
                                          .after = extrude_after};
static const struct sdf_domain revolve = {
    .vec4s = 1, .prepare = revolve_prepare, .box = revolve_box, .map = revolve_map};
static const struct sdf_domain twist = {
    .vec4s = 1, .prepare = twist_prepare, .box = twist_box, .map = twist_map, .after = twist_after};

const struct sdf sdf_modifiers[] = {
    {"round", .change = change_round, .lowered = whole_lowered},
    {"shell", .change = change_shell, .lowered = whole_lowered},
    {"mirror", .domain = &mirror},
    {"twist", .domain = &twist},
    {"extrude", .domain = &extrude},
    {"revolve", .domain = &revolve},
    {.type = NULL},
};
