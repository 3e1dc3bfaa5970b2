/* SPDX-License-Identifier: MIT */
/* First pass: where each ray meets the field, its normal and its surface. */

layout(location = 0) out vec4 out_geometry;
layout(location = 1) out uvec4 out_matter;
layout(location = 2) out uvec4 out_more;

/* Where the ray is inside the bounds: entry and exit; exit < entry where it misses them. */
vec2 clip(Ray ray)
{
    vec3 inverse = 1.0 / ray.direction;
    vec3 a = (bounds_min.xyz - ray.origin) * inverse;
    vec3 b = (bounds_max.xyz - ray.origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(max(near.x, near.y), max(near.z, bounds_min.w)),
                min(min(far.x, far.y), min(far.z, bounds_max.w)));
}

/* Sphere tracing with steps stretched by the slope seen so far; a step whose spheres do not touch
 * is taken back (Ban and Valasek: Automatic Step Size Relaxation in Sphere Tracing, Eurographics
 * 2023 short papers). The ray ends where the distance is a part of the pixel's footprint. A ray
 * that runs out of steps has hit when it is within some footprints, as grazing rays are. */
float march(Ray ray, vec2 span)
{
    float t = span.x;
    float ahead = 0.0; /* length of the step being tried */
    float radius = 0.0, slope = -1.0;
    int left = span.y >= span.x ? size.w : 0;
    bool hit = false;

    for (int i = zero; i < left; i++) {
        float d = map(ray.origin + ray.direction * (t + ahead));
        if (ahead > radius + abs(d)) {
            slope = -1.0;
            ahead = radius;
            continue;
        }
        if (ahead > 0.0) {
            slope = mix(slope, (d - radius) / ahead, 0.3);
        }
        t += ahead;
        radius = max(d, 0.0);
        hit = d < 0.25 * footprint(t);
        if (hit || t > span.y) {
            break;
        }
        ahead = max(radius * max(1.0, 2.0 / (1.0 - slope)), 0.25 * footprint(t));
    }
    hit = (hit || radius < 3.0 * footprint(t)) && t <= span.y && left > 0;
    return hit ? t : INFINITY;
}

/* The gradient by four points of a tetrahedron, `e` apart, in a loop so that map() stands in the
 * program once (Quilez: normals for an SDF). */
vec3 field_normal(vec3 p, float e, bool hit)
{
    vec3 sum = vec3(0.0);
    int count = hit ? 4 : 0;

    for (int i = zero; i < count; i++) {
        vec3 corner = vec3((((i + 3) >> 1) & 1), ((i >> 1) & 1), (i & 1)) * 2.0 - 1.0;
        sum += corner * map(p + corner * e);
    }
    float size = length(sum);
    return size > 0.0 ? sum / size : vec3(0.0, 1.0, 0.0);
}

void main()
{
    ivec2 at = tile.xy * size.z + ivec2(gl_FragCoord.xy);
    Ray ray = camera_ray(at);
    float t = march(ray, clip(ray));
    bool hit = t < INFINITY;
    float reach = hit ? t : 0.0;
    vec3 p = ray.origin + ray.direction * reach;
    vec3 n = field_normal(p, 0.5 * footprint(reach) + 1e-5, hit);
    Surface s;

    surface(p, s);
    s.id = hit ? s.id : 0u;
    out_geometry = vec4(hit ? n : vec3(0.0), t);
    surface_pack(s, out_matter, out_more);
}
