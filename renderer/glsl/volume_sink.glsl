/* SPDX-License-Identifier: MIT */
/* Where volume.glsl dims the light on surfaces in a pass of its own: after shadow_sink.glsl. */

#include "interface.glsl"

layout(rgba16f, binding = IMAGE_VISIBILITY) uniform image2DArray visibility;
ivec2 sink_here = ivec2(0);

void dim_visibility(int light, float part)
{
    ivec3 at = ivec3(sink_here, light);
    imageStore(visibility, at, imageLoad(visibility, at) * vec4(vec3(part), 1.0));
}
