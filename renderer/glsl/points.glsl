/* SPDX-License-Identifier: MIT */
/* A list of points is where its first lies and how many there are. */

#include "params.glsl"

int points_count(vec2 points)
{
    return int(points.y);
}

/* Point i of a list, two of them in a vec4. */
vec2 points_at(vec2 points, int i)
{
    vec4 pair = P_ANY(int(points.x) + (i >> 1));
    return (i & 1) == 0 ? pair.xy : pair.zw;
}
