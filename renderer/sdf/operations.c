/* SPDX-License-Identifier: MIT */
/* What combines the distances of several children.
 *
 * No field gets steeper here. Minimum, maximum and `exclusive` are everywhere one of their operands
 * or its negative. Blends and `morph` have two partial derivatives that are >= 0 and together at
 * most 1, so their gradient is no longer than that of the steeper operand. */
#include "tools.h"

static double combine_union(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = b < a;
    return fmin(a, b);
}

static double combine_intersection(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = b > a;
    return fmax(a, b);
}

static double combine_difference(double a, double b, const double *n, double *out_share)
{
    return combine_intersection(a, -b, n, out_share);
}

/* In one but not in the other. */
static double combine_exclusive(double a, double b, const double *n, double *out_share)
{
    (void)n;
    *out_share = a + b >= 0 ? b < a : b > a;
    return fmax(fmin(a, b), -fmax(a, b));
}

static double combine_morph(double a, double b, const double *n, double *out_share)
{
    *out_share = n[0];
    return a * (1 - n[0]) + b * n[0];
}

/* --- blends: n = k, kernel, order --- */

/* In the order of the registry. */
enum kernel { QUADRATIC, CUBIC, QUARTIC, CIRCULAR, EXPONENTIAL, ROOT, POWER, POLYNOMIAL };

#define K_MIN 1e-7 /* nothing divides by less */
/* Below, the power kernel is nearly 0 even far from all surfaces, so that no ray gets anywhere. */
#define POWER_MIN 1.0

static double blend_k(const double *n)
{
    return fmax(n[0], (enum kernel)n[1] == POWER ? POWER_MIN : K_MIN);
}

/* What k measures: a length, 1 by a length, the square of one, or nothing. */
static void blend_scale(double *n, double scale)
{
    n[0] = blend_k(n);
    switch ((enum kernel)n[1]) {
    case QUADRATIC:
    case CUBIC:
    case QUARTIC:
    case CIRCULAR:
    case POLYNOMIAL:
        n[0] *= scale;
        break;
    case EXPONENTIAL:
        n[0] /= scale;
        break;
    case ROOT:
        n[0] *= scale * scale;
        break;
    case POWER:
        break;
    }
}

/* How far below the lesser of two distances their blend is, where they are x apart, and its
 * derivative by the greater. Written so that nothing is the difference of great numbers: floats
 * keep their digits far away too. The power kernel is no function of x. */
static double blend_depth(double x, double k, const double *n, double *out_greater)
{
    double h = fmax(k - x, 0) / k, y = 1 - h, root;

    switch ((enum kernel)n[1]) {
    case CUBIC:
        *out_greater = h * h / 2;
        return k * h * h * h / 6;
    case QUARTIC:
        *out_greater = h * h * h / 2;
        return k * h * h * h * h / 8;
    case CIRCULAR:
        root = sqrt(2 - y * y);
        *out_greater = (1 - y / root) / 2;
        return k * (1 - (y + root) / 2);
    case EXPONENTIAL:
        *out_greater = 1 / (1 + exp2(k * x));
        return log1p(exp2(-k * x)) / (k * log(2));
    case ROOT:
        root = sqrt(x * x + k);
        *out_greater = k / (2 * root * (root + x));
        return k / (2 * (root + x));
    case POLYNOMIAL:
        *out_greater = pow(h, n[2] - 1) / 2;
        return k * pow(h, n[2]) / (2 * n[2]);
    case QUADRATIC:
    case POWER:
        break;
    }
    *out_greater = h / 2;
    return k * h * h / 4;
}

/* (a^-k + b^-k)^(-1/k), the lesser taken out of the brackets. With u the part of a^-k in the sum,
 * the derivative by a is u^(1 + 1/k) <= u, and by b at most 1 - u. The shares are the derivatives
 * divided by their sum. */
static double power_blend(double least, double most, double k, double *out_greater)
{
    if (least <= 0) {
        *out_greater = 0;
        return least;
    }
    const double ratio = least / most, part = exp2(k * log2(ratio)), share = part * ratio;
    *out_greater = share / (1 + share);
    return least * exp2(-log1p(part) / (k * log(2)));
}

static double smin(double a, double b, const double *n, double *out_share)
{
    const enum kernel kernel = (enum kernel)n[1];
    double least = fmin(a, b), most = fmax(a, b), greater;
    const double d = kernel == POWER ? power_blend(least, most, n[0], &greater)
                                     : least - blend_depth(most - least, n[0], n, &greater);

    *out_share = b < a ? 1 - greater : greater;
    return d;
}

static double combine_smooth_intersection(double a, double b, const double *n, double *out_share)
{
    return -smin(-a, -b, n, out_share);
}

static double combine_smooth_difference(double a, double b, const double *n, double *out_share)
{
    return -smin(-a, b, n, out_share);
}

/* Folded from the left, equal operands are lowered most: what is x below their minimum already goes
 * down by the blend's depth there, and x plus that depth grows with x. */
static double blend_lowered(const double *n, size_t count)
{
    const enum kernel kernel = (enum kernel)n[1];
    double k = blend_k(n), x = 0, greater;

    for (size_t i = 1; i < count && kernel != POWER; i++) {
        x += blend_depth(x, k, n, &greater);
    }
    return x;
}

/* The power kernel moves no surface, but makes the field of equal operands as much less. */
static double blend_stretched(const double *n, size_t count)
{
    const bool power = (enum kernel)n[1] == POWER && count > 1;

    return power ? pow((double)count, 1 / blend_k(n)) : 1;
}

/* Only polynomials and the circle end. */
static bool blend_feels_far(const double *n)
{
    return (enum kernel)n[1] >= EXPONENTIAL;
}

static double no_reach(const double *n)
{
    (void)n;
    return 0;
}

static double blend_reach(const double *n)
{
    return blend_feels_far(n) && (enum kernel)n[1] != POLYNOMIAL ? INFINITY : n[0];
}

const struct sdf sdf_operations[] = {
    {"union", .combine = combine_union, .rule = SDF_ANY, .reach = no_reach},
    {"intersection", .combine = combine_intersection, .rule = SDF_ALL, .reach = no_reach},
    {"difference", .combine = combine_difference, .rule = SDF_FIRST, .reach = no_reach},
    {"exclusive", .combine = combine_exclusive, .rule = SDF_ANY},
    {"smooth_union", .reach = blend_reach, .scale = blend_scale, .combine = smin, .rule = SDF_ANY,
     .soft = true, .feels_far = blend_feels_far, .lowered = blend_lowered,
     .stretched = blend_stretched},
    {"smooth_intersection", .scale = blend_scale, .combine = combine_smooth_intersection,
     .rule = SDF_ALL, .soft = true, .reach = blend_reach},
    {"smooth_difference", .scale = blend_scale, .combine = combine_smooth_difference,
     .rule = SDF_FIRST, .soft = true, .reach = blend_reach},
    {"morph", .combine = combine_morph, .rule = SDF_ANY, .soft = true, .operands = 2},
    {"material", .combine = combine_union, .rule = SDF_ANY, .reach = no_reach},
    {"group", .combine = combine_union, .rule = SDF_ANY, .reach = no_reach},
    {.type = NULL},
};
