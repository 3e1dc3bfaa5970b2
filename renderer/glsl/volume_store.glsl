/* SPDX-License-Identifier: MIT */
/* Where volume.glsl dims the light on surfaces in a pass of its own: after shadow_store.glsl. */

#include "interface.glsl"

layout(rgba16f, binding = IMAGE_VISIBILITY) uniform image2DArray lit;
ivec2 lit_here = ivec2(0);

void dim_visibility(int light, float part)
{
    ivec3 at = ivec3(lit_here, light);
    imageStore(lit, at, imageLoad(lit, at) * vec4(vec3(part), 1.0));
}
