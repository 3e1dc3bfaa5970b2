/* SPDX-License-Identifier: MIT */
/* Two-dimensional shapes, in the plane of X and Y. */
#include <stdlib.h>

#include "tools.h"

#define PI 3.141592653589793

static struct bounds plane_box(double left, double low, double right, double high)
{
    return (struct bounds){
        .low = {left, low, -INFINITY}, .high = {right, high, INFINITY}, .stretch = 1};
}

static struct bounds centred_box(double x, double y)
{
    return plane_box(-x, -y, x, y);
}

/* The box of `count` points, x and y each, with this much around them. */
static struct bounds points_box(const double *points, int count, double around)
{
    struct bounds box = plane_box(INFINITY, INFINITY, -INFINITY, -INFINITY);

    for (int i = 0; i < 2 * count; i++) {
        box.low[i % 2] = fmin(box.low[i % 2], points[i] - around);
        box.high[i % 2] = fmax(box.high[i % 2], points[i] + around);
    }
    return box;
}

/* Of (ax, ay) and (bx, by): positive where b lies to the left of a. */
static double cross2(double ax, double ay, double bx, double by)
{
    return ax * by - ay * bx;
}

/* The square of the distance to the segment from a to b. */
static double to_segment(const double *p, const double *a, const double *b)
{
    double x = p[0] - a[0], y = p[1] - a[1], ex = b[0] - a[0], ey = b[1] - a[1];
    const double t = clamp((x * ex + y * ey) / fmax(ex * ex + ey * ey, 1e-30), 0, 1);

    x -= t * ex;
    y -= t * ey;
    return x * x + y * y;
}

static double circle(const double p[3], const double *n)
{
    return hypot(p[0], p[1]) - n[0];
}

static struct bounds circle_box(const double *n)
{
    return centred_box(n[0], n[0]);
}

static double rectangle(const double p[3], const double *n)
{
    return corner(fabs(p[0]) - n[0] / 2, fabs(p[1]) - n[1] / 2);
}

static struct bounds rectangle_box(const double *n)
{
    return centred_box(n[0] / 2, n[1] / 2);
}

static void round_rectangle_prepare(double *n)
{
    n[2] = fmin(n[2], fmin(n[0], n[1]) / 2);
}

static double round_rectangle(const double p[3], const double *n)
{
    double core[2] = {n[0] - 2 * n[2], n[1] - 2 * n[2]};

    return rectangle(p, core) - n[2];
}

/* Inside: to the same side of all three edges, the one on which the third corner lies. */
static double triangle2(const double p[3], const double *n)
{
    const double *corners[3] = {n, n + 2, n + 4};
    const double turn = cross2(n[2] - n[0], n[3] - n[1], n[4] - n[0], n[5] - n[1]);
    double nearest = INFINITY, side = INFINITY;

    for (int i = 0; i < 3; i++) {
        const double *a = corners[i], *b = corners[(i + 1) % 3];
        const double left = cross2(b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]);
        nearest = fmin(nearest, to_segment(p, a, b));
        side = fmin(side, turn > 0 ? left : turn < 0 ? -left : 0);
    }
    return side > 0 ? -sqrt(nearest) : sqrt(nearest);
}

static struct bounds triangle2_box(const double *n)
{
    return points_box(n, 3, 0);
}

/* Star and regular polygon: in the half of a sector, a tip on its axis and a corner on its side
 * with the edge between them. */
static double star(const double p[3], const double *n)
{
    const double turn = 2 * PI / n[1];
    const double angle = turn * round(atan2(p[0], p[1]) / turn), c = cos(angle), s = sin(angle);
    double q[2] = {fabs(c * p[0] - s * p[1]), s * p[0] + c * p[1]};
    double tip[2] = {0, n[0]}, dent[2] = {n[2] * sin(turn / 2), n[2] * cos(turn / 2)};
    const double d = sqrt(to_segment(q, tip, dent));

    return cross2(dent[0], dent[1] - tip[1], q[0], q[1] - tip[1]) < 0 ? -d : d;
}

static struct bounds star_box(const double *n)
{
    const double reach = fmax(n[0], n[2]);

    return centred_box(reach, reach);
}

static double regular_polygon(const double p[3], const double *n)
{
    double as_star[3] = {n[0], n[1], n[0] * cos(PI / n[1])};

    return star(p, as_star);
}

/* n = how many corners, and x and y of each. Inside: a ray from the point to the right crosses an
 * odd number of sides. */
static double polygon(const double p[3], const double *n)
{
    const int count = (int)n[0];
    const double *a = n + 1 + 2 * (count - 1);
    double nearest = INFINITY;
    bool inside = false;

    for (int i = 0; i < count; i++) {
        const double *b = n + 1 + 2 * i;
        const double left = cross2(b[0] - a[0], b[1] - a[1], p[0] - a[0], p[1] - a[1]);
        const bool level = (a[1] > p[1]) != (b[1] > p[1]);
        inside = inside != (level && (left > 0) == (b[1] > a[1]));
        nearest = fmin(nearest, to_segment(p, a, b));
        a = b;
    }
    return inside ? -sqrt(nearest) : sqrt(nearest);
}

static struct bounds polygon_box(const double *n)
{
    return points_box(n + 1, (int)n[0], 0);
}

static int polygon_trips(const double *n)
{
    return (int)n[0];
}

/* A line so thick that it has no hole is a disc. */
static void ring_prepare(double *n)
{
    if (n[1] / 2 > n[0]) {
        n[1] += 2 * n[0];
        n[0] = 0;
    }
}

static double ring(const double p[3], const double *n)
{
    return fabs(hypot(p[0], p[1]) - n[0]) - n[1] / 2;
}

static struct bounds ring_box(const double *n)
{
    return centred_box(n[0] + n[1] / 2, n[0] + n[1] / 2);
}

/* arc: radius and angle become the end of the line on the side of +X. */
static void arc_prepare(double *n)
{
    const double radius = n[0], angle = n[1];

    n[0] = fmax(radius * sin(angle), 1e-12 * radius); /* never 0: the axis has a side */
    n[1] = radius * cos(angle);
}

/* What bounds the line on the side of +X, from its inside: two circles around the origin, and
 * beyond the end the end's circle, as far as it does not meet the one of the other end on the Y
 * axis. A hole as small as the rounding of numbers is none. */
static double arc_depth(double x, double y, const double *n, bool beyond)
{
    const double half = n[2] / 2, radius = hypot(n[0], n[1]), r = hypot(x, y), pore = 1e-6 * radius;
    const double end = hypot(x - n[0], y - n[1]), out = half / fmax(end, 1e-30);
    const double qx = n[0] + (x - n[0]) * out, qy = n[1] + (y - n[1]) * out;
    double nearest = beyond ? INFINITY : radius + half - r;

    if (!beyond && half < radius - pore) {
        nearest = fmin(nearest, half - radius + r);
    }
    if (qx >= 0 && cross2(qx, qy, n[0], n[1]) >= 0) {
        nearest = fmin(nearest, half - end);
    }
    const double root = sqrt(fmax((half - n[0]) * (half + n[0]), 0));
    for (int i = 0; i < 2 && half >= n[0]; i++) {
        const double meet = n[1] + (i ? root : -root);
        nearest = meet < (i ? -pore : pore) ? fmin(nearest, hypot(x, y - meet)) : nearest;
    }
    return nearest;
}

double flat_arc(const double p[3], const double *n)
{
    const double x = fabs(p[0]), y = p[1];
    const bool beyond = cross2(x, y, n[0], n[1]) > 0;
    const double line = beyond ? hypot(x - n[0], y - n[1]) : fabs(hypot(x, y) - hypot(n[0], n[1]));
    const double d = line - n[2] / 2;

    return d > 0 ? d : -arc_depth(x, y, n, beyond);
}

static struct bounds arc_box(const double *n)
{
    const double radius = hypot(n[0], n[1]), half = n[2] / 2;
    const double side = (n[1] < 0 ? radius : n[0]) + half;

    return plane_box(-side, n[1] - half, side, radius + half);
}

static void vesica_prepare(double *n)
{
    n[1] = fmin(n[1], 2 * n[0]);
}

static double vesica(const double p[3], const double *n)
{
    const double x = fabs(p[0]), y = fabs(p[1]), centre = n[1] / 2;
    const double tip = sqrt((n[0] - centre) * (n[0] + centre));

    return (y - tip) * centre > x * tip ? hypot(x, y - tip) : hypot(x + centre, y) - n[0];
}

static struct bounds vesica_box(const double *n)
{
    return centred_box(n[0] - n[1] / 2, sqrt(n[0] * n[0] - n[1] * n[1] / 4));
}

static void cross_prepare(double *n)
{
    n[1] = fmin(n[1], n[0]);
}

/* In one eighth of the plane: the end of a bar, its side, and the corner between the bars. */
static double cross(const double p[3], const double *n)
{
    const double x = fmax(fabs(p[0]), fabs(p[1])), y = fmin(fabs(p[0]), fabs(p[1]));
    const double along = x - n[0] / 2, aside = y - n[1] / 2;

    if (along > 0 || aside > 0) {
        return hypot(fmax(along, 0), fmax(aside, 0));
    }
    return fmax(along, -hypot(fmax(n[1] / 2 - x, 0), aside));
}

static struct bounds cross_box(const double *n)
{
    return centred_box(n[0] / 2, n[0] / 2);
}

/* On the curve a + 2 t u + t^2 v, half of the derivative of the squared distance is a cubic that
 * rises through its root where the distance is least. Newton's method starts at both ends: whatever
 * lies between, the cubic is hollow or arched on the way from one of them, so that its steps never
 * pass the root. The curve's sharpest point stands in where both are slow, near a cusp. */
enum { BEZIER_STEPS = 10 };

static double bezier_square(const double *w, const double *u, const double *v, double t)
{
    const double x = w[0] + t * (2 * u[0] + t * v[0]), y = w[1] + t * (2 * u[1] + t * v[1]);

    return x * x + y * y;
}

static double bezier(const double p[3], const double *n)
{
    double w[2], u[2], v[2];

    for (int i = 0; i < 2; i++) {
        w[i] = n[i] - p[i];
        u[i] = n[2 + i] - n[i];
        v[i] = n[i] - 2 * n[2 + i] + n[4 + i];
    }
    const double uv = u[0] * v[0] + u[1] * v[1], vv = v[0] * v[0] + v[1] * v[1];
    const double c0 = w[0] * u[0] + w[1] * u[1];
    const double c1 = 2 * (u[0] * u[0] + u[1] * u[1]) + w[0] * v[0] + w[1] * v[1];
    double t[3] = {0, 1, clamp(-uv / fmax(vv, 1e-30), 0, 1)}, nearest = INFINITY;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < BEZIER_STEPS && k < 2; i++) {
            const double value = ((vv * t[k] + 3 * uv) * t[k] + c1) * t[k] + c0;
            const double slope = (3 * vv * t[k] + 6 * uv) * t[k] + c1;
            t[k] = clamp(t[k] - value / fmax(slope, 1e-20), 0, 1);
        }
        nearest = fmin(nearest, bezier_square(w, u, v, t[k]));
    }
    return sqrt(nearest) - n[6] / 2;
}

static struct bounds bezier_box(const double *n)
{
    return points_box(n, 3, n[6] / 2);
}

static int bezier_trips(const double *n)
{
    (void)n;
    return BEZIER_STEPS;
}

/* On the side of +X: the half disc's circle above the line from its one end to the other, below it
 * the straight side and the notch. */
static double heart(const double p[3], const double *n)
{
    const double size = n[0], x = fabs(p[0]), y = p[1];

    if (x + y > size) {
        return hypot(x - size / 4, y - 3 * size / 4) - size * sqrt(0.125);
    }
    const double foot = fmax(x + y, 0) / 2;
    const double d = fmin(hypot(x, y - size), hypot(x - foot, y - foot));
    return x < y ? -d : d;
}

static struct bounds heart_box(const double *n)
{
    const double side = n[0] * (0.25 + sqrt(0.125));

    return plane_box(-side, 0, side, n[0] * (0.75 + sqrt(0.125)));
}

static double ellipse(const double p[3], const double *n)
{
    return (hypot(p[0] / n[0], p[1] / n[1]) - 1) * fmin(n[0], n[1]);
}

static struct bounds ellipse_box(const double *n)
{
    struct bounds box = centred_box(n[0], n[1]);

    box.stretch = fmax(n[0], n[1]) / fmin(n[0], n[1]);
    return box;
}

static double segment(const double p[3], const double *n)
{
    return sqrt(to_segment(p, n, n + 2)) - n[4] / 2;
}

static struct bounds segment_box(const double *n)
{
    return points_box(n, 2, n[4] / 2);
}

const struct sdf sdf_flat[] = {
    {"circle", .shape = circle, .box = circle_box},
    {"rectangle", .shape = rectangle, .box = rectangle_box},
    {"round_rectangle", .prepare = round_rectangle_prepare, .shape = round_rectangle,
     .box = rectangle_box},
    {"triangle2", .shape = triangle2, .box = triangle2_box},
    {"regular_polygon", .shape = regular_polygon, .box = circle_box},
    {"polygon", .shape = polygon, .box = polygon_box, .trips = polygon_trips},
    {"star", .shape = star, .box = star_box},
    {"ring", .prepare = ring_prepare, .shape = ring, .box = ring_box},
    {"arc", .prepare = arc_prepare, .shape = flat_arc, .box = arc_box},
    {"vesica", .prepare = vesica_prepare, .shape = vesica, .box = vesica_box},
    {"cross", .prepare = cross_prepare, .shape = cross, .box = cross_box},
    {"bezier", .shape = bezier, .box = bezier_box, .trips = bezier_trips},
    {"heart", .shape = heart, .box = heart_box},
    {"ellipse", .shape = ellipse, .box = ellipse_box},
    {"segment", .shape = segment, .box = segment_box},
    {.type = NULL},
};
