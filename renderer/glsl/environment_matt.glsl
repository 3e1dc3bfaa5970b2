/* SPDX-License-Identifier: MIT */
/* Compute: what falls on a matt surface, for each of its normals: the mean of the environment,
 * weighted by the cosine. Weights are those of the sum, so that an environment of 1 gives 1. */

#include "environment_place.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f, binding = IMAGE_ENVIRONMENT) writeonly uniform image2D out_matt;

#define COLUMNS 64
#define ROWS 32

void main()
{
    ivec2 here = ivec2(gl_GlobalInvocationID.xy), size = imageSize(out_matt);
    vec3 n = made_direction(here, size), sum = vec3(0.0);
    float level = max(log2(float(textureSize(sky_picture, 0).x) / float(COLUMNS)), 0.0);
    float weights = 0.0;

    for (int row = zero; row < ROWS; row++) {
        float v = (float(row) + 0.5) / float(ROWS);
        float area = sin(v * PI); /* of a texel, but for a factor */
        for (int column = zero; column < COLUMNS; column++) {
            vec2 place = vec2((float(column) + 0.5) / float(COLUMNS), v);
            float weight = area * max(dot(n, place_direction(place)), 0.0);
            sum += weight * textureLod(sky_picture, place, level).rgb;
            weights += weight;
        }
    }
    imageStore(out_matt, here, vec4(sum / weights, 1.0));
}
