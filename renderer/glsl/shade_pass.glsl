/* SPDX-License-Identifier: MIT */
/* Adds the light of each sample's ray to the sample, and sends on the rays that it asks for.
 * turn.w: 1 for first rays; turn.y: 1 for the last ones, which start no others; turn.z: 1 where
 * there is haze. */

layout(binding = 0) uniform sampler2D geometry;
layout(binding = 1) uniform usampler2D matter;
layout(binding = 2) uniform usampler2D more;
layout(binding = 11) uniform sampler2D haze_seen;
layout(rgba32f, binding = 4) uniform image2D totals; /* light; w: coverage */

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    bool first = turn.w == 1;
    Surface s = surface_unpack(texelFetch(matter, here, 0), texelFetch(more, here, 0));
    float open = texelFetch(visibility, ivec3(here, 0), 0).a;
    vec4 smoke = turn.z == 1 ? texelFetch(haze_seen, here, 0) : vec4(0.0, 0.0, 0.0, 1.0);
    vec4 weight = first ? vec4(1.0, 1.0, 1.0, 0.0) : imageLoad(weights, here);
    vec3 medium = first ? vec3(0.0) : imageLoad(media, here).rgb;
    vec4 total = first ? vec4(0.0) : imageLoad(totals, here);

    add_light(here, ray_load(here), texelFetch(geometry, here, 0), s, open, smoke, first,
              turn.y == 1, weight, medium, total);
    imageStore(totals, here, total);
}
