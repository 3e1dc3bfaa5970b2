/* SPDX-License-Identifier: MIT */
/* Asks code about points all over a box, before it is drawn. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "code_parts.h"

/* Points for code of little work, and for code of much. */
enum { POINTS_MAX = 1000, POINTS_MIN = 60, RUNS_OF_POINT = 10 };
#define WORK_MAX 2e7

/* How much faster than declared a distance may change: rounded constants make directions that are
 * not quite unit vectors. */
#define SLACK 1.01

struct probe {
    const struct code *code;
    const double *numbers;
    double low[3], size[3];
    double step;     /* of a short way */
    double greatest; /* slope */
    struct error *err;
};

/* Points that fill a cube evenly, however many of them are taken: multiples of powers of the root
 * of x^4 = x + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). None is
 * in the middle or on an axis, where honest code may divide by 0. */
static void point_of(const struct probe *probe, int index, double out[3])
{
    const double root = 1.2207440846057596;
    double power = 1;
    for (int i = 0; i < 3; i++) {
        power /= root;
        out[i] = probe->low[i] + probe->size[i] * fmod(0.5 + (index + 1) * power, 1);
    }
}

static void direction_of(int index, double out[3])
{
    double z = 2 * fmod(index * 0.7548776662466927, 1) - 1;
    double turn = 2 * M_PI * fmod(index * 0.5698402909980532, 1), r = sqrt(1 - z * z);
    out[0] = r * cos(turn);
    out[1] = r * sin(turn);
    out[2] = z;
}

static void along(const double p[3], const double direction[3], double t, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] + t * direction[i];
    }
}

static bool refuse(const struct probe *probe, const struct code_fault *fault, const double p[3])
{
    return error_set_at(probe->err, ERROR_COMPILE, "", fault->line, fault->column,
                        "%s at the point (%.4g, %.4g, %.4g)", fault->message, p[0], p[1], p[2]);
}

static bool ask(const struct probe *probe, const double p[3], double *out)
{
    struct code_fault fault;
    *out = code_distance(probe->code, p, probe->numbers, &fault);
    bool fine = fault.line == 0 || (fault.infinite && *out < CODE_FAR);
    return fine || refuse(probe, &fault, p);
}

/* Between two points `between` apart. What is too far is no measure of anything. */
static void take_slope(struct probe *probe, double a, double b, double between)
{
    double slope = fabs(a - b) / between;
    if (fmax(fabs(a), fabs(b)) < CODE_FAR && slope > probe->greatest) {
        probe->greatest = slope;
    }
}

/* Along the steepest way through the point, and a longer one anywhere. */
static bool ask_around(struct probe *probe, const double p[3], int index)
{
    enum { LONGER = 50 };
    double h = probe->step, here, q[3], a, b, gradient[3], direction[3];
    if (!ask(probe, p, &here)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        const double axis[3] = {i == 0, i == 1, i == 2};
        along(p, axis, h, q);
        bool ok = ask(probe, q, &a);
        along(p, axis, -h, q);
        if (!ok || !ask(probe, q, &b)) {
            return false;
        }
        gradient[i] = a - b;
    }
    double length = hypot(hypot(gradient[0], gradient[1]), gradient[2]);
    for (int i = 0; i < 3; i++) {
        direction[i] = length > 0 ? gradient[i] / length : 0;
    }
    along(p, direction, h, q);
    bool ok = ask(probe, q, &a);
    along(p, direction, -h, q);
    if (!ok || !ask(probe, q, &b)) {
        return false;
    }
    take_slope(probe, a, b, 2 * h);
    direction_of(index, direction);
    along(p, direction, LONGER * h, q);
    if (!ask(probe, q, &a)) {
        return false;
    }
    take_slope(probe, here, a, LONGER * h);
    return true;
}

static bool probe_distance(struct probe *probe, int points, double lipschitz)
{
    for (int i = 0; i < points; i++) {
        double p[3];
        point_of(probe, i, p);
        if (!ask_around(probe, p, i)) {
            return false;
        }
    }
    return probe->greatest <= SLACK * lipschitz ||
           error_set(probe->err, ERROR_COMPILE, "",
                     "the distance changes by up to %.3g per unit of length, and declared are %.3g",
                     probe->greatest, lipschitz);
}

/* Whether the colour is the one that stands for none. */
static bool shade_at(const struct code *code, const struct code_shading *at, const double *n,
                     struct code_fault *fault)
{
    static const double magenta[4] = {1, 0, 1, 1};
    double color[4];
    if (code_gives_surface(code)) {
        struct code_surface surface;
        code_surface(code, at, n, &surface, fault);
        return memcmp(surface.color, magenta, sizeof surface.color) == 0;
    }
    code_shade(code, at, n, color, fault);
    return memcmp(color, magenta, sizeof color) == 0;
}

static bool probe_shade(const struct probe *probe, int points)
{
    for (int i = 0; i < points; i++) {
        struct code_shading at = {.ray_distance = 1 + i};
        struct code_fault fault;
        point_of(probe, i, at.world_position);
        memcpy(at.object_position, at.world_position, sizeof at.object_position);
        direction_of(i, at.world_normal);
        direction_of(i + points, at.ray_direction);
        bool none = shade_at(probe->code, &at, probe->numbers, &fault);
        if (fault.line > 0 && (none || !fault.infinite)) {
            return refuse(probe, &fault, at.world_position);
        }
    }
    return true;
}

bool code_probe(const struct code *code, const double *n, const double low[3], const double high[3],
                double lipschitz, struct error *err)
{
    const double steps = 1e4, work = (double)code->tree.entry->work + 1;
    struct probe probe = {.code = code, .numbers = n, .err = err};
    double size = 0, count = WORK_MAX / (RUNS_OF_POINT * work);
    for (int i = 0; i < 3; i++) {
        probe.low[i] = low[i];
        probe.size[i] = high[i] - low[i];
        size = fmax(size, probe.size[i]);
    }
    probe.step = fmax(size, 1e-3) / steps;
    int points = (int)fmin(fmax(count, POINTS_MIN), POINTS_MAX);
    return code->use == CODE_SHADE ? probe_shade(&probe, points)
                                   : probe_distance(&probe, points, lipschitz);
}
