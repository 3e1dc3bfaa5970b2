/* SPDX-License-Identifier: MIT */
/* Where shadow.glsl leaves its answers in a pass of its own: a layer for each light, and the part
 * of the environment's light in w of the first. */

#include "interface.glsl"

layout(rgba16f, binding = IMAGE_VISIBILITY) writeonly uniform image2DArray out_visibility;
ivec2 store_here = ivec2(0);

void store_ambient_visibility(float ambient_visibility)
{
    imageStore(out_visibility, ivec3(store_here, 0), vec4(0.0, 0.0, 0.0, ambient_visibility));
}

void store_visibility(int light, float visibility, float ambient_visibility)
{
    imageStore(out_visibility, ivec3(store_here, light),
               vec4(vec3(visibility), ambient_visibility));
}
