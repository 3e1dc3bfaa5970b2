/* SPDX-License-Identifier: MIT */
/* Where shadow.glsl leaves its answers in a pass of its own: a layer for each light, and the part
 * of the environment's light in w of the first. */

layout(rgba16f, binding = 5) writeonly uniform image2DArray out_visibility;
ivec2 store_here = ivec2(0);

#define OPEN(value) imageStore(out_visibility, ivec3(store_here, 0), vec4(0.0, 0.0, 0.0, value))
#define SEEN(i, value) imageStore(out_visibility, ivec3(store_here, i), value)
