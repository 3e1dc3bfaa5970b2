/* SPDX-License-Identifier: MIT */
/* What is around the distance functions of users. */

/* Where a function is asked: it is known inside its box alone, (half of its lengths, scale). */
vec3 within(vec3 p, vec4 box)
{
    return clamp(p, -box.xyz, box.xyz);
}

/* A distance at within(p), cut by the box. What is in the box lies beyond the box's nearest point,
 * at a right angle or more: outside, both ways together are no longer than the distance. */
float cut(float d, vec3 p, vec4 box)
{
    vec3 q = abs(p) - box.xyz;
    float outside = length(max(q, 0.0)) * box.w;
    float inside = min(max(q.x, max(q.y, q.z)), 0.0) * box.w;
    return outside > 0.0 ? length(vec2(outside, max(d, 0.0))) : max(d, inside);
}
