/* SPDX-License-Identifier: MIT */
/* Last pass: what is known of each pixel becomes an output. OUTPUT is one of OUT_.... */

#include "gbuffer_load.glsl"
#include "outputs.glsl"
#include "pixel.glsl"
#include "visibility_load.glsl"
#include "visibility_mean.glsl"

layout(location = ARGS_LOCATION) uniform ResolveArgs args;
layout(binding = UNIT_STEPS) uniform sampler2D steps;
#if OUTPUT == OUT_ID_RAW
layout(location = 0) out uvec4 out_pixel;
#else
layout(location = 0) out vec4 out_pixel;
#endif

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy) + args.margin;
    ivec2 pixel = dispatch.origin + here;
#if OUTPUT == OUT_COLOR
    out_pixel = pixel_color(pixel_light(here, args.blend_edges == 1), pixel);
#elif OUTPUT == OUT_LINEAR
    out_pixel = pixel_light(here, args.blend_edges == 1);
#elif OUTPUT == OUT_ID_RAW
    out_pixel = uvec4(surface_load(here).id);
#else
    vec4 g = texelFetch(geometry, here, 0);
    Ray ray = camera_sample(pixel, 0);
    Met m;
    m.hit = g.w < INFINITY;
    m.normal = g.xyz;
    m.distance = g.w;
    m.place = ray.origin + ray.direction * g.w;
    m.steps = texelFetch(steps, here, 0).x;
    m.surface = surface_load(here);
    m.lights = visibility_mean(here);
    m.open = openness(here);
    out_pixel = output_of(OUTPUT, m);
#endif
}
