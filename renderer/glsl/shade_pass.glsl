/* SPDX-License-Identifier: MIT */
/* Adds the light of each sample's ray to the sample, and sends on the rays that it asks for. */

#include "gbuffer_load.glsl"
#include "group.glsl"
#include "ray_load.glsl"
#include "secondary_rays.glsl"
#include "stack.glsl"
#include "visibility_load.glsl"

layout(location = ARGS_LOCATION) uniform ShadeArgs args;
layout(binding = UNIT_INSCATTERING) uniform sampler2D inscattered;
layout(rgba32f, binding = IMAGE_TOTAL) uniform image2D totals; /* light; w: coverage */

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    bool first = args.first == 1;
    Surface s = surface_load(here);
    float ambient_visibility = ambient_visibility_of(here), curvature = steps_load(here).y;
    vec4 smoke = args.volumes == 1 ? texelFetch(inscattered, here, 0) : vec4(0.0, 0.0, 0.0, 1.0);
    vec4 throughput = first ? vec4(1.0, 1.0, 1.0, 0.0) : imageLoad(throughputs, here);
    vec3 absorption = first ? vec3(0.0) : imageLoad(absorptions, here).rgb;
    vec4 total = first ? vec4(0.0) : imageLoad(totals, here);

    shade_ray(here, ray_load(here), texelFetch(geometry, here, 0), curvature, s, ambient_visibility,
              smoke, first, args.last == 1, throughput, absorption, total);
    imageStore(totals, here, total);
}
