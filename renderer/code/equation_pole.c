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

/* A zero in a bracket makes the difference of its ends vanish with its length; a jump does not, and
 * a pole makes it grow. */
static enum equation_break break_in(const struct line *line, double low, double high, double *out_t)
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
    const double last = fabs(above - below);
    return last > 8 * first      ? EQUATION_POLE
           : last > 0.25 * first ? EQUATION_JUMP
                                 : EQUATION_UNBROKEN;
}

static enum equation_break find_on(const struct line *line, double *out_t)
{
    enum equation_break found = EQUATION_UNBROKEN;
    double before = value_at(line, 0);

    for (int i = 1; i <= PARTS && !found; i++) {
        const double t = (double)i / PARTS, value = value_at(line, t);
        if (isfinite(before) && isfinite(value) && (before < 0) != (value < 0)) {
            found = break_in(line, t - 1.0 / PARTS, t, out_t);
        }
        before = value;
    }
    return found;
}

/* Additive recurrences of the powers of a root of x^7 = x + 1: even in six dimensions (Roberts,
 * "The unreasonable effectiveness of quasirandom sequences", 2018). */
static double even(int n, int dimension)
{
    static const double root = 1.1127756842787055;

    return fmod(0.5 + n * pow(root, -1 - dimension), 1);
}

static void find_point(const struct equation_clip *clip, int n, int dimension, double out[3])
{
    double most = 0, square = 0;

    for (int i = 0; i < 3; i++) {
        out[i] = 2 * even(n, dimension + i) - 1;
        most = fmax(most, fabs(out[i]));
        square += out[i] * out[i];
    }
    /* The cube's shells become the ball's. */
    const double scale = clip->ball && square > 0 ? most / sqrt(square) : 1;
    for (int i = 0; i < 3; i++) {
        out[i] *= scale * clip->half[i];
    }
}

void equation_line(const struct equation_clip *clip, int n, double out_from[3], double out_way[3])
{
    find_point(clip, n, 0, out_from);
    find_point(clip, n, 3, out_way);
    for (int i = 0; i < 3; i++) {
        out_way[i] -= out_from[i];
    }
}

enum equation_break equation_pole(const struct equation *equation, const double *letters,
                                  const struct equation_clip *clip, double out_at[3])
{
    struct line line = {.equation = equation, .letters = letters};
    enum equation_break found = EQUATION_UNBROKEN;
    double t = 0;

    for (int n = 0; n < LINES && !found; n++) {
        equation_line(clip, n, line.from, line.way);
        found = find_on(&line, &t);
    }
    if (found) {
        point_at(&line, t, out_at);
    }
    return found;
}
