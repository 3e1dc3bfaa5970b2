/* SPDX-License-Identifier: MIT */
/* First pass: where each ray meets the field, and its normal. It runs twice: coarsely at first,
 * with a cone for BLOCK x BLOCK samples, which tells how far all their rays are free. */

layout(rgba32f, binding = 0) writeonly uniform image2D out_geometry;
layout(r32f, binding = 4) uniform image2D starts; /* one value for each block */

#define BLOCK 8

/* Radius of a block's cone in footprints, which are half a pixel: from the block's ray to the far
 * side of the farthest sample. */
#define CONE (14.0 / float(size.z))

struct Hit {
    bool hit;
    float free; /* nothing is nearer */
    float t;
    vec3 normal;
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
 * their sum is 4 e times as long as the gradient. */
Hit march(Ray ray, float start, float cone)
{
    vec2 span = bounds_span(ray.origin, ray.direction);
    bool single = cone == 0.0;
    float t = max(single ? span.x : 0.0, start);
    float end = single ? min(span.y, bounds_max.w) : bounds_max.w;
    float widening = eye.w > 0.5 ? 0.0 : cone * forward.w;
    float ahead = 0.0; /* length of the step being tried */
    float radius = 0.0, slope = -1.0;
    int left = end >= t ? size.w : 0;
    bool hit = false;
    vec3 base = ray.origin, gradient = vec3(0.0);
    float e = 0.0, rest = 0.0, free = t;

    for (int round = zero; round < 2; round++) {
        for (int i = zero; i < left; i++) {
            vec3 corner = vec3((((i + 3) >> 1) & 1), ((i >> 1) & 1), (i & 1)) * 2.0 - 1.0;
            vec3 offset = round == 0 ? ray.direction * (t + ahead) : corner * e;
            float d = map(base + offset);
            gradient += corner * d;
            rest += 0.25 * d;
            if (round > 0) {
                continue;
            }
            bool back = ahead > radius + abs(d);
            slope = back ? -1.0 : ahead > 0.0 ? mix(slope, (d - radius) / ahead, 0.3) : slope;
            t = back ? t : t + ahead;
            radius = back ? radius : d;
            float print = footprint(t);
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
            hit = (hit || radius < 3.0 * footprint(t)) && t <= end && left > 0;
            /* The rest of the way is at least as long as the distance. */
            t += max(radius, 0.0);
            base = ray.origin + ray.direction * (hit ? t : 0.0);
            e = 0.5 * footprint(t) + 1e-5;
            gradient = vec3(0.0);
            rest = 0.0;
            left = hit && single ? 4 : 0;
        }
    }
    float size = length(gradient);
    vec3 normal = size > 0.0 ? gradient / size : -ray.direction;
    /* Behind an edge that the ray only brushed, the field leads away from the eye. */
    normal = normalize(normal - ray.direction * max(dot(normal, ray.direction) + 0.02, 0.0));
    /* The last piece, to the tangent plane. */
    t += rest * 4.0 * e / max(size, 0.4 * e) / max(-dot(normal, ray.direction), 0.02);
    return Hit(hit, free, hit ? t : INFINITY, normal);
}

void main()
{
    preload();
    ivec2 here = group_place();
    bool coarse = tile.w == 1;
    Ray ray = camera_ray(tile.xy * size.z + (coarse ? here * BLOCK + BLOCK / 2 : here));
    float start = coarse ? bounds_min.w : imageLoad(starts, here / BLOCK).x;
    Hit found = march(ray, start, coarse ? CONE : 0.0);

    if (coarse) {
        imageStore(starts, here, vec4(found.free));
    } else {
        imageStore(out_geometry, here, vec4(found.hit ? found.normal : vec3(0.0), found.t));
    }
}
