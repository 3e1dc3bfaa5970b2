/* SPDX-License-Identifier: MIT */
/* The maps of the environment, by longitude and latitude: the middle looks along -Z, +X is right of
 * it, the first row is straight up. In those that environment.glsl makes, first and last row are
 * the poles themselves, so that nothing is pinched there. */

#include "constants.glsl"
#include "interface.glsl"

/* What is around the scene; what mirrors show of it, mip level i for the roughness
 * (i + 1) / MIRROR_LEVELS; and its irradiance / pi. */
layout(binding = UNIT_PANORAMA) uniform sampler2D sky_picture;
layout(binding = UNIT_MIRRORED) uniform sampler2D sky_mirror;
layout(binding = UNIT_IRRADIANCE) uniform sampler2D sky_matt;

/* Longitude and latitude, 0 to 1. */
vec2 sky_place(vec3 d)
{
    float side = abs(d.x) + abs(d.z) > 0.0 ? atan(d.x, -d.z) : 0.0;
    return vec2(0.5 + side / (2.0 * PI), acos(clamp(d.y, -1.0, 1.0)) / PI);
}

/* One mip level of a picture with a row at each pole. Its size is not asked of the driver: llvmpipe
 * would answer all lanes for the level of the first. */
vec3 sky_made(sampler2D made, vec3 d, float level)
{
    vec2 place = sky_place(d);
    float rows = float(max(textureSize(made, 0).y >> int(level), 1));
    return textureLod(made, vec2(place.x, (place.y * (rows - 1.0) + 0.5) / rows), level).rgb;
}

/* What is around the scene, over about the angle `blur`. */
vec3 sky_pictured(vec3 d, float blur)
{
    float texel = PI / float(textureSize(sky_picture, 0).y);
    return textureLod(sky_picture, sky_place(d), log2(max(abs(blur) / texel, 1.0))).rgb;
}

vec3 sky_mirror_map(vec3 d, float level)
{
    return sky_made(sky_mirror, d, level);
}

vec3 sky_matt_map(vec3 n)
{
    return sky_made(sky_matt, n, 0.0);
}
