/* SPDX-License-Identifier: MIT */
/* Last pass: what is known of each pixel becomes an output. One of OUT_... is defined. */

#include "gbuffer_load.glsl"
#include "pixel.glsl"
#include "visibility_load.glsl"

layout(location = ARGS_LOCATION) uniform ResolveArgs args;
layout(binding = UNIT_STEPS) uniform sampler2D steps;
#if defined(OUT_ID_RAW)
layout(location = 0) out uvec4 out_pixel;
#else
layout(location = 0) out vec4 out_pixel;
#endif

/* Neighbouring ids get hues far apart: steps of the golden ratio. */
vec3 id_color(uint id)
{
    float hue = fract(float(id) * 0.61803399);
    float value = 0.65 + 0.35 * fract(float(id) * 0.38196601 + 0.5);
    vec3 c = clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return id == 0u ? vec3(0.0) : value * mix(vec3(1.0), c, 0.75);
}

#ifdef OUT_STEPS
/* STEPS_WHITE and the colours are those of protocol/picture.h. */
vec3 steps_color(float steps)
{
    float place = clamp(steps / float(STEPS_WHITE), 0.0, 1.0) * float(STEPS_COLORS - 1);
    int i = min(int(place), STEPS_COLORS - 2);
    return mix(steps_colors[i], steps_colors[i + 1], place - float(i));
}
#endif

/* Part of the light that arrives, of all lights together that throw shadows. */
vec3 light_seen(ivec2 here)
{
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = zero; i < frame.light_count; i++) {
        bool counts_in = frame.lights[i].shadow != SHADOW_NONE;
        sum += counts_in ? visibility_of(here, i) : vec3(0.0);
        count += counts_in ? 1.0 : 0.0;
    }
    return count > 0.0 ? sum / count : vec3(1.0);
}

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy) + args.margin;
    ivec2 pixel = dispatch.origin + here;
    vec4 g = texelFetch(geometry, here, 0);
    bool hit = g.w < INFINITY;
    Surface s = surface_load(here);
    float rough = s.model == MODEL_STANDARD ? s.gloss : sqrt(2.0 / (s.gloss + 2.0));
    vec4 optical = vec4(s.reflectivity, s.ior, 1.0 - s.transmission, rough);
    vec4 c = pixel_light(here, args.blend_edges == 1);

    vec4 none = vec4(0.0);
#if defined(OUT_COLOR)
    out_pixel = pixel_color(c, pixel);
#elif defined(OUT_LINEAR)
    out_pixel = c;
#elif defined(OUT_DEPTH)
    out_pixel = vec4(g.w);
#elif defined(OUT_NORMAL)
    out_pixel = hit ? vec4(g.xyz * 0.5 + 0.5, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);
#elif defined(OUT_NORMAL_RAW)
    out_pixel = hit ? vec4(g.xyz, 1.0) : none;
#elif defined(OUT_POSITION)
    Ray ray = camera_sample(pixel, 0);
    out_pixel = hit ? vec4(ray.origin + ray.direction * g.w, 1.0) : none;
#elif defined(OUT_ID)
    out_pixel = vec4(id_color(s.id), 1.0);
#elif defined(OUT_ID_RAW)
    out_pixel = uvec4(s.id);
#elif defined(OUT_STEPS)
    out_pixel = vec4(steps_color(texelFetch(steps, here, 0).x), 1.0);
#elif defined(OUT_STEPS_RAW)
    out_pixel = texelFetch(steps, here, 0).xxxx;
#elif defined(OUT_ALBEDO)
    out_pixel = vec4(srgb(hit ? s.diffuse : vec3(0.0)), 1.0);
#elif defined(OUT_ALBEDO_RAW)
    out_pixel = hit ? vec4(s.diffuse, 1.0) : none;
#elif defined(OUT_SPECULAR)
    out_pixel = vec4(srgb(hit ? s.specular : vec3(0.0)), 1.0);
#elif defined(OUT_SPECULAR_RAW)
    out_pixel = hit ? vec4(s.specular, 1.0) : none;
#elif defined(OUT_OPTICAL)
    out_pixel = vec4(hit ? vec3(optical.x, (optical.y - 1.0) / 3.0, optical.z) : vec3(0.0), 1.0);
#elif defined(OUT_OPTICAL_RAW)
    out_pixel = hit ? optical : none;
#elif defined(OUT_SHADOW)
    out_pixel = vec4(hit ? light_seen(here) : vec3(1.0), 1.0);
#elif defined(OUT_SHADOW_RAW)
    out_pixel = vec4(hit ? light_seen(here) : vec3(1.0), 1.0);
#elif defined(OUT_OCCLUSION)
    out_pixel = vec4(vec3(hit ? openness(here) : 1.0), 1.0);
#elif defined(OUT_OCCLUSION_RAW)
    out_pixel = vec4(hit ? openness(here) : 1.0);
#endif
}
