/* SPDX-License-Identifier: MIT */
/* The field at p, `distance` along a ray. Where surfaces are farther than `enough`, a lower bound
 * that is at least so much will do: interpreters need not look at the whole field for it. FAR asks
 * for the field itself. The engine has its own (engine/interpret.c), and lets rays wait for others.
 */

#include "field_map.glsl"

float field_bound(vec3 p, float distance, float enough)
{
#ifdef FIELD_TAPES
    return tapes_bound(p, enough);
#else
    return map(p);
#endif
}

/* Whether the ray got no answer, and has to ask again. */
bool field_waits(float d)
{
    return false;
}
