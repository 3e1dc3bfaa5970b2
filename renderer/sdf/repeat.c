/* SPDX-License-Identifier: MIT */
/* What shows its children many times. */
#include "tools.h"

#define PI 3.14159265358979324

/* repeat: n = spacing, limit, centre, reach, each a vec4.
 *
 * Copies sit at spacing * k, where k runs in steps of 1 from -limit to limit, so k is half a number
 * where their count is even. On each axis by itself, a part of the child at offset v of its box's
 * centre is nearest in the copy round(x - v / spacing), clamped to the limit, where
 * x = (p - centre) / spacing. As v lies in the box, looking at round(x - reach) to round(x + reach)
 * misses none, reach being half the box by the spacing. PARTIAL is 1 where they are too many. */
enum { SPACING = 0, REPEAT_LIMIT = 4, CENTRE = 8, CELL_REACH = 12, PARTIAL = 15 };

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
        n[PARTIAL] = 1;
    }
}

static void repeat_prepare(const double *params, const struct bounds *child, double scale,
                           double *out_n)
{
    (void)scale;
    out_n[PARTIAL] = 0;
    for (int i = 0; i < 3; i++) {
        const double spacing = params[i], count = params[3 + i];
        const double half = (child->high[i] - child->low[i]) / 2;
        const bool repeated = count != 0 && count != 1;
        out_n[SPACING + i] = repeated ? spacing : 1;
        out_n[REPEAT_LIMIT + i] = count < 0 ? REPEAT_ENDLESS : fmax(count - 1, 0) / 2;
        out_n[CENTRE + i] = isfinite(half) ? child->low[i] + half : 0;
        const double reach = isfinite(half) || count > 0 ? half / spacing : 1;
        out_n[CELL_REACH + i] = repeated ? fmin(reach, SDF_REPEAT_CELLS_MAX) : 0;
        out_n[PARTIAL] = count < 0 && !isfinite(half) ? 1 : out_n[PARTIAL];
    }
    limit_cells(out_n);
}

static struct bounds repeat_box(const double *params, const struct bounds *child)
{
    struct bounds out = *child;

    for (int i = 0; i < 3; i++) {
        const double count = params[3 + i];
        const double reach = count < 0 ? INFINITY : params[i] * fmax(count - 1, 0) / 2;
        out.low[i] -= reach;
        out.high[i] += reach;
    }
    return out;
}

static void repeat_range(const double p[3], const double *n, double out_first[3],
                         double out_last[3])
{
    for (int i = 0; i < 3; i++) {
        const double limit = n[REPEAT_LIMIT + i], half = limit - floor(limit);
        const double x = (p[i] - n[CENTRE + i]) / n[SPACING + i] - half + 0.5;
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

/* repeat_polar: n = radius, angle from copy to copy, middle of the child's angle, reach, then how
 * many copies there are, slack, 1 / (1 + slack), scale.
 *
 * Seen from the axis, a part of the child at angle v is nearest in the copy round((phi - v)/step).
 * As v lies within `half` of the middle of the box's angle, looking at round(x - reach) to
 * round(x + reach) misses none, where x = (phi - middle) / step and reach = half / step. A box
 * around the axis lies at all angles, so all copies are looked at.
 *
 * Where that are too many, fewer stand in for them, at equal angles. Each part of a true copy is
 * then at most half an angle from where a stand-in has it, which is `slack` times the point's
 * distance from the axis; taking that off leaves a bound. */
enum { POLAR_RADIUS, STEP, MIDDLE, REACH, AROUND, SLACK, PER_SLOPE, POLAR_SCALE };

#define REACH_MARGIN 1e-3 /* for the angles of a GPU */

struct fan {
    double middle, half; /* the angles at which the child is seen from the axis */
    double around;       /* copies, or what stands in for them */
    double slack;
};

static bool has_axis(const double low[3], const double high[3])
{
    return low[0] <= 0 && high[0] >= 0 && low[2] <= 0 && high[2] >= 0;
}

/* The angles of a box that does not contain the axis. */
static void see_box(const double low[3], const double high[3], struct fan *fan)
{
    double toward = atan2(low[2] + high[2], low[0] + high[0]), least = 0, most = 0;

    for (int i = 0; i < 4; i++) {
        double turn = atan2(i & 1 ? high[2] : low[2], i & 2 ? high[0] : low[0]) - toward;
        turn -= 2 * PI * round(turn / (2 * PI));
        least = fmin(least, turn);
        most = fmax(most, turn);
    }
    fan->middle = toward + (least + most) / 2;
    fan->half = (most - least) / 2;
}

static struct fan fan_of(const double *params, const struct bounds *child)
{
    struct fan fan = {.half = PI, .around = params[0]};
    struct bounds moved = *child;

    moved.low[0] += params[1];
    moved.high[0] += params[1];
    if (bounds_is_finite(&moved) && !has_axis(moved.low, moved.high)) {
        see_box(moved.low, moved.high, &fan);
    }
    /* round(x + reach) - round(x - reach) + 1 is at most 2 * reach + 2. */
    const double most = fmax((SDF_REPEAT_CELLS_MAX - 2) * PI / fan.half, SDF_REPEAT_CELLS_MAX);
    if (fan.around > most) {
        fan.around = floor(most);
        fan.slack = 2 * sin(PI / (2 * fan.around));
    }
    return fan;
}

static int polar_cells(const double *n)
{
    return (int)fmin(ceil(2 * n[REACH]) + 1, n[AROUND]);
}

static void polar_prepare(const double *params, const struct bounds *child, double scale,
                          double *out_n)
{
    struct fan fan = fan_of(params, child);

    out_n[POLAR_RADIUS] = params[1];
    out_n[STEP] = 2 * PI / fan.around;
    out_n[MIDDLE] = fan.middle;
    out_n[REACH] = fan.half / out_n[STEP] + REACH_MARGIN;
    out_n[AROUND] = fan.around;
    out_n[SLACK] = fan.slack;
    out_n[PER_SLOPE] = 1 / (1 + fan.slack);
    out_n[POLAR_SCALE] = scale;
}

/* A ring. With stand-ins it grows by the slack, which is more the farther out. */
static struct bounds polar_box(const double *params, const struct bounds *child)
{
    const double slack = fan_of(params, child).slack, lag = 1 - child->stretch * slack;
    struct bounds out = *child;

    out.low[0] += params[1];
    out.high[0] += params[1];
    const double radius = lag > 0 ? bounds_radius_y(&out) / lag : INFINITY;
    out = bounds_grow(out, slack * radius);
    out.low[0] = out.low[2] = -radius;
    out.high[0] = out.high[2] = radius;
    out.stretch *= (1 + slack) / fmax(lag, 1e-9);
    return out;
}

static void polar_range(const double p[3], const double *n, double out_first[3], double out_last[3])
{
    const double x = (atan2(p[2], p[0]) - n[MIDDLE]) / n[STEP] + 0.5;

    out_first[0] = floor(x - n[REACH]);
    out_last[0] = fmin(floor(x + n[REACH]), out_first[0] + n[AROUND] - 1);
    out_first[1] = out_first[2] = out_last[1] = out_last[2] = 0;
}

static void polar_cell(const double p[3], const double cell[3], const double *n, double out[3])
{
    const double c = cos(n[STEP] * cell[0]), s = sin(n[STEP] * cell[0]);

    out[0] = c * p[0] + s * p[2] - n[POLAR_RADIUS];
    out[1] = p[1];
    out[2] = c * p[2] - s * p[0];
}

static double polar_after(double d, const double p[3], const double *n)
{
    return (d - hypot(p[0], p[2]) * n[SLACK] * n[POLAR_SCALE]) * n[PER_SLOPE];
}

static const struct sdf_domain repeat = {.vec4s = 4,
                                         .prepare = repeat_prepare,
                                         .box = repeat_box,
                                         .range = repeat_range,
                                         .cell = repeat_cell,
                                         .cells = repeat_cells,
                                         .partial = PARTIAL};
static const struct sdf_domain repeat_polar = {.vec4s = 2,
                                               .prepare = polar_prepare,
                                               .box = polar_box,
                                               .after = polar_after,
                                               .range = polar_range,
                                               .cell = polar_cell,
                                               .cells = polar_cells};

const struct sdf sdf_repeats[] = {
    {"repeat", .domain = &repeat},
    {"repeat_polar", .domain = &repeat_polar},
    {.type = NULL},
};
