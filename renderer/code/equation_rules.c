/* SPDX-License-Identifier: MIT */
/* Derivatives and interval rules of the functions of equations, in the language of users' code.
 * Rules of intervals: Moore, Interval Analysis (1966). Outside of a function's domain its value is
 * that at the domain's nearest end, and its slope 0. */
#include "equation_rules.h"

#include "jets.h"

#define TEXT(x) #x
#define TEXT_OF(x) TEXT(x)
#define HUGE TEXT_OF(JET_MAX)

const char equation_sizes[] =
    "vec2 sizes(vec2 x)\n"
    "{\n"
    "    vec2 s = abs(x);\n"
    "    return vec2(x.x * x.y <= 0.0 ? 0.0 : min(s.x, s.y), max(s.x, s.y));\n"
    "}\n";

const struct equation_rule equation_reciprocal = {
    "($ == 0.0 ? " HUGE " : 1.0 / $)", "($ == 0.0 ? 0.0 : -1.0 / ($ * $))",
    "vec4 range_reciprocal(vec2 x)\n"
    "{\n"
    "    vec2 s = max(sizes(x), 1e-18);\n"
    "    vec2 slope = vec2(-1.0 / (s.x * s.x), -1.0 / (s.y * s.y));\n"
    "    if (x.x * x.y <= 0.0) {\n"
    "        return vec4(-" HUGE ", " HUGE ", slope);\n"
    "    }\n"
    "    return vec4(1.0 / x.y, 1.0 / x.x, slope);\n"
    "}\n"};

const struct equation_rule equation_rules[EQUATION_FUNCTIONS] = {
    [EQUATION_SIN] = {"sin($)", "cos($)", ""},
    [EQUATION_COS] = {"cos($)", "(-sin($))", ""},
    [EQUATION_TAN] = {"tan($)", "(1.0 + tan($) * tan($))",
                      "vec4 range_tan(vec2 x)\n"
                      "{\n"
                      "    vec2 turns = floor((x - 1.570796327) / 3.141592654);\n"
                      "    vec2 value = tan(x), s = sizes(value);\n"
                      "    if (turns.y > turns.x || x.y - x.x >= 3.141592654) {\n"
                      "        return vec4(-" HUGE ", " HUGE ", 1.0, " HUGE ");\n"
                      "    }\n"
                      "    return vec4(value, 1.0 + s * s);\n"
                      "}\n"},
    [EQUATION_ASIN] = {"asin($)", "(abs($) < 1.0 ? inversesqrt(1.0 - $ * $) : 0.0)",
                       "vec4 range_asin(vec2 x)\n"
                       "{\n"
                       "    vec2 y = clamp(x, -1.0, 1.0), s = sizes(y);\n"
                       "    vec2 slope = inversesqrt(max(1.0 - s * s, 1e-18));\n"
                       "    slope *= step(sizes(x).yx, vec2(1.0));\n"
                       "    return vec4(asin(y), slope);\n"
                       "}\n"},
    [EQUATION_ACOS] = {"acos($)", "(abs($) < 1.0 ? -inversesqrt(1.0 - $ * $) : 0.0)",
                       "vec4 range_acos(vec2 x)\n"
                       "{\n"
                       "    vec2 y = clamp(x, -1.0, 1.0), s = sizes(y);\n"
                       "    vec2 slope = inversesqrt(max(1.0 - s * s, 1e-18));\n"
                       "    slope *= step(sizes(x).yx, vec2(1.0));\n"
                       "    return vec4(acos(y).yx, -slope.yx);\n"
                       "}\n"},
    [EQUATION_ATAN] = {"atan($)", "(1.0 / (1.0 + $ * $))",
                       "vec4 range_atan(vec2 x)\n"
                       "{\n"
                       "    vec2 s = sizes(x), slope = 1.0 / (1.0 + s * s);\n"
                       "    return vec4(atan(x), slope.yx);\n"
                       "}\n"},
    [EQUATION_SINH] = {"sinh(clamp($, -40.0, 40.0))", "cosh(clamp($, -40.0, 40.0))",
                       "vec4 range_sinh(vec2 x)\n"
                       "{\n"
                       "    vec2 y = clamp(x, -40.0, 40.0);\n"
                       "    return vec4(sinh(y), cosh(sizes(y)));\n"
                       "}\n"},
    [EQUATION_COSH] = {"cosh(clamp($, -40.0, 40.0))", "sinh(clamp($, -40.0, 40.0))",
                       "vec4 range_cosh(vec2 x)\n"
                       "{\n"
                       "    vec2 y = clamp(x, -40.0, 40.0);\n"
                       "    return vec4(cosh(sizes(y)), sinh(y));\n"
                       "}\n"},
    [EQUATION_TANH] = {"tanh($)", "(1.0 - tanh($) * tanh($))",
                       "vec4 range_tanh(vec2 x)\n"
                       "{\n"
                       "    vec2 value = tanh(x), s = sizes(value), slope = 1.0 - s * s;\n"
                       "    return vec4(value, slope.yx);\n"
                       "}\n"},
    [EQUATION_EXP] = {"exp(min($, 40.0))", "exp(min($, 40.0))", ""},
    [EQUATION_LOG] = {"log(max($, 1e-18))", "($ > 1e-18 ? 1.0 / $ : 0.0)",
                      "vec4 range_log(vec2 x)\n"
                      "{\n"
                      "    vec2 y = max(x, 1e-18), slope = 1.0 / y;\n"
                      "    return vec4(log(y), slope.yx * step(1e-18, x));\n"
                      "}\n"},
    [EQUATION_SQRT] = {"sqrt(max($, 0.0))", "($ > 0.0 ? 0.5 * inversesqrt(max($, 1e-18)) : 0.0)",
                       "vec4 range_sqrt(vec2 x)\n"
                       "{\n"
                       "    vec2 y = max(x, 1e-18), slope = 0.5 * inversesqrt(y);\n"
                       "    return vec4(sqrt(max(x, 0.0)), slope.yx * step(0.0, x));\n"
                       "}\n"},
    [EQUATION_CBRT] = {"(sign($) * pow(abs($), 0.3333333333))",
                       "(0.3333333333 * pow(max(abs($), 1e-18), -0.6666666667))",
                       "vec4 range_cbrt(vec2 x)\n"
                       "{\n"
                       "    vec2 s = max(sizes(x), 1e-18);\n"
                       "    vec2 slope = 0.3333333333 * pow(s, -0.6666666667);\n"
                       "    return vec4(sign(x) * pow(abs(x), 0.3333333333), slope.yx);\n"
                       "}\n"},
    [EQUATION_ABS] = {"abs($)", "sign($)",
                      "vec4 range_abs(vec2 x)\n"
                      "{\n"
                      "    return vec4(sizes(x), x.x < 0.0 ? -1.0 : 1.0, x.y > 0.0 ? 1.0 : -1.0);\n"
                      "}\n"},
    [EQUATION_SIGN] = {"sign($)", "($ * 0.0)",
                       "vec4 range_sign(vec2 x)\n"
                       "{\n"
                       "    vec2 value = sign(x);\n"
                       "    return vec4(value, 0.0, value.y > value.x ? " HUGE " : 0.0);\n"
                       "}\n"},
    [EQUATION_FLOOR] = {"floor($)", "($ * 0.0)",
                        "vec4 range_floor(vec2 x)\n"
                        "{\n"
                        "    vec2 value = floor(x);\n"
                        "    return vec4(value, 0.0, value.y > value.x ? " HUGE " : 0.0);\n"
                        "}\n"},
    [EQUATION_CEIL] = {"ceil($)", "($ * 0.0)",
                       "vec4 range_ceil(vec2 x)\n"
                       "{\n"
                       "    vec2 value = ceil(x);\n"
                       "    return vec4(value, 0.0, value.y > value.x ? " HUGE " : 0.0);\n"
                       "}\n"},
    [EQUATION_MIN] = {"min", NULL,
                      "vec4 dual_min(vec4 a, vec4 b) { return a.w < b.w ? a : b; }\n"
                      "mat3 jet_min(mat3 a, mat3 b)\n"
                      "{\n"
                      "    mat3 both = mat3(min(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]));\n"
                      "    return a[2].y < b[2].x ? a : b[2].y < a[2].x ? b : both;\n"
                      "}\n"},
    [EQUATION_MAX] = {"max", NULL,
                      "vec4 dual_max(vec4 a, vec4 b) { return a.w > b.w ? a : b; }\n"
                      "mat3 jet_max(mat3 a, mat3 b)\n"
                      "{\n"
                      "    mat3 both = mat3(min(a[0], b[0]), max(a[1], b[1]), max(a[2], b[2]));\n"
                      "    return a[2].x > b[2].y ? a : b[2].x > a[2].y ? b : both;\n"
                      "}\n"},
    /* The slopes are x / (x^2 + y^2) and -y / (x^2 + y^2). Without the cut along -x in the box,
     * its corners have the least and the greatest angle. */
    [EQUATION_ATAN2] = {"atan2", NULL,
                        "vec4 dual_atan2(vec4 y, vec4 x)\n"
                        "{\n"
                        "    vec3 turn = y.xyz * x.w - x.xyz * y.w;\n"
                        "    return vec4(turn / max(x.w * x.w + y.w * y.w, 1e-18),\n"
                        "                atan2(y.w, x.w));\n"
                        "}\n"
                        "vec2 parts(vec2 x, vec2 of)\n"
                        "{\n"
                        "    return vec2(x.x / (x.x < 0.0 ? of.x : of.y),\n"
                        "                x.y / (x.y < 0.0 ? of.y : of.x));\n"
                        "}\n"
                        "mat3 jet_atan2(mat3 a, mat3 b)\n"
                        "{\n"
                        "    vec2 y = a[2].xy, x = b[2].xy, v = sizes(y), u = sizes(x);\n"
                        "    vec2 square = max(u * u + v * v, 1e-18);\n"
                        "    bool cut = y.x * y.y <= 0.0 && x.x <= 0.0;\n"
                        "    vec2 high = atan2(vec2(y.y), x), low = atan2(vec2(y.x), x);\n"
                        "    vec2 most = max(high, low), least = min(high, low);\n"
                        "    vec2 value = vec2(min(least.x, least.y), max(most.x, most.y));\n"
                        "    vec2 along = cut ? vec2(-" HUGE ", " HUGE ") : parts(x, square);\n"
                        "    vec2 across = cut ? vec2(-" HUGE ", " HUGE ") : parts(y, square);\n"
                        "    mat3 c = jet_minus(jet_of(a, vec4(0.0, 0.0, along)),\n"
                        "                       jet_of(b, vec4(0.0, 0.0, across)));\n"
                        "    value = cut ? vec2(-3.1415927, 3.1415927) : value;\n"
                        "    return mat3(c[0], c[1], vec3(value, 0.0));\n"
                        "}\n"},
};
