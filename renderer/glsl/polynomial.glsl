/* SPDX-License-Identifier: MIT */
/* Surfaces by polynomials (renderer/sdf/polynomial.h), as in renderer/sdf/polynomial.c. */

#include "field_mask.glsl"
#include "params.glsl"

/* In parts of the extent: so near to a root its value needs more digits, from this degree on. */
#define POLYNOMIAL_NEAR 0.25
#define POLYNOMIAL_FINE 16.0

/* enum polynomial_end. */
#define POLYNOMIAL_GOES_ON 0.0
#define POLYNOMIAL_ENDS_Y 1.0

/* No operation is made another: what they lose is computed. Before GLSL 4 nothing says so. */
#ifndef PRECISE
#define PRECISE
#endif

/* Around p up to the third order: (value, bounds of the first, second and third order), and the
 * second order along the gradient. Series in the ways along x, y and z are cut at that order: `s`
 * in z, `r` in y and z, `a` in all. */
vec4 polynomial_orders(vec3 p, int at, int count, out float along)
{
    vec4 a0 = vec4(0.0), r0 = vec4(0.0), s = vec4(0.0);
    vec3 a1 = vec3(0.0), a4 = vec3(0.0), r1 = vec3(0.0);
    vec2 a2 = vec2(0.0), a5 = vec2(0.0), a7 = vec2(0.0), r2 = vec2(0.0);
    float a3 = 0.0, a6 = 0.0, a8 = 0.0, a9 = 0.0, r3 = 0.0;
    for (int i = 0; i < count; i++) {
        vec4 c = P_FROM(at + i);
        s = s * p.z + vec4(c.y, s.xyz);
        s = s * p.z + vec4(c.z, s.xyz);
        s = s * p.z + vec4(c.w, s.xyz);
        if (c.x > POLYNOMIAL_GOES_ON) {
            r3 = r3 * p.y + r2.x;
            r2 = r2 * p.y + r1.xy;
            r1 = r1 * p.y + r0.xyz;
            r0 = r0 * p.y + s;
            s = vec4(0.0);
        }
        if (c.x > POLYNOMIAL_ENDS_Y) {
            a9 = a9 * p.x + a7.x;
            a8 = a8 * p.x + a5.x;
            a7 = a7 * p.x + a4.xy;
            a6 = a6 * p.x + a2.x;
            a5 = a5 * p.x + a1.xy;
            a4 = a4 * p.x + a0.xyz;
            a3 = a3 * p.x + r3;
            a2 = a2 * p.x + r2;
            a1 = a1 * p.x + r1;
            a0 = a0 * p.x + r0;
            r0 = vec4(0.0);
            r1 = vec3(0.0);
            r2 = vec2(0.0);
            r3 = 0.0;
        }
    }
    vec3 first = vec3(a4.x, a1.x, a0.y);
    vec3 even = vec3(a7.x, a2.x, a0.z), odd = vec3(a5.x, a4.y, a1.y);
    vec3 up = first / max(length(first), 1e-18);
    along = dot(even, up * up) + dot(odd, vec3(up.x * up.y, up.x * up.z, up.y * up.z));
    vec4 cubes = vec4(a9, a3, a0.w, 0.0);
    vec3 one = vec3(a8, a7.y, a6), two = vec3(a4.z, a2.y, a1.z);
    return vec4(a0.x, length(first), sqrt(dot(even, even) + 0.5 * dot(odd, odd)),
                sqrt(dot(cubes, cubes) + (dot(one, one) + dot(two, two)) / 3.0 +
                     a5.y * a5.y / 6.0));
}

/* s * z + c, where c and z are sums of two, as the sum of a value and of what it lacks. */
vec2 polynomial_step(vec2 s, vec2 z, float c, float low)
{
    float high = uintBitsToFloat(floatBitsToUint(s.x) & 0xfffff000u), rest = s.x - high;
    PRECISE float product = s.x * (z.x + z.y);
    PRECISE float lost = ((high * z.x - product) + high * z.y + rest * z.x) + rest * z.y;
    PRECISE float sum = product + c;
    PRECISE float part = sum - product;
    PRECISE float left = (product - (sum - part)) + (c - part);
    return vec2(sum, s.y * (z.x + z.y) + (lost + left + low));
}

vec2 polynomial_halves(float x)
{
    float high = uintBitsToFloat(floatBitsToUint(x) & 0xfffff000u);
    return vec2(high, x - high);
}

/* The value alone, in twice the digits; `count` rows behind a coefficient stands what it lacks. */
float polynomial_fine(vec3 p, int at, int count)
{
    vec2 x = polynomial_halves(p.x), y = polynomial_halves(p.y), z = polynomial_halves(p.z);
    vec2 a = vec2(0.0), r = vec2(0.0), s = vec2(0.0);
    for (int i = 0; i < count; i++) {
        vec4 c = P_FROM(at + i), low = P_FROM(at + count + i);
        s = polynomial_step(s, z, c.y, low.y);
        s = polynomial_step(s, z, c.z, low.z);
        s = polynomial_step(s, z, c.w, low.w);
        if (c.x > POLYNOMIAL_GOES_ON) {
            r = polynomial_step(r, y, s.x, s.y);
            s = vec2(0.0);
        }
        if (c.x > POLYNOMIAL_ENDS_Y) {
            a = polynomial_step(a, x, r.x, r.y);
            r = vec2(0.0);
        }
    }
    return a.x + a.y;
}

/* All higher orders within `radius` of the origin as one of the fourth. */
float polynomial_rest(int at, int count, float radius)
{
    float sum = 0.0;
    for (int i = 0; i < count; i++) {
        vec4 c = P_FROM(at + i);
        sum = (((sum * radius + c.x) * radius + c.y) * radius + c.z) * radius + c.w;
    }
    return sum;
}

/* What f may change by on a way r, and that by r: orders b, and the fourth. */
vec2 polynomial_change(vec3 b, float fourth, float r)
{
    return vec2((((fourth * r + b.z) * r + b.y) * r + b.x) * r,
                ((4.0 * fourth * r + 3.0 * b.z) * r + 2.0 * b.y) * r + b.x);
}

/* The way on which f may change by `f`, at most `limit`: Newton's method from above, where it
 * converges, then the chord, which is below. */
float polynomial_distance(float f, vec3 b, float fourth, float limit)
{
    float r = min(min(f / b.x, sqrt(f / b.y)), min(sqrt(sqrt(f / max(fourth, 1e-18))), limit));
    for (int i = 0; i < 3; i++) {
        vec2 change = polynomial_change(b, fourth, r);
        r -= max(change.x - f, 0.0) / change.y;
    }
    return r * min(1.0, f / max(polynomial_change(b, fourth, r).x, 1e-30));
}

/* A sheet: |f| at most half of the thickness times the slope within a grain. */
float polynomial_sheet(float f, vec3 b, float fourth, float thickness, float grain, float limit)
{
    float half_thickness = 0.5 * thickness;
    float begin = half_thickness * polynomial_change(b, fourth, grain).y;
    float s = limit, whole = begin;
    for (int i = 0; i < 4; i++) {
        float t = s + grain;
        float bend = (12.0 * fourth * t + 6.0 * b.z) * t + 2.0 * b.y;
        vec2 change = polynomial_change(b, fourth, s);
        whole = change.x + half_thickness * polynomial_change(b, fourth, t).y;
        s = i < 3 ? s - max(whole - f, 0.0) / (change.y + half_thickness * bend) : s;
    }
    float outside = s * min(1.0, (f - begin) / max(whole - begin, 1e-30));
    return f > begin ? outside : max(half_thickness * (f / begin - 1.0), -half_thickness);
}

/* About how far from a root a polynomial in one variable is, by its value and two derivatives. */
float polynomial_laguerre(float f, float slope, float bend, float degree)
{
    float newton = abs(f) / slope, less = degree - 1.0;
    float part = less - degree * f * bend / (slope * slope);
    return degree * newton / (1.0 + sqrt(max(less * part, 0.0)));
}

/* Within the clip, in parts of its extent; an estimate may be so much more than the bound. */
float polynomial_within(vec3 p, int at, float more)
{
    vec4 form = P_FROM(at + 1), steps = P_FROM(at + 2);
    int count = int(form.w), rows = int(steps.w), rest = at + 3;
    float along;
    vec4 orders = polynomial_orders(p, rest + count, rows, along);
    vec3 b = max(orders.yzw, 1e-18);
    if (form.z >= POLYNOMIAL_FINE && abs(orders.x) < POLYNOMIAL_NEAR * b.x) {
        orders.x = polynomial_fine(p, rest + count, rows);
    }
    float f = abs(orders.x), fourth = 0.0, radius = length(p);
    float limit = polynomial_distance(f, b, 0.0, steps.y), d = limit;
    if (count > 0) {
        fourth = polynomial_rest(rest, count, radius + limit + steps.z);
        float less = polynomial_distance(f, b, fourth, limit);
        float between = sqrt(less * limit);
        float other = polynomial_rest(rest, count, radius + between + steps.z);
        float more = polynomial_distance(f, b, other, between);
        d = max(less, more);
        fourth = more > less ? other : fourth;
    }
    bool sheet = form.y >= 0.0;
    d = sheet ? polynomial_sheet(f, b, fourth, form.y, steps.z, d) : orders.x < 0.0 ? -d : d;
    float root = polynomial_laguerre(orders.x, b.x, 2.0 * along, form.z);
    return d > 0.0 ? clamp(root - (sheet ? 0.5 * form.y : 0.0), d, d + more) : d;
}

float polynomial(vec3 p, int at)
{
    vec4 clip = P_FROM(at);
    float radius = P_FROM(at + 1).x;
    bool ball = radius > 0.0;
    vec3 near = ball ? p * min(1.0, radius / max(length(p), 1e-18)) : clamp(p, -clip.xyz, clip.xyz);
    float outside = distance(p, near);
    float more = field_estimates ? max(P_FROM(at + 2).x - outside / clip.w, 0.0) : 0.0;
    vec3 faces = abs(p) - clip.xyz;
    float face = ball ? length(p) - radius : max(faces.x, max(faces.y, faces.z));
    float d = polynomial_within(near / clip.w, at, more) * clip.w;
    return outside > 0.0 ? length(vec2(outside, max(d, 0.0))) : max(d, face);
}
