/* SPDX-License-Identifier: MIT */
/* Adds the light of each sample's ray to the sample, and sends on the rays that it asks for. */

#include "gbuffer_load.glsl"
#include "group.glsl"
#include "paths.glsl"
#include "ray_load.glsl"
#include "stack.glsl"
#include "visibility_load.glsl"

layout(location = ARGS_LOCATION) uniform ShadeArgs args;
layout(binding = UNIT_HAZE) uniform sampler2D haze_seen;
layout(binding = UNIT_STEPS) uniform sampler2D steps; /* y: curvature */
layout(rgba32f, binding = IMAGE_TOTAL) uniform image2D totals; /* light; w: coverage */

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    bool first = args.first == 1;
    Surface s = surface_load(here);
    float open = openness(here), curve = texelFetch(steps, here, 0).y;
    vec4 smoke = args.haze == 1 ? texelFetch(haze_seen, here, 0) : vec4(0.0, 0.0, 0.0, 1.0);
    vec4 weight = first ? vec4(1.0, 1.0, 1.0, 0.0) : imageLoad(weights, here);
    vec3 medium = first ? vec3(0.0) : imageLoad(media, here).rgb;
    vec4 total = first ? vec4(0.0) : imageLoad(totals, here);

    add_light(here, ray_load(here), texelFetch(geometry, here, 0), curve, s, open, smoke, first,
              args.last == 1, weight, medium, total);
    imageStore(totals, here, total);
}
