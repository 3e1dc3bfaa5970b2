/* SPDX-License-Identifier: MIT */
/* What the march and material passes left of a sample. */

#include "gbuffer.glsl"
#include "geometry_load.glsl"

layout(binding = UNIT_MATERIAL0) uniform usampler2D material0;
layout(binding = UNIT_MATERIAL1) uniform usampler2D material1;
layout(binding = UNIT_STEPS) uniform sampler2D steps;

Surface surface_load(ivec2 here)
{
    return surface_unpack(texelFetch(material0, here, 0), texelFetch(material1, here, 0));
}

/* Steps and source of the hit, and its curvature. */
vec2 steps_load(ivec2 here)
{
    return texelFetch(steps, here, 0).xy;
}
