/* SPDX-License-Identifier: MIT */
/* What shadow_pass.glsl left of a sample. */

#include "interface.glsl"

layout(binding = UNIT_VISIBILITY) uniform sampler2DArray visibility;

/* Part of a light's colour that arrives. */
vec3 visibility_of(ivec2 here, int light)
{
    return texelFetch(visibility, ivec3(here, light), 0).rgb;
}

/* Part of the environment's light that arrives. */
float ambient_visibility_of(ivec2 here)
{
    return texelFetch(visibility, ivec3(here, 0), 0).a;
}
