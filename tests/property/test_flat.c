/* SPDX-License-Identifier: MIT */
/* Two-dimensional shapes: what is inside is what the words say, and the distance is that of the
 * nearest point of the other side. Inside and outside are told here by other means than in the
 * formulas, and distances by looking around. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "renderer/sdf/sdf.h"
#include "tests/support/random_scene.h"

#define PI 3.141592653589793
#define TOLERANCE 1e-3

/* --- inside or outside, by the words of the catalogue; numbers as written in a document --- */

static bool in_circle(const double p[2], const double *n)
{
    return p[0] * p[0] + p[1] * p[1] < n[0] * n[0];
}

static bool in_rectangle(const double p[2], const double *n)
{
    return fabs(p[0]) < n[0] / 2 && fabs(p[1]) < n[1] / 2;
}

/* Within the radius of a point of the rectangle whose sides are the radius farther in. */
static bool in_round_rectangle(const double p[2], const double *n)
{
    double radius = fmin(n[2], fmin(n[0], n[1]) / 2), sum = 0;

    for (int i = 0; i < 2; i++) {
        const double core = n[i] / 2 - radius;
        const double nearest = p[i] < -core ? -core : p[i] > core ? core : p[i];
        sum += (p[i] - nearest) * (p[i] - nearest);
    }
    return sum <= radius * radius; /* may be 0 */
}

/* Barycentric coordinates above 0. */
static bool in_triangle2(const double p[2], const double *n)
{
    const double ux = n[2] - n[0], uy = n[3] - n[1], vx = n[4] - n[0], vy = n[5] - n[1];
    const double x = p[0] - n[0], y = p[1] - n[1], area = ux * vy - uy * vx;
    const double s = (x * vy - y * vx) / area, t = (ux * y - uy * x) / area;

    return s > 0 && t > 0 && s + t < 1;
}

/* The corners go once around the point, by the sum of the angles under which it sees the sides. */
static bool in_corners(const double p[2], const double *corners, int count)
{
    double sum = 0;

    for (int i = 0; i < count; i++) {
        const double *a = corners + 2 * i, *b = corners + 2 * ((i + 1) % count);
        const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1];
        sum += atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
    return fabs(sum) > PI;
}

static bool in_polygon(const double p[2], const double *n)
{
    return in_corners(p, n + 1, (int)n[0]);
}

static bool in_turned_corners(const double p[2], int count, double even, double odd)
{
    double corners[4 * 64];

    for (int i = 0; i < count; i++) {
        const double angle = 2 * PI * i / count, radius = i % 2 ? odd : even;
        corners[2 * i] = radius * sin(angle);
        corners[2 * i + 1] = radius * cos(angle);
    }
    return in_corners(p, corners, count);
}

static bool in_regular_polygon(const double p[2], const double *n)
{
    return in_turned_corners(p, (int)n[1], n[0], n[0]);
}

static bool in_star(const double p[2], const double *n)
{
    return in_turned_corners(p, 2 * (int)n[1], n[0], n[2]);
}

static bool in_ring(const double p[2], const double *n)
{
    const double r = sqrt(p[0] * p[0] + p[1] * p[1]);

    return r > n[0] - n[1] / 2 && r < n[0] + n[1] / 2;
}

typedef void line(const double *n, double t, double out[2]);

static double to_point(line *at, const double p[2], const double *n, double t)
{
    double q[2];

    at(n, t, q);
    return hypot(q[0] - p[0], q[1] - p[1]);
}

/* The distance to a line, where t runs from 0 to 1: around each of its parts' ends that is nearer
 * than the next ones, thirds are cut off. */
static double to_line(line *at, const double p[2], const double *n, int parts)
{
    double best = INFINITY, before = INFINITY, here = to_point(at, p, n, 0);

    for (int i = 0; i <= parts; i++) {
        const double after = i < parts ? to_point(at, p, n, (i + 1.0) / parts) : INFINITY;
        double low = fmax(i - 1.0, 0) / parts, high = fmin(i + 1.0, parts) / parts;
        while (here <= before && here <= after && high - low > 1e-5) {
            const double third = (high - low) / 3;
            const double a = to_point(at, p, n, low + third), b = to_point(at, p, n, high - third);
            best = fmin(best, fmin(a, b));
            low += a < b ? 0 : third;
            high -= a < b ? third : 0;
        }
        best = fmin(best, here);
        before = here;
        here = after;
    }
    return best;
}

static void arc_at(const double *n, double t, double out[2])
{
    out[0] = n[0] * sin(n[1] * (2 * t - 1));
    out[1] = n[0] * cos(n[1] * (2 * t - 1));
}

static bool in_arc(const double p[2], const double *n)
{
    return to_line(arc_at, p, n, 12) < n[2] / 2;
}

static bool in_vesica(const double p[2], const double *n)
{
    const double centre = fmin(n[1] / 2, n[0]);

    return hypot(p[0] - centre, p[1]) < n[0] && hypot(p[0] + centre, p[1]) < n[0];
}

static bool in_cross(const double p[2], const double *n)
{
    const double across = fmin(n[1], n[0]);

    return (fabs(p[0]) < n[0] / 2 && fabs(p[1]) < across / 2) ||
           (fabs(p[1]) < n[0] / 2 && fabs(p[0]) < across / 2);
}

/* By halving lines, as one draws it (de Casteljau). */
static void bezier_at(const double *n, double t, double out[2])
{
    for (int i = 0; i < 2; i++) {
        const double ab = n[i] + t * (n[2 + i] - n[i]), bc = n[2 + i] + t * (n[4 + i] - n[2 + i]);
        out[i] = ab + t * (bc - ab);
    }
}

static bool in_bezier(const double p[2], const double *n)
{
    return to_line(bezier_at, p, n, 24) < n[6] / 2;
}

static bool in_heart(const double p[2], const double *n)
{
    const double x = fabs(p[0]) / n[0], y = p[1] / n[0];
    const bool square = x + fabs(y - 0.5) < 0.5;
    const bool half_disc = x + y >= 1 && pow(x - 0.25, 2) + pow(y - 0.75, 2) < 0.125;

    return square || half_disc;
}

static bool in_ellipse(const double p[2], const double *n)
{
    return pow(p[0] / n[0], 2) + pow(p[1] / n[1], 2) < 1;
}

static void segment_at(const double *n, double t, double out[2])
{
    for (int i = 0; i < 2; i++) {
        out[i] = n[i] + t * (n[2 + i] - n[i]);
    }
}

static bool in_segment(const double p[2], const double *n)
{
    return to_line(segment_at, p, n, 2) < n[4] / 2;
}

static bool vesica_is_a_point(const double *n)
{
    return n[1] >= 2 * n[0];
}

struct words {
    const char *type;
    bool (*inside)(const double p[2], const double *n);
    /* Nothing is inside; NULL: that cannot be. */
    bool (*hollow)(const double *n);
    /* A line that may overlap itself, and its width: there the inside is only a bound. */
    line *line;
    int width;
};

static const struct words all_words[] = {
    {.type = "circle", .inside = in_circle},
    {.type = "rectangle", .inside = in_rectangle},
    {.type = "round_rectangle", .inside = in_round_rectangle},
    {.type = "triangle2", .inside = in_triangle2},
    {.type = "regular_polygon", .inside = in_regular_polygon},
    {.type = "polygon", .inside = in_polygon},
    {.type = "star", .inside = in_star},
    {.type = "ring", .inside = in_ring},
    {.type = "arc", .inside = in_arc},
    {.type = "vesica", .inside = in_vesica, .hollow = vesica_is_a_point},
    {.type = "cross", .inside = in_cross},
    {.type = "bezier", .inside = in_bezier, .line = bezier_at, .width = 6},
    {.type = "heart", .inside = in_heart},
    {.type = "ellipse", .inside = in_ellipse},
    {.type = "segment", .inside = in_segment},
};

static const struct words *words_of(const struct node_type *type)
{
    for (size_t i = 0; i < sizeof all_words / sizeof all_words[0]; i++) {
        if (strcmp(all_words[i].type, type->record.name) == 0) {
            return &all_words[i];
        }
    }
    fail_msg("this test does not know what is inside a %s", type->record.name);
    return NULL;
}

/* --- one shape --- */

struct shape {
    const struct node_type *type;
    const struct sdf *sdf;
    const struct words *words;
    double raw[SDF_NUMBERS_MAX], ready[SDF_NUMBERS_MAX]; /* as written, and for the function */
};

static void shape_prepare(struct shape *shape)
{
    memcpy(shape->ready, shape->raw, sizeof shape->raw);
    if (shape->sdf->prepare) {
        shape->sdf->prepare(shape->ready);
    }
}

static struct shape random_shape(struct random *random, const struct node_type *type)
{
    const struct random_limits limits = {.plain = true};
    struct scene *scene = random_scene(random, type, &limits);
    struct shape shape = {.type = type, .sdf = sdf_find(type), .words = words_of(type)};

    sdf_numbers(type->record.params, scene->root->params.values, shape.raw);
    shape_prepare(&shape);
    scene_destroy(scene);
    return shape;
}

static double distance(const struct shape *shape, double x, double y)
{
    const double p[3] = {x, y, 0};

    return shape->sdf->shape(p, shape->ready);
}

static void fail_at(const struct shape *shape, const char *what, const double p[2], double d)
{
    fprintf(stderr, "%s", shape->type->record.name);
    for (int i = 0; i < 12; i++) {
        fprintf(stderr, " %.9g", shape->raw[i]);
    }
    fail_msg("%s: %g %s at %.9g %.9g", shape->type->record.name, d, what, p[0], p[1]);
}

/* Is a point at this distance from p on the other side? */
static bool other_side_at(const struct shape *shape, const double p[2], double radius,
                          int directions, bool in)
{
    for (int i = 0; i < directions; i++) {
        const double angle = 2 * PI * i / directions;
        double q[2] = {p[0] + radius * cos(angle), p[1] + radius * sin(angle)};
        if (shape->words->inside(q, shape->raw) != in) {
            return true;
        }
    }
    return false;
}

static bool other_side_within(const struct shape *shape, const double p[2], double radius,
                              int directions, bool in)
{
    for (int i = 1; i <= 4; i++) {
        if (other_side_at(shape, p, radius * i / 4, directions, in)) {
            return true;
        }
    }
    return false;
}

/* Where the distance says that the nearest point is: against its gradient. */
static void nearest_point(const struct shape *shape, const double p[2], double d, double out[2])
{
    const double h = 1e-6;
    const double x = distance(shape, p[0] + h, p[1]) - distance(shape, p[0] - h, p[1]);
    const double y = distance(shape, p[0], p[1] + h) - distance(shape, p[0], p[1] - h);
    const double length = fmax(hypot(x, y), 1e-30);

    out[0] = p[0] - d * x / length;
    out[1] = p[1] - d * y / length;
}

static bool is_exact(const struct shape *shape, const double p[2], double d, bool in)
{
    const struct words *words = shape->words;
    double nearest[2];

    if (in && words->line) {
        const double depth =
            shape->raw[words->width] / 2 - to_line(words->line, p, shape->raw, 200);
        return fabs(-d - depth) < TOLERANCE;
    }
    nearest_point(shape, p, d, nearest);
    /* Corners may be as sharp as needles. */
    return other_side_within(shape, nearest, TOLERANCE, 360, in) ||
           other_side_within(shape, nearest, TOLERANCE, 100000, in);
}

static void check_point(const struct shape *shape, const double p[2])
{
    const double d = distance(shape, p[0], p[1]), nearer = fabs(d) - TOLERANCE;
    const bool in = shape->words->inside(p, shape->raw);

    if (fabs(d) > 1e-6 && in != (d < 0)) {
        fail_at(shape, "has the wrong sign", p, d);
    }
    if (nearer > 0 && (other_side_at(shape, p, nearer, 360, in) ||
                       other_side_within(shape, p, nearer * 0.8, 90, in))) {
        fail_at(shape, "overstates", p, d);
    }
    const bool hollow = shape->words->hollow && shape->words->hollow(shape->raw);
    if (shape->type->exactness == EXACT && !hollow && !is_exact(shape, p, d, in)) {
        fail_at(shape, "understates", p, d);
    }
}

static void distances_are_those_of_the_words(void **state)
{
    (void)state;
    struct random random = {21};
    size_t rows = 0;

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        if (type->kind != KIND_FLAT) {
            continue;
        }
        rows++;
        for (int round = 0; round < 250; round++) {
            struct shape shape = random_shape(&random, type);
            for (int k = 0; k < 4; k++) {
                const double size = k % 2 ? 2.5 : 0.8; /* half of the points near or in the shape */
                double p[2] = {random_between(&random, -size, size),
                               random_between(&random, -size, size)};
                if (shape.words->line && k == 0) { /* on the line, where a miss weighs most */
                    shape.words->line(shape.raw, random_between(&random, 0, 1), p);
                }
                check_point(&shape, p);
            }
        }
    }
    assert_int_equal(rows, sizeof all_words / sizeof all_words[0]);
}

static void boxes_hold_the_shapes_and_have_no_end_along_z(void **state)
{
    (void)state;
    struct random random = {22};
    size_t solid = 0;

    for (size_t i = 0; i < node_type_count(); i++) {
        const struct node_type *type = node_type_at(i);
        for (int round = 0; round < 200 && type->kind == KIND_FLAT; round++) {
            struct shape shape = random_shape(&random, type);
            struct bounds box = shape.sdf->box(shape.ready);
            assert_true(box.low[2] == -INFINITY && box.high[2] == INFINITY);
            for (int k = 0; k < 50; k++) {
                const double p[3] = {random_between(&random, -1, 1), random_between(&random, -1, 1),
                                     random_between(&random, -1, 1)};
                const double d = shape.sdf->shape(p, shape.ready);
                assert_true(d == distance(&shape, p[0], p[1]));
                struct bounds grown = bounds_grow(box, fmax(d, 0) + 1e-9);
                for (int j = 0; j < 2; j++) {
                    if (p[j] < grown.low[j] || p[j] > grown.high[j]) {
                        fail_at(&shape, "is outside of the box", p, d);
                    }
                }
                solid += d < 0;
            }
        }
    }
    assert_true(solid > 10000);
}

/* --- parameters at the edge of what they may be --- */

static const struct {
    const char *type;
    double n[12];
    double p[2];
    double distance;
} known[] = {
    {"round_rectangle", {2, 1, 9}, {0.5, 1}, 0.5}, /* a pill: the rounding is limited */
    {"round_rectangle", {2, 1, 0}, {4, 4.5}, 5},
    {"triangle2", {0, 0, 4, 0, 0, 3}, {1, 1}, -1},
    {"triangle2", {0, 0, 0, 3, 4, 0}, {1, 1}, -1},    /* the other way around */
    {"triangle2", {0, 0, 2, 0, 1, 0}, {1, 0.5}, 0.5}, /* flat: a line */
    {"triangle2", {0, 0, 2, 0, 1, 0}, {1, 0}, 0},
    {"triangle2", {1, 1, 1, 1, 1, 1}, {4, 5}, 5}, /* a point */
    {"regular_polygon", {1, 4}, {0, 0}, -0.70710678118654752},
    {"regular_polygon", {1, 4}, {0, 3}, 2}, /* above the first corner */
    {"regular_polygon", {1, 64}, {0, -1}, 0},
    {"regular_polygon", {1, 3}, {0, -2}, 1.5},
    {"star", {2, 4, 0}, {0.5, 1}, 0.5}, /* four spokes without area */
    {"star", {2, 4, 0}, {0, 0}, 0},
    {"star", {1, 2, 1}, {2, 2}, 2.1213203435596426}, /* two points: a square on its corner */
    {"star", {1, 3, 2}, {0, -3}, 1},                 /* the corners between are farther out */
    {"polygon", {4, 0, 0, 2, 0, 2, 2, 0, 2}, {1, 1}, -1},
    {"polygon", {4, 0, 2, 2, 2, 2, 0, 0, 0}, {1, 1}, -1},      /* the other way around */
    {"polygon", {4, 0, 0, 2, 0, 2, 0, 2, 2}, {2.5, 0.5}, 0.5}, /* a corner twice */
    {"polygon", {3, 0, 0, 2, 0, 4, 0}, {1, 0.5}, 0.5},         /* flat: a line */
    {"ring", {2, 1}, {0, 0}, 1.5},
    {"ring", {1, 4}, {0, 0}, -3}, /* no hole: a disc */
    {"ring", {1, 4}, {0, 5}, 2},
    {"arc", {2, 0, 1}, {0, 0}, 1.5}, /* a disc at (0, 2) */
    {"arc", {2, 0, 1}, {0, 2}, -0.5},
    {"arc", {2, 0, 1}, {0, -2}, 3.5},
    {"arc", {2, PI, 1}, {0, -2}, -0.5}, /* a ring */
    {"arc", {2, PI, 1}, {0, -5}, 2.5},
    {"arc", {2, PI / 2, 1}, {2, -3}, 2.5},
    {"arc", {1, PI, 4}, {0, 0}, -3},       /* a ring without a hole */
    {"arc", {3, PI / 2, 10}, {0, -3}, -1}, /* the ends' circles meet at (0, -4) */
    {"arc", {3, PI / 2, 10}, {0, 0}, -4},
    {"arc", {3, PI / 2, 10}, {0, 7}, -1},
    {"vesica", {1, 0}, {0, 3}, 2}, /* one disc */
    {"vesica", {1, 7}, {3, 4}, 5}, /* a point */
    {"vesica", {5, 6}, {0, 9}, 5}, /* beyond the tip at (0, 4) */
    {"vesica", {5, 6}, {0, 0}, -2},
    {"cross", {2, 9}, {0, 0}, -1}, /* as thick as long: a square */
    {"cross", {4, 2}, {0, 0}, -1.4142135623730951},
    {"cross", {4, 2}, {3, 2}, 1.4142135623730951},
    {"cross", {4, 2}, {1.5, 3}, 1.118033988749895},
    {"bezier", {0, 0, 1, 0, 2, 0, 1}, {1, 2}, 1.5}, /* straight */
    {"bezier", {0, 0, 1, 0, 2, 0, 1}, {5, 4}, 4.5},
    {"bezier", {0, 0, 2, 0, 2, 0, 1}, {1, 2}, 1.5}, /* straight and uneven */
    {"bezier", {0, 0, 4, 0, 0, 0, 1}, {5, 0}, 2.5}, /* there and back again, from (2, 0) */
    {"bezier", {0, 0, 4, 0, 0, 0, 1}, {1, 3}, 2.5},
    {"bezier", {1, 1, 1, 1, 1, 1, 2}, {4, 5}, 4},          /* a point */
    {"bezier", {-1, 1, 0, -1, 1, 1, 0.5}, {0, 0.5}, 0.25}, /* x^2 at its centre of curvature */
    {"heart", {2}, {0, -3}, 3},
    {"heart", {2}, {0, 3}, 0.87403204889764219},
    {"heart", {2}, {0, 1}, -0.70710678118654752},
    {"segment", {1, 1, 1, 1, 1}, {4, 5}, 4.5},
    {"segment", {0, 0, 4, 0, 2}, {2, 0.25}, -0.75},
};

static void degenerate_shapes_have_distances(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct shape shape = {.type = node_type_find(known[i].type)};
        shape.sdf = sdf_find(shape.type);
        memcpy(shape.raw, known[i].n, sizeof known[i].n);
        shape_prepare(&shape);
        const double d = distance(&shape, known[i].p[0], known[i].p[1]);
        if (!(fabs(d - known[i].distance) < 1e-4)) {
            fail_msg("%s (row %zu): %.15g instead of %.15g", known[i].type, i, d,
                     known[i].distance);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_of_the_words),
        cmocka_unit_test(boxes_hold_the_shapes_and_have_no_end_along_z),
        cmocka_unit_test(degenerate_shapes_have_distances),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
