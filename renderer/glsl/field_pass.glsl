/* SPDX-License-Identifier: MIT */
/* What all passes with a field in them have: a sample's place, its ray, and what they are told. */

#include "group.glsl"
#include "ray_load.glsl"

layout(location = ARGS_LOCATION) uniform SampleArgs args;
