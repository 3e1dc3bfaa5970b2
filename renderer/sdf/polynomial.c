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

/* Of a power of x and one of y. */
static int series_rows(int length)
{
    return length > 3 ? (length + 2) / 3 : 1;
}

static int coefficient_rows(int degree)
{
    int rows = 0;

    for (int i = 0; i <= degree; i++) {
        for (int j = 0; j <= degree - i; j++) {
            rows += series_rows(degree - i - j + 1);
        }
    }
    return rows;
}

size_t polynomial_rows(int degree)
{
    const size_t rows = (size_t)coefficient_rows(degree);

    return (size_t)polynomial_rest_rows(degree) + (degree < POLYNOMIAL_FINE ? rows : 2 * rows);
}

int polynomial_trips(int degree, int count)
{
    const int loops = degree < POLYNOMIAL_FINE ? 1 : 2, within = 3 + 3 + 3 + 4;

    return loops * (count + 1) + 2 * (polynomial_rest_rows(degree) + 1) + within;
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
static double *write_row(const double *c, int length, enum polynomial_end end, double *out)
{
    while (length > 0 && c[length - 1] == 0) {
        length--;
    }
    const int rows = series_rows(length);
    for (int row = 0; row < rows; row++, out += 4) {
        out[0] = row < rows - 1 ? POLYNOMIAL_GOES_ON : end;
        for (int i = 0; i < 3; i++) {
            const int power = 3 * (rows - row) - 1 - i;
            out[1 + i] = power < length ? c[power] : 0;
        }
    }
    return out;
}

/* Of a power of x the highest power of y; 0 where there is none. */
static int highest(const double *c, int degree, int i)
{
    for (int j = degree - i; j > 0; j--) {
        const double *row = c + polynomial_at(degree, i, j);
        for (int k = 0; k <= degree - i - j; k++) {
            if (row[k] != 0) {
                return j;
            }
        }
    }
    return 0;
}

int polynomial_write(int degree, const double *c, double *out)
{
    double own[POLYNOMIAL_DEGREE_MAX + 1];
    const int rest = 4 * polynomial_rest_rows(degree);

    memset(out, 0, 4 * polynomial_rows(degree) * sizeof *out);
    norms(degree, c, own);
    for (int m = 4; m <= degree; m++) {
        out[rest - 1 - (m - 4)] = own[m] * m * (m - 1) * (m - 2) * (m - 3) / 24;
    }
    out += rest;
    double *const begin = out;
    for (int i = degree; i >= 0; i--) {
        for (int j = highest(c, degree, i); j >= 0; j--) {
            const double *row = c + polynomial_at(degree, i, j);
            out = write_row(row, degree - i - j + 1, j > 0 ? POLYNOMIAL_ENDS_Y : POLYNOMIAL_ENDS_X,
                            out);
        }
    }
    const size_t numbers = (size_t)(out - begin);
    for (size_t i = 0; degree >= POLYNOMIAL_FINE && i < numbers; i++) {
        out[i] = begin[i] - (double)(float)begin[i];
    }
    return (int)(numbers / 4);
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
static void find_orders(const double p[3], const double *n, int count, double out[ORDERS])
{
    double a[SERIES] = {0}, r[ORDERS][ORDERS] = {{0}}, s[ORDERS] = {0};

    for (int i = 0; i < count; i++, n += 4) {
        for (int k = 1; k <= 3; k++) {
            step_z(s, p[2], n[k]);
        }
        if (n[0] != POLYNOMIAL_GOES_ON) {
            step_y(r, p[1], s);
            memset(s, 0, sizeof s);
        }
        if (n[0] == POLYNOMIAL_ENDS_X) {
            step_x(a, p[0], r);
            memset(r, 0, sizeof r);
        }
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
    const int count = (int)n[7], rows = (int)n[11];
    double b[5] = {0};

    find_orders(p, rest + (size_t)(4 * count), rows, b);
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
