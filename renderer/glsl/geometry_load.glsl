/* SPDX-License-Identifier: MIT */
/* Where samples met something: gbuffer.glsl. */

#include "constants.glsl"
#include "interface.glsl"

layout(binding = UNIT_GEOMETRY) uniform sampler2D geometry;
