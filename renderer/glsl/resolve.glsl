/* SPDX-License-Identifier: MIT */
/* Last pass: what is known of each pixel becomes an output. OUTPUT is one of OUT_...;
 * met_load.glsl is met_passes.glsl or met_sample.glsl. */

#include "met_load.glsl"
#include "outputs.glsl"
#include "pixel.glsl"

layout(location = ARGS_LOCATION) uniform ResolveArgs args;
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
    out_pixel = uvec4(met_id(here));
#else
    out_pixel = output_of(OUTPUT, met_load(here));
#endif
}
