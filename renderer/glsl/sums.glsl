/* SPDX-License-Identifier: MIT */
/* The mean of a pixel's samples in linear light. A screen shows as white what is brighter, so the
 * plain mean of a lamp and the dark beside it is white from one sample of the lamp on, and its edge
 * has steps. Hence a sample brighter than white counts by as much less as it is brighter (Karis:
 * High quality temporal supersampling, SIGGRAPH 2014 course; his weight darkens all means, this one
 * leaves those of what a screen can show). */

#include "tone.glsl"

float sample_weight(vec3 light)
{
    return 1.0 / max(frame.exposure * max(light.r, max(light.g, light.b)), 1.0);
}

/* What a sample adds to its pixel: light by its weight, coverage; one, and the weight of what it
 * tells of the pixel's colour. */
void sample_sums(vec4 total, out vec4 light, out vec2 counts)
{
    float weight = sample_weight(total.rgb);
    bool transparent = (frame.effects & EFFECT_TRANSPARENT) != 0;
    light = vec4(weight * total.rgb, total.w);
    counts = vec2(1.0, transparent ? weight * total.w : weight);
}

/* Light, times coverage, and coverage, of a sum of these. */
vec4 sums_mean(vec4 light, vec2 counts)
{
    float coverage = light.a / max(counts.x, 1e-20);
    vec3 color = light.rgb / max(counts.y, 1e-20);
    return (frame.effects & EFFECT_TRANSPARENT) != 0 ? vec4(color * coverage, coverage)
                                                     : vec4(color, 1.0);
}
