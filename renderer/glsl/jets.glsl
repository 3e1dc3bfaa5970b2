/* SPDX-License-Identifier: MIT */
/* Duals and jets of equations (renderer/code/jets.h): products, sums and chain rules. */

#define JET_MAX 1e18

vec4 jet_dual_times(vec4 a, vec4 b)
{
    return vec4(a.xyz * b.w + b.xyz * a.w, a.w * b.w);
}

vec4 jet_dual_of(vec4 a, float value, float slope)
{
    return vec4(a.xyz * slope, value);
}

vec2 jet_bounded(vec2 x)
{
    return clamp(x, -JET_MAX, JET_MAX);
}

/* The slopes of a jet times an interval. */
mat3 jet_slopes(mat3 a, vec2 by)
{
    vec3 p = a[0] * by.x, q = a[0] * by.y, r = a[1] * by.x, s = a[1] * by.y;
    return mat3(max(min(min(p, q), min(r, s)), -JET_MAX), min(max(max(p, q), max(r, s)), JET_MAX),
                vec3(0.0));
}

mat3 jet_times(mat3 a, mat3 b)
{
    vec2 u = a[2].xy, v = b[2].xy;
    mat3 c = jet_slopes(a, v), d = jet_slopes(b, u);
    vec2 p = u * v.x, q = u * v.y;
    vec2 value = vec2(min(min(p.x, p.y), min(q.x, q.y)), max(max(p.x, p.y), max(q.x, q.y)));
    return mat3(c[0] + d[0], c[1] + d[1], vec3(jet_bounded(value), 0.0));
}

mat3 jet_minus(mat3 a, mat3 b)
{
    return mat3(a[0] - b[1], a[1] - b[0], a[2] - b[2].yxz);
}

mat3 jet_scaled(mat3 a, float s)
{
    vec3 p = a[0] * s, q = a[1] * s;
    vec2 v = a[2].xy * s;
    return mat3(max(min(p, q), -JET_MAX), min(max(p, q), JET_MAX),
                vec3(jet_bounded(vec2(min(v.x, v.y), max(v.x, v.y))), 0.0));
}

mat3 jet_moved(mat3 a, float s)
{
    return mat3(a[0], a[1], a[2] + vec3(s, s, 0.0));
}

/* The chain rule: of a function's least and greatest value, and its least and greatest slope. */
mat3 jet_of(mat3 a, vec4 range)
{
    mat3 d = jet_slopes(a, jet_bounded(range.zw));
    return mat3(d[0], d[1], vec3(jet_bounded(range.xy), 0.0));
}

/* To the even power k; `power` is |a[2].xy|^(k - 1). */
mat3 jet_even(mat3 a, vec2 power, float k)
{
    vec2 x = a[2].xy, ends = abs(x) * power, slope = k * power;
    return jet_of(a, vec4(x.x * x.y <= 0.0 ? 0.0 : min(ends.x, ends.y), max(ends.x, ends.y),
                          x.x < 0.0 ? -slope.x : slope.x, x.y < 0.0 ? -slope.y : slope.y));
}

/* The same for an odd one. */
mat3 jet_odd(mat3 a, vec2 power, float k)
{
    vec2 x = a[2].xy;
    return jet_of(a, vec4(x * power, x.x * x.y <= 0.0 ? 0.0 : k * min(power.x, power.y),
                          k * max(power.x, power.y)));
}

vec2 jet_cosine(vec2 x)
{
    vec2 ends = cos(x), turns = floor(x / 6.283185307);
    vec2 half_turns = floor((x - 3.141592654) / 6.283185307);
    return vec2(half_turns.y > half_turns.x ? -1.0 : min(ends.x, ends.y),
                turns.y > turns.x ? 1.0 : max(ends.x, ends.y));
}

/* The slope is -sin x = cos(x + pi/2). */
vec4 jet_range_cos(vec2 x)
{
    return vec4(jet_cosine(x), jet_cosine(x + 1.570796327));
}
