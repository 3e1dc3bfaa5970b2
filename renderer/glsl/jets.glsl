/* SPDX-License-Identifier: MIT */
/* Duals and jets of equations (renderer/code/jets.h): products, sums and chain rules. */

#include "field_mask.glsl"

#define JET_MAX 1e18
#define JET_SECANTS 8.0

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

/* Of both ends of an interval: (sine of either, cosine of either), each from the least to the
 * greatest between them. A sine is greatest after a quarter of a turn. */
vec4 jet_turn(vec2 x)
{
    vec2 s = sin(x), c = cos(x), turns = 0.15915494309 * x;
    vec2 top = floor(turns - 0.25), low = floor(turns + 0.25);
    vec2 front = floor(turns), back = floor(turns - 0.5);
    return vec4(low.y > low.x ? -1.0 : min(s.x, s.y), top.y > top.x ? 1.0 : max(s.x, s.y),
                back.y > back.x ? -1.0 : min(c.x, c.y), front.y > front.x ? 1.0 : max(c.x, c.y));
}

/* The cosine; that of a sine is jet_of(a, turn), whose slopes are cosines. */
mat3 jet_cos(mat3 a, vec4 turn)
{
    return jet_of(a, vec4(turn.zw, -turn.y, -turn.x));
}

vec4 jet_dual_sin(vec4 a)
{
    return vec4(a.xyz * cos(a.w), sin(a.w));
}

vec4 jet_dual_cos(vec4 a)
{
    return vec4(a.xyz * -sin(a.w), cos(a.w));
}

mat3 jet_exp(mat3 a)
{
    vec2 y = exp(min(a[2].xy, 40.0));
    return jet_of(a, vec4(y, y));
}

vec4 jet_dual_exp(vec4 a)
{
    float y = exp(min(a.w, 40.0));
    return vec4(a.xyz * y, y);
}

/* --- distances --- */

/* The nearest point of the clip, and the way there; in the clip: less than 0. */
vec4 jet_near_box(vec3 p, vec3 size)
{
    vec3 near = clamp(p, -0.5 * size, 0.5 * size), faces = abs(p) - 0.5 * size;
    float outside = distance(p, near);
    return vec4(near, outside > 0.0 ? outside : max(faces.x, max(faces.y, faces.z)));
}

vec4 jet_near_ball(vec3 p, float radius)
{
    float apart = length(p);
    return vec4(p * min(1.0, radius / max(apart, 1e-18)), apart - radius);
}

/* The distance of a solid from p, which is `d` away from the nearest point of its clip. */
float jet_clipped(vec4 near, float d)
{
    return near.w > 0.0 ? length(vec2(near.w, max(d, 0.0))) : max(d, near.w);
}

/* What boxes begin with, see jet_solid: Newton's step, or `reach` where that is longer. */
vec4 jet_begin(vec4 a, float reach)
{
    return vec4(abs(a.w), min(abs(a.w) / max(length(a.xyz), 1e-18), reach), reach, 0.0);
}

/* How much an estimate may be; 0: none is asked for. */
float jet_room(float room)
{
    return field_estimates ? room : 0.0;
}

vec3 jet_ahead(vec3 p, vec4 a, vec4 at)
{
    return p - a.xyz * ((a.w < 0.0 ? -at.y : at.y) / max(length(a.xyz), 1e-18));
}

/* How far a parabola through these has its root. Where it stays above 0 there is none, and it is
 * farther: this is 3.5 and 4.1 of Newton's steps where 3 and 4 lead to a root of that order, and
 * without end where f falls by less than half on the first of them, as beside a pole. */
float jet_estimated(vec4 a, vec4 at, vec4 ahead)
{
    float slope = length(a.xyz), reach = max(at.y, 1e-9);
    float bend = ((a.w < 0.0 ? -ahead.w : ahead.w) - at.x + slope * reach) / reach;
    float square = slope * slope - 4.0 * bend * (at.x / reach);
    return 2.0 * at.x / max(slope + sign(square) * sqrt(abs(square)), 1e-18);
}

float jet_steepest(mat3 a)
{
    return max(length(max(abs(a[0]), abs(a[1]))), 1e-18);
}

/* Half sides of the next box, between one without a zero and one that may have one. */
float jet_smaller(float reach, float known, bool jumps)
{
    return sqrt(max(known, (jumps ? 0.04 : 0.001) * reach) * reach);
}

float jet_larger(float reach, float limit)
{
    return 2.0 * reach < limit ? sqrt(reach * limit) : 0.0;
}

/* What boxes around a point tell of the way to a zero: (|f| at the point, half side of the next
 * box, of the least box that may have a zero, the way that is free), from that and the jet in this
 * box; 0: no other box tells more. Nothing is in a box without a zero among its values. Such a box
 * grows: Newton's step is short where the slope has no bound, as beside the end of a domain. Where
 * the slope in a box tells less than that in a smaller one would, the box shrinks. Close to a jump
 * or a pole in every box, a ray goes on by a little: it ends at the jump where the sign changes. */
vec4 jet_solid(mat3 a, vec4 at)
{
    float steepest = jet_steepest(a), reach = at.y;
    bool apart = a[2].x * a[2].y > 0.0, jumps = !apart && steepest > 1e17;
    float free = apart ? reach : min(at.x / steepest, reach);
    float known = max(at.w, jumps ? 0.0003 * reach : free);
    float less = known > 0.4 * reach ? 0.0 : jet_smaller(reach, known, jumps);
    return apart ? vec4(at.x, jet_larger(reach, at.z), at.z, known)
                 : vec4(at.x, less, reach, known);
}

/* The same to a sheet, which is where |f| is at most half of the thickness times the slope in a
 * small box (`grain`) around the point. Let M be the slope in a box that is larger by the grain
 * than a ball. Within the ball |f| falls by at most M a unit of way, and the slope in small boxes
 * is at most M: the sheet is at least |f| / M less half of its thickness away, or the radius of
 * the ball. Where M has no bound, as at the end of a domain, all around would be a sheet of it: so
 * a box about as thick as the sheet (`around`) has to have a zero among its values there. */
vec4 jet_sheet(mat3 a, vec4 at, float thickness)
{
    float steepest = jet_steepest(a), reach = at.y, grain = thickness / 16.0;
    float around = 0.5 * thickness + grain;
    bool apart = a[2].x * a[2].y > 0.0, jumps = !apart && steepest > 1e17, last = reach <= grain;
    bool steep = at.x < 0.001 * thickness * steepest;
    float slow = min(at.x / steepest - 0.5 * thickness, last ? grain : reach - grain);
    float known = max(at.w, apart ? max(slow, reach - 0.5 * thickness) : slow);
    float less = max(jet_smaller(reach, known, jumps), grain);
    less = known < 2.0 * grain && reach < 2.0 * thickness ? grain : less;
    less = steep && reach > around && known < 0.0 ? around : less;
    less = known > 0.4 * reach ? 0.0 : less;
    float next = apart && known >= 0.0 ? jet_larger(reach, at.z) : less;
    return vec4(at.x, last ? 0.0 : next, apart ? at.z : reach, known);
}

/* A search of the free way, see jets.h. */
mat3 jet_search(vec4 a, float limit)
{
    float value = abs(a.w), begin = min(value / max(length(a.xyz), 1e-18), limit);
    return mat3(begin, value, begin > 0.0 ? 0.0 : 2.0, 0.0, value, limit, limit, 0.0, 0.0);
}

mat3 jet_searched(mat3 a, mat3 search)
{
    float r = search[0].x, limit = search[1].z;
    float free = max(max(a[2].x, -a[2].y), search[0].y - jet_steepest(a) * r);
    float side = free > 0.0 ? 1.0 : -1.0, other = side == search[0].z ? 0.5 : 1.0;
    bool whole = free > 0.0 && search[2].y == 0.0;
    vec2 here = vec2(r, free), half_of = vec2(1.0, other);
    vec2 low = free > 0.0 ? here : search[1].xy * half_of;
    vec2 high = free > 0.0 ? search[2].xy * half_of : here;
    float part = low.y / max(low.y - high.y, 1e-30), between = high.x - low.x;
    bool halves = part < 0.02 || search[2].z >= JET_SECANTS;
    float next = low.x + between * (halves ? 0.5 : part);
    bool close = between < 1e-5 * next || (!halves && abs(next - r) < 2e-4 * r);
    bool found = whole ? r >= limit : close;
    return mat3(whole ? limit : next, search[0].y, found ? 2.0 : side, low, limit, high,
                search[2].z + 1.0);
}
