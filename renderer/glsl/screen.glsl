/* SPDX-License-Identifier: MIT */
/* Light and coverage as the colour of a pixel on a screen. */

#include "camera.glsl"
#include "tone.glsl"

vec3 color_of(vec4 c, float coverage)
{
    return srgb(shown(coverage > 0.0 ? c.rgb / coverage : vec3(0.0)));
}

/* The same as a screen shows it, with noise below its steps. */
vec4 pixel_color(vec4 light, ivec2 pixel)
{
    float dither = (pixel_noise(pixel) - 0.5) * 0.98 / 255.0;
    return vec4(color_of(light, light.a) + dither, light.a);
}
