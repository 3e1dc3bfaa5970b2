/* SPDX-License-Identifier: MIT */
/* What is around the distance functions of users. */

/* A distance, cut by a box: (half of its lengths, scale). */
float cut(float d, vec3 p, vec4 box)
{
    vec3 q = abs(p) - box.xyz;
    return max(d, (length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0)) * box.w);
}
