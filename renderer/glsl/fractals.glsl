/* SPDX-License-Identifier: MIT */
/* Fractals, minimal surfaces and landscapes; in C they are in renderer/sdf/fractals.c. */

#include "shapes.glsl"

/* A sponge of two mazes with a wall between them, cut by a box. */
float sd_gyroid(vec3 p, float period, float thickness, vec3 size)
{
    vec3 turns = p / period;
    vec3 angle = 6.28318531 * (turns - round(turns));
    float g = dot(sin(angle), cos(angle.yzx));
    return max(sd_box(p, size), abs(g) * period * 0.0918881492 - 0.5 * thickness);
}

/* A cube without its middle, and so on. */
float sd_menger(vec3 p, float size, float iterations)
{
    float d = sd_box(p, vec3(size)), cell = size;
    vec3 q = p;
    for (int i = 0; i < int(iterations); i++) {
        q -= cell * round(q / cell);
        vec3 a = abs(q);
        d = max(d, cell / 6.0 - max(min(a.x, a.y), min(max(a.x, a.y), a.z)));
        cell /= 3.0;
    }
    return d;
}

#define JULIA_ITERATIONS 20

/* All points whose orbit under q -> q^2 + c stays near: how large a ball around p is free. */
float sd_julia(vec3 p, vec4 c, float iterations)
{
    float edge = 0.5 + 0.5 * sqrt(1.0 + 4.0 * length(c));
    float radius[JULIA_ITERATIONS + 1];
    vec4 q = vec4(p, 0.0);
    int last = 0;
    radius[0] = length(p);
    float e = radius[0];
    for (int i = 0; i < int(iterations) && e < 2.0 * edge; i++) {
        q = vec4(q.x * q.x - dot(q.yzw, q.yzw), 2.0 * q.x * q.yzw) + c;
        last = i + 1;
        e = length(q);
        radius[last] = e;
    }
    e -= edge;
    for (int i = last - 1; i >= 0; i--) {
        float r = radius[i];
        e = max(e / max(sqrt(r * r + abs(e)) + r, 1e-15), r - edge);
    }
    return e;
}

#define BULB_ITERATIONS 12
#define BULB_TRIALS 16

/* The product of complex numbers. */
vec2 turned(vec2 a, vec2 b)
{
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

/* A complex number to a power from 0 to 31. */
vec2 turned_often(vec2 a, int power)
{
    vec2 b = (power & 1) != 0 ? a : vec2(1.0, 0.0);
    a = turned(a, a);
    b = (power & 2) != 0 ? turned(a, b) : b;
    a = turned(a, a);
    b = (power & 4) != 0 ? turned(a, b) : b;
    a = turned(a, a);
    b = (power & 8) != 0 ? turned(a, b) : b;
    a = turned(a, a);
    return (power & 16) != 0 ? turned(a, b) : b;
}

/* How large a ball around the orbit's start may be if it grew as one of radius `ball` does. */
float bulb_reach(vec3 orbit[BULB_ITERATIONS + 1], int last, float power, float edge, float ball)
{
    bool inside = orbit[last].x <= edge;
    float grown = 1.0, best = 0.0;
    for (int i = 0; i <= last; i++) {
        vec3 at = orbit[i];
        float room = inside ? edge - at.x : at.x - edge;
        best = !inside || i == last ? max(best, room / grown) : 0.0;
        float e = ball * grown;
        float stretch = min((at.x + e) / max(at.y - e, 1e-30), power);
        float far = 0.5 * power * pow(at.x + e, power - 1.0);
        grown = min(stretch * (at.z + far) * grown + 1.0, 1e30);
    }
    return best;
}

/* All points whose orbit under z -> z^power + p stays near: how large a ball around p is free. */
float sd_mandelbulb(vec3 p, float power, float iterations)
{
    float edge = exp2(1.0 / (power - 1.0));
    vec3 orbit[BULB_ITERATIONS + 1], z = p;
    int last = 0;
    for (int i = 0; i <= int(iterations); i++) {
        float r = length(z), a = length(z.xz);
        last = i;
        orbit[i] = vec3(r, a, 0.5 * power * pow(r, power - 1.0));
        if (r >= 2.0 * edge) {
            break;
        }
        vec2 turn = turned_often(vec2(z.y, a) / max(r, 1e-15), int(power));
        vec2 around = turned_often(z.zx / max(a, 1e-15), int(power));
        z = pow(r, power) * vec3(turn.y * around.y, turn.x, turn.y * around.x) + p;
    }
    float ball = bulb_reach(orbit, last, power, edge, 0.0);
    float core = (power - 1.0) * pow(power, power / (1.0 - power)) - orbit[0].x;
    float low = max(core, 0.0), high = ball, before = 0.0, pace = 0.0;
    for (int i = 0; i < BULB_TRIALS && low < high; i++) {
        float found = bulb_reach(orbit, last, power, edge, ball);
        float error = log(max(found, 1e-30) / ball);
        low = max(low, min(found, ball));
        high = min(high, max(found, ball));
        if (abs(error) < 3e-4) {
            break;
        }
        error = error < 0.0 ? -log(1.0 - error) : error;
        pace = i > 0 && error != before ? error * pace / (before - error) : 0.5 * error;
        before = error;
        float next = clamp(ball * exp(clamp(pace, -1.5, 1.5)), low, high);
        pace = log(next / ball);
        ball = next;
    }
    return orbit[last].x <= edge ? -low : low;
}

/* A number from 0 to 1 for each corner of a lattice. */
float corner_height(ivec2 at, uint seed)
{
    uint h = uint(at.x) * 0x9e3779b1u + uint(at.y) * 0x85ebca77u + seed * 0xc2b2ae3du;
    h = (h ^ h >> 16) * 0x7feb352du;
    h = (h ^ h >> 15) * 0x846ca68bu;
    return float((h ^ h >> 16) >> 8) / 16777215.0;
}

/* Heights between the corners of a lattice. */
float value_noise(vec2 p, uint seed)
{
    vec2 cell = floor(p), t = p - cell;
    ivec2 at = ivec2(cell);
    t *= t * (3.0 - 2.0 * t);
    return mix(mix(corner_height(at, seed), corner_height(at + ivec2(1, 0), seed), t.x),
               mix(corner_height(at + ivec2(0, 1), seed), corner_height(at + 1, seed), t.x), t.y);
}

/* A landscape cut by a box. */
float sd_terrain(vec3 p, vec3 size, float octaves, float seed)
{
    float cell = 0.25 * max(size.x, size.z), whole = 2.0 - exp2(1.0 - octaves);
    float steepness = length(vec2(1.0, 1.6 * octaves * size.y / (whole * cell)));
    float d = sd_box(p, size), low = (p.y + 0.5 * size.y) / steepness;
    if (low <= d) {
        return d;
    }
    vec2 q = clamp(p.xz, -0.5 * size.xz, 0.5 * size.xz) / cell;
    float height = 0.0, weight = size.y / whole;
    for (int i = 0; i < int(octaves); i++) {
        height += weight * value_noise(q, uint(seed) + 65536u * uint(i));
        q = 2.0 * q + vec2(0.37, 0.61);
        weight *= 0.5;
    }
    return max(low - height / steepness, d);
}
