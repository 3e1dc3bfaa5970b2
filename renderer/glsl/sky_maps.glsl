/* SPDX-License-Identifier: MIT */
/* The maps of the environment, by longitude and latitude: the middle looks along -Z, +X is right of
 * it, the first row is straight up. In those that environment.glsl makes, first and last row are
 * the poles themselves, so that nothing is pinched there. */

#include "constants.glsl"
#include "interface.glsl"

/* What is around the scene; what surfaces reflect of it, mip level i for the roughness
 * (i + 1) / SPECULAR_LEVELS; and its irradiance / pi. */
layout(binding = UNIT_ENVIRONMENT_MAP) uniform sampler2D environment_map;
layout(binding = UNIT_SPECULAR_MAP) uniform sampler2D specular_map;
layout(binding = UNIT_IRRADIANCE_MAP) uniform sampler2D irradiance_map;

/* Longitude and latitude, 0 to 1. */
vec2 map_coordinates(vec3 d)
{
    float side = abs(d.x) + abs(d.z) > 0.0 ? atan(d.x, -d.z) : 0.0;
    return vec2(0.5 + side / (2.0 * PI), acos(clamp(d.y, -1.0, 1.0)) / PI);
}

/* One mip level of a picture with a row at each pole. Its size is not asked of the driver: llvmpipe
 * would answer all lanes for the level of the first. */
vec3 sample_map(sampler2D made, vec3 d, float level)
{
    vec2 place = map_coordinates(d);
    float rows = float(max(textureSize(made, 0).y >> int(level), 1));
    return textureLod(made, vec2(place.x, (place.y * (rows - 1.0) + 0.5) / rows), level).rgb;
}

/* What is around the scene, over about the angle `blur`. */
vec3 sample_environment_map(vec3 d, float blur)
{
    float texel = PI / float(textureSize(environment_map, 0).y);
    return textureLod(environment_map, map_coordinates(d), log2(max(abs(blur) / texel, 1.0))).rgb;
}

vec3 sample_specular_map(vec3 d, float level)
{
    return sample_map(specular_map, d, level);
}

vec3 sample_irradiance_map(vec3 n)
{
    return sample_map(irradiance_map, n, 0.0);
}
