/* SPDX-License-Identifier: MIT */
/* Where volume.glsl dims the light on surfaces in a pass of its own: after shadow_store.glsl. */

layout(rgba16f, binding = 5) uniform image2DArray lit;
ivec2 lit_here = ivec2(0);

#define DIMMED(i, part) \
    imageStore(lit, ivec3(lit_here, i), \
               imageLoad(lit, ivec3(lit_here, i)) * vec4(vec3(part), 1.0))
