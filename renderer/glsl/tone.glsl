/* SPDX-License-Identifier: MIT */
/* Light as a screen can show it. */

#include "frame.glsl"

/* Hill's fit of the ACES reference and output transforms, as matrices and a rational curve (Hill,
 * in the BakingLab of Pettineo and Neubelt, 2016). */
vec3 aces(vec3 c)
{
    const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383,
                           0.04823, 0.01566, 0.83777);
    const mat3 back = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276,
                           -0.07367, -0.00605, 1.07602);
    vec3 v = into * c;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return back * v;
}

vec3 tone_map(vec3 c)
{
    if (frame.tone_map == TONE_NONE) {
        return clamp(c, 0.0, 1.0);
    }
    if (frame.tone_map == TONE_REINHARD) {
        return c / (1.0 + dot(c, vec3(0.2126, 0.7152, 0.0722)));
    }
    return clamp(aces(c / 0.85), 0.0, 1.0);
}

/* Linear light as a screen shows it, before its curve. */
vec3 shown(vec3 light)
{
    return tone_map(light * frame.exposure);
}

/* IEC 61966-2-1 */
vec3 srgb(vec3 c)
{
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
