/* SPDX-License-Identifier: MIT */
/* Everything in one fragment shader, from the camera on: the other way to the picture, to compare
 * the passes with. Without smoke, and without colours of light through clear things. */

#include "camera.glsl"
#include "field_surface.glsl"
#include "forward_store.glsl"
#include "march.glsl"
#include "paths.glsl"
#include "shadow.glsl"

layout(location = ARGS_LOCATION) uniform ForwardArgs args;
layout(rgba32f, binding = IMAGE_TOTAL) writeonly uniform image2D totals;

void main()
{
    preload();
    ivec2 here = ivec2(gl_FragCoord.xy);
    Ray ray = camera_sample(dispatch.origin + here, args.sample_index);
    vec4 weight = vec4(1.0, 1.0, 1.0, 0.0), total = vec4(0.0);
    vec3 medium = vec3(0.0);

    has_next = true;
    for (int i = zero; i <= args.rays && has_next; i++) {
        Hit found = march(ray, 0.0, 0.0, frame.max_steps);
        float t = found.hit ? found.t : 0.0;
        vec3 p = ray.origin + ray.direction * t;
        Surface s;
        through = found.solid ? FAR : ray.inside ? -FAR : 0.0;
        surface(p, Shading(p, vec3(0.0), found.normal, ray.direction, t), s);
        look(p, found.normal, footprint(ray, t), found.hit);
        has_next = false;
        vec4 g = vec4(found.normal, found.solid ? -max(found.t, 1e-30) : found.t);
        add_light(here, ray, g, found.curvature, s, seen_open, vec4(0.0, 0.0, 0.0, 1.0), i == 0,
                  i == args.rays, weight, medium, total);
        ray = ray_of(next_ray.from, next_ray.along);
        weight = next_ray.weight;
        medium = next_ray.medium.rgb;
    }
    imageStore(totals, here, total);
}
