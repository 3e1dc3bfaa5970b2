/* SPDX-License-Identifier: MIT */
/* What the pictures of an environment are made of, texel by texel: the sky where there is no
 * picture, what surfaces reflect of it, and what falls on diffuse ones. */

#include "radical_inverse.glsl"
#include "sky.glsl"

/* `place`: longitude and latitude, 0 to 1: the other way round than map_coordinates(). */
vec3 map_direction(vec2 place)
{
    float longitude = (place.x - 0.5) * 2.0 * PI, latitude = place.y * PI;
    float s = sin(latitude);
    return vec3(s * sin(longitude), cos(latitude), -s * cos(longitude));
}

/* Of a texel in a picture with a row at each pole. */
vec3 texel_direction(ivec2 here, ivec2 size)
{
    return map_direction(
        vec2((float(here.x) + 0.5) / float(size.x), float(here.y) / float(size.y - 1)));
}

/* The environment without a picture. */
vec3 environment_sky(ivec2 here, ivec2 size)
{
    vec2 place = (vec2(here) + 0.5) / vec2(size);
    return min(sky_plain(map_direction(place), 0.0), HALF_MAX);
}

/* A frame around n; the rotation is any. */
mat3 frame_around(vec3 n)
{
    vec3 side = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
    return mat3(side, cross(n, side), n);
}

/* What a surface of one roughness reflects, for each direction that it looks along: the mean of the
 * environment over the lobe of GGX, seen head-on (Karis: Real shading in Unreal Engine 4, SIGGRAPH
 * 2013). Each sample stands for a cone of its own width, which a mip level of the picture holds
 * (Krivanek and Colbert: Real-time shading with filtered importance sampling, EGSR 2008). */
vec3 environment_prefilter(ivec2 here, ivec2 size, int number)
{
    mat3 around = frame_around(texel_direction(here, size));
    float roughness = float(number + 1) / float(SPECULAR_LEVELS), a2 = pow(roughness, 4.0);
    vec2 texels = vec2(textureSize(environment_map, 0));
    float texel = 4.0 * PI / (texels.x * texels.y); /* mean solid angle */
    int samples = 32 << number; /* narrow lobes need fewer */
    vec3 sum = vec3(0.0);
    float weights = 0.0;

    for (int i = zero; i < samples; i++) {
        float angle = 2.0 * PI * radical_inverse(i), x = (float(i) + 0.5) / float(samples);
        float c2 = (1.0 - x) / (1.0 + (a2 - 1.0) * x); /* of the halfway vector */
        vec3 h = vec3(sqrt(1.0 - c2) * vec2(cos(angle), sin(angle)), sqrt(c2));
        vec3 towards = vec3(2.0 * h.z * h.xy, 2.0 * c2 - 1.0);
        float peak = c2 * (a2 - 1.0) + 1.0, density = a2 / (PI * peak * peak) / 4.0;
        float level = 0.5 * log2(1.0 / (float(samples) * density * texel));
        float weight = max(towards.z, 0.0);
        vec2 place = map_coordinates(around * towards);
        sum += weight * textureLod(environment_map, place, max(level, 0.0)).rgb;
        weights += weight;
    }
    return sum / weights;
}

#define COLUMNS 64
#define ROWS 32

/* What falls on a diffuse surface, for each of its normals: the mean of the environment, weighted
 * by the cosine. Weights are those of the sum, so that an environment of 1 gives 1. */
vec3 environment_irradiance(ivec2 here, ivec2 size)
{
    vec3 n = texel_direction(here, size), sum = vec3(0.0);
    float level = max(log2(float(textureSize(environment_map, 0).x) / float(COLUMNS)), 0.0);
    float weights = 0.0;

    for (int row = zero; row < ROWS; row++) {
        float v = (float(row) + 0.5) / float(ROWS);
        float area = sin(v * PI); /* of a texel, but for a factor */
        for (int column = zero; column < COLUMNS; column++) {
            vec2 place = vec2((float(column) + 0.5) / float(COLUMNS), v);
            float weight = area * max(dot(n, map_direction(place)), 0.0);
            sum += weight * textureLod(environment_map, place, level).rgb;
            weights += weight;
        }
    }
    return sum / weights;
}
