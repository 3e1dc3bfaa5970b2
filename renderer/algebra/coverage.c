/* SPDX-License-Identifier: MIT */
#include "coverage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "protocol/limits.h"
#include "protocol/memory.h"
#include "renderer/code/surface_sample.h"

enum {
    POINTS = 2000,
    LINES = 20000, /* at most */
    SIDE = LIMIT_IMPLICIT_DEGREE + 1,
    CELLS = 8, /* of a line, for each degree */
    HALVINGS = 50,
    ACROSS = 65, /* samples along each parameter */
    BEGINNINGS = 16,
    STEPS = 40,
};
#define NOISE 1e-13 /* of the sum of the terms: what is less has no sign */
#define REACH 2.0   /* ways between samples, from which a search begins */
#define SHIFT 1e-6  /* for differences, of a range */

/* --- random lines --- */

/* From 0 to 1 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014). */
static double next_random(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;

    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct chord {
    double middle[3], half[3]; /* from middle - half to middle + half */
};

static void random_line(uint64_t *state, double radius, double point[3], double way[3])
{
    const double up = 2 * next_random(state) - 1, turn = 2 * M_PI * next_random(state);
    const double off = radius * sqrt(next_random(state)), place = 2 * M_PI * next_random(state);
    const double level = sqrt(1 - up * up), c = cos(turn), s = sin(turn);
    const double across[3] = {-s, c, 0}, along[3] = {-up * c, -up * s, level};

    way[0] = level * c, way[1] = level * s, way[2] = up;
    for (int i = 0; i < 3; i++) {
        point[i] = off * (cos(place) * across[i] + sin(place) * along[i]);
    }
}

static void cut_by_box(const struct equation_clip *clip, const double point[3], const double way[3],
                       double *low, double *high)
{
    for (int i = 0; i < 3; i++) {
        const double a = (-clip->half[i] - point[i]) / way[i];
        const double b = (clip->half[i] - point[i]) / way[i];
        *low = fmax(*low, fmin(a, b));
        *high = fmin(*high, fmax(a, b));
    }
}

/* False: the line goes by. */
static bool random_chord(uint64_t *state, const struct equation_clip *clip, struct chord *out)
{
    const double radius = clip->ball ? clip->half[0] : sqrt(dot(clip->half, clip->half));
    double point[3], way[3];

    random_line(state, radius, point, way);
    /* The point is the one of the line that is nearest to the origin. */
    double high = sqrt(fmax(radius * radius - dot(point, point), 0)), low = -high;
    if (!clip->ball) {
        cut_by_box(clip, point, way, &low, &high);
    }
    for (int i = 0; i < 3; i++) {
        out->middle[i] = point[i] + way[i] * (low + high) / 2;
        out->half[i] = way[i] * (high - low) / 2;
    }
    return low < high;
}

/* --- the equation on a line --- */

struct measuring {
    int degree;
    double (*coefficients)[SIDE][SIDE]; /* of powers of x / half and so on; the largest is 1 */
    const struct equation_clip *clip;
    struct surface_reading reading;
    double (*samples)[3], *spacing; /* the way to the farthest sample beside it, squared */
    double near;
    double room[LIMIT_EQUATION_NODES + 1];
    struct coverage *out;
};

static void set_coefficients(struct measuring *m, const fmpz_mpoly_t f,
                             const fmpz_mpoly_ctx_t space)
{
    slong largest = 0;
    fmpz_t coefficient;

    fmpz_init(coefficient);
    for (int round = 0; round < 2; round++) {
        for (slong n = 0; n < fmpz_mpoly_length(f, space); n++) {
            slong power;
            ulong e[3];
            int more;
            fmpz_mpoly_get_term_coeff_fmpz(coefficient, f, n, space);
            fmpz_mpoly_get_term_exp_ui(e, f, n, space);
            double value = fmpz_get_d_2exp(&power, coefficient);
            for (int i = 0; i < 3; i++) {
                value *= pow(m->clip->half[i], (double)e[i]);
            }
            value = frexp(value, &more);
            power += more;
            largest = round == 0 && (n == 0 || power > largest) ? power : largest;
            if (round == 1 && power - largest > -1000) {
                m->coefficients[e[0]][e[1]][e[2]] = ldexp(value, (int)(power - largest));
            }
        }
    }
    fmpz_clear(coefficient);
}

/* p (of degree n) becomes p (a + b t) + q. */
static void times_line(double *p, int n, double a, double b, const double *q)
{
    for (int i = n + 1; i >= 0; i--) {
        p[i] = (i <= n ? a * p[i] : 0) + (i > 0 ? b * p[i - 1] : 0) + q[i];
    }
}

/* By Horner's rule in x, in y and in z. */
static void restrict_to(const struct measuring *m, const struct chord *chord, double out[SIDE])
{
    double a[3], b[3];
    const int d = m->degree;

    for (int i = 0; i < 3; i++) {
        a[i] = chord->middle[i] / m->clip->half[i];
        b[i] = chord->half[i] / m->clip->half[i];
    }
    memset(out, 0, SIDE * sizeof *out);
    for (int i = d; i >= 0; i--) {
        double sum[SIDE] = {0};
        for (int j = d - i; j >= 0; j--) {
            double row[SIDE] = {0};
            for (int k = d - i - j; k >= 0; k--) {
                double constant[SIDE] = {m->coefficients[i][j][k]};
                times_line(row, d - i - j - k - 1, a[2], b[2], constant);
            }
            times_line(sum, d - i - j - 1, a[1], b[1], row);
        }
        times_line(out, d - i - 1, a[0], b[0], sum);
    }
}

static double value_at(const double *p, int degree, double t)
{
    double value = 0;

    for (int i = degree; i >= 0; i--) {
        value = value * t + p[i];
    }
    return value;
}

static double root_between(const double *p, int degree, double low, double high)
{
    const bool side = value_at(p, degree, low) < 0;

    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        if ((value_at(p, degree, middle) < 0) == side) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return (low + high) / 2;
}

/* --- parameters of a point --- */

/* What is proved has no letters of a node's own. */
static const double no_letters[SURFACE_SAMPLE_LETTERS] = {0};

static void sample_patch(struct measuring *m)
{
    m->samples = memory_alloc((size_t)ACROSS * ACROSS, sizeof *m->samples);
    m->spacing = memory_alloc((size_t)ACROSS * ACROSS, sizeof *m->spacing);
    surface_points(&m->reading, no_letters, ACROSS, m->samples[0]);
}

static double square_between(const double a[3], const double b[3])
{
    const double e[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const double square = dot(e, e);

    return isfinite(square) ? square : INFINITY;
}

/* The samples around one; how many. */
static int find_beside(int sample, int out[8])
{
    const int i = sample / ACROSS, j = sample % ACROSS;
    int count = 0;

    for (int k = 0; k < 9; k++) {
        const int a = i + k / 3 - 1, b = j + k % 3 - 1;
        if (k != 4 && a >= 0 && a < ACROSS && b >= 0 && b < ACROSS) {
            out[count++] = a * ACROSS + b;
        }
    }
    return count;
}

static void find_spacing(struct measuring *m)
{
    for (int sample = 0; sample < ACROSS * ACROSS; sample++) {
        int beside[8];
        const int count = find_beside(sample, beside);
        m->spacing[sample] = 0;
        for (int i = 0; i < count; i++) {
            m->spacing[sample] =
                fmax(m->spacing[sample], square_between(m->samples[sample], m->samples[beside[i]]));
        }
    }
}

static double square_from(struct measuring *m, const double p[3], const double uv[2], double e[3])
{
    double at[3];

    surface_point(&m->reading, no_letters, uv[0], uv[1], m->room, at);
    for (int i = 0; i < 3; i++) {
        e[i] = at[i] - p[i];
    }
    return square_between(at, p);
}

/* Where the step leads within the ranges: (J^T J + damping) step = -J^T e. */
static void step_from(struct measuring *m, const double p[3], const double uv[2], const double e[3],
                      double damping, double out[2])
{
    double by[2][3];

    for (int k = 0; k < 2; k++) {
        double moved[2] = {uv[0], uv[1]}, there[3];
        const double shift = uv[k] > 0.5 ? -SHIFT : SHIFT;
        moved[k] += shift;
        square_from(m, p, moved, there);
        for (int i = 0; i < 3; i++) {
            by[k][i] = (there[i] - e[i]) / shift;
        }
    }
    const double mixed = dot(by[0], by[1]), all = dot(by[0], by[0]) + dot(by[1], by[1]);
    const double a = dot(by[0], by[0]) + damping * all, b = dot(by[1], by[1]) + damping * all;
    const double ga = -dot(by[0], e), gb = -dot(by[1], e), under = a * b - mixed * mixed;
    out[0] = fmin(fmax(uv[0] + (ga * b - gb * mixed) / under, 0), 1);
    out[1] = fmin(fmax(uv[1] + (gb * a - ga * mixed) / under, 0), 1);
}

static bool descend(struct measuring *m, const double p[3], int sample)
{
    const int row = sample / ACROSS, column = sample % ACROSS;
    double uv[2] = {(double)row / (ACROSS - 1), (double)column / (ACROSS - 1)};
    double e[3], damping = 1e-6;
    double square = square_from(m, p, uv, e);

    for (int i = 0; i < STEPS && square > m->near * m->near; i++) {
        double next[2], there[3];
        step_from(m, p, uv, e, damping, next);
        const double other = square_from(m, p, next, there);
        if (other < square) {
            memcpy(uv, next, sizeof uv);
            memcpy(e, there, sizeof e);
            damping = fmax(damping / 10, 1e-9);
            square = other;
        } else {
            damping *= 10;
        }
    }
    return square <= m->near * m->near;
}

static bool is_least_beside(const double *squares, int sample)
{
    int beside[8];
    const int count = find_beside(sample, beside);

    for (int i = 0; i < count; i++) {
        if (squares[beside[i]] < squares[sample]) {
            return false;
        }
    }
    return true;
}

/* Keeps the nearest ones, the nearest first. */
static int keep_beginning(const double *squares, int sample, int *list, int count)
{
    int at = count < BEGINNINGS ? count : BEGINNINGS;

    while (at > 0 && squares[list[at - 1]] > squares[sample]) {
        if (at < BEGINNINGS) {
            list[at] = list[at - 1];
        }
        at--;
    }
    if (at < BEGINNINGS) {
        list[at] = sample;
    }
    return count < BEGINNINGS ? count + 1 : count;
}

static bool is_covered(struct measuring *m, const double p[3])
{
    double squares[ACROSS * ACROSS];
    int beginnings[BEGINNINGS], count = 0;

    for (int i = 0; i < ACROSS * ACROSS; i++) {
        squares[i] = square_between(m->samples[i], p);
    }
    for (int i = 0; i < ACROSS * ACROSS; i++) {
        const double reach = REACH * REACH * m->spacing[i] + m->near * m->near;
        if (isfinite(squares[i]) && squares[i] <= reach && is_least_beside(squares, i)) {
            count = keep_beginning(squares, i, beginnings, count);
        }
    }
    for (int i = 0; i < count; i++) {
        if (descend(m, p, beginnings[i])) {
            return true;
        }
    }
    return false;
}

/* --- all --- */

static void take_root(struct measuring *m, const struct chord *chord, double t)
{
    double p[3];

    for (int i = 0; i < 3; i++) {
        p[i] = chord->middle[i] + t * chord->half[i];
    }
    m->out->points++;
    m->out->covered += is_covered(m, p);
}

static void measure_chord(struct measuring *m, const struct chord *chord)
{
    const int cells = CELLS * m->degree;
    double p[SIDE], noise = 0;

    restrict_to(m, chord, p);
    for (int i = 0; i <= m->degree; i++) {
        noise += NOISE * fabs(p[i]);
    }
    double before = value_at(p, m->degree, -1);
    for (int i = 1; i <= cells && m->out->points < POINTS; i++) {
        const double t = 2.0 * i / cells - 1, value = value_at(p, m->degree, t);
        if ((before < 0) != (value < 0) && fmax(fabs(before), fabs(value)) > noise) {
            take_root(m, chord, root_between(p, m->degree, t - 2.0 / cells, t));
        }
        before = value;
    }
}

static void measure(struct measuring *m)
{
    uint64_t state = 1;
    struct chord chord;

    for (int i = 0; i < LINES && m->out->points < POINTS; i++) {
        if (random_chord(&state, m->clip, &chord)) {
            measure_chord(m, &chord);
        }
    }
}

static bool read_surface(struct surface_reading *out, const struct surface *surface)
{
    struct equation_errors errors;
    int part;

    return surface_reading_init(out, surface, &part, &errors);
}

void coverage_measure(const fmpz_mpoly_t f, const fmpz_mpoly_ctx_t space,
                      const struct surface *surface, const struct equation_clip *clip,
                      struct coverage *out)
{
    struct measuring *m = memory_alloc(1, sizeof *m);

    *out = (struct coverage){0};
    m->out = out;
    m->clip = clip;
    m->near = COVERAGE_NEAR * fmax(fmax(clip->half[0], clip->half[1]), clip->half[2]);
    m->degree = (int)fmpz_mpoly_total_degree_si(f, space);
    if (read_surface(&m->reading, surface)) {
        m->coefficients = memory_alloc(SIDE, sizeof *m->coefficients);
        set_coefficients(m, f, space);
        sample_patch(m);
        find_spacing(m);
        measure(m);
        surface_reading_finish(&m->reading);
    }
    free(m->coefficients);
    free(m->samples);
    free(m->spacing);
    free(m);
}

void coverage_size(const struct surface *surface, double out[3])
{
    const size_t count = (size_t)ACROSS * ACROSS;
    struct surface_reading reading;
    double *points = memory_alloc(3 * count, sizeof *points);

    memset(out, 0, 3 * sizeof *out);
    if (read_surface(&reading, surface)) {
        surface_points(&reading, no_letters, ACROSS, points);
        surface_reading_finish(&reading);
    }
    for (size_t i = 0; i < 3 * count; i++) {
        const double x = fabs(points[i]);
        out[i % 3] = isfinite(x) ? fmax(out[i % 3], x) : out[i % 3];
    }
    for (int i = 0; i < 3; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.2e", 2.04 * out[i]);
        out[i] = out[i] > 0 ? fmin(strtod(text, NULL), LIMIT_COORDINATE) : 1;
    }
    free(points);
}

cJSON *coverage_answer(const struct coverage *coverage)
{
    const double share = coverage->points > 0 ? (double)coverage->covered / coverage->points : 0;
    cJSON *json = cJSON_CreateObject();
    char text[160];

    cJSON_AddNumberToObject(json, "points", coverage->points);
    cJSON_AddNumberToObject(json, "covered", coverage->covered);
    if (coverage->points == 0) {
        snprintf(text, sizeof text, "no line meets the implicit surface within the clip");
    } else {
        /* All of it, or none, is told of no other. */
        const double percent = coverage->covered == coverage->points ? 100 : fmin(100 * share, 99);
        const bool some = coverage->covered > 0 && percent < 1;
        snprintf(text, sizeof text,
                 "the patch covers %s%.0f %% of the implicit surface within the clip",
                 some ? "below " : "", some ? 1 : percent);
        cJSON_AddNumberToObject(json, "share", share);
    }
    cJSON_AddStringToObject(json, "text", text);
    return json;
}
