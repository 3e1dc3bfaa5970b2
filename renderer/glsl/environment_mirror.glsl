/* SPDX-License-Identifier: MIT */
/* Compute: what a surface of one roughness mirrors, for each direction that it looks along: the
 * mean of the environment over the lobe of GGX, seen head-on (Karis: Real shading in Unreal Engine
 * 4, SIGGRAPH 2013). Each sample stands for a cone of its own width, which a mip level of the
 * picture holds (Krivanek and Colbert: Real-time shading with filtered importance sampling, EGSR
 * 2008). */

#include "environment_place.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba16f, binding = IMAGE_ENVIRONMENT) writeonly uniform image2D out_mirror;

/* The bits of i, mirrored behind the point: van der Corput's sequence. */
float radical_inverse(int i)
{
    return float(bitfieldReverse(uint(i))) * 2.3283064365386963e-10;
}

/* A frame around n; the rotation is any. */
mat3 frame_around(vec3 n)
{
    vec3 side = normalize(cross(abs(n.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), n));
    return mat3(side, cross(n, side), n);
}

void main()
{
    ivec2 here = ivec2(gl_GlobalInvocationID.xy), size = imageSize(out_mirror);
    mat3 around = frame_around(made_direction(here, size));
    float roughness = float(args.level + 1) / float(MIRROR_LEVELS), a2 = pow(roughness, 4.0);
    vec2 texels = vec2(textureSize(sky_picture, 0));
    float texel = 4.0 * PI / (texels.x * texels.y); /* mean solid angle */
    int samples = 32 << args.level; /* narrow lobes need fewer */
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
        vec2 place = sky_place(around * towards);
        sum += weight * textureLod(sky_picture, place, max(level, 0.0)).rgb;
        weights += weight;
    }
    imageStore(out_mirror, here, vec4(sum / weights, 1.0));
}
