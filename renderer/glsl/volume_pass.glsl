/* SPDX-License-Identifier: MIT */
/* What volumes add to each sample's ray, and how they dim the light at its end. */

#include "camera.glsl"
#include "field_pass.glsl"
#include "gbuffer_load.glsl"
#include "volume.glsl"
#include "volume_sink.glsl"

layout(rgba16f, binding = IMAGE_INSCATTERING) writeonly uniform image2D out_inscattering;

void main()
{
    preload();
    ivec2 here = group_place();
    bool some = here.x >= 0;
    sink_here = here;
    Ray ray = ray_load(here);
    float t = some ? abs(texelFetch(geometry, here, 0).w) : 0.0;
    /* Where slabs begin differs from pixel to pixel, and so none is seen. */
    float part = fract(pixel_noise(dispatch.origin + here) + 0.61803399 * float(args.sample_index));
    vec4 found = inscattering(ray, t, part);
    if (some) {
        imageStore(out_inscattering, here, vec4(min(found.rgb, 60000.0), found.a));
    }
}
