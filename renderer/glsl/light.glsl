/* SPDX-License-Identifier: MIT */
/* Second pass: light on what march.glsl found. Blinn-Phong, shadows, ambient occlusion, sky. */

layout(binding = 0) uniform sampler2D geometry;
layout(binding = 1) uniform usampler2D matter;
layout(binding = 2) uniform usampler2D more;

layout(location = 0) out vec4 out_color;

/* How much of a light reaches `from`, 0..1. The penumbra of a light of angular size 1/k follows
 * from the least distance-to-length ratio along the ray, taken between steps where the spheres of
 * two steps meet (Aaltonen: GPU-based clay simulation and ray-tracing tech in Claybook, GDC 2018;
 * Quilez: soft shadows in raymarched SDFs). */
float shadow(vec3 from, vec3 towards, float start, float reach, float k, bool hard, bool needed)
{
    float light = 1.0, t = start, before = 1e20;
    int steps = needed ? modes.w : 0;

    for (int i = zero; i < steps; i++) {
        float d = map(from + towards * t);
        float back = before < 1e19 ? d * d / (2.0 * before) : 0.0;
        float closest = sqrt(max(d * d - back * back, 0.0));
        light = min(light, k * closest / max(t - back, 1e-6));
        before = d;
        t += max(d, 0.25 * start);
        if (d < 1e-5 || light < 0.004 || t > reach) {
            light = d < 1e-5 ? 0.0 : light;
            break;
        }
    }
    light = clamp(light, 0.0, 1.0);
    light = hard ? step(0.02, light) : light * light * (3.0 - 2.0 * light);
    return needed ? light : 0.0;
}

/* Darkening where other surfaces are near: how much smaller than the distance from the surface the
 * field is, along the normal (Evans: Fast approximations for global illumination, SIGGRAPH 2006). */
float occlusion(vec3 p, vec3 n, float start, bool hit)
{
    const int samples = 5;
    float dark = 0.0, weight = 1.0, sum = 0.0;
    int count = hit ? samples : 0;

    for (int i = zero; i < count; i++) {
        float h = start + ground.w * float((i + 1) * (i + 1)) / float(samples * samples);
        float d = map(p + n * h);
        dark += weight * clamp((h - d) / h, 0.0, 1.0);
        sum += weight;
        weight *= 0.75;
    }
    return 1.0 - dark / max(sum, 1.0);
}

struct Incoming {
    vec3 direction; /* towards the light */
    vec3 color;
    float reach; /* distance to the light */
};

Incoming incoming(Light light, vec3 p)
{
    if (int(light.place.w) == LIGHT_DIRECTIONAL) {
        return Incoming(light.place.xyz, light.color.rgb, 1e9);
    }
    vec3 away = light.place.xyz - p;
    float r2 = max(dot(away, away), 1e-12), r = sqrt(r2);
    float fall = 1.0 / max(r2, light.extent.x * light.extent.x);
    if (light.extent.y > 0.0) {
        float x = r2 / (light.extent.y * light.extent.y);
        float window = clamp(1.0 - x * x, 0.0, 1.0);
        fall *= window * window;
    }
    return Incoming(away / r, light.color.rgb * fall, r);
}

vec3 lit(Ray ray, float t, vec3 n, Surface s, bool hit)
{
    float print = footprint(t);
    vec3 p = ray.origin + ray.direction * t;
    vec3 view = -ray.direction;
    vec3 from = p + n * (1.5 * print);
    float open = occlusion(p, n, 2.0 * print, hit);
    vec3 sum = s.emission + s.ambient * s.diffuse * sky_ambient(n) * open;

    for (int i = zero; i < modes.x; i++) {
        Incoming light = incoming(lights[i], p);
        float lambert = dot(n, light.direction);
        bool needed = hit && lambert > 0.0;
        float shade = 1.0;
        int kind = int(lights[i].extent.z);
        float far = light.reach - lights[i].extent.x;
        shade = shadow(from, light.direction, 2.0 * print, far, lights[i].color.w,
                       kind == SHADOW_HARD, needed && kind != SHADOW_NONE);
        shade = kind == SHADOW_NONE ? 1.0 : shade;
        vec3 halfway = normalize(light.direction + view);
        float gloss = pow(max(dot(n, halfway), 0.0), s.shininess) * (s.shininess + 8.0) / 8.0;
        vec3 reflected = s.diffuse + s.specular * gloss * 0.25;
        sum += needed ? light.color * reflected * (lambert * shade) : vec3(0.0);
    }
    return sum;
}

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec4 g = texelFetch(geometry, here, 0);
    Surface s = surface_unpack(texelFetch(matter, here, 0), texelFetch(more, here, 0));
    Ray ray = camera_ray(tile.xy * size.z + here);
    bool hit = g.w < INFINITY;
    vec3 color = lit(ray, hit ? g.w : 0.0, hit ? g.xyz : vec3(0.0, 1.0, 0.0), s, hit);

    out_color = vec4(hit ? color : sky(ray.direction), 1.0);
}
