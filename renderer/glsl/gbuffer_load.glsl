/* SPDX-License-Identifier: MIT */
/* What the march and matter passes left of a sample. */

#include "gbuffer.glsl"
#include "geometry_load.glsl"

layout(binding = UNIT_MATTER) uniform usampler2D matter;
layout(binding = UNIT_MORE) uniform usampler2D more;

Surface surface_load(ivec2 here)
{
    return surface_unpack(texelFetch(matter, here, 0), texelFetch(more, here, 0));
}
