/* SPDX-License-Identifier: MIT */
/* Duals and jets, as in glsl/jets.glsl. */
#include "jets.h"

#include <math.h>
#include <stdbool.h>

enum { LEAST, MOST = 3, VALUE = 6, NUMBERS = 9 }; /* in a jet */

/* The rows of the table in builtins.c are of one type. */
#define UNUSED(n) (void)(n)

static double bounded(double x)
{
    return x < -JET_MAX ? -JET_MAX : x > JET_MAX ? JET_MAX : x;
}

/* Intervals are (least, greatest). */
static void product(const double a[2], const double b[2], double out[2])
{
    const double p = a[0] * b[0], q = a[0] * b[1], r = a[1] * b[0], s = a[1] * b[1];

    out[0] = bounded(fmin(fmin(p, q), fmin(r, s)));
    out[1] = bounded(fmax(fmax(p, q), fmax(r, s)));
}

/* The slopes of a jet times an interval. */
static void add_slopes(double *out, const double *jet, const double by[2])
{
    for (int i = 0; i < 3; i++) {
        const double slope[2] = {jet[LEAST + i], jet[MOST + i]};
        double scaled[2];
        product(slope, by, scaled);
        out[LEAST + i] += scaled[0];
        out[MOST + i] += scaled[1];
    }
}

static bool has_zero(const double x[2])
{
    return x[0] * x[1] <= 0;
}

void jet_dual_times(double *out, const double *const in[], int n)
{
    const double *a = in[0], *b = in[1];

    UNUSED(n);
    for (int i = 0; i < 3; i++) {
        out[i] = a[i] * b[3] + b[i] * a[3];
    }
    out[3] = a[3] * b[3];
}

void jet_dual_of(double *out, const double *const in[], int n)
{
    UNUSED(n);
    for (int i = 0; i < 3; i++) {
        out[i] = in[0][i] * in[2][0];
    }
    out[3] = in[1][0];
}

void jet_times(double *out, const double *const in[], int n)
{
    double sum[NUMBERS] = {0};

    UNUSED(n);
    add_slopes(sum, in[0], in[1] + VALUE);
    add_slopes(sum, in[1], in[0] + VALUE);
    product(in[0] + VALUE, in[1] + VALUE, sum + VALUE);
    for (int i = 0; i < NUMBERS; i++) {
        out[i] = sum[i];
    }
}

void jet_minus(double *out, const double *const in[], int n)
{
    const double *a = in[0], *b = in[1];

    UNUSED(n);
    for (int i = 0; i < 3; i++) {
        out[LEAST + i] = a[LEAST + i] - b[MOST + i];
        out[MOST + i] = a[MOST + i] - b[LEAST + i];
    }
    out[VALUE] = a[VALUE] - b[VALUE + 1];
    out[VALUE + 1] = a[VALUE + 1] - b[VALUE];
    out[VALUE + 2] = 0;
}

void jet_scaled(double *out, const double *const in[], int n)
{
    const double by[2] = {in[1][0], in[1][0]};
    double scaled[NUMBERS] = {0};

    UNUSED(n);
    add_slopes(scaled, in[0], by);
    product(in[0] + VALUE, by, scaled + VALUE);
    for (int i = 0; i < NUMBERS; i++) {
        out[i] = scaled[i];
    }
}

void jet_moved(double *out, const double *const in[], int n)
{
    UNUSED(n);
    for (int i = 0; i < NUMBERS; i++) {
        out[i] = in[0][i] + (i == VALUE || i == VALUE + 1 ? in[1][0] : 0);
    }
}

void jet_of(double *out, const double *const in[], int n)
{
    const double *range = in[1];
    const double slope[2] = {bounded(range[2]), bounded(range[3])};
    const double value[2] = {bounded(range[0]), bounded(range[1])};
    double chained[NUMBERS] = {0};

    UNUSED(n);
    add_slopes(chained, in[0], slope);
    for (int i = 0; i < NUMBERS; i++) {
        out[i] = i < VALUE ? chained[i] : i < VALUE + 2 ? value[i - VALUE] : 0;
    }
}

void jet_even(double *out, const double *const in[], int n)
{
    const double *x = in[0] + VALUE, *power = in[1], k = in[2][0];
    const double ends[2] = {fabs(x[0]) * power[0], fabs(x[1]) * power[1]};
    const double range[4] = {has_zero(x) ? 0 : fmin(ends[0], ends[1]), fmax(ends[0], ends[1]),
                             x[0] < 0 ? -k * power[0] : k * power[0],
                             x[1] < 0 ? -k * power[1] : k * power[1]};

    jet_of(out, (const double *const[]){in[0], range}, n);
}

void jet_odd(double *out, const double *const in[], int n)
{
    const double *x = in[0] + VALUE, *power = in[1], k = in[2][0];
    const double range[4] = {x[0] * power[0], x[1] * power[1],
                             has_zero(x) ? 0 : k * fmin(power[0], power[1]),
                             k * fmax(power[0], power[1])};

    jet_of(out, (const double *const[]){in[0], range}, n);
}

/* The least and greatest of a wave that is greatest where `turns` is a whole number. */
static void range_of_wave(const double ends[2], const double turns[2], double at, double out[2])
{
    const bool low = floor(turns[1] - at - 0.5) > floor(turns[0] - at - 0.5);
    const bool high = floor(turns[1] - at) > floor(turns[0] - at);

    out[0] = low ? -1 : fmin(ends[0], ends[1]);
    out[1] = high ? 1 : fmax(ends[0], ends[1]);
}

void jet_turn(double *out, const double *const in[], int n)
{
    const double x[2] = {in[0][0], in[0][1]};
    const double turns[2] = {0.15915494309 * x[0], 0.15915494309 * x[1]};

    UNUSED(n);
    range_of_wave((const double[]){sin(x[0]), sin(x[1])}, turns, 0.25, out);
    range_of_wave((const double[]){cos(x[0]), cos(x[1])}, turns, 0, out + 2);
}

void jet_cos(double *out, const double *const in[], int n)
{
    const double *turn = in[1];
    const double range[4] = {turn[2], turn[3], -turn[1], -turn[0]};

    jet_of(out, (const double *const[]){in[0], range}, n);
}

void jet_dual_sin(double *out, const double *const in[], int n)
{
    const double x = in[0][3], value = sin(x), slope = cos(x);

    jet_dual_of(out, (const double *const[]){in[0], &value, &slope}, n);
}

void jet_dual_cos(double *out, const double *const in[], int n)
{
    const double x = in[0][3], value = cos(x), slope = -sin(x);

    jet_dual_of(out, (const double *const[]){in[0], &value, &slope}, n);
}

static double bounded_exp(double x)
{
    return exp(fmin(x, 40));
}

void jet_exp(double *out, const double *const in[], int n)
{
    const double least = bounded_exp(in[0][VALUE]), most = bounded_exp(in[0][VALUE + 1]);

    jet_of(out, (const double *const[]){in[0], (const double[]){least, most, least, most}}, n);
}

void jet_dual_exp(double *out, const double *const in[], int n)
{
    const double value = bounded_exp(in[0][3]);

    jet_dual_of(out, (const double *const[]){in[0], &value, &value}, n);
}

/* --- distances --- */

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

void jet_near_box(double *out, const double *const in[], int n)
{
    double beyond[3], within = -INFINITY;

    UNUSED(n);
    for (int i = 0; i < 3; i++) {
        const double p = in[0][i], half = 0.5 * in[1][i];
        out[i] = fmin(fmax(p, -half), half);
        beyond[i] = p - out[i];
        within = fmax(within, fabs(p) - half);
    }
    const double outside = length_of(beyond);
    out[3] = outside > 0 ? outside : within;
}

void jet_near_ball(double *out, const double *const in[], int n)
{
    const double *p = in[0], radius = in[1][0], way = length_of(p);
    const double by = fmin(1, radius / fmax(way, 1e-18));

    UNUSED(n);
    out[3] = way - radius;
    for (int i = 0; i < 3; i++) {
        out[i] = p[i] * by;
    }
}

void jet_clipped(double *out, const double *const in[], int n)
{
    const double way = in[0][3], d = in[1][0];

    UNUSED(n);
    out[0] = way > 0 ? hypot(way, fmax(d, 0)) : fmax(d, way);
}

void jet_begin(double *out, const double *const in[], int n)
{
    const double value = fabs(in[0][3]), slope = length_of(in[0]);

    UNUSED(n);
    out[0] = value;
    out[1] = fmin(value / fmax(slope, 1e-18), in[1][0]);
    out[2] = in[1][0];
    out[3] = 0;
}

void jet_room(double *out, const double *const in[], int n)
{
    UNUSED(in);
    UNUSED(n);
    out[0] = 0;
}

void jet_ahead(double *out, const double *const in[], int n)
{
    const double *dual = in[1], step = dual[3] < 0 ? -in[2][1] : in[2][1];
    const double slope = fmax(length_of(dual), 1e-18);

    UNUSED(n);
    for (int i = 0; i < 3; i++) {
        out[i] = in[0][i] - dual[i] / slope * step;
    }
}

void jet_estimated(double *out, const double *const in[], int n)
{
    const double value = in[1][0], step = fmax(in[1][1], 1e-18), slope = length_of(in[0]);
    const double ahead = in[0][3] < 0 ? -in[2][3] : in[2][3];
    const double bend = (ahead - value + slope * step) / (step * step);
    const double square = slope * slope - 4 * bend * value;

    UNUSED(n);
    out[0] = 2 * value / fmax(slope + copysign(sqrt(fabs(square)), square), 1e-18);
}

/* What an interval tells of the slope: the greatest; that nothing is 0; that there is a jump. */
struct told {
    double most;
    bool clear, jumps;
};

static struct told told_by(const double *jet)
{
    double steepest[3];

    for (int i = 0; i < 3; i++) {
        steepest[i] = fmax(fabs(jet[LEAST + i]), fabs(jet[MOST + i]));
    }
    const double most = fmax(length_of(steepest), 1e-18);
    const bool clear = !has_zero(jet + VALUE);
    return (struct told){most, clear, !clear && most > 1e17};
}

static double smaller(double reach, double known, bool jumps)
{
    return sqrt(fmax(known, (jumps ? 0.04 : 0.001) * reach) * reach);
}

static double larger(double reach, double limit)
{
    return 2 * reach < limit ? sqrt(reach * limit) : 0;
}

void jet_solid(double *out, const double *const in[], int n)
{
    const double value = in[1][0], reach = in[1][1], limit = in[1][2];
    const struct told told = told_by(in[0]);
    const double free = told.clear ? reach : fmin(value / told.most, reach);
    const double known = fmax(in[1][3], told.jumps ? 0.0003 * reach : free);

    UNUSED(n);
    out[0] = value;
    out[1] = told.clear            ? larger(reach, limit)
             : known > 0.4 * reach ? 0
                                   : smaller(reach, known, told.jumps);
    out[2] = told.clear ? limit : reach;
    out[3] = known;
}

void jet_sheet(double *out, const double *const in[], int n)
{
    const double value = in[1][0], reach = in[1][1], limit = in[1][2], half = 0.5 * in[2][0];
    const double grain = half / 8, around = half + grain;
    const struct told told = told_by(in[0]);
    const bool last = reach <= grain, steep = value < 0.002 * half * told.most;
    const double slow = fmin(value / told.most - half, last ? grain : reach - grain);
    const double known = fmax(in[1][3], told.clear ? fmax(slow, reach - half) : slow);
    const bool ends = known < 2 * grain && reach < 4 * half;

    UNUSED(n);
    out[0] = value;
    out[1] = last                                   ? 0
             : told.clear && known >= 0             ? larger(reach, limit)
             : known > 0.4 * reach                  ? 0
             : steep && reach > around && known < 0 ? around
             : ends                                 ? grain
                    : fmax(smaller(reach, known, told.jumps), grain);
    out[2] = told.clear ? limit : reach;
    out[3] = known;
}

/* Columns of a search. */
enum { TRY = 0, LOW = 3, HIGH = 6 };

void jet_search(double *out, const double *const in[], int n)
{
    const double value = fabs(in[0][3]), limit = in[1][0];
    const double step = fmin(value / fmax(length_of(in[0]), 1e-18), limit);
    const double begin[NUMBERS] = {step, value, step > 0 ? 0 : 2, 0, value, limit, limit, 0, 0};

    UNUSED(n);
    for (int i = 0; i < NUMBERS; i++) {
        out[i] = begin[i];
    }
}

void jet_searched(double *out, const double *const in[], int n)
{
    const double *jet = in[0], *search = in[1], r = search[TRY], limit = search[LOW + 2];
    const double least = fmax(jet[VALUE], -jet[VALUE + 1]);
    const double free = fmax(least, search[TRY + 1] - told_by(jet).most * r);
    const int moved = free > 0 ? LOW : HIGH, stays = free > 0 ? HIGH : LOW;
    const double side = free > 0 ? 1 : -1;
    const bool whole = free > 0 && search[HIGH + 1] == 0;

    UNUSED(n);
    for (int i = 0; i < NUMBERS; i++) {
        out[i] = search[i];
    }
    out[moved] = r;
    out[moved + 1] = free;
    out[stays + 1] *= side == search[TRY + 2] ? 0.5 : 1;
    out[HIGH + 2]++;
    const double between = out[HIGH] - out[LOW];
    const double part = out[LOW + 1] / fmax(out[LOW + 1] - out[HIGH + 1], 1e-30);
    const bool halves = part < 0.02 || out[HIGH + 2] > JET_SECANTS;
    const double next = out[LOW] + between * (halves ? 0.5 : part);
    const bool close = between < 1e-5 * next || (!halves && fabs(next - r) < 2e-4 * r);
    const bool found = whole ? r >= limit : close;
    out[TRY] = whole ? limit : next;
    out[TRY + 2] = found ? 2 : side;
}
