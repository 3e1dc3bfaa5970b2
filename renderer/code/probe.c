/* SPDX-License-Identifier: MIT */
/* Asks code about points all over a box, before it is drawn. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "code_internal.h"

/* Points for code of little work, and for code of much. */
enum { POINTS_MAX = 1000, POINTS_MIN = 60, RUNS_OF_POINT = 10 };
#define WORK_MAX 2e7

/* How much faster than declared a distance may change: rounded constants make directions that are
 * not quite unit vectors. */
#define SLACK 1.01

/* Points that fill a cube evenly, however many of them are taken: multiples of powers of the root
 * of x^4 = x + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018). None is
 * in the middle or on an axis, where honest code may divide by 0. */
static void point_of(const struct code_probe *probe, int index, double out[3])
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
    const double z = 2 * fmod(index * 0.7548776662466927, 1) - 1;
    const double turn = 2 * M_PI * fmod(index * 0.5698402909980532, 1), r = sqrt(1 - z * z);

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

static bool refuse(const struct code_fault *fault, const double p[3], struct error *err)
{
    return error_set_at(err, ERROR_COMPILE, "", fault->line, fault->column,
                        "%s at the point (%.4g, %.4g, %.4g)", fault->message, p[0], p[1], p[2]);
}

static bool ask(const struct code_probe *probe, const double p[3], double *out, struct error *err)
{
    struct code_fault fault;

    *out = code_distance(probe->code, p, probe->numbers, &fault);
    const bool fine = fault.line == 0 || (fault.infinite && *out < CODE_FAR);
    return fine || refuse(&fault, p, err);
}

/* Between two points `between` apart. What is too far is no measure of anything. */
static void take_slope(struct code_probe *probe, double a, double b, double between)
{
    const double slope = fabs(a - b) / between;

    if (fmax(fabs(a), fabs(b)) < CODE_FAR && slope > probe->greatest) {
        probe->greatest = slope;
    }
}

/* Along the steepest way through the point, and a longer one anywhere. */
static bool ask_around(struct code_probe *probe, const double p[3], int index, struct error *err)
{
    enum { LONGER = 50 };
    double h = probe->step, here, q[3], a, b, gradient[3], direction[3];
    if (!ask(probe, p, &here, err)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        const double axis[3] = {i == 0, i == 1, i == 2};
        along(p, axis, h, q);
        const bool ok = ask(probe, q, &a, err);
        along(p, axis, -h, q);
        if (!ok || !ask(probe, q, &b, err)) {
            return false;
        }
        gradient[i] = a - b;
    }
    const double length = hypot(hypot(gradient[0], gradient[1]), gradient[2]);
    for (int i = 0; i < 3; i++) {
        direction[i] = length > 0 ? gradient[i] / length : 0;
    }
    along(p, direction, h, q);
    const bool ok = ask(probe, q, &a, err);
    along(p, direction, -h, q);
    if (!ok || !ask(probe, q, &b, err)) {
        return false;
    }
    take_slope(probe, a, b, 2 * h);
    direction_of(index, direction);
    along(p, direction, LONGER * h, q);
    if (!ask(probe, q, &a, err)) {
        return false;
    }
    take_slope(probe, here, a, LONGER * h);
    return true;
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

static bool ask_shade(const struct code_probe *probe, const double p[3], int index,
                      struct error *err)
{
    struct code_shading at = {.ray_distance = 1 + index};
    struct code_fault fault;

    memcpy(at.world_position, p, sizeof at.world_position);
    memcpy(at.object_position, p, sizeof at.object_position);
    direction_of(index, at.world_normal);
    direction_of(index + probe->points, at.ray_direction);
    const bool none = shade_at(probe->code, &at, probe->numbers, &fault);
    return fault.line == 0 || (fault.infinite && !none) || refuse(&fault, p, err);
}

void code_probe_begin(struct code_probe *out, const struct code *code, const double *n,
                      const double low[3], const double high[3], double lipschitz)
{
    const double steps = 1e4, work = (double)code->tree.entry->work + 1;
    double size = 0, count = WORK_MAX / (RUNS_OF_POINT * work);

    *out = (struct code_probe){.code = code, .numbers = n, .lipschitz = lipschitz};
    for (int i = 0; i < 3; i++) {
        out->low[i] = low[i];
        out->size[i] = high[i] - low[i];
        size = fmax(size, out->size[i]);
    }
    out->step = fmax(size, 1e-3) / steps;
    out->points = (int)fmin(fmax(count, POINTS_MIN), POINTS_MAX);
}

bool code_probe_ask(struct code_probe *probe, struct error *err)
{
    const bool shades = probe->code->use == CODE_SHADE;
    const int index = probe->asked++;
    double p[3];

    point_of(probe, index, p);
    if (!(shades ? ask_shade(probe, p, index, err) : ask_around(probe, p, index, err)) &&
        !probe->slopes_only) {
        return false;
    }
    return probe->asked < probe->points || shades || probe->greatest <= SLACK * probe->lipschitz ||
           error_set(err, ERROR_COMPILE, "",
                     "the distance changes by up to %.3g per unit of length, and declared are %.3g",
                     probe->greatest, probe->lipschitz);
}
