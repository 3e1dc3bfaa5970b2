/* SPDX-License-Identifier: MIT */
#include "polynomial.h"

#include <math.h>
#include <string.h>

enum { ORDERS = 4, SERIES = 20 };

/* --- numbers --- */

int polynomial_rest_rows(int degree)
{
    return degree > 3 ? degree / 4 : 0;
}

static int further_rows(int length)
{
    return length / 4;
}

int polynomial_coefficient_rows(int degree)
{
    int rows = degree + 1;

    for (int i = 0; i <= degree; i++) {
        for (int j = 0; j <= degree - i; j++) {
            rows += 1 + further_rows(degree - i - j + 1);
        }
    }
    return rows;
}

size_t polynomial_rows(int degree)
{
    const size_t rows = (size_t)polynomial_coefficient_rows(degree);

    return (size_t)polynomial_rest_rows(degree) + (degree < POLYNOMIAL_FINE ? rows : 2 * rows);
}

int polynomial_trips(int degree)
{
    return (int)polynomial_rows(degree) + 2 * polynomial_rest_rows(degree) + 13;
}

static double factorial(int n)
{
    return tgamma(n + 1);
}

/* The norms of the orders. */
static void norms(int degree, const double *c, double *out)
{
    memset(out, 0, (size_t)(degree + 1) * sizeof *out);
    for (int i = 0; i <= degree; i++) {
        for (int j = 0; j <= degree - i; j++) {
            for (int k = 0; k <= degree - i - j; k++, c++) {
                out[i + j + k] +=
                    *c * *c * factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k);
            }
        }
    }
    for (int n = 0; n <= degree; n++) {
        out[n] = sqrt(out[n]);
    }
}

/* The coefficients of one power of x and one of y. Returns what follows. */
static double *write_row(const double *c, int length, double *out)
{
    while (length > 0 && c[length - 1] == 0) {
        length--;
    }
    const int further = further_rows(length);
    out[0] = further;
    for (int i = 0; i < 3 + 4 * further; i++) {
        const int power = 3 + 4 * further - 1 - i;
        out[1 + i] = power < length ? c[power] : 0;
    }
    return out + 4 + (size_t)(4 * further);
}

static int highest(const double *c, int degree, int i)
{
    for (int j = degree - i; j >= 0; j--) {
        const double *row = c + polynomial_at(degree, i, j);
        for (int k = 0; k <= degree - i - j; k++) {
            if (row[k] != 0) {
                return j;
            }
        }
    }
    return -1;
}

void polynomial_write(int degree, const double *c, double *out)
{
    double own[POLYNOMIAL_DEGREE_MAX + 1];
    const int rest = 4 * polynomial_rest_rows(degree);

    memset(out, 0, 4 * polynomial_rows(degree) * sizeof *out);
    norms(degree, c, own);
    for (int m = 4; m <= degree; m++) {
        out[rest - 1 - (m - 4)] = own[m] * m * (m - 1) * (m - 2) * (m - 3) / 24;
    }
    out += rest;
    double *lows = out + (size_t)(4 * polynomial_coefficient_rows(degree));
    const double *begin = out;
    for (int i = degree; i >= 0; i--) {
        const int most = highest(c, degree, i);
        out[0] = most + 1;
        out += 4;
        for (int j = most; j >= 0; j--) {
            out = write_row(c + polynomial_at(degree, i, j), degree - i - j + 1, out);
        }
    }
    for (const double *at = begin; degree >= POLYNOMIAL_FINE && at < out; at++) {
        *lows++ = *at - (double)(float)*at;
    }
}

/* --- evaluation --- */

/* Where the terms of a series of order 3 lie that have i powers of x and j of y. */
static size_t place(int i, int j)
{
    return polynomial_at(ORDERS - 1, i, j);
}

/* s = s * (z + way) + c */
static void step_z(double s[ORDERS], double z, double c)
{
    for (int k = ORDERS - 1; k > 0; k--) {
        s[k] = s[k] * z + s[k - 1];
    }
    s[0] = s[0] * z + c;
}

/* r = r * (y + way) + s */
static void step_y(double r[ORDERS][ORDERS], double y, const double s[ORDERS])
{
    for (int j = ORDERS - 1; j >= 0; j--) {
        for (int k = 0; k < ORDERS - j; k++) {
            r[j][k] = r[j][k] * y + (j > 0 ? r[j - 1][k] : s[k]);
        }
    }
}

/* a = a * (x + way) + r */
static void step_x(double a[SERIES], double x, double r[ORDERS][ORDERS])
{
    for (int i = ORDERS - 1; i >= 0; i--) {
        for (int j = 0; j < ORDERS - i; j++) {
            for (int k = 0; k < ORDERS - i - j; k++) {
                double *to = &a[place(i, j) + (size_t)k];
                *to = *to * x + (i > 0 ? a[place(i - 1, j) + (size_t)k] : r[j][k]);
            }
        }
    }
}

/* The value, and bounds of three orders. */
static void find_orders(const double p[3], const double *n, int degree, double out[ORDERS])
{
    double a[SERIES] = {0};

    for (int i = 0; i <= degree; i++) {
        double r[ORDERS][ORDERS] = {{0}};
        const int rows = (int)n[0];
        n += 4;
        for (int j = 0; j < rows; j++) {
            double s[ORDERS] = {0};
            const int length = 3 + 4 * (int)n[0];
            n++;
            for (int k = 0; k < length; k++) {
                step_z(s, p[2], *n++);
            }
            step_y(r, p[1], s);
        }
        step_x(a, p[0], r);
    }
    norms(ORDERS - 1, a, out);
    out[0] = a[0];
}

static double rest_within(const double *n, int count, double radius)
{
    double sum = 0;

    for (int i = 0; i < 4 * count; i++) {
        sum = sum * radius + n[i];
    }
    return sum;
}

/* What f may change by on a way, and that by the way. */
static double change(const double b[5], double r)
{
    return (((b[4] * r + b[3]) * r + b[2]) * r + b[1]) * r;
}

static double slope(const double b[5], double r)
{
    return ((4 * b[4] * r + 3 * b[3]) * r + 2 * b[2]) * r + b[1];
}

static double way(double f, const double b[5], double most)
{
    double r = fmin(fmin(f / b[1], sqrt(f / b[2])), fmin(sqrt(sqrt(f / fmax(b[4], 1e-18))), most));

    for (int i = 0; i < 3; i++) {
        r -= fmax(change(b, r) - f, 0) / slope(b, r);
    }
    return r * fmin(1, f / fmax(change(b, r), 1e-30));
}

static double sheet(double f, const double b[5], double thickness, double grain, double most)
{
    const double half = 0.5 * thickness, begin = half * slope(b, grain);
    double s = most, whole = begin;

    for (int i = 0; i < 4; i++) {
        const double t = s + grain;
        const double bend = (12 * b[4] * t + 6 * b[3]) * t + 2 * b[2];
        whole = change(b, s) + half * slope(b, t);
        s = i < 3 ? s - fmax(whole - f, 0) / (slope(b, s) + half * bend) : s;
    }
    return f > begin ? s * fmin(1, (f - begin) / fmax(whole - begin, 1e-30))
                     : fmax(half * (f / begin - 1), -half);
}

static double within(const double p[3], const double *n)
{
    const double thickness = n[5], grain = n[10];
    const double *rest = n + (size_t)(4 * POLYNOMIAL_HEAD);
    const int degree = (int)n[6], count = (int)n[7];
    double b[5] = {0};

    find_orders(p, rest + (size_t)(4 * count), degree, b);
    const double f = fabs(b[0]), radius = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int i = 1; i < ORDERS; i++) {
        b[i] = fmax(b[i], 1e-18);
    }
    const double most = way(f, b, n[9]);
    double d = most;
    if (count > 0) {
        const double first = rest_within(rest, count, radius + most + grain);
        b[4] = first;
        const double less = way(f, b, most), between = sqrt(less * most);
        b[4] = rest_within(rest, count, radius + between + grain);
        const double more = way(f, b, between);
        d = fmax(less, more);
        b[4] = more > less ? b[4] : first;
    }
    if (thickness >= 0) {
        return sheet(f, b, thickness, grain, d);
    }
    return b[0] < 0 ? -d : d;
}

double polynomial_distance(const double p[3], const double *n)
{
    const double extent = n[3], radius = n[4];
    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    double near[3], square = 0, face = -INFINITY;

    for (int i = 0; i < 3; i++) {
        near[i] = radius > 0 ? p[i] * fmin(1, radius / fmax(length, 1e-18))
                             : fmin(fmax(p[i], -n[i]), n[i]);
        square += (p[i] - near[i]) * (p[i] - near[i]);
        face = fmax(face, radius > 0 ? length - radius : fabs(p[i]) - n[i]);
        near[i] /= extent;
    }
    const double d = within(near, n) * extent;
    return square > 0 ? hypot(sqrt(square), fmax(d, 0)) : fmax(d, face);
}

/* Behind the numbers of the cut. */
static double shape(const double p[3], const double *n)
{
    return polynomial_distance(p, n + SDF_CUT_NUMBERS);
}

const struct sdf sdf_polynomial = {.type = "implicit", .shape = shape};
