/* SPDX-License-Identifier: MIT */
/* What the makers of environments have in common: directions of pictures by longitude and latitude,
 * the other way round than sky_place(). */

#include "sky.glsl"

layout(location = ARGS_LOCATION) uniform EnvironmentArgs args;

/* `place`: longitude and latitude, 0 to 1. */
vec3 place_direction(vec2 place)
{
    float longitude = (place.x - 0.5) * 2.0 * PI, latitude = place.y * PI;
    float s = sin(latitude);
    return vec3(s * sin(longitude), cos(latitude), -s * cos(longitude));
}

/* Of a texel in a picture with a row at each pole. */
vec3 made_direction(ivec2 here, ivec2 size)
{
    return place_direction(vec2((float(here.x) + 0.5) / float(size.x),
                                float(here.y) / float(size.y - 1)));
}
