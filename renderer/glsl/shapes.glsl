/* SPDX-License-Identifier: MIT */
/* Distance functions of primitives; in C they are in renderer/sdf/shapes.c. */

/* The point in a node's own space: three rows of (x, y, z, translation). */
vec3 local(vec3 p, vec4 x, vec4 y, vec4 z)
{
    return vec3(dot(x.xyz, p) + x.w, dot(y.xyz, p) + y.w, dot(z.xyz, p) + z.w);
}

/* Distance to the intersection of two half-spaces at right angles. */
float corner(float a, float b)
{
    return min(max(a, b), 0.0) + length(max(vec2(a, b), 0.0));
}

/* A ball. */
float sd_sphere(vec3 p, float radius)
{
    return length(p) - radius;
}

/* A ball with three radii: a bound. */
float sd_ellipsoid(vec3 p, vec3 radii)
{
    return (length(p / radii) - 1.0) * min(radii.x, min(radii.y, radii.z));
}

/* A cuboid of full lengths `size`. */
float sd_box(vec3 p, vec3 size)
{
    vec3 q = abs(p) - size * 0.5;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

/* A cuboid whose rounding lies inside `size`; radius at most half of the least length. */
float sd_round_box(vec3 p, vec3 size, float radius)
{
    return sd_box(p, size - 2.0 * radius) - radius;
}

/* A ring around Y. */
float sd_torus(vec3 p, float radius, float tube)
{
    return length(vec2(length(p.xz) - radius, p.y)) - tube;
}

/* A cylinder along Y. */
float sd_cylinder(vec3 p, float radius, float height)
{
    return corner(length(p.xz) - radius, abs(p.y) - 0.5 * height);
}

/* All points near the segment from a to b. */
float sd_capsule(vec3 p, vec3 a, vec3 b, float radius)
{
    vec3 pa = p - a, ba = b - a;
    float t = clamp(dot(pa, ba) / max(dot(ba, ba), 1e-30), 0.0, 1.0);
    return length(pa - t * ba) - radius;
}

/* A cone along Y, tip up: nearest point of slope or base, in the half-plane below the tip. */
float sd_cone(vec3 p, float radius, float height)
{
    vec2 q = vec2(length(p.xz), 0.5 * height - p.y), tip = vec2(radius, height);
    vec2 slope = q - tip * clamp(dot(q, tip) / dot(tip, tip), 0.0, 1.0);
    vec2 base = vec2(max(q.x - radius, 0.0), q.y - height);
    float d = sqrt(min(dot(slope, slope), dot(base, base)));
    return max(q.x * height - q.y * radius, q.y - height) > 0.0 ? d : -d;
}

/* Everything on one side of a plane; unit normal. */
float sd_plane(vec3 p, vec3 normal, float offset)
{
    return dot(p, normal) - offset;
}
