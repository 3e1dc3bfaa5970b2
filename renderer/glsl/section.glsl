/* SPDX-License-Identifier: MIT */
/* A plane that cuts the whole field. What casts shadows is cut as what is seen. */

#include "frame.glsl"

/* The distance at p, where it is d without the cut. No bound on it becomes too great. */
float section_cut(float d, vec3 p)
{
    float beyond = dot(frame.section_normal, p) - frame.section_offset;
    return (frame.effects & EFFECT_SECTION) != 0 ? max(d, beyond) : d;
}
