/* SPDX-License-Identifier: MIT */
/* Last pass: samples become pixels. One of OUT_COLOR, OUT_LINEAR, OUT_DEPTH, OUT_NORMAL,
 * OUT_NORMAL_RAW, OUT_ID, OUT_ID_RAW is defined.
 *
 * Every sample is tone mapped before the average is taken: a bright highlight then has edges as
 * smooth as any other. The average is one of light, so it is taken before the sRGB curve. */

layout(binding = 4) uniform sampler2D radiance;
layout(binding = 0) uniform sampler2D geometry;
layout(binding = 2) uniform usampler2D more;

#define TONE_NONE 0
#define TONE_REINHARD 1

#if defined(OUT_ID_RAW)
layout(location = 0) out uvec4 out_pixel;
#else
layout(location = 0) out vec4 out_pixel;
#endif

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
    if (modes.z == TONE_NONE) {
        return clamp(c, 0.0, 1.0);
    }
    if (modes.z == TONE_REINHARD) {
        return c / (1.0 + dot(c, vec3(0.2126, 0.7152, 0.0722)));
    }
    return clamp(aces(c / 0.85), 0.0, 1.0);
}

/* IEC 61966-2-1 */
vec3 srgb(vec3 c)
{
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

/* In -0.5..0.5, from the place in the picture alone (Jimenez: Next generation post processing in
 * Call of Duty: Advanced Warfare, SIGGRAPH 2014): hides the steps of 8 bits in gradients, and
 * leaves alone what is already a whole step. */
float dither(ivec2 pixel)
{
    return fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715)))) - 0.5;
}

vec3 average(ivec2 pixel, bool display)
{
    int n = size.z;
    vec3 sum = vec3(0.0);
    for (int i = zero; i < n * n; i++) {
        vec3 c = texelFetch(radiance, pixel * n + ivec2(i % n, i / n), 0).rgb;
        sum += display ? tone_map(c * zenith.w) : c;
    }
    return sum / float(n * n);
}

/* Neighbouring ids get hues far apart: steps of the golden ratio. */
vec3 id_color(uint id)
{
    float hue = fract(float(id) * 0.61803399);
    float value = 0.65 + 0.35 * fract(float(id) * 0.38196601 + 0.5);
    vec3 c = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return id == 0u ? vec3(0.0) : value * mix(vec3(1.0), c, 0.75);
}

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy);
#if defined(OUT_COLOR)
    vec3 c = srgb(average(here, true));
    out_pixel = vec4(c + dither(tile.xy + here) * 0.98 / 255.0, 1.0);
#elif defined(OUT_LINEAR)
    out_pixel = vec4(average(here, false), 1.0);
#elif defined(OUT_DEPTH)
    out_pixel = vec4(texelFetch(geometry, here, 0).w);
#elif defined(OUT_NORMAL)
    vec4 g = texelFetch(geometry, here, 0);
    out_pixel = vec4(g.w < INFINITY ? g.xyz * 0.5 + 0.5 : vec3(0.0), 1.0);
#elif defined(OUT_NORMAL_RAW)
    out_pixel = vec4(texelFetch(geometry, here, 0).xyz, 1.0);
#elif defined(OUT_ID)
    out_pixel = vec4(id_color(texelFetch(more, here, 0).w), 1.0);
#elif defined(OUT_ID_RAW)
    out_pixel = uvec4(texelFetch(more, here, 0).w);
#endif
}
