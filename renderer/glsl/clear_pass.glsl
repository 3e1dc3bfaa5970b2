/* SPDX-License-Identifier: MIT */
/* A step of the beams to one light. They have textures of their own: what is read is of the
 * sample's own ray in CLEAR_AIM, then of the beam. */

#include "clear.glsl"
#include "gbuffer_load.glsl"
#include "group.glsl"
#include "list.glsl"
#include "ray_load.glsl"

layout(location = ARGS_LOCATION) uniform ClearArgs args;
layout(rgba32f, binding = IMAGE_RAY_FROM) uniform image2D out_ray_from;
layout(rgba32f, binding = IMAGE_RAY_ALONG) uniform image2D out_ray_along;
layout(rgba32f, binding = IMAGE_WEIGHT) uniform image2D weights; /* w: way to the light */
layout(rgba16f, binding = IMAGE_MEDIUM) uniform image2D media;
layout(rgba16f, binding = IMAGE_SEEN) uniform image2DArray seen;

void send(ivec2 here, Beam beam)
{
    imageStore(out_ray_from, here, ray_from(beam.ray));
    imageStore(out_ray_along, here, ray_along(beam.ray));
    imageStore(weights, here, vec4(beam.weight, beam.left));
    imageStore(media, here, vec4(beam.medium, 0.0));
    list_add(here);
}

void main()
{
    ivec2 here = group_place();
    if (here.x < 0) {
        return;
    }
    Ray ray = ray_load(here);
    Surface s = surface_load(here);
    vec4 g = texelFetch(geometry, here, 0);
    vec4 arrives = imageLoad(seen, ivec3(here, args.light));
    vec4 weight = imageLoad(weights, here);
    Beam beam = Beam(ray, weight.rgb, weight.w, imageLoad(media, here).rgb);
    bool aims = args.phase == CLEAR_AIM;
    bool goes = aims ? beam_begin(frame.lights[args.light], ray, g, s.painted, arrives.rgb, beam)
                     : beam_pass(beam, g, s);
    if (goes && args.phase != CLEAR_END) {
        send(here, beam);
    } else if (!aims) {
        imageStore(seen, ivec3(here, args.light), vec4(arrives.rgb * beam.weight, arrives.a));
    }
}
