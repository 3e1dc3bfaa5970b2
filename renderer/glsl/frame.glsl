/* SPDX-License-Identifier: MIT */
/* What is the same for a whole picture, `frame` (renderer/glsl/interface.h), and where a dispatch
 * is at, `dispatch`. */

#include "constants.glsl"
#include "interface.glsl"

#define zero dispatch.zero

/* Where a ray is inside of a box: entry and exit; exit < entry where it misses it. */
vec2 box_span(vec3 low, vec3 high, vec3 origin, vec3 direction)
{
    /* Along a side, and on it, 0 times infinity would be no number. */
    vec3 inverse = 1.0 / mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 a = (low - origin) * inverse;
    vec3 b = (high - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return vec2(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}

vec2 bounds_span(vec3 origin, vec3 direction)
{
    return box_span(frame.bounds_min, frame.bounds_max, origin, direction);
}
