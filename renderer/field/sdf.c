/* SPDX-License-Identifier: MIT */
/* Distance functions in C. Where a formula comes from stands in its registry row (nodes.c); each
 * GLSL function of the same name is the same formula. */
#include "sdf.h"

#include <assert.h>
#include <math.h>
#include <string.h>

static double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double length3(double x, double y, double z)
{
    return sqrt(x * x + y * y + z * z);
}

/* Distance to the intersection of two half-spaces at right angles whose distances are a and b. */
static double corner(double a, double b)
{
    return fmin(fmax(a, b), 0) + hypot(fmax(a, 0), fmax(b, 0));
}

/* --- shapes --- */

static double sphere(const double p[3], const double *n)
{
    return length3(p[0], p[1], p[2]) - n[0];
}

static struct bounds sphere_box(const double *n)
{
    return bounds_centred(n[0], n[0], n[0]);
}

static double ellipsoid(const double p[3], const double *n)
{
    return (length3(p[0] / n[0], p[1] / n[1], p[2] / n[2]) - 1) * fmin(n[0], fmin(n[1], n[2]));
}

static struct bounds ellipsoid_box(const double *n)
{
    struct bounds box = bounds_centred(n[0], n[1], n[2]);
    box.stretch = fmax(n[0], fmax(n[1], n[2])) / fmin(n[0], fmin(n[1], n[2]));
    return box;
}

static double box(const double p[3], const double *n)
{
    double x = fabs(p[0]) - n[0] / 2, y = fabs(p[1]) - n[1] / 2, z = fabs(p[2]) - n[2] / 2;
    return length3(fmax(x, 0), fmax(y, 0), fmax(z, 0)) + fmin(fmax(x, fmax(y, z)), 0);
}

static struct bounds box_box(const double *n)
{
    return bounds_centred(n[0] / 2, n[1] / 2, n[2] / 2);
}

static void round_box_prepare(double *n)
{
    n[3] = fmin(n[3], fmin(n[0], fmin(n[1], n[2])) / 2);
}

static double round_box(const double p[3], const double *n)
{
    double core[3] = {n[0] - 2 * n[3], n[1] - 2 * n[3], n[2] - 2 * n[3]};
    return box(p, core) - n[3];
}

static double torus(const double p[3], const double *n)
{
    return hypot(hypot(p[0], p[2]) - n[0], p[1]) - n[1];
}

static struct bounds torus_box(const double *n)
{
    return bounds_centred(n[0] + n[1], n[1], n[0] + n[1]);
}

static double cylinder(const double p[3], const double *n)
{
    return corner(hypot(p[0], p[2]) - n[0], fabs(p[1]) - n[1] / 2);
}

static struct bounds cylinder_box(const double *n)
{
    return bounds_centred(n[0], n[1] / 2, n[0]);
}

static double capsule(const double p[3], const double *n)
{
    double pa[3], ba[3];
    for (int i = 0; i < 3; i++) {
        pa[i] = p[i] - n[i];
        ba[i] = n[3 + i] - n[i];
    }
    double t = clamp(dot(pa, ba) / fmax(dot(ba, ba), 1e-30), 0, 1);
    return length3(pa[0] - t * ba[0], pa[1] - t * ba[1], pa[2] - t * ba[2]) - n[6];
}

static struct bounds capsule_box(const double *n)
{
    struct bounds box = {.stretch = 1};
    for (int i = 0; i < 3; i++) {
        box.low[i] = fmin(n[i], n[3 + i]) - n[6];
        box.high[i] = fmax(n[i], n[3 + i]) + n[6];
    }
    return box;
}

/* In the half-plane (distance from the axis, height below the tip) the cone is a triangle: the
 * nearest point lies on its slope or on its base. */
static double cone(const double p[3], const double *n)
{
    double radius = n[0], height = n[1];
    double x = hypot(p[0], p[2]), y = height / 2 - p[1];
    double t = clamp((x * radius + y * height) / (radius * radius + height * height), 0, 1);
    double slope = hypot(x - t * radius, y - t * height);
    double base = hypot(x - fmin(x, radius), y - height);
    double outside = fmax(x * height - y * radius, y - height);
    return outside > 0 ? fmin(slope, base) : -fmin(slope, base);
}

static void plane_prepare(double *n)
{
    double length = length3(n[0], n[1], n[2]);
    for (int i = 0; i < 3; i++) {
        n[i] = length > 0 ? n[i] / length : i == 1;
    }
}

static double plane(const double p[3], const double *n)
{
    return dot(p, n) - n[3];
}

static struct bounds plane_box(const double *n)
{
    struct bounds box = bounds_infinite();
    for (int i = 0; i < 3; i++) {
        if (n[i] == 1) {
            box.high[i] = n[3];
        } else if (n[i] == -1) {
            box.low[i] = -n[3];
        }
    }
    return box;
}

/* --- operations --- */

static double combine_union(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = b < a;
    return fmin(a, b);
}

static double combine_intersection(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = b > a;
    return fmax(a, b);
}

static double combine_difference(double a, double b, const double *n, double *out_share)
{
    return combine_intersection(a, -b, n, out_share);
}

static void blend_prepare(double *n)
{
    n[0] = fmax(n[0], 1e-7);
}

static double combine_smooth_union(double a, double b, const double *n, double *out_share)
{
    double h = fmax(n[0] - fabs(a - b), 0) / n[0];
    *out_share = b < a ? 1 - h / 2 : h / 2;
    return fmin(a, b) - h * h * n[0] / 4;
}

static double combine_smooth_intersection(double a, double b, const double *n, double *out_share)
{
    return -combine_smooth_union(-a, -b, n, out_share);
}

static double combine_smooth_difference(double a, double b, const double *n, double *out_share)
{
    return -combine_smooth_union(-a, b, n, out_share);
}

/* One blend lowers by at most k/4; from the left fold x <- x + (k - x)^2 / (4k) never passes k. */
static double blend_lowered(const double *n, size_t count)
{
    return n[0] * fmin(1, (double)(count > 0 ? count - 1 : 0) / 4);
}

/* --- modifiers of the distance --- */

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

/* --- modifiers of the domain --- */

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

static const struct sdf_domain mirror = {
    .vec4s = 1, .prepare = mirror_prepare, .box = mirror_box, .map = mirror_map};
static const struct sdf_domain repeat = {.vec4s = 4,
                                         .prepare = repeat_prepare,
                                         .box = repeat_box,
                                         .range = repeat_range,
                                         .cell = repeat_cell,
                                         .cells = repeat_cells};
static const struct sdf_domain twist = {
    .vec4s = 1, .prepare = twist_prepare, .box = twist_box, .map = twist_map, .after = twist_after};

/* --- the table --- */

static const struct sdf rows[] = {
    {"sphere", .shape = sphere, .box = sphere_box},
    {"ellipsoid", .shape = ellipsoid, .box = ellipsoid_box},
    {"box", .shape = box, .box = box_box},
    {"round_box", .prepare = round_box_prepare, .shape = round_box, .box = box_box},
    {"torus", .shape = torus, .box = torus_box},
    {"cylinder", .shape = cylinder, .box = cylinder_box},
    {"capsule", .shape = capsule, .box = capsule_box},
    {"cone", .shape = cone, .box = cylinder_box},
    {"plane", .prepare = plane_prepare, .shape = plane, .box = plane_box},
    {"union", .combine = combine_union, .rule = SDF_ANY},
    {"intersection", .combine = combine_intersection, .rule = SDF_ALL},
    {"difference", .combine = combine_difference, .rule = SDF_FIRST},
    {"smooth_union", .prepare = blend_prepare, .combine = combine_smooth_union, .rule = SDF_ANY,
     .soft = true, .lowered = blend_lowered},
    {"smooth_intersection", .prepare = blend_prepare, .combine = combine_smooth_intersection,
     .rule = SDF_ALL, .soft = true},
    {"smooth_difference", .prepare = blend_prepare, .combine = combine_smooth_difference,
     .rule = SDF_FIRST, .soft = true},
    {"round", .change = change_round, .lowered = whole_lowered},
    {"shell", .change = change_shell, .lowered = whole_lowered},
    {"mirror", .domain = &mirror},
    {"repeat", .domain = &repeat},
    {"twist", .domain = &twist},
    {"group", .combine = combine_union, .rule = SDF_ANY},
};

size_t sdf_count(void)
{
    return sizeof rows / sizeof rows[0];
}

const struct sdf *sdf_at(size_t index)
{
    return index < sdf_count() ? &rows[index] : NULL;
}

const struct sdf *sdf_find(const struct node_type *type)
{
    for (size_t i = 0; i < sdf_count(); i++) {
        if (strcmp(rows[i].type, type->record.name) == 0) {
            return &rows[i];
        }
    }
    return NULL;
}

int sdf_numbers(const struct record *params, double out_n[SDF_NUMBERS_MAX])
{
    int count = 0;
    for (size_t i = 0; i < record_type_count(params->type); i++) {
        if (params->type->params[i].type == PARAM_ENUM) {
            continue;
        }
        int components = param_components(params->type->params[i].type);
        assert(count + components <= SDF_NUMBERS_MAX);
        memcpy(out_n + count, params->values[i].number, (size_t)components * sizeof *out_n);
        count += components;
    }
    return count;
}
