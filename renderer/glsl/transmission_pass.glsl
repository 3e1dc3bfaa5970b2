/* SPDX-License-Identifier: MIT */
/* A step of the beams to one light. They have textures of their own: what is read is of the
 * sample's own ray in TRANSMISSION_AIM, then of the beam. */

#include "gbuffer_load.glsl"
#include "group.glsl"
#include "list.glsl"
#include "ray_load.glsl"
#include "transmission.glsl"

layout(location = ARGS_LOCATION) uniform TransmissionArgs args;
layout(rgba32f, binding = IMAGE_RAY_ORIGIN) uniform image2D out_ray_origin;
layout(rgba32f, binding = IMAGE_RAY_DIRECTION) uniform image2D out_ray_direction;
layout(rgba32f, binding = IMAGE_THROUGHPUT) uniform image2D throughputs; /* w: distance left */
layout(rgba16f, binding = IMAGE_ABSORPTION) uniform image2D absorptions;
layout(rgba16f, binding = IMAGE_STATIC_VISIBILITY) uniform image2DArray visibility;

void send(ivec2 here, Beam beam)
{
    imageStore(out_ray_origin, here, pack_ray_origin(beam.ray));
    imageStore(out_ray_direction, here, pack_ray_direction(beam.ray));
    imageStore(throughputs, here, vec4(beam.transmittance, beam.distance));
    imageStore(absorptions, here, vec4(beam.absorption, 0.0));
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
    vec4 arrives = imageLoad(visibility, ivec3(here, args.light));
    vec4 transmittance = imageLoad(throughputs, here);
    Beam beam = Beam(ray, transmittance.rgb, transmittance.w, imageLoad(absorptions, here).rgb);
    bool aims = args.phase == TRANSMISSION_AIM;
    bool goes = aims ? beam_begin(frame.lights[args.light], ray, g, s.opaque_cut, arrives.rgb, beam)
                     : beam_pass(beam, g, s);
    if (goes && args.phase != TRANSMISSION_END) {
        send(here, beam);
    } else if (!aims) {
        imageStore(visibility, ivec3(here, args.light),
                   vec4(arrives.rgb * beam.transmittance, arrives.a));
    }
}
