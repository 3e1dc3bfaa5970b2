/* SPDX-License-Identifier: MIT */
/* Where a ray meets the field, and its normal. */

struct Hit {
    bool hit;
    bool solid; /* of a ray inside: what it met is in there, not the way out */
    float free; /* nothing is nearer */
    float t;
    vec3 normal; /* towards where the ray comes from */
    int steps;
};

/* In a loop of two rounds, so that map() stands in the program once, which halves the time drivers
 * take to compile it.
 *
 * First: sphere tracing with steps stretched by the slope seen so far; a step whose spheres do not
 * touch is taken back (Ban and Valasek: Automatic Step Size Relaxation in Sphere Tracing,
 * Eurographics 2023 short papers). The ray ends where the distance is a part of the pixel's
 * footprint. A ray that runs out of steps has hit when it is within some footprints, as grazing
 * rays are. A cone instead goes as far as the sphere holds it, and ends where that is little.
 *
 * Then: the normal, the gradient by four points of a tetrahedron (Quilez: normals for an SDF);
 * their sum is 4 e times as long as the gradient.
 *
 * A ray inside of something clear goes until the way out or something solid in there, whichever
 * comes first: each of its steps takes two rounds of the loop, one for either field. */
Hit march(Ray ray, float start, float cone, int most)
{
    vec2 span = bounds_span(ray.origin, ray.direction);
    bool single = cone == 0.0;
    float t = max(single ? span.x : 0.0, start);
    float end = single ? min(span.y, bounds_max.w) : bounds_max.w;
    float widening = eye.w > 0.5 ? 0.0 : cone * forward.w;
    float ahead = 0.0; /* length of the step being tried */
    float radius = 0.0, slope = -1.0;
    int left = end >= t ? (ray.inside ? 2 * most : most) : 0, taken = 0;
    bool hit = false, solid = false;
    vec3 base = ray.origin, gradient = vec3(0.0);
    float e = 0.0, rest = 0.0, free = t, out_there = FAR;

    for (int round = zero; round < 2; round++) {
        for (int i = zero; i < left; i++) {
            bool clear = ray.inside && (round == 0 ? (i & 1) == 0 : !solid);
            through = ray.inside ? (clear ? -FAR : FAR) : 0.0;
            vec3 corner = vec3((((i + 3) >> 1) & 1), ((i >> 1) & 1), (i & 1)) * 2.0 - 1.0;
            vec3 offset = round == 0 ? ray.direction * (t + ahead) : corner * e;
            float d = map(base + offset);
            d = clear ? -d : d;
            gradient += corner * d;
            rest += 0.25 * d;
            if (round > 0 || clear) {
                out_there = d;
                continue;
            }
            taken++;
            /* Where both are, the solid one is seen, not some of each. */
            solid = d < out_there + 0.5 * footprint(ray, t);
            d = min(d, out_there);
            bool back = ahead > radius + abs(d);
            slope = back ? -1.0 : ahead > 0.0 ? mix(slope, (d - radius) / ahead, 0.3) : slope;
            t = back ? t : t + ahead;
            radius = back ? radius : d;
            float print = footprint(ray, t);
            float room = radius - cone * print;
            hit = room < (single ? 0.3 : 0.4 * cone) * print;
            if (hit || t > end) {
                break;
            }
            ahead = max(back ? radius : radius * max(1.0, 2.0 / (1.0 - slope)), 0.25 * print);
            ahead = single ? ahead : room / (1.0 + widening);
        }
        if (round == 0) {
            free = t;
            hit = (hit || radius < 3.0 * footprint(ray, t)) && t <= end && left > 0;
            /* The rest of the way is at least as long as the distance. */
            t += max(radius, 0.0);
            base = ray.origin + ray.direction * (hit ? t : 0.0);
            e = 0.5 * footprint(ray, t) + 1e-5;
            gradient = vec3(0.0);
            rest = 0.0;
            left = hit && single ? 4 : 0;
        }
    }
    through = 0.0;
    float length_of = length(gradient);
    vec3 normal = length_of > 0.0 ? gradient / length_of : -ray.direction;
    /* Behind an edge that the ray only brushed, the field leads away from the eye. */
    normal = normalize(normal - ray.direction * max(dot(normal, ray.direction) + 0.02, 0.0));
    /* The last piece, to the tangent plane. */
    t += rest * 4.0 * e / max(length_of, 0.4 * e) / max(-dot(normal, ray.direction), 0.02);
    return Hit(hit, solid, free, hit ? t : INFINITY, normal, taken);
}
