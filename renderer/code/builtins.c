/* SPDX-License-Identifier: MIT */
/* The functions in C, and the table. */
#include "builtins.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "jets.h"
#include "patterns.h"

/* --- component by component --- */

static double from_degrees(double x)
{
    return x * (M_PI / 180);
}

static double from_radians(double x)
{
    return x * (180 / M_PI);
}

static double least(double x, double y)
{
    return y < x ? y : x;
}

static double most(double x, double y)
{
    return x < y ? y : x;
}

static double between(double x, double low, double high)
{
    return least(most(x, low), high);
}

static double saturated(double x)
{
    return between(x, 0, 1);
}

static double sign_of(double x)
{
    return (x > 0) - (x < 0);
}

static double fraction(double x)
{
    return x - floor(x);
}

static double rounded(double x)
{
    return floor(x + 0.5);
}

static double remainder_floor(double x, double y)
{
    return y == 0 ? x : x - y * floor(x / y);
}

static double remainder_trunc(double x, double y)
{
    return y == 0 ? x : x - y * trunc(x / y);
}

static double root(double x)
{
    return sqrt(most(x, 0));
}

static double inverse_root(double x)
{
    return 1 / sqrt(most(x, BUILTIN_TINY));
}

static double power(double x, double y)
{
    return pow(most(fabs(x), y > 0 ? 0 : BUILTIN_TINY), y);
}

static double log_natural(double x)
{
    return log(most(x, BUILTIN_TINY));
}

static double log_two(double x)
{
    return log2(most(x, BUILTIN_TINY));
}

static double log_ten(double x)
{
    return log10(most(x, BUILTIN_TINY));
}

static double arc_sine(double x)
{
    return asin(between(x, -1, 1));
}

static double arc_cosine(double x)
{
    return acos(between(x, -1, 1));
}

static double arc_of(double y, double x)
{
    return x == 0 && y == 0 ? 0 : atan2(y + 0.0, x); /* no -0, which is -pi with x < 0 */
}

static double area_cosine(double x)
{
    return acosh(most(x, 1));
}

static double area_tangent(double x)
{
    return atanh(between(x, -0.9999, 0.9999));
}

static double reciprocal(double x)
{
    return 1 / builtin_nonzero(x);
}

static double multiplied_added(double a, double b, double c)
{
    return a * b + c;
}

static double mixed(double x, double y, double t)
{
    return x * (1 - t) + y * t;
}

static double selected(double x, double y, double second)
{
    return second != 0 ? y : x;
}

static double stepped(double edge, double x)
{
    return x < edge ? 0 : 1;
}

static double stepped_smoothly(double low, double high, double x)
{
    if (low == high) {
        return stepped(low, x);
    }
    const double t = between((x - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}

static double product(double x, double y)
{
    return x * y;
}

static double is_nan(double x)
{
    return isnan(x);
}

static double is_infinite(double x)
{
    return isinf(x) != 0;
}

static double is_less(double x, double y)
{
    return x < y;
}

static double is_less_equal(double x, double y)
{
    return x <= y;
}

static double is_greater(double x, double y)
{
    return x > y;
}

static double is_greater_equal(double x, double y)
{
    return x >= y;
}

static double is_equal(double x, double y)
{
    return x == y;
}

static double is_unequal(double x, double y)
{
    return x != y;
}

static double is_false(double x)
{
    return x == 0;
}

/* --- as a whole --- */

static double sum_of_products(const double *a, const double *b, int n)
{
    double sum = 0;

    for (int i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

static void dot_product(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    out[0] = sum_of_products(in[0], in[1], n);
}

static void length_of(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    out[0] = sqrt(sum_of_products(in[0], in[0], n));
}

static void distance_of(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    double sum = 0;

    for (int i = 0; i < n; i++) {
        const double d = in[0][i] - in[1][i];
        sum += d * d;
    }
    out[0] = sqrt(sum);
}

static void cross_product(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    const double *a = in[0], *b = in[1];

    for (int i = 0; i < n; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void normalized(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    const double scale = inverse_root(sum_of_products(in[0], in[0], n));

    for (int i = 0; i < n; i++) {
        out[i] = in[0][i] * scale;
    }
}

static void face_forward(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    const double sign = sum_of_products(in[2], in[1], n) < 0 ? 1 : -1;

    for (int i = 0; i < n; i++) {
        out[i] = sign * in[0][i];
    }
}

static void reflected(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    const double twice = 2 * sum_of_products(in[1], in[0], n);

    for (int i = 0; i < n; i++) {
        out[i] = in[0][i] - twice * in[1][i];
    }
}

/* GLSL 4.30, 8.5 */
static void refracted(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    const double eta = in[2][0], along = sum_of_products(in[1], in[0], n);
    const double k = 1 - eta * eta * (1 - along * along);

    for (int i = 0; i < n; i++) {
        out[i] = k < 0 ? 0 : eta * in[0][i] - (eta * along + sqrt(k)) * in[1][i];
    }
}

static void any_of(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    out[0] = 0;
    for (int i = 0; i < n; i++) {
        out[0] = out[0] != 0 || in[0][i] != 0;
    }
}

static void all_of(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    out[0] = 1;
    for (int i = 0; i < n; i++) {
        out[0] = out[0] != 0 && in[0][i] != 0;
    }
}

static void transposed(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    for (int i = 0; i < n * n; i++) {
        out[i] = in[0][i % n * n + i / n];
    }
}

static void outer_product(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    for (int i = 0; i < n * n; i++) {
        out[i] = in[0][i % n] * in[1][i / n];
    }
}

/* Without one row and one column; the sign of its place included. */
static double cofactor(const double *m, int n, int row, int column)
{
    double rest[9];
    int count = 0;

    for (int i = 0; i < n * n; i++) {
        if (i % n != row && i / n != column) {
            rest[count++] = m[i];
        }
    }
    const double sign = (row + column) % 2 == 0 ? 1 : -1;
    if (n == 2) {
        return sign * rest[0];
    }
    if (n == 3) {
        return sign * (rest[0] * rest[3] - rest[1] * rest[2]);
    }
    return sign * (rest[0] * (rest[4] * rest[8] - rest[5] * rest[7]) -
                   rest[3] * (rest[1] * rest[8] - rest[2] * rest[7]) +
                   rest[6] * (rest[1] * rest[5] - rest[2] * rest[4]));
}

static void determinant_of(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    out[0] = 0;
    for (int i = 0; i < n; i++) {
        out[0] += in[0][i] * cofactor(in[0], n, i, 0);
    }
}

/* Nothing where there is none. */
static void inverted(double *out, const double *const in[BUILTIN_ARGUMENTS], int n)
{
    double scale;

    determinant_of(&scale, in, n);
    for (int i = 0; i < n * n; i++) {
        out[i] = scale == 0 ? 0 : cofactor(in[0], n, i / n, i % n) / scale;
    }
}

/* --- the table --- */

/* `load` is time of llvmpipe's compiler for one component of a chain of such calls, in units of 0.3
 * ms where a scene without code takes 0.9 s: of 60 calls, the slower one of its two ways
 * (GALLIVM_PERF=nopt, and none). For comparison, a sum or product takes a third of a unit. */

const struct builtin builtin_table[] = {
    /* clang-format off */
    {"radians", FAMILY_FLOAT, 1, .one = from_degrees},
    {"degrees", FAMILY_FLOAT, 1, .one = from_radians},
    {"sin", FAMILY_FLOAT, 1, .load = 52, .one = sin},
    {"cos", FAMILY_FLOAT, 1, .load = 52, .one = cos},
    {"tan", FAMILY_FLOAT, 1, .load = 72, .one = tan},
    {"asin", FAMILY_FLOAT, 1, .weight = 3, .load = 80, .glsl = "code_asin", .one = arc_sine},
    {"acos", FAMILY_FLOAT, 1, .weight = 3, .load = 88, .glsl = "code_acos", .one = arc_cosine},
    {"atan", FAMILY_FLOAT, 1, .weight = 3, .load = 60, .one = atan},
    {"atan", FAMILY_FLOAT, 2, .weight = 8, .load = 116, .glsl = "code_atan", .two = arc_of},
    {"atan2", FAMILY_FLOAT, 2, .weight = 8, .load = 116, .glsl = "code_atan", .two = arc_of},
    {"sinh", FAMILY_FLOAT, 1, .load = 40, .one = sinh},
    {"cosh", FAMILY_FLOAT, 1, .load = 40, .one = cosh},
    {"tanh", FAMILY_FLOAT, 1, .load = 40, .one = tanh},
    {"asinh", FAMILY_FLOAT, 1, .weight = 2, .load = 45, .one = asinh},
    {"acosh", FAMILY_FLOAT, 1, .load = 45, .glsl = "code_acosh", .one = area_cosine},
    {"atanh", FAMILY_FLOAT, 1, .load = 40, .glsl = "code_atanh", .one = area_tangent},
    {"pow", FAMILY_FLOAT, 2, .load = 64, .glsl = "code_pow", .two = power},
    {"exp", FAMILY_FLOAT, 1, .load = 20, .one = exp},
    {"exp2", FAMILY_FLOAT, 1, .load = 16, .one = exp2},
    {"log", FAMILY_FLOAT, 1, .load = 30, .glsl = "code_log", .one = log_natural},
    {"log2", FAMILY_FLOAT, 1, .load = 26, .glsl = "code_log2", .one = log_two},
    {"log10", FAMILY_FLOAT, 1, .load = 30, .glsl = "(0.4342944819 * code_log($0))", .one = log_ten},
    {"sqrt", FAMILY_FLOAT, 1, .load = 10, .glsl = "code_sqrt", .one = root},
    {"inversesqrt", FAMILY_FLOAT, 1, .load = 10, .glsl = "code_inversesqrt", .one = inverse_root},
    {"rsqrt", FAMILY_FLOAT, 1, .load = 10, .glsl = "code_inversesqrt", .one = inverse_root},
    {"rcp", FAMILY_FLOAT, 1, .load = 10, .glsl = "(1.0 / code_nonzero($0))", .one = reciprocal},
    {"abs", FAMILY_SIGNED, 1, .one = fabs},
    {"sign", FAMILY_SIGNED, 1, .load = 10, .one = sign_of},
    {"floor", FAMILY_FLOAT, 1, .load = 6, .one = floor},
    {"ceil", FAMILY_FLOAT, 1, .load = 6, .one = ceil},
    {"trunc", FAMILY_FLOAT, 1, .load = 6, .one = trunc},
    {"round", FAMILY_FLOAT, 1, .load = 6, .glsl = "floor($0 + 0.5)", .one = rounded},
    {"roundEven", FAMILY_FLOAT, 1, .load = 6, .one = rint},
    {"fract", FAMILY_FLOAT, 1, .load = 6, .one = fraction},
    {"frac", FAMILY_FLOAT, 1, .load = 6, .glsl = "fract", .one = fraction},
    {"mod", FAMILY_FLOAT, 2, .weight = 2, .load = 12, .glsl = "code_mod", .two = remainder_floor},
    {"fmod", FAMILY_FLOAT, 2, .weight = 2, .load = 12, .glsl = "code_fmod", .two = remainder_trunc},
    {"min", FAMILY_NUMBER, 2, .two = least},
    {"max", FAMILY_NUMBER, 2, .two = most},
    {"clamp", FAMILY_NUMBER, 3, .glsl = "min(max($0, $1), $2)", .three = between},
    {"saturate", FAMILY_FLOAT, 1, .glsl = "code_saturate", .one = saturated},
    {"mix", FAMILY_FLOAT, 3, .load = 4, .three = mixed},
    {"mix", FAMILY_SELECT, 3, .three = selected},
    {"lerp", FAMILY_FLOAT, 3, .load = 4, .glsl = "mix", .three = mixed},
    {"step", FAMILY_FLOAT, 2, .two = stepped},
    {"smoothstep", FAMILY_FLOAT, 3, .weight = 2, .load = 24, .glsl = "code_smoothstep",
     .three = stepped_smoothly},
    {"fma", FAMILY_FLOAT, 3, .glsl = "($0 * $1 + $2)", .three = multiplied_added},
    {"mad", FAMILY_FLOAT, 3, .glsl = "($0 * $1 + $2)", .three = multiplied_added},
    {"isnan", FAMILY_TEST, 1, .one = is_nan},
    {"isinf", FAMILY_TEST, 1, .one = is_infinite},
    {"length", FAMILY_SCALAR, 1, .load = 6, .whole = length_of},
    {"distance", FAMILY_SCALAR, 2, .load = 6, .whole = distance_of},
    {"dot", FAMILY_SCALAR, 2, .whole = dot_product},
    {"cross", FAMILY_CROSS, 2, .load = 8, .whole = cross_product},
    {"normalize", FAMILY_SHAPE, 1, .load = 7, .glsl = "code_normalize", .whole = normalized},
    {"faceforward", FAMILY_SHAPE, 3, .whole = face_forward},
    {"reflect", FAMILY_SHAPE, 2, .whole = reflected},
    {"refract", FAMILY_REFRACT, 3, .weight = 4, .load = 27, .whole = refracted},
    {"matrixCompMult", FAMILY_MATRIX, 2, .load = 4, .two = product},
    {"transpose", FAMILY_MATRIX, 1, .whole = transposed},
    {"inverse", FAMILY_MATRIX, 1, .weight = 5, .load = 42, .glsl = "code_inverse",
     .whole = inverted},
    {"determinant", FAMILY_DETERMINANT, 1, .load = 9, .whole = determinant_of},
    {"outerProduct", FAMILY_OUTER, 2, .whole = outer_product},
    {"mul", FAMILY_PRODUCT, 2, .glsl = NULL},
    {"lessThan", FAMILY_COMPARE, 2, .two = is_less},
    {"lessThanEqual", FAMILY_COMPARE, 2, .two = is_less_equal},
    {"greaterThan", FAMILY_COMPARE, 2, .two = is_greater},
    {"greaterThanEqual", FAMILY_COMPARE, 2, .two = is_greater_equal},
    {"equal", FAMILY_EQUAL, 2, .two = is_equal},
    {"notEqual", FAMILY_EQUAL, 2, .two = is_unequal},
    {"not", FAMILY_LOGIC, 1, .one = is_false},
    {"any", FAMILY_COUNT, 1, .whole = any_of},
    {"all", FAMILY_COUNT, 1, .whole = all_of},
    /* Value noise from -1 to 1, waves about two units long. */
    {"noise", FAMILY_PLACE, 1, .weight = 20, .load = 104, .glsl = "noise_value($0, 0u)",
     .whole = pattern_noise},
    /* The sum of up to eight octaves, each of twice the frequency and half the height. */
    {"fbm", FAMILY_OCTAVES, 2, .weight = 40, .load = 160, .trips = PATTERN_OCTAVES,
     .glsl = "code_fbm", .whole = pattern_fbm},
    /* A number from 0 to 1 for each cube of side 1, by chance. */
    {"hash", FAMILY_PLACE, 1, .weight = 8, .load = 24, .glsl = "code_hash", .whole = pattern_hash},
    /* 0 and 1 by turns in cubes of side 1. */
    {"checker", FAMILY_PLACE, 1, .weight = 2, .load = 5,
     .glsl = "code_checker", .whole = pattern_checker},
    /* 0 in the first half of each unit, 1 in the second. */
    {"stripes", FAMILY_FLOAT, 1, .weight = 2, .load = 24,
     .glsl = "code_stripes", .one = pattern_stripes},
    /* How much of each of three patterns along X, Y and Z a surface shows; 1 in all. */
    {"triplanar", FAMILY_CROSS, 1, .weight = 4, .load = 10, .glsl = "code_triplanar",
     .whole = pattern_triplanar},
    {"jet_dual_times", FAMILY_JET, 2, .weight = 3,
     .whole = jet_dual_times, .sizes = {4, 4, 4}},
    {"jet_dual_of", FAMILY_JET, 3,
     .whole = jet_dual_of, .sizes = {4, 4, 1, 1}},
    {"jet_times", FAMILY_JET, 2, .weight = 12,
     .whole = jet_times, .sizes = {BUILTIN_JET, BUILTIN_JET, BUILTIN_JET}},
    {"jet_minus", FAMILY_JET, 2,
     .whole = jet_minus, .sizes = {BUILTIN_JET, BUILTIN_JET, BUILTIN_JET}},
    {"jet_scaled", FAMILY_JET, 2, .weight = 3,
     .whole = jet_scaled, .sizes = {BUILTIN_JET, BUILTIN_JET, 1}},
    {"jet_moved", FAMILY_JET, 2,
     .whole = jet_moved, .sizes = {BUILTIN_JET, BUILTIN_JET, 1}},
    {"jet_of", FAMILY_JET, 2, .weight = 6,
     .whole = jet_of, .sizes = {BUILTIN_JET, BUILTIN_JET, 4}},
    {"jet_even", FAMILY_JET, 3, .weight = 8,
     .whole = jet_even, .sizes = {BUILTIN_JET, BUILTIN_JET, 2, 1}},
    {"jet_odd", FAMILY_JET, 3, .weight = 8,
     .whole = jet_odd, .sizes = {BUILTIN_JET, BUILTIN_JET, 2, 1}},
    {"jet_turn", FAMILY_JET, 1, .weight = 6, .load = 60,
     .whole = jet_turn, .sizes = {4, 2}},
    {"jet_cos", FAMILY_JET, 2, .weight = 6,
     .whole = jet_cos, .sizes = {BUILTIN_JET, BUILTIN_JET, 4}},
    {"jet_dual_sin", FAMILY_JET, 1, .weight = 3, .load = 26,
     .whole = jet_dual_sin, .sizes = {4, 4}},
    {"jet_dual_cos", FAMILY_JET, 1, .weight = 3, .load = 26,
     .whole = jet_dual_cos, .sizes = {4, 4}},
    {"jet_exp", FAMILY_JET, 1, .weight = 6, .load = 10,
     .whole = jet_exp, .sizes = {BUILTIN_JET, BUILTIN_JET}},
    {"jet_dual_exp", FAMILY_JET, 1, .weight = 3, .load = 6,
     .whole = jet_dual_exp, .sizes = {4, 4}},
    {"jet_near_box", FAMILY_JET, 2, .weight = 4,
     .whole = jet_near_box, .sizes = {4, 3, 3}},
    {"jet_near_ball", FAMILY_JET, 2, .weight = 4,
     .whole = jet_near_ball, .sizes = {4, 3, 1}},
    {"jet_clipped", FAMILY_JET, 2, .weight = 6,
     .whole = jet_clipped, .sizes = {1, 4, 1}},
    {"jet_begin", FAMILY_JET, 2, .weight = 6,
     .whole = jet_begin, .sizes = {4, 4, 1}},
    {"jet_room", FAMILY_JET, 1,
     .whole = jet_room, .sizes = {1, 1}},
    {"jet_ahead", FAMILY_JET, 3, .weight = 6,
     .whole = jet_ahead, .sizes = {3, 3, 4, 4}},
    {"jet_estimated", FAMILY_JET, 3, .weight = 12,
     .whole = jet_estimated, .sizes = {1, 4, 4, 4}},
    {"jet_solid", FAMILY_JET, 2, .weight = 20, .load = 30,
     .whole = jet_solid, .sizes = {4, BUILTIN_JET, 4}},
    {"jet_sheet", FAMILY_JET, 3, .weight = 25, .load = 36,
     .whole = jet_sheet, .sizes = {4, BUILTIN_JET, 4, 1}},
    {"jet_search", FAMILY_JET, 2, .weight = 6,
     .whole = jet_search, .sizes = {BUILTIN_JET, 4, 1}},
    {"jet_searched", FAMILY_JET, 2, .weight = 25, .load = 36,
     .whole = jet_searched, .sizes = {BUILTIN_JET, BUILTIN_JET, BUILTIN_JET}},
    {.name = NULL},
    /* clang-format on */
};

const struct builtin *builtin_find(const char *name, bool ours)
{
    for (const struct builtin *row = builtin_table; row->name; row++) {
        if (strcmp(row->name, name) == 0 && (ours || row->family != FAMILY_JET)) {
            return row;
        }
    }
    return NULL;
}

struct type builtin_jet_type(uint8_t size)
{
    return size == BUILTIN_JET ? type_matrix(3) : type_vector(BASE_FLOAT, size);
}

const char *builtin_advice(const char *name)
{
    static const struct {
        const char *prefix, *advice;
    } rows[] = {
        {"texture", "there are no textures; compute the value"},
        {"texelFetch", "there are no textures; compute the value"},
        {"tex1D", "there are no textures; compute the value"},
        {"tex2D", "there are no textures; compute the value"},
        {"tex3D", "there are no textures; compute the value"},
        {"image", "there are no images; compute the value"},
        {"dFd", "code is asked about one point; take differences of the function itself"},
        {"fwidth", "code is asked about one point; take differences of the function itself"},
        {"ddx", "code is asked about one point; take differences of the function itself"},
        {"ddy", "code is asked about one point; take differences of the function itself"},
        {"clip", "code cannot leave out a point; return a large distance, or a colour"},
        {"sincos", "write sin() and cos()"},
        {"modf", "write trunc() and fract()"},
        {"noise", "no driver has it; call noise(vec3)"},
        {"atomic", "there is nothing to share between points"},
        {"printf", "code can only return its value"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (strncmp(name, rows[i].prefix, strlen(rows[i].prefix)) == 0) {
            return rows[i].advice;
        }
    }
    return NULL;
}
