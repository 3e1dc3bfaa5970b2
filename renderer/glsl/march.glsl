/* SPDX-License-Identifier: MIT */
/* Where a ray meets the field, and its normal. */

#include "field_map.glsl"
#include "ray.glsl"

struct Hit {
    bool hit;
    bool solid; /* what it met was looked for alone: in something clear, or close to its surface */
    float free; /* nothing is nearer */
    float t;
    vec3 normal; /* towards where the ray comes from */
    int steps;
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

/* In a loop of three rounds, so that map() stands in the program once, which halves the time
 * drivers take to compile it.
 *
 * First: sphere tracing with steps stretched by the slope seen so far; a step whose spheres do not
 * touch is taken back (Ban and Valasek: Automatic Step Size Relaxation in Sphere Tracing,
 * Eurographics 2023 short papers). No step leads beyond where a line through the last two distances
 * meets the surface (secant method). Where a step ends inside, the line between its ends tells
 * where it crossed. A ray that runs out of steps has hit when it is within some footprints. A cone
 * instead goes as far as the sphere holds it, and ends where that is little.
 *
 * Then: the normal, the gradient by four points of a tetrahedron (Quilez: normals for an SDF);
 * their sum is 4 e times as long as the gradient. Where the mean of the four is not the distance in
 * their middle, there is an edge, or another side, among them: a much smaller tetrahedron just in
 * front of the surface takes their place.
 *
 * A ray inside of something clear goes until the way out or something solid in there, whichever
 * comes first: each of its steps takes two rounds of the loop, one for either field. */
Hit march(Ray ray, float start, float cone, int most)
{
    vec2 span = bounds_span(ray.origin, ray.direction);
    bool single = cone == 0.0;
    float t = max(single ? span.x : 0.0, start);
    float end = single ? min(span.y, frame.max_distance) : frame.max_distance;
    float widening = frame.orthographic != 0 ? 0.0 : cone * frame.pixel_radius;
    float far_off = greatest(ray.origin);
    float ahead = 0.0; /* length of the step being tried */
    float radius = 0.0, root = 0.0, slope = -1.0, grade = -1.0;
    int left = end >= t ? (ray.inside ? 2 * most : most) : 0, taken = 0;
    bool hit = false, solid = false, early = false;
    vec3 base = ray.origin, gradient = vec3(0.0);
    float e = 0.0, rest = 0.0, free = t, out_there = FAR;

    for (int round = zero; round < 3; round++) {
        for (int i = zero; i < left; i++) {
            bool clear = ray.inside && (round == 0 ? (i & 1) == 0 : !solid);
            early = round == 0 ? t + ahead < ray.start : early;
            bool fresh = ahead == 0.0 || (t < ray.start && !early);
            through = clear ? -FAR : ray.inside || early ? FAR : 0.0;
            vec3 corner = vec3((((i + 3) >> 1) & 1), ((i >> 1) & 1), (i & 1)) * 2.0 - 1.0;
            vec3 offset = round == 0 ? ray.direction * (t + ahead) : corner * e;
            float d = map(base + offset);
            d = clear ? -d : d;
            gradient += corner * d;
            rest += 0.25 * d;
            if (round > 0 || clear) {
                out_there = early ? FAR : d;
                continue;
            }
            taken++;
            float print = footprint(ray, t + ahead), grain = GRAIN * (far_off + t);
            /* Where both are, the solid one is seen, not some of each. */
            solid = d < out_there + 0.02 * print;
            d = min(d, out_there);
            float last = ahead, change = d - radius;
            bool even = single && abs(change - grade * last) < 0.1 * last;
            bool back = last > radius + abs(d) + max(even ? GAP * print : 0.0, 2.0 * grain);
            bool inside = single && !back && d < 0.0 && !fresh, stay = back || inside;
            grade = back || fresh ? -1.0 : change / last;
            slope = back || fresh ? -1.0 : mix(slope, grade, 0.3);
            t = stay ? t : t + last;
            radius = stay ? radius : d;
            /* From t to where the line meets the surface, and so far from an end of it. */
            root = radius / max(-grade, 1e-6);
            float aside = inside ? min(root, last - root) : root;
            bool met = !back && aside * (aside + last) < AT_SURFACE * print * print;
            float room = radius - cone * print;
            hit = single ? met || radius < grain : room < 0.4 * cone * print;
            root = hit && !met ? 0.0 : max(root, 0.0);
            if (hit || t > end) {
                break;
            }
            float gap = min(GAP * print, root > 16.0 * print ? print : 2.0 * radius + 0.07 * print);
            float reach = (2.0 * radius + (even ? gap : 0.0)) / (1.0 - slope);
            ahead = inside ? root : max(radius, min(reach, root + 0.01 * print));
            ahead = single ? max(ahead, 2.0 * grain) : room / (1.0 + widening);
            /* Not beyond where it looks for clear things too. */
            ahead = t < ray.start ? min(max(radius, 2.0 * grain), ray.start - t) : ahead;
        }
        if (round == 0) {
            free = t;
            t += hit ? root : max(radius, 0.0);
            hit = (hit || root < 3.0 * footprint(ray, t)) && t <= end && left > 0;
            base = ray.origin + ray.direction * (hit ? t : 0.0);
            e = 0.1 * footprint(ray, t) + 2e-5 * greatest(base);
            left = hit && single ? 4 : 0;
        } else {
            left = round == 1 && abs(rest) > 0.0075 * length(gradient) ? left : 0;
            e = 0.1 * e + 2e-5 * greatest(base);
            base -= ray.direction * (2.0 * e / clamp(-grade, 0.25, 1.0));
        }
        if (left > 0) {
            gradient = vec3(0.0);
            rest = 0.0;
        }
    }
    through = 0.0;
    float length_of = length(gradient);
    vec3 normal = length_of > 0.0 ? gradient / length_of : -ray.direction;
    /* Behind an edge that the ray only brushed, the field leads away from the eye. */
    normal = normalize(normal - ray.direction * max(dot(normal, ray.direction) + 0.02, 0.0));
    return Hit(hit, solid && (ray.inside || early), free, hit ? t : INFINITY, normal, taken);
}
