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

/* Whether x = `at` + a number of whole turns is in the interval. */
static bool turns_in(const double x[2], double at)
{
    const double turn = 6.283185307;

    return floor((x[1] - at) / turn) > floor((x[0] - at) / turn);
}

static void range_of_cosine(const double x[2], double out[2])
{
    const double ends[2] = {cos(x[0]), cos(x[1])};

    out[0] = turns_in(x, 3.141592654) ? -1 : fmin(ends[0], ends[1]);
    out[1] = turns_in(x, 0) ? 1 : fmax(ends[0], ends[1]);
}

/* The slope is -sin x = cos(x + pi/2). */
void jet_range_cos(double *out, const double *const in[], int n)
{
    const double x[2] = {in[0][0], in[0][1]};
    const double ahead[2] = {x[0] + 1.570796327, x[1] + 1.570796327};

    UNUSED(n);
    range_of_cosine(x, out);
    range_of_cosine(ahead, out + 2);
}
