/* SPDX-License-Identifier: MIT */
/* What the first sample of a pixel met, as sample_pass.glsl left it. */

#include "camera.glsl"
#include "outputs.glsl"

layout(binding = UNIT_NORMAL) uniform sampler2D normals;
layout(binding = UNIT_DIFFUSE) uniform sampler2D diffuses;
layout(binding = UNIT_SPECULAR) uniform sampler2D speculars;
layout(binding = UNIT_OPTICAL) uniform sampler2D opticals;
layout(binding = UNIT_LIGHTS) uniform sampler2D lights;

uint met_id(ivec2 here)
{
    return uint(texelFetch(speculars, here, 0).w);
}

Met met_load(ivec2 here)
{
    vec4 g = texelFetch(normals, here, 0), diffuse = texelFetch(diffuses, here, 0);
    vec4 light = texelFetch(lights, here, 0), optical = texelFetch(opticals, here, 0);
    Ray ray = camera_sample(dispatch.origin + here, 0);
    Surface s;
    s.diffuse = diffuse.rgb;
    s.specular = texelFetch(speculars, here, 0).rgb;
    s.reflectivity = optical.x;
    s.ior = optical.y;
    s.transmission = optical.z;
    s.model = MODEL_STANDARD; /* whose gloss is its roughness */
    s.gloss = optical.w;
    s.id = met_id(here);
    return Met(g.w < INFINITY, g.xyz, g.w, ray.origin + ray.direction * g.w, diffuse.w, s,
               light.rgb, light.a);
}
