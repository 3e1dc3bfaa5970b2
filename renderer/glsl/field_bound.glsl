/* SPDX-License-Identifier: MIT */
/* How far from p nothing is, `distance` along a ray. Where `exact` is false, it need not look at
 * the whole field: interpreters do not. The engine has its own (engine/interpret.c), and lets rays
 * wait for others. */

#include "field_map.glsl"

float field_bound(vec3 p, float distance, bool exact)
{
#ifdef FIELD_TAPES
    return tapes_bound(p, exact);
#else
    return map(p);
#endif
}

/* Whether the ray got no answer, and has to ask again. */
bool field_waits(float d)
{
    return false;
}
