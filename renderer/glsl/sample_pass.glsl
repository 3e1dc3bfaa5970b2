/* SPDX-License-Identifier: MIT */
/* One more sample of each pixel, by one fragment shader. What it writes is added to what is there:
 * what the first sample met is told by that one alone. */

#include "sample.glsl"
#include "sums.glsl"

layout(location = ARGS_LOCATION) uniform TraceArgs args;
layout(binding = UNIT_STARTS) uniform sampler2D starts;
layout(binding = UNIT_MASK) uniform sampler2D mask;

layout(location = SAMPLE_PIXELS) out vec4 out_pixels;   /* light; w: coverage */
layout(location = SAMPLE_COUNTED) out vec4 out_counted; /* samples, weight, rays that followed */
layout(location = SAMPLE_GEOMETRY) out vec4 out_geometry;
layout(location = SAMPLE_NORMAL) out vec4 out_normal;     /* w: distance */
layout(location = SAMPLE_DIFFUSE) out vec4 out_diffuse;   /* w: steps */
layout(location = SAMPLE_SPECULAR) out vec4 out_specular; /* w: id */
layout(location = SAMPLE_OPTICAL) out vec4 out_optical; /* w: roughness */
layout(location = SAMPLE_LIGHTS) out vec4 out_lights; /* w: the environment's */

void add_sample(ivec2 here)
{
    ivec2 pixel = dispatch.origin + here;
    ivec2 block = (pixel >> BLOCK_BITS) - (dispatch.origin >> BLOCK_BITS);
    vec4 total, g;
    Met met;
    int rays = trace(pixel, texelFetch(starts, block, 0).x, args.sample_index, args.rays,
                     args.depth, args.shadows == 1, args.lights == 1, total, g, met);
    Surface s = met.surface;

    vec2 counts;
    sample_sums(total, out_pixels, counts);
    out_counted = vec4(counts, float(rays), 0.0);
    out_geometry = out_normal = out_diffuse = out_specular = out_optical = out_lights = vec4(0.0);
    if (args.sample_index == 0) {
        out_geometry = g;
        out_normal = vec4(met.normal, met.distance);
        out_diffuse = vec4(s.diffuse, met.steps);
        out_specular = vec4(s.specular, float(s.id));
        out_optical = vec4(s.reflectivity, s.ior, s.transmission, optical_of(s).w);
        out_lights = vec4(met.lights, met.ambient_visibility);
    }
}

void main()
{
    preload();
    ivec2 here = ivec2(gl_FragCoord.xy);
    if (args.masked == 1 && texelFetch(mask, here, 0).x == 0.0) {
        discard;
    } else {
        add_sample(here);
    }
}
