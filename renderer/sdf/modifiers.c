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

/* repeat: n = spacing, limit, centre, reach, each a vec4.
 *
 * Copies sit at spacing * k, where k runs in steps of 1 from -limit to limit, so k is half a number
 * where their count is even. On each axis by itself, a part of the child at offset v of its box's
 * centre is nearest in the copy round(x - v / spacing), clamped to the limit, where
 * x = (p - centre) / spacing. As v lies in the box, looking at round(x - reach) to round(x + reach)
 * misses none, reach being half the box by the spacing. */
enum { SPACING = 0, REPEAT_LIMIT = 4, CENTRE = 8, CELL_REACH = 12 };

#define REPEAT_ENDLESS 1048576.0 /* copies to each side; a float still holds k exactly */

static int axis_cells(const double *n, int axis)
{
    return (int)fmin(ceil(2 * n[CELL_REACH + axis]) + 1, 2 * n[REPEAT_LIMIT + axis] + 1);
}

static int repeat_cells(const double *n)
{
    return axis_cells(n, 0) * axis_cells(n, 1) * axis_cells(n, 2);
}

/* Where children reach over very many cells, or without end over endless ones, only the nearest are
 * looked at. */
static void limit_cells(double *n)
{
    while (repeat_cells(n) > SDF_REPEAT_CELLS_MAX) {
        int most = 0;
        for (int i = 1; i < 3; i++) {
            most = axis_cells(n, i) > axis_cells(n, most) ? i : most;
        }
        n[CELL_REACH + most] = (axis_cells(n, most) - 2) / 2.0;
    }
}

static void repeat_prepare(const double *params, const struct bounds *child, double scale,
                           double *out_n)
{
    (void)scale;
    for (int i = 0; i < 3; i++) {
        double spacing = params[i], count = params[3 + i];
        double half = (child->high[i] - child->low[i]) / 2;
        bool repeated = count != 0 && count != 1;
        out_n[SPACING + i] = repeated ? spacing : 1;
        out_n[REPEAT_LIMIT + i] = count < 0 ? REPEAT_ENDLESS : fmax(count - 1, 0) / 2;
        out_n[CENTRE + i] = isfinite(half) ? child->low[i] + half : 0;
        double reach = isfinite(half) || count > 0 ? half / spacing : 1;
        out_n[CELL_REACH + i] = repeated ? fmin(reach, SDF_REPEAT_CELLS_MAX) : 0;
    }
    limit_cells(out_n);
}

static struct bounds repeat_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;
    for (int i = 0; i < 3; i++) {
        double count = params[3 + i];
        double reach = count < 0 ? INFINITY : params[i] * fmax(count - 1, 0) / 2;
        out.low[i] -= reach;
        out.high[i] += reach;
    }
    return out;
}

static void repeat_range(const double p[3], const double *n, double out_first[3],
                         double out_last[3])
{
    for (int i = 0; i < 3; i++) {
        double limit = n[REPEAT_LIMIT + i], half = limit - floor(limit);
        double x = (p[i] - n[CENTRE + i]) / n[SPACING + i] - half + 0.5;
        out_first[i] = clamp(floor(x - n[CELL_REACH + i]) + half, -limit, limit);
        out_last[i] = clamp(floor(x + n[CELL_REACH + i]) + half, -limit, limit);
    }
}

static void repeat_cell(const double p[3], const double cell[3], const double *n, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] - n[SPACING + i] * cell[i];
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
static const struct sdf_domain repeat = {.vec4s = 4,
                                         .prepare = repeat_prepare,
                                         .box = repeat_box,
                                         .range = repeat_range,
                                         .cell = repeat_cell,
                                         .cells = repeat_cells};
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
    {"repeat", .domain = &repeat},
    {"twist", .domain = &twist},
    {"extrude", .domain = &extrude},
    {"revolve", .domain = &revolve},
    {.type = NULL},
};
