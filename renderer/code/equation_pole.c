/* SPDX-License-Identifier: MIT */
#include "equation_pole.h"

#include <math.h>

#include "equation_value.h"

enum { LINES = 192, PARTS = 64, HALVINGS = 40 };

struct line {
    const struct equation *equation;
    const double *letters;
    double from[3], way[3];
};

static void point_at(const struct line *line, double t, double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = line->from[i] + t * line->way[i];
    }
}

static double value_at(const struct line *line, double t)
{
    double p[3];

    point_at(line, t, p);
    return equation_value(line->equation, p, line->letters);
}

/* A zero in a bracket makes the difference of its ends vanish with its length; a pole or a jump
 * does not. */
static bool has_jump(const struct line *line, double low, double high, double *out_t)
{
    double below = value_at(line, low), above = value_at(line, high);
    const double first = fabs(above - below);

    for (int i = 0; i < HALVINGS; i++) {
        const double t = (low + high) / 2, value = value_at(line, t);
        if ((value < 0) == (below < 0)) {
            low = t;
            below = value;
        } else {
            high = t;
            above = value;
        }
    }
    *out_t = (low + high) / 2;
    return fabs(above - below) > 0.25 * first;
}

static bool find_on(const struct line *line, double *out_t)
{
    double before = value_at(line, 0);

    for (int i = 1; i <= PARTS; i++) {
        const double t = (double)i / PARTS, value = value_at(line, t);
        if (isfinite(before) && isfinite(value) && (before < 0) != (value < 0) &&
            has_jump(line, t - 1.0 / PARTS, t, out_t)) {
            return true;
        }
        before = value;
    }
    return false;
}

/* Additive recurrences of the powers of a root of x^7 = x + 1: even in six dimensions (Roberts,
 * "The unreasonable effectiveness of quasirandom sequences", 2018). */
static double even(int n, int dimension)
{
    static const double root = 1.1127756842787055;

    return fmod(0.5 + n * pow(root, -1 - dimension), 1);
}

bool equation_pole(const struct equation *equation, const double *letters, const double half[3],
                   double out_at[3])
{
    for (int n = 0; n < LINES; n++) {
        struct line line = {.equation = equation, .letters = letters};
        double t;
        for (int i = 0; i < 3; i++) {
            line.from[i] = (2 * even(n, i) - 1) * half[i];
            line.way[i] = (2 * even(n, 3 + i) - 1) * half[i] - line.from[i];
        }
        if (find_on(&line, &t)) {
            point_at(&line, t, out_at);
            return true;
        }
    }
    return false;
}
