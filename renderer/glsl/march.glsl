/* SPDX-License-Identifier: MIT */
/* Where a ray meets the field, and its normal. */

#include "field_bound.glsl"
#include "ray.glsl"
#include "section.glsl"

struct Hit {
    bool hit;
    bool opaque; /* met alone: inside something transmissive, or close to its surface */
    float free;  /* nothing is nearer */
    int source;  /* GEOMETRY_... */
    float t;
    vec3 normal; /* towards where the ray comes from */
    int steps;
    float curvature; /* by which angle `normal` turns over a unit of way; 0 if not wanted */
};

/* Distances of this part of a point's coordinates are rounding. */
#define GRAIN 2e-7

float greatest(vec3 v)
{
    vec3 a = abs(v);
    return max(a.x, max(a.y, a.z));
}

/* As long as the field changes as it did before, a step may leave so much of the ray unseen between
 * its spheres, in footprints; less where a surface is near, as among the threads of fractals. */
#define GAP 0.5

/* A ray has met the surface where the line through its last two distances leads there within a way
 * of X. Past a ball of radius R that may be X (X + way between the two) / 2 R too far outside: the
 * greatest such product, in square footprints. */
#define AT_SURFACE 0.001

/* A fifth of a turn. */
#define FIFTH mat2(0.30901699, 0.95105652, -0.95105652, 0.30901699)

/* Of a surface of which the field says the height at five places, evenly around on a circle of
 * radius e: the mean of them, and their wave of two turns. The root of the mean square of both
 * curvatures, below 0 where it is hollow; 0 for what is rounding or an edge. */
float curvature_of(float mean, vec2 wave, float e, float rounding)
{
    float both = 2.0 * mean / (e * e), apart = 0.8 * length(wave) / (e * e);
    float size = max(length(vec2(both, apart)) - 2.0 * rounding / (e * e), 0.0);
    return size * e > 0.25 ? 0.0 : mean < 0.0 ? -size : size;
}

/* In a loop of four rounds, so that map() stands in the program once, which halves the time
 * drivers take to compile it.
 *
 * First: sphere tracing with steps stretched by the slope seen so far; a step whose spheres do not
 * touch is taken back (Ban and Valasek: Automatic Step Size Relaxation in Sphere Tracing,
 * Eurographics 2023 short papers). No step leads beyond where a line through the last two distances
 * meets the surface (secant method). Where a step ends inside, the line between its ends tells
 * where it crossed. A ray that runs out of steps has hit when it is within some footprints, or when
 * the field has fallen evenly, as along a plane: then it is where the line leads. A cone instead
 * goes as far as the sphere holds it, and ends where that is little.
 *
 * Then: the normal, the gradient by four points of a tetrahedron (Quilez: normals for an SDF);
 * their sum is 4 e times as long as the gradient. Where the mean of the four is not the distance in
 * their middle, there is an edge, or another side, among them: a much smaller tetrahedron just in
 * front of the surface takes their place.
 *
 * Last, where it is wanted: curvature, by the field at five places around the normal.
 * Of five, neither the mean nor the wave of two turns changes when the circle is tilted.
 *
 * A ray inside of something transmissive goes until the way out or something opaque in there,
 * whichever comes first: each of its steps takes two rounds of the loop, one for either field. */
Hit march(Ray ray, float start, float cone, int max_steps)
{
    vec2 span = bounds_span(ray.origin, ray.direction);
    bool single = cone == 0.0;
    float t = max(single ? span.x : 0.0, start);
    float end = single ? min(span.y, frame.max_distance) : frame.max_distance;
    float widening = camera.orthographic != 0 ? 0.0 : cone * camera.pixel_radius;
    float far_off = greatest(ray.origin);
    float ahead = 0.0; /* length of the step being tried */
    float radius = 0.0, root = 0.0, slope = -1.0, grade = -1.0;
    int left = end >= t ? (ray.inside ? 2 * max_steps : max_steps) : 0, taken = 0;
    bool hit = false, opaque = false, early = false, straight = false;
    vec3 base = ray.origin, gradient = vec3(0.0);
    float e = 0.0, rest = 0.0, free = t, out_there = FAR;
    float level = 0.0, steep = 1.0;
    bool smoothly = false;
    vec3 east = vec3(0.0), north = vec3(0.0), uphill = vec3(0.0);
    vec2 around = vec2(1.0, 0.0), wave = vec2(0.0);

    for (int round = zero; round < 4; round++) {
        for (int i = zero; i < left; i++) {
            bool transmissive = ray.inside && (round == 0 ? (i & 1) == 0 : !opaque);
            early = round == 0 ? t + ahead < ray.start : early;
            bool fresh = ahead == 0.0 || (t < ray.start && !early);
            field_mask = transmissive ? -FAR : ray.inside || early ? FAR : 0.0;
            vec3 corner = vec3((((i + 3) >> 1) & 1), ((i >> 1) & 1), (i & 1)) * 2.0 - 1.0;
            corner = round == 3 ? east * around.x + north * around.y : corner;
            vec3 offset = round == 0 ? ray.direction * (t + ahead) : corner * e;
            vec3 p = base + offset;
            float d = section_cut(field_bound(p, t + ahead, round > 0 ? FAR : 0.0), p);
            if (field_waits(d)) {
                i--;
                continue;
            }
            d = transmissive ? -d : d;
            gradient += corner * d;
            rest += 0.25 * d;
            if (round == 3) {
                wave += d * vec2(around.x * around.x - around.y * around.y,
                                 2.0 * around.x * around.y);
                around = FIFTH * around;
            }
            if (round > 0 || transmissive) {
                out_there = early ? FAR : d;
                continue;
            }
            taken++;
            float footprint = pixel_footprint(ray, t + ahead), grain = GRAIN * (far_off + t);
            /* Where both are, the opaque one is seen, not some of each. */
            opaque = d < out_there + 0.02 * footprint;
            d = min(d, out_there);
            float last = ahead, change = d - radius;
            bool even = single && abs(change - grade * last) < 0.1 * last;
            straight = single && !fresh && abs(change - grade * last) < 0.01 * abs(change);
            bool back = last > radius + abs(d) + max(even ? GAP * footprint : 0.0, 2.0 * grain);
            bool inside = single && !back && d < 0.0 && !fresh, stay = back || inside;
            grade = back || fresh ? -1.0 : change / last;
            slope = back || fresh ? -1.0 : mix(slope, grade, 0.3);
            t = stay ? t : t + last;
            radius = stay ? radius : d;
            /* From t to where the line meets the surface, and so far from an end of it. */
            root = radius / max(-grade, 1e-6);
            float aside = inside ? min(root, last - root) : root;
            bool met = !back && aside * (aside + last) < AT_SURFACE * footprint * footprint;
            float room = radius - cone * footprint;
            hit = single ? met || radius < grain : room < 0.4 * cone * footprint;
            root = hit && !met ? 0.0 : max(root, 0.0);
            if (hit || t > end) {
                break;
            }
            float gap = min(GAP * footprint,
                            root > 16.0 * footprint ? footprint : 2.0 * radius + 0.07 * footprint);
            float reach = (2.0 * radius + (even ? gap : 0.0)) / (1.0 - slope);
            ahead = inside ? root : max(radius, min(reach, root + 0.01 * footprint));
            ahead = single ? max(ahead, 2.0 * grain) : room / (1.0 + widening);
            /* Not beyond where it looks for transmissive objects too. */
            ahead = t < ray.start ? min(max(radius, 2.0 * grain), ray.start - t) : ahead;
        }
        if (round == 0) {
            free = t;
            hit = hit || (straight && grade < 0.0);
            t += hit ? root : max(radius, 0.0);
            hit = (hit || root < 3.0 * pixel_footprint(ray, t)) && t <= end && left > 0;
            base = ray.origin + ray.direction * (hit ? t : 0.0);
            e = 0.1 * pixel_footprint(ray, t) + 2e-5 * greatest(base);
            left = hit && single ? 4 : 0;
        } else if (round == 1) {
            bool edge = abs(rest) > 0.0075 * length(gradient);
            smoothly = left > 0 && !edge;
            left = edge ? left : 0;
            level = rest;
            steep = length(gradient) / (4.0 * e);
            e = 0.1 * e + 2e-5 * greatest(base);
            base -= ray.direction * (2.0 * e / clamp(-grade, 0.25, 1.0));
        } else if (round == 2) {
            smoothly = smoothly && (frame.effects & EFFECT_CURVATURE) != 0;
            left = smoothly ? 5 : 0;
            uphill = gradient;
            base = ray.origin + ray.direction * t;
            e = 0.5 * pixel_footprint(ray, t);
            east = normalize(abs(uphill.y) < abs(uphill.x) ? vec3(-uphill.z, 0.0, uphill.x)
                                                           : vec3(0.0, uphill.z, -uphill.y));
            north = normalize(cross(uphill, east));
        }
        if (left > 0 && round < 3) {
            gradient = vec3(0.0);
            rest = 0.0;
        }
    }
    field_mask = 0.0;
    float length_of = length(uphill), curvature = 0.0;
    vec3 normal = length_of > 0.0 ? uphill / length_of : -ray.direction;
    if (smoothly) {
        float rounding = GRAIN * (far_off + t);
        curvature = curvature_of((0.8 * rest - level) / steep, wave / steep, e, rounding / steep);
    }
    /* Behind an edge that the ray only brushed, the field leads away from the eye. */
    normal = normalize(normal - ray.direction * max(dot(normal, ray.direction) + 0.02, 0.0));
    return Hit(hit, opaque && (ray.inside || early), free, GEOMETRY_FIELD, hit ? t : INFINITY,
               normal, taken, curvature);
}
