/* SPDX-License-Identifier: MIT */
/* How far from p nothing is, `distance` along a ray. The engine has its own (engine/interpret.c):
 * it need not look at the whole field where `exact` is false, and it lets rays wait for others. */

#include "field_map.glsl"

float field_bound(vec3 p, float distance, bool exact)
{
    return map(p);
}

/* Whether the ray got no answer, and has to ask again. */
bool field_waits(float d)
{
    return false;
}
