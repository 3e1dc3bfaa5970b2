/* SPDX-License-Identifier: MIT */
/* Compute: the environment without a picture, as a picture. */

#include "environment_place.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f, binding = IMAGE_ENVIRONMENT) writeonly uniform image2D out_picture;

void main()
{
    ivec2 here = ivec2(gl_GlobalInvocationID.xy);
    vec2 place = (vec2(here) + 0.5) / vec2(imageSize(out_picture));
    imageStore(out_picture, here, vec4(min(sky_plain(place_direction(place), 0.0), HALF_MAX), 1.0));
}
